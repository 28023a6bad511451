"""From a classification to its certificate, and to the file.

Source: singsym's own; the format is in `docs/certificates.md`.
"""

from __future__ import annotations

import gzip
import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from singsym.certificates.checker.balls import is_off_zero
from singsym.certificates.checker.sets import statement
from singsym.certificates.checker.table import Finding
from singsym.certificates.checker.verification import FORMAT
from singsym.certificates.prover.proof import WHOLE, Hints, prove
from singsym.classes.result import Classification, ClassResult, Piece
from singsym.classes.taxonomy.types import feasible_classes
from singsym.conditions.conditions import Conditions, conditions
from singsym.kinematics.reduction import reduce
from singsym.kinematics.velocity import VelocityEquation
from singsym.polynomials import Equations, Polynomial


@dataclass(frozen=True)
class Certificate:
    """The lines of a certificate: header, statement, and the proof."""

    lines: tuple[dict[str, Any], ...]

    def write(self, path: str | Path) -> Path:
        """Write JSON lines, compressed; raises `OSError`.  Equal certificates give equal files."""
        text = "".join(json.dumps(line, separators=(",", ":")) + "\n" for line in self.lines)
        target = Path(path)
        target.write_bytes(gzip.compress(text.encode(), mtime=0))
        return target


def certificate(result: Classification, seconds: float = WHOLE) -> Certificate:
    """The certificate of a classification, with a proof of as much of its table as is found in so much work.

    >>> from singsym.classes.classify import classify
    >>> from singsym.mechanism import load
    >>> made = certificate(classify(load("slider-crank"), cache=False))
    >>> made.lines[0]["claims"][0]
    {'types': 'RI, IO', 'occurs': True, 'dimension': 0, 'points': 2, 'components': 2}
    """
    name = result.mechanism.name if result.mechanism else "given equations"
    possible = {c.types for c in feasible_classes(result.equation.n)}
    data = statement_data(result.equation)
    about = statement(data)
    proof = prove(about, _hints(result, conditions(result.equation)), seconds)
    claims = [_claim(c, proof.curves) for c in result.classes if c.types in possible]
    return Certificate(({"format": FORMAT, "name": name, "claims": claims}, data, *proof.lines))


def statement_data(equation: VelocityEquation) -> dict[str, Any]:
    """The second line of a certificate: the velocity equation and the configuration space it is about."""
    space = equation.space
    relations = [r for r in space.ring.relations if r not in space.equations]
    return {
        "variables": list(space.ring.names),
        "constants": [[c.name, str(c.low), str(c.high)] for c in space.ring.constants],
        "equations": [str(e) for e in (*space.equations, *relations) if e],
        "exclusions": [[str(p) for p in group] for group in space.exclusions],
        "positive": [str(p) for p in space.positive],
        "nonnegative": [str(p) for p in space.nonnegative],
        "L": [[str(entry) for entry in row] for row in equation.matrix.rows],
        "roles": [column.role for column in equation.columns],
        "N": equation.N,
        "n": equation.n,
    }


def _claim(found: ClassResult, curves: Sequence[Finding]) -> dict[str, Any]:
    """A row of the table, as far as it is decided; curves: those of the proof."""
    occurs = None if found.verdict.is_undecided else found.verdict.is_yes
    row: dict[str, Any] = {"types": found.singularity_class.name, "occurs": occurs}
    if occurs:
        row |= {"dimension": found.dimension, "points": found.points, "components": found.components}
        if found.components is not None and (together := _together(found, curves)):
            row["together"] = together
    return row


def _together(found: ClassResult, curves: Sequence[Finding]) -> list[list[list[int]]]:
    """The loops of curves that a table counts together: those of one stratum, or of one image of it.

    Which these are is only seen in balls around points of them.
    """
    own = [curve for curve in curves if curve.types == {found.singularity_class.name}]
    left = [[curve.line, k] for curve in own for k in range(len(curve.components or ()))]
    by_line = {curve.line: curve for curve in own}
    groups: list[list[list[int]]] = []
    for piece in found.pieces if found.dimension == 1 else ():
        groups.append([loop for loop in left if _is_along(by_line[loop[0]], loop[1], piece)])
        left = [loop for loop in left if loop not in groups[-1]]
    return [loops for loops in groups if len(loops) > 1]


def _is_along(curve: Finding, place: int, piece: Piece) -> bool:
    """Whether a loop of a curve seems to lie in a piece, closed up, and not in what the piece leaves out."""
    points = [tube.start for tube in (curve.components or ())[place]]

    def lies_in(equations: Equations) -> bool:
        own = [e.value.project_to_context(curve.at.context) for e in equations]
        return not any(is_off_zero(e, point) for e in own for point in points)

    return lies_in(piece.basis) and not any(lies_in(group) for group in piece.exclusions)


def _hints(result: Classification, found: Conditions) -> Hints:
    """The loci of (4) and (5), their products, known configurations, and the order of a reduction."""
    names = result.equation.space.ring.names
    loci: dict[Polynomial, None] = {}
    products = []
    for label in ("4", "5"):
        product = result.equation.space.ring.one
        for factor in found[label].factors:
            loci[factor.polynomial] = None
            product = product * factor.polynomial**factor.multiplicity
        products.append(product)
    points = [
        tuple(float(witness.coordinates[name]) for name in names)
        for row in result.classes
        for witness in row.witnesses
    ]
    curves = any(row.components is not None and row.dimension == 1 for row in result.classes)
    places = {column.label: j for j, column in enumerate(result.equation.columns)}
    columns = tuple(places[label] for step in reduce(result.equation).record for label in step.columns)
    factors, determinants = (tuple(p.value for p in group) for group in (loci, products))
    return Hints(factors, determinants, tuple(points), curves, columns)
