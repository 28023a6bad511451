"""Certificates damaged at random: a claim, a line or one field of a rule is changed, not what it is about.

Each kind of damage is drawn as often as each other, and each field of each rule, so that none is only tried
where a certificate has much of it.

Source: fault injection; mutation testing (DeMillo, Lipton, Sayward 1978).
"""

from __future__ import annotations

import copy
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from random import Random
from typing import Any

from singsym.certificates.checker.rules import RULES
from singsym.certificates.checker.verification import LEAVES

Lines = list[dict[str, Any]]
KEPT = 2
"""Header and statement: of these only the claims are changed."""
TRIES = 20
"""So often a kind of damage is drawn until it changes something."""
Place = tuple[int | str, ...]
"""Where a value is: the number of a line, then keys and places inside."""


@dataclass(frozen=True)
class Damage:
    """Damaged lines, with the kind of damage; field: as `ranks point.radius`, or `line`, or `claims`."""

    lines: Lines
    kind: str
    field: str


def damaged(lines: Lines, random: Random) -> Damage:
    """The same lines but for one change."""
    kinds = random.sample(list(KINDS), len(KINDS))
    for kind in (kind for kind in kinds for _ in range(TRIES)):
        found = copy.deepcopy(lines)
        field = KINDS[kind](found, random)
        if field and found != lines:
            return Damage(found, kind, field)
    raise AssertionError("no kind of damage changes these lines")


# -- the table, and whole lines ------------------------------------------------------------------------


def _claim(lines: Lines, random: Random) -> str:
    row = random.choice(lines[0]["claims"])
    key = random.choice(("occurs", "dimension", "points", "components"))
    if key == "occurs":
        row[key] = not row[key]
    else:
        row |= {"occurs": True, key: random.randrange(6)}
    return "claims"


def _two(lines: Lines, random: Random) -> tuple[int, int]:
    return random.randrange(KEPT, len(lines)), random.randrange(KEPT, len(lines))


def _drop_line(lines: Lines, random: Random) -> str:
    del lines[_two(lines, random)[0]]
    return "line"


def _double_line(lines: Lines, random: Random) -> str:
    one, two = _two(lines, random)
    lines.insert(one, copy.deepcopy(lines[two]))
    return "line"


def _swap_lines(lines: Lines, random: Random) -> str:
    one, two = _two(lines, random)
    lines[one], lines[two] = lines[two], lines[one]
    return "line"


def _end_early(lines: Lines, random: Random) -> str:
    del lines[_two(lines, random)[0] :]
    return "line"


def _other_set(lines: Lines, random: Random) -> str:
    """What is shown of one set is said of another."""
    one, two = _two(lines, random)
    lines[one]["at"], lines[two]["at"] = lines[two]["at"], lines[one]["at"]
    return "line"


def _other_rule(lines: Lines, random: Random) -> str:
    lines[_two(lines, random)[0]]["rule"] = random.choice((*RULES, *LEAVES))
    return "line"


def _exchange_variables(lines: Lines, random: Random) -> str:
    """Two variables, in one line or in all of the proof."""
    if len(lines[1]["variables"]) < 2:
        return ""
    one, two = random.sample(lines[1]["variables"], 2)
    places = range(KEPT, len(lines)) if random.random() < 0.3 else [_two(lines, random)[0]]
    for place in places:
        lines[place] = _renamed(lines[place], {one: two, two: one})
    return "line"


def _renamed(value: Any, names: dict[str, str]) -> Any:
    if isinstance(value, dict):
        return {names.get(key, key): _renamed(inner, names) for key, inner in value.items()}
    if isinstance(value, list):
        return [_renamed(inner, names) for inner in value]
    return (
        re.sub(r"[A-Za-z_]\w*", lambda m: names.get(m[0], m[0]), value) if isinstance(value, str) else value
    )


# -- fields --------------------------------------------------------------------------------------------


def values(lines: Lines) -> Iterator[tuple[Place, str]]:
    """Each value of the proof with its field: the rule, and the keys on the way."""
    variables = {*lines[1]["variables"]}

    def inside(value: Any, place: Place, keys: tuple[str, ...]) -> Iterator[tuple[Place, str]]:
        if place[1:] not in ((), ("rule",)):
            yield place, ".".join(keys)
        if isinstance(value, dict):
            for key, part in value.items():
                yield from inside(part, (*place, key), (*keys, "variable" if key in variables else key))
        elif isinstance(value, list):
            for k, part in enumerate(value):
                yield from inside(part, (*place, k), keys)

    for number, line in enumerate(lines[KEPT:], KEPT):
        for place, field in inside(line, (number,), ()):
            yield place, f"{line['rule']} {field}"


def _inner(lines: Any, place: Place) -> Any:
    for key in place:
        lines = lines[key]
    return lines


def _field(lines: Lines, random: Random, suits: Callable[[Any], bool]) -> tuple[list[Place], str]:
    """The places of a field, drawn of all fields, that have a value of some kind; none where no field has."""
    fields: dict[str, list[Place]] = {}
    for place, field in values(lines):
        if suits(_inner(lines, place)):
            fields.setdefault(field, []).append(place)
    field = random.choice(sorted(fields)) if fields else ""
    return fields.get(field, []), field


def _changes(
    suits: Callable[[Any], bool], change: Callable[[Any, Random], Any]
) -> Callable[[Lines, Random], str]:
    """Damage of one value of a kind."""

    def apply(lines: Lines, random: Random) -> str:
        places, field = _field(lines, random, suits)
        if places:
            place = random.choice(places)
            _inner(lines, place[:-1])[place[-1]] = change(_inner(lines, place), random)
        return field

    return apply


def _exchange(lines: Lines, random: Random) -> str:
    """Two values of one field, from two places of the proof: minors, boxes, tubes, units of each other."""
    places, field = _field(lines, random, lambda value: value is not None)
    one, two = random.choice(places), random.choice(places)
    if one[: len(two)] == two or two[: len(one)] == one:
        return ""
    a, b = _inner(lines, one), _inner(lines, two)
    _inner(lines, one[:-1])[one[-1]], _inner(lines, two[:-1])[two[-1]] = b, a
    return field


def _copy_over(lines: Lines, random: Random) -> str:
    """One value of a field takes the place of another."""
    places, field = _field(lines, random, lambda value: value is not None)
    one, two = random.choice(places), random.choice(places)
    _inner(lines, one[:-1])[one[-1]] = copy.deepcopy(_inner(lines, two))
    return field


def _drop(lines: Lines, random: Random) -> str:
    places, field = _field(lines, random, lambda value: True)
    place = random.choice(places)
    del _inner(lines, place[:-1])[place[-1]]
    return field


def _add(lines: Lines, random: Random) -> str:
    """A field that another part of the proof has, or a claim that a rank is exact."""
    objects = [(place, field) for place, field in values(lines) if isinstance(_inner(lines, place), dict)]
    objects += [((number,), line["rule"]) for number, line in enumerate(lines[KEPT:], KEPT)]
    own, field = random.choice(objects)
    other = _inner(lines, random.choice(objects)[0])
    more = {key: value for key, value in other.items() if key not in _inner(lines, own)} | {"exact": True}
    key = random.choice(list(more))
    _inner(lines, own)[key] = copy.deepcopy(more[key])
    return field


def _entries(change: Callable[[list[Any], Random], Any]) -> Callable[[Lines, Random], str]:
    def whole(value: Any, random: Random) -> Any:
        change(value, random)
        return value

    return _changes(lambda value: isinstance(value, list) and bool(value), whole)


def _is_text(value: Any) -> bool:
    return isinstance(value, str) and any(c.isdigit() for c in value)


def _flip(text: str, random: Random) -> str:
    """The sign of one term."""
    terms = re.split(r" ([+-]) ", text)
    k = random.randrange(0, len(terms), 2)
    if k == 0:
        return terms[0].removeprefix("-") + text[len(terms[0]) :] if text.startswith("-") else f"-{text}"
    terms[k - 1] = "-" if terms[k - 1] == "+" else "+"
    return terms[0] + "".join(f" {part} " if i % 2 else part for i, part in enumerate(terms[1:], 1))


def _number_in(text: str, random: Random) -> str:
    """One number of a text: a coefficient, an exponent, a numerator or a denominator."""
    found = list(re.finditer(r"(?<![A-Za-z_\d])\d+", text))
    if not found:
        return text
    at = random.choice(found)
    old = int(at[0])
    new = random.choice((old + 1, abs(old - 1), 2 * old, random.randrange(10), int(str(old)[:-1] or 1)))
    return text[: at.start()] + str(new) + text[at.end() :]


def _whole(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


def _other_number(value: int, random: Random) -> int:
    return random.choice((value + 1, value - 1, 2 * value, 10 * value, value // 2, -value, 0))


def _wider(lines: Lines, random: Random) -> str:
    """A box of another size: its radius, or how far a tube goes."""
    boxes = list[tuple[Place, str]]()
    tubes = list[tuple[Place, str]]()
    for place, field in values(lines):
        value = _inner(lines, place)
        if field.endswith(".radius"):
            boxes.append((place, field))
        elif field.endswith("curve.loops") and len(place) == 5:
            tubes.append((place, field))
    chosen = random.choice([kind for kind in (boxes, tubes) if kind] or [[]])
    if not chosen:
        return ""
    place, field = random.choice(chosen)
    value, times = _inner(lines, place), random.choice((2, 10, 100, 1000))
    if isinstance(value, str):
        p, _, q = value.partition("/")
        wider = f"{p}/{int(q or 1) * times}" if random.random() < 0.2 else f"{int(p) * times}/{q or 1}"
        _inner(lines, place[:-1])[place[-1]] = wider
    elif random.random() < 0.5:
        value[5] *= times
    else:
        value[2] += (value[2] - value[1]) * times
    return field


def _of_another_kind(value: Any, random: Random) -> Any:
    return random.choice(([], {}, "x", "", None, True, -1, 0, 1e3, [[]], [value]))


def _permute(value: list[Any], random: Random) -> None:
    one, two = random.randrange(len(value)), random.randrange(len(value))
    value[one], value[two] = value[two], value[one]


KINDS: dict[str, Callable[[Lines, Random], str]] = {
    "another claim": _claim,
    "a line dropped": _drop_line,
    "a line doubled": _double_line,
    "lines swapped": _swap_lines,
    "ends early": _end_early,
    "sets exchanged": _other_set,
    "another rule": _other_rule,
    "variables exchanged": _exchange_variables,
    "a sign flipped": _changes(_is_text, _flip),
    "another coefficient": _changes(_is_text, _number_in),
    "another number": _changes(_whole, _other_number),
    "a box widened": _wider,
    "values exchanged": _exchange,
    "a value copied over": _copy_over,
    "a value dropped": _drop,
    "a value added": _add,
    "an entry dropped": _entries(lambda value, random: value.pop(random.randrange(len(value)))),
    "an entry doubled": _entries(lambda value, random: value.append(random.choice(value))),
    "entries swapped": _entries(_permute),
    "a bool turned": _changes(lambda value: isinstance(value, bool), lambda value, random: not value),
    "of another kind": _changes(lambda value: True, _of_another_kind),
}
