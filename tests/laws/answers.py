"""Two answers of one classification in different circumstances: what must not differ.

Source: the fields of `singsym classify --format json`; "undecided" and null are no answer.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

Answer = Mapping[str, Any]
"""What `output.plain_data.classification_data` gives, or the command line with `--format json`."""


def contradictions(one: Answer, two: Answer, *, same_names: bool = True) -> list[str]:
    """Numbers and verdicts that both answers decide, and differently; nothing where one just says less.

    same_names: whether variables have the same names in both, so that loci can be told by their factors.
    """
    found = []
    for first, second in zip(one["classes"], two["classes"], strict=True):
        name = ", ".join(first["types"])
        assert name == ", ".join(second["types"])
        found += _differing(name, first, second, ("verdict", "dimension", "points", "components"))
    for label in ("4", "5"):
        first, second = _union(one["loci"], label), _union(two["loci"], label)
        found += _differing(f"({label})", first, second, ("verdict", "dimension"))
    if same_names:
        known = {(locus["condition"], locus["factor"]): locus for locus in one["loci"]}
        for locus in two["loci"]:
            place = (locus["condition"], locus["factor"])
            if place in known:
                fields = ("verdict", "dimension", "points", "components")
                found += _differing(f"({place[0]}) {place[1]}", known[place], locus, fields)
    found += _differing("space", _space(one), _space(two), ("dimension", "smooth"))
    return found


def _differing(name: str, one: Answer, two: Answer, fields: Iterable[str]) -> list[str]:
    pairs = [(field, one[field], two[field]) for field in fields]
    return [
        f"{name}: {field} {x} and {y}" for field, x, y in pairs if x != y and not {x, y} & {None, "undecided"}
    ]


def _union(loci: Sequence[Answer], label: str) -> Answer:
    """The zero set of a whole condition, which does not depend on how it is written as factors."""
    own = [locus for locus in loci if locus["condition"] == label]
    dimensions = [locus["dimension"] for locus in own if locus["verdict"] != "no"]
    if not own or any(locus["verdict"] == "undecided" for locus in own):
        return {"verdict": None, "dimension": None}
    verdict = "yes" if dimensions else "no"
    return {"verdict": verdict, "dimension": None if None in dimensions else max(dimensions, default=-1)}


def _space(answer: Answer) -> Answer:
    """The largest dimension, and whether all is smooth; pieces may be told apart or not."""
    pieces = answer["configuration_space"]
    dimensions = [piece["dimension"] for piece in pieces]
    smooth = {piece["smooth"] for piece in pieces}
    return {
        "dimension": None if None in dimensions or not dimensions else max(dimensions),
        "smooth": smooth.pop() if len(smooth) == 1 else None,
    }
