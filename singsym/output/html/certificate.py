"""The certificate of a table on the report page: its lines in words, and which of them prove each class.

Source: singsym's own; the rules are those of `docs/certificates.md`.
"""

from __future__ import annotations

import gzip
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from html import escape
from pathlib import Path
from typing import Any

from singsym.certificates.checker.table import Row
from singsym.certificates.checker.verification import Verification, verify
from singsym.certificates.prover.writing import statement_data
from singsym.certificates.wording import TRUSTED, row_text
from singsym.classes.result import Classification, ClassResult
from singsym.output.pieces import counted

LONGEST = 120
"""Characters of a polynomial that are shown."""
Line = Mapping[str, Any]


@dataclass(frozen=True)
class Proof:
    """A certificate that was verified: the file's name, its lines from the third, and what they prove."""

    file: str
    lines: tuple[Line, ...]
    verified: Verification

    @classmethod
    def of(cls, classification: Classification, path: str | Path) -> Proof:
        """Read and verify the certificate of a classification.

        Raises `OSError`, and `ValueError` where it is rejected, or is about other equations.
        """
        verified = verify(path)
        if verified.data != statement_data(classification.equation):
            raise ValueError(f"{path} is about other equations than those of this classification")
        text = gzip.decompress(Path(path).read_bytes()).decode()
        lines = tuple(json.loads(line) for line in text.splitlines()[2:])
        return cls(Path(path).name, lines, verified)

    @cached_property
    def rows(self) -> dict[frozenset[str], Row]:
        """What is proven, by types."""
        return {frozenset(row.types.split(", ")): row for row in self.verified.proven}

    def row(self, result: ClassResult) -> Row | None:
        """What is proven of a class; None for one that the mobility forbids."""
        return self.rows.get(frozenset(result.types.names))

    def proving(self, row: Row) -> tuple[int, ...]:
        """The lines whose leaves may have the types of a row; 0 stands for sets that are left open."""
        found = (f.line for f in self.verified.findings if row.types in f.types and f.high >= 0)
        return tuple(dict.fromkeys(found))


def linked(proof: Proof, result: ClassResult) -> str:
    """Links to the lines that prove what is said of a class."""
    row = proof.row(result)
    if row is None:
        return ""
    if row.occurs is False:
        return '<a href="#certificate">all lines</a>'
    lines = [f'<a href="#line-{n}">line {n}</a>' for n in proof.proving(row) if n]
    return ", ".join(lines) or '<a href="#certificate">left open</a>'


def sentence(proof: Proof, result: ClassResult) -> str:
    """What the certificate proves of a class, with links, for its place among the proofs; "" for nothing."""
    row = proof.row(result)
    if row is None:
        return ""
    if row.occurs is None:
        return f"By the certificate it is not proven: {linked(proof, result)}."
    if row.occurs is False:
        return (
            'By the <a href="#certificate">certificate</a>: no leaf has these types, and no set is left open.'
        )
    said = row_text(row).removeprefix(f"{row.types}: ")
    return f"By the certificate: {escape(said)} ({linked(proof, result)})."


def certificate(proof: Proof) -> str:
    """The section with all lines in words."""
    verified = proof.verified
    whole = "proves the table in full" if verified.complete else "proves a part of the table"
    kept = f"<code>singsym verify {escape(proof.file)}</code> checks it without any search"
    parts = [
        f"<p>A certificate of {counted(len(proof.lines), 'step')} {whole}; {kept}. Set 0 is the whole "
        "configuration space; each line ends one set, or leads to others that have its points together.</p>"
    ]
    if verified.missing:
        items = "".join(f"<li>{escape(what)}</li>" for what in verified.missing)
        parts.append(f"<p>Not proven:</p><ul>{items}</ul>")
    from_line = {n: k for k, line in enumerate(proof.lines, 3) for n in line.get("into", ())}
    items = "".join(_item(proof, k, line, from_line) for k, line in enumerate(proof.lines, 3))
    trusted = "; ".join(map(escape, TRUSTED))
    return f'{"".join(parts)}<ol start="3">{items}</ol><p class="note">Taken on trust: {trusted}.</p>'


def _item(proof: Proof, number: int, line: Line, from_line: Mapping[int, int]) -> str:
    at, rule = line["at"], line["rule"]
    name = f'<a href="#line-{from_line[at]}">Set {at}</a>' if at in from_line else f"Set {at}"
    into = line.get("into", ())
    words = _WORDS.get(rule)
    said = words(line) if words else f"{escape(rule)}{f' leads to {_sets(into)}' if into else ''}"
    shown = _shown(proof, number, rule) if not into else ""
    return f'<li id="line-{number}">{name}: {said}{shown}.</li>'


def _shown(proof: Proof, number: int, rule: str) -> str:
    """What a leaf shows: types, numbers, dimensions."""
    said = []
    for found in proof.verified.findings:
        if found.line != number:
            continue
        types = " or ".join(f"({t})" if t else "regular" for t in sorted(found.types))
        if found.points is not None:
            said.append(f"{counted(found.points, 'real point')} {types}")
            continue
        bounds = f"dimension {found.high}" if found.low == found.high else f"dimension at most {found.high}"
        parts = "" if found.components is None else f", {counted(len(found.components), 'component')}"
        said.append(f"{types}, {bounds}{parts}")
    said = said or ["none of them real and allowed"] * (rule == "points")
    return f": {'; '.join(said)}" if said else ""


def _sets(numbers: Any) -> str:
    return " and ".join(f"set {n}" for n in numbers)


def _polynomial(text: str) -> str:
    cut = text if len(text) <= LONGEST else f"{text[:LONGEST].rpartition(' ')[0]} …"
    return f"<code>{escape(cut)}</code>"


def _split(line: Line) -> str:
    zero, other = line["into"]
    return f"{_polynomial(line['by'])} is zero in set {zero}, and not zero in set {other}"


def _derive(line: Line) -> str:
    equations, steps = counted(len(line["equations"]), "equation"), counted(len(line["steps"]), "step")
    return f"{equations} with the same zeros, by {steps}: {_sets(line['into'])}"


def _cancel(line: Line) -> str:
    return (
        f"{_polynomial(line['polynomial'])} is zero, as a product of it with what vanishes nowhere is in the "
        f"ideal: {_sets(line['into'])}"
    )


def _squares(line: Line) -> str:
    zero = ", ".join(_polynomial(polynomial) for _, polynomial in line["terms"])
    return f"{zero} are zero, as a sum of their squares is in the ideal: {_sets(line['into'])}"


def _rows(line: Line) -> str:
    places = ", ".join(str(k + 1) for k in line["rows"])
    what = f"rows {places} of L are combined by a matrix with a determinant that vanishes nowhere"
    return f"{what}: {_sets(line['into'])}"


def _pivot(line: Line) -> str:
    what = f"row {line['row'] + 1} and column {line['column'] + 1} of L go by a pivot that vanishes nowhere"
    return f"{what}: {_sets(line['into'])}"


_WORDS: dict[str, Callable[[Line], str]] = {
    "split": _split,
    "derive": _derive,
    "cancel": _cancel,
    "pivot": _pivot,
    "rows": _rows,
    "squares": _squares,
    "empty": lambda line: "no points, as one of its equations is a number that is not zero",
    "points": lambda line: "finitely many points, all known",
    "ranks": lambda line: "its ranks are known",
    "open": lambda line: f"left open: {escape(str(line.get('why', '')))}",
}
