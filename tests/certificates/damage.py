"""Certificates damaged at random: one number, word, line or entry is changed, and what it is about is not.

Source: fault injection.
"""

from __future__ import annotations

import copy
import json
from random import Random
from typing import Any

Lines = list[dict[str, Any]]
KEPT = 2
"""Header and statement: of these only the claims are changed."""


def damaged(lines: Lines, random: Random) -> Lines:
    """The same lines but for one change."""
    found = copy.deepcopy(lines)
    if random.random() < 0.15:
        _claim_otherwise(found[0]["claims"], random)
        return found
    place = random.randrange(KEPT, len(found))
    kind = random.randrange(4)
    if kind == 0:
        del found[place]
    elif kind == 1 and len(found) > KEPT + 1:
        other = random.randrange(KEPT, len(found))
        found[place], found[other] = found[other], found[place]
    elif kind == 2:
        found.insert(place, copy.deepcopy(found[random.randrange(KEPT, len(found))]))
    else:
        _change(found[place], random)
    return found


def _claim_otherwise(claims: Lines, random: Random) -> None:
    row = random.choice(claims)
    key = random.choice(("occurs", "dimension", "points", "components"))
    if key == "occurs":
        row[key] = not row[key]
    else:
        row |= {"occurs": True, key: random.randrange(6)}


def _change(value: Any, random: Random) -> None:
    """One entry deep inside an object or a list is changed."""
    places = list(value) if isinstance(value, dict) else list(range(len(value)))
    place = random.choice(places) if places else None
    if place is None:
        if isinstance(value, list):
            value.append(0)
        return
    inner = value[place]
    if isinstance(inner, (dict, list)) and inner and random.random() < 0.85:
        _change(inner, random)
    elif random.random() < 0.15:
        del value[place]
    else:
        value[place] = _other(inner, random)


def _other(value: Any, random: Random) -> Any:
    if isinstance(value, bool) or value is None:
        return not value
    if isinstance(value, int):
        return random.choice((value + 1, value - 1, 2 * value, -value, 0))
    if isinstance(value, str) and value:
        k = random.randrange(len(value))
        sign = "+" if value[k] == "-" else "-" if value[k] == "+" else str(random.randrange(10))
        return value[:k] + sign + value[k + 1 :]
    return random.choice(([], {}, "x", -1, json.loads("1e3")))
