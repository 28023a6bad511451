"""Where the singularities of a mechanism lie, as sets of polynomials that vanish together.

Source: conditions (4), (5), (iii) and (vi) of Zlatanov, Fenton, Benhabib (1998): every singularity is on (4)
or (5), those with RPM on (iii), those with IIM on (vi).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from singsym.conditions.factor import Factor
from singsym.kinematics.velocity import VelocityEquation
from singsym.polynomials import Polynomial

_MATRIX = {"4": "L_I", "5": "L_O", "iii": "L_p", "vi": "L"}


@dataclass(frozen=True)
class SingularLocus:
    """One way to satisfy a condition: its factors vanish together.

    label: of the condition; bounds: by how much ranks are at least below full where the factors vanish.
    """

    label: str
    factors: tuple[Factor, ...]

    @property
    def bounds(self) -> dict[str, int]:
        """The matrix that loses rank, by one at least."""
        return {_MATRIX[self.label]: 1}

    @property
    def polynomials(self) -> tuple[Polynomial, ...]:
        """The factors' polynomials."""
        return tuple(f.polynomial for f in self.factors)

    @property
    def words(self) -> str:
        """What vanishes, in words where the factors were recognised."""
        return " and ".join(f.words or f"{f.polynomial.short_text(4)} = 0" for f in self.factors)


def singular_loci(equation: VelocityEquation) -> Iterator[SingularLocus]:
    """Those that are written out, as `unwritten` says of the others."""
    for label in _MATRIX:
        for alternative in equation.conditions[label].alternatives or ():
            yield SingularLocus(label, alternative)


def unwritten(equation: VelocityEquation) -> tuple[str, ...]:
    """The conditions whose loci are not known as polynomials; those that hold everywhere among them."""
    found = (equation.conditions[label] for label in _MATRIX)
    return tuple(c.label for c in found if c.alternatives is None or c.everywhere)


def determinant_loci(equation: VelocityEquation) -> tuple[tuple[SingularLocus, ...], tuple[str, ...]]:
    """The loci of (4) and (5) that are one equation each; the conditions of these that are not so written."""
    factors = determinant_factors(equation)
    own = [l for l in singular_loci(equation) if factors.get(l.label) is not None]
    return tuple(own), tuple(label for label, found in factors.items() if found is None)


def determinant_factors(equation: VelocityEquation) -> Mapping[str, Sequence[Polynomial] | None]:
    """The factors of (4) and (5); None where they are not single polynomials."""
    found: dict[str, Sequence[Polynomial] | None] = {}
    for label in ("4", "5"):
        condition = equation.conditions[label]
        plain = condition.alternatives is not None and all(len(a) == 1 for a in condition.alternatives)
        written = plain and not condition.everywhere
        found[label] = [f.polynomial for f in condition.factors] if written else None
    return found
