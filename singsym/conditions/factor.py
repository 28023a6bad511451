"""A factor of a condition, as a polynomial and as what it says of named points and axes.

Source: Zlatanov, Fenton, Benhabib (1998), sections 3 and 4, print conditions as products of such factors.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

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
        """The same, and the values of the joint that alone is in it."""
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
        scale = polynomial_latex(self.name.scale, SHORT)
        if len(self.name.scale) > 1:
            scale = rf"\left({scale}\right)"
        root = rf"\sqrt{{{self.name.radicand}}}" if self.name.radicand != 1 else ""
        outer = r"\, ".join(part for part in (scale, root) if part not in ("", "1"))
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
            shown = _text(self._multiple or self.polynomial, longest)
            return f"{self.name.quantity.text} = {shown}" if self.name else shown
        scale = _text(self.name.scale, longest)
        if len(self.name.scale) > 1:
            scale = f"({scale})"
        root = f"sqrt({self.name.radicand})" if self.name.radicand != 1 else ""
        outer = [part for part in (scale, root) if part not in ("", "1")]
        shown = _text(self.polynomial, longest)
        whole = "*".join((*outer, f"({shown})" if len(self.polynomial) > 1 else shown))
        return f"{self.name.quantity.text} = {whole}"

    @cached_property
    def _multiple(self) -> Polynomial | None:
        """What the named quantity is as one polynomial, where that is as short as a product."""
        if self.name is None or self.name.radicand != 1 or not self.name.scale.is_constant:
            return None
        unit = abs(self.name.scale.constant) == 1
        return self.polynomial * self.name.scale if unit or len(self.polynomial) == 1 else None

    def __str__(self) -> str:
        return f"{self.text()}  ({self.words})" if self.words else self.text()


def _text(polynomial: Polynomial, longest: int | None) -> str:
    return str(polynomial) if longest is None else polynomial.short_text(longest)
