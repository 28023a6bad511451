"""What a classification tells while it goes on: conditions first, then classes as their points are found.

Source: singsym's own.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from singsym.classes.realisation.looks import known_dimensions
from singsym.classes.realisation.realisation import Realised
from singsym.classes.taxonomy.types import SingularityType, class_of
from singsym.classes.unit_border import Border
from singsym.conditions.conditions import Condition, Conditions
from singsym.effort.progress import report_finding

LONGEST = 4
"""Polynomials without a name are cut after so many terms."""


def tell_conditions(inside: Conditions, border: Border) -> None:
    """Report where (4) and (5) hold, on whose loci all singular configurations lie."""
    for label in ("4", "5"):
        report_finding(f"({label})", _words(inside[label], border))


def _words(condition: Condition, border: Border) -> str:
    if condition.everywhere:
        return "in every configuration"
    if condition.alternatives is None:
        return "where a rank drops"
    factors = [
        f.words or f"{border.polynomial(f.polynomial).short_text(LONGEST)} = 0" for f in condition.factors
    ]
    return "; or ".join(factors) or "in no configuration"


@dataclass
class Told:
    """The largest dimension of each class that was reported."""

    dimensions: dict[SingularityType, int] = field(default_factory=dict)

    def take(self, part: Realised) -> None:
        """Report what is new in the pieces of a stratum."""
        for types, dimension in known_dimensions(part.pieces).items():
            own = class_of(types)
            if own is None or dimension <= self.dimensions.get(types, -1):
                continue
            self.dimensions[types] = dimension
            size = f", dimension {dimension} at least" if dimension else ""
            report_finding(f"{own}", f"occurs{size}")
