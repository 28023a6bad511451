"""A factor of a condition, as a polynomial and as what it says of named points and axes.

Source: Zlatanov, Fenton, Benhabib (1998), sections 3 and 4, print conditions as products of such factors.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import prod

from singsym.conditions.incidences.joint_values import JointRoots
from singsym.conditions.named_quantities import GeometricName, PointNames
from singsym.polynomials import Polynomial
from singsym.polynomials.latex import polynomial_latex

SHORT = 6
"""A factor before a determinant's polynomial is cut, in LaTeX, after so many terms."""


@dataclass(frozen=True)
class Factor:
    """A polynomial whose vanishing is one way to satisfy a condition, with its name if it has one.

    said: what its vanishing says of the named points, where it has no name; joint: where only one is in it.
    """

    polynomial: Polynomial
    multiplicity: int = 1
    name: GeometricName | None = None
    said: str = ""
    joint: JointRoots | None = None

    @classmethod
    def named(cls, polynomial: Polynomial, multiplicity: int, names: PointNames) -> Factor:
        """A polynomial with the name that it has, and the values of the joint that alone is in it."""
        return cls(polynomial, multiplicity, names.recognise(polynomial), joint=names.joint_roots(polynomial))

    @property
    def incidence(self) -> str:
        """What its vanishing says of the named points; empty where it was not recognised."""
        return self.name.quantity.words if self.name else self.said

    @property
    def words(self) -> str:
        """The same, or else the values of the joint that alone is in it."""
        return self.incidence or (self.joint.words if self.joint else "")

    @property
    def explained(self) -> str:
        """All that its vanishing says: of the named points, and of the joint that alone is in it."""
        return "; ".join(part for part in (self.incidence, self.joint.words if self.joint else "") if part)

    @property
    def is_plain(self) -> bool:
        """Whether it has no name, or is up to its sign the quantity that it is called."""
        if self.name is None:
            return True
        scale = self.name.scale
        return self.name.radicand == 1 and scale.is_constant and abs(scale.constant) == 1

    def written_as(self, other: Polynomial, name: GeometricName | None) -> Factor:
        """The same with another polynomial, a multiple of this one by a number, and what that is called.

        >>> from singsym.conditions.incidences.quantities import Quantity
        >>> from singsym.polynomials import Ring
        >>> x, g = Ring(("x", "g")).gens
        >>> name = GeometricName(Quantity("q", "q", "A, B, C collinear"), x.ring.one)
        >>> print(Factor(x + 4, name=name).written_as(x + g, None))
        x + g  (A, B, C collinear)
        """
        joint = self.joint.written_as(other) if self.joint else None
        return Factor(other, self.multiplicity, name, self.incidence, joint)

    def latex(self, longest: int = 24) -> str:
        """The polynomial, cut where it is long; what a named quantity is on the configuration space."""
        if self.name is None or self._multiple is not None:
            shown = polynomial_latex(self._multiple or self.polynomial, longest)
            return f"{self.name.quantity.latex} = {shown}" if self.name else shown
        root = rf"\sqrt{{{self.name.radicand}}}" if self.name.radicand != 1 else ""
        parts = [_in_brackets(polynomial_latex(f, SHORT), f, r"\left(", r"\right)") for f in self._scale]
        outer = r"\, ".join(part for part in (*parts, root) if part not in ("", "1"))
        return rf"{self.name.quantity.latex} = {outer}({polynomial_latex(self.polynomial, longest)})"

    def text(self, longest: int | None = None) -> str:
        r"""The same as plain text; longest: terms before polynomials are cut, None for no cut.

        >>> from singsym.conditions.incidences.quantities import Quantity
        >>> from singsym.polynomials import Ring
        >>> R = Ring(("x", "y"))
        >>> x, y = R.gens
        >>> name = GeometricName(Quantity(r"u \cdot v", "u.v", "axes u and v perpendicular"), R.constant(3))
        >>> print(Factor(x + y, name=name), Factor(x + y, name=name).latex())
        u.v = 3*(x + y)  (axes u and v perpendicular) u \cdot v = 3(x + y)
        """
        if self.name is None or self._multiple is not None:
            shown = (self._multiple or self.polynomial).short_text(longest)
            return f"{self.name.quantity.text} = {shown}" if self.name else shown
        root = f"sqrt({self.name.radicand})" if self.name.radicand != 1 else ""
        parts = [_in_brackets(f.short_text(longest), f) for f in self._scale]
        outer = [part for part in (*parts, root) if part not in ("", "1")]
        whole = "*".join((*outer, _in_brackets(self.polynomial.short_text(longest), self.polynomial)))
        return f"{self.name.quantity.text} = {whole}"

    @property
    def _scale(self) -> tuple[Polynomial, ...]:
        """The scale of the name as a number and polynomials without common factors of terms."""
        if self.name is None:
            return ()
        factors = [f for f, k in self.name.scale.factors() for _ in range(k)]
        product = prod(factors, start=self.name.scale.ring.one)
        number = self.name.scale.exact_quotient(product)
        single = [f for f in factors if len(f) == 1]
        monomial = prod(single, start=number)
        return (monomial, *(f for f in factors if len(f) > 1))

    @cached_property
    def _multiple(self) -> Polynomial | None:
        """What the named quantity is as one polynomial, where that is as short as a product."""
        if self.name is None or self.name.radicand != 1 or not self.name.scale.is_constant:
            return None
        unit = abs(self.name.scale.constant) == 1
        return self.polynomial * self.name.scale if unit or len(self.polynomial) == 1 else None

    def __str__(self) -> str:
        return f"{self.text()}  ({self.explained})" if self.explained else self.text()


def _in_brackets(shown: str, polynomial: Polynomial, left: str = "(", right: str = ")") -> str:
    """A polynomial as a factor of a product."""
    return f"{left}{shown}{right}" if len(polynomial) > 1 else shown
