"""A certificate, from file to the table that it proves.

Source: singsym's own; the format is in `docs/certificates.md`.
"""

from __future__ import annotations

import gzip
import json
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path
from typing import Any

from singsym.certificates.checker.curves import components, meetings
from singsym.certificates.checker.points import points
from singsym.certificates.checker.polynomials import Rejected
from singsym.certificates.checker.ranks import bounds_on, is_possible, possible_types, types_of
from singsym.certificates.checker.rules import RULES
from singsym.certificates.checker.sets import (
    RealSet,
    Statement,
    chosen,
    listed,
    named,
    statement,
    whole_number,
)
from singsym.certificates.checker.strata import dimension_above, dimension_below, dimension_within
from singsym.certificates.checker.table import Finding, Row, claimed_rows, proven_row, unproven

FORMAT = "singsym certificate 3"
LEAVES = ("empty", "points", "ranks", "open")


@dataclass(frozen=True)
class Verification:
    """What a certificate proves.

    name: of the mechanism, as the certificate says; proven: one row for the types of each class; claimed:
    what the certificate says it proves; missing: what of that it does not, with the reason; rules: how often
    each was used; data: the statement that all this is about; findings: what leaves and open sets show;
    trusted: what was not checked.
    """

    name: str
    proven: tuple[Row, ...]
    claimed: tuple[Row, ...]
    missing: tuple[str, ...]
    rules: Mapping[str, int]
    data: Mapping[str, Any]
    findings: tuple[Finding, ...]

    @property
    def complete(self) -> bool:
        """Whether all of the table is proven."""
        return not self.missing


def verify(path: str | Path) -> Verification:
    """Check a certificate, without any search.

    Raises `Rejected`, a `ValueError`, with the line, for a file that is no certificate, or of which a step
    is wrong or a claim disproven; `OSError` where it cannot be read.
    """
    header, data, *lines = _lines(Path(path))
    number = 1
    try:
        if header.get("format") != FORMAT or not isinstance(header.get("name"), str):
            raise Rejected(f"expected a file of the format {FORMAT!r}")
        claims = claimed_rows(header)
        number = 2
        about = statement(data)
        proof = _Proof(about)
        for number, line in enumerate(lines, 3):
            proof.add(number, line)
    except Rejected as error:
        raise Rejected(f"line {number}: {error}") from None
    findings = proof.findings()
    together = {claim.types: claim.together for claim in claims}
    proven = tuple(proven_row(types, findings, together.get(types, ())) for types in all_types(about))
    missing = tuple(_missing(claims, proven, proof))
    return Verification(header["name"], proven, claims, missing, proof.rules, data, tuple(findings))


def _lines(path: Path) -> list[dict[str, Any]]:
    """The lines of a file; raises `Rejected`."""
    written = path.read_bytes()
    try:
        lines = [json.loads(line) for line in gzip.decompress(written).decode().splitlines()]
    except Exception as error:  # of damaged bytes, whatever it is
        raise Rejected(f"{path}: expected JSON lines, compressed by gzip: {error}") from None
    if len(lines) < 2 or not all(isinstance(line, dict) for line in lines):
        raise Rejected(f"{path}: expected lines of the format {FORMAT!r}, each an object")
    return lines


class _Proof:
    """The tree under way: the sets that are not taken apart yet, by their numbers, and the leaves."""

    def __init__(self, about: Statement) -> None:
        self.about = about
        self.open: dict[int, RealSet] = {0: about.whole}
        self.why: dict[int, str] = {}
        self.seen = {0}
        self.done: list[Finding] = []
        self.rules: Counter[str] = Counter()

    def add(self, number: int, line: Mapping[str, Any]) -> None:
        """One more line; raises `Rejected` where it is wrong."""
        place, rule = whole_number(line, "at"), line.get("rule")
        if place not in self.open:
            raise Rejected(f"there is no set {place}, or it was taken apart before")
        if rule in RULES:
            parts, numbers = RULES[rule](self.open[place], line), listed(line, "into", int)
            if len(numbers) != len(parts) or len({*numbers}) < len(parts) or self.seen & {*numbers}:
                raise Rejected(f"into: expected {len(parts)} new numbers, got {numbers}")
            self.open.update(zip(numbers, parts, strict=True))
            self.seen.update(numbers)
        elif rule == "open":
            self.why[place] = str(line.get("why", ""))
            self.rules["open"] += 1
            return
        elif rule in LEAVES:
            found = _leaf(self.open[place], self.about, line, self.done)
            self.done += [replace(finding, line=number) for finding in found]
        else:
            raise Rejected(f"rule: expected one of {', '.join((*RULES, *LEAVES))}, got {str(rule)[:80]}")
        del self.open[place]
        self.rules[rule] += 1

    def findings(self) -> list[Finding]:
        """What the leaves show; nothing is known of sets that are still open but their dimension."""
        types = frozenset(all_types(self.about))
        doubts = [Finding(at, types, None, -1, max(0, dimension_above(at))) for at in self.open.values()]
        return [*self.done, *doubts]


def _leaf(at: RealSet, about: Statement, line: Mapping[str, Any], before: Sequence[Finding]) -> list[Finding]:
    if line["rule"] == "empty":
        f = chosen(at.equations, [line.get("equation")], "equation")[0]
        if not f or not f.is_constant():
            raise Rejected("the set is not seen to be empty")
        return []
    if line["rule"] == "points":
        return [Finding(at, frozenset([t]), k, 0, 0, zero=f) for t, k, f in points(at, about, line)]
    types = possible_types(bounds_on(at, about, named(line, "ranks")), about.n)
    if not types:
        raise Rejected("no defects are possible: N and n are not those of L")
    low = dimension_below(at, named(line, "point")) if "point" in line else -1
    high = dimension_within(at, named(line, "dimension")) if "dimension" in line else dimension_above(at)
    if "curve" not in line:
        return [Finding(at, types, None, low, high)]
    data = named(line, "curve")
    loops = components(at, {**named(line, "point", {}), **data})
    if not loops:
        return []
    joins, curves = {}, {f.line: (f.at, f.components) for f in before if f.components}
    for entry in listed(data, "meets", dict, []):
        number = whole_number(entry, "line")
        if number not in curves:
            raise Rejected("meets: expected the line of a curve before")
        joins[number] = meetings((at, loops), curves[number], entry)
    return [Finding(at, types, None, low, high, loops, joins=joins)]


def all_types(about: Statement) -> list[str]:
    """The types that configurations of this mobility can have, but for none."""
    # lowering all four defects by one keeps the types while delta, p > 1; |delta - p| <= n
    few, more = range(about.n + 2), range(2 * about.n + 2)
    found = {types_of(d) for d in product(few, few, more, more) if is_possible(d, about.n)}
    return sorted(filter(None, found), key=lambda types: (len(types), types))


def _missing(claims: tuple[Row, ...], proven: tuple[Row, ...], proof: _Proof) -> Iterator[str]:
    by_types = {row.types: row for row in proven}
    listed_types = [claim.types for claim in claims]
    if len(set(listed_types)) < len(claims) or set(listed_types) - set(by_types):
        raise Rejected("claims: expected a row for each types that there can be, each once")
    for claim in claims:
        yield from (f"{claim.types}: {what}" for what in unproven(claim, by_types[claim.types]))
    yield from (f"{types}: no row of the claims" for types in by_types if types not in listed_types)
    for place in proof.open:
        yield f"set {place} is left open: {proof.why.get(place, 'the certificate ends before')}"
