"""Factors of conditions recognised as determinants of named points and axes.

Source: section 4.1 of Zlatanov, Fenton, Benhabib (1998): conditions are linear dependences of screws; a
3x3 determinant of planar screws vanishes where their points are collinear, section 3.3.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import combinations, islice
from math import prod

import sympy
from flint import fmpq

from singsym.conditions.incidences.grassmann_cayley import Vector, determinant, minus
from singsym.conditions.incidences.incidences import Incidences
from singsym.conditions.incidences.joint_values import JointRoots, joint_roots
from singsym.conditions.incidences.quantities import Quantity, arrow, symbol
from singsym.kinematics.nonzero import Certifier
from singsym.kinematics.placement import cross, dot
from singsym.polynomials import Polynomial

MANY = 5000
"""Not more than this many combinations of names are tried in space."""


_Candidates = tuple[tuple[Polynomial, Polynomial, Quantity], ...]
"""Of each quantity its primitive form, by which it is found, and its value."""


@dataclass(frozen=True)
class GeometricName:
    """What a factor is called: on the configuration space the quantity is sqrt(`radicand`) `scale` times it.

    scale: a polynomial without a feasible zero, mostly a constant; radicand: a whole number.
    """

    quantity: Quantity
    scale: Polynomial
    radicand: int = 1


def _ratio(a: Polynomial, b: Polynomial) -> fmpq:
    """The rational number that one polynomial is of another with the same primitive form."""
    return a.leading_term[1] / b.leading_term[1]


@dataclass(frozen=True, eq=False)
class PointNames:
    """Recognises polynomials as determinants of a configuration space's named points and axes.

    A name is given only where the determinant is the polynomial times a factor proved nonzero, on the circles
    and spheres of the configuration space, or a number of times it up to rational multiples of all equations;
    the name carries that factor.  What the mechanism's architecture suggests is tried first.

    >>> from singsym.kinematics.placement import ConfigurationSpace
    >>> from singsym.polynomials import Ring
    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> points = {"A": (R.zero, R.zero), "B": (R.one, R.one), "C": (x, y)}
    >>> found = PointNames(Certifier(ConfigurationSpace(R, (), points=points))).recognise(2 * x - 2 * y)
    >>> found.quantity.words, found.scale
    ('A, B, C collinear', -1/2)
    """

    certifier: Certifier
    incidences: Incidences | None = None

    @property
    def _points(self) -> dict[str, Vector]:
        return self.certifier.space.places

    def recognise(self, polynomial: Polynomial) -> GeometricName | None:
        """The name of a factor; None where none of the determinants of named points is it."""
        own = self.certifier.normal_form(polynomial)
        wanted = own.primitive()
        for lengths, values in self._kinds():
            # of a long polynomial a square is very long
            square = self.certifier.normal_form(wanted * wanted).primitive() if lengths else None
            for key, value, quantity in lengths:
                if key == square and (name := self._as_length(quantity, value, own)) is not None:
                    return name
            for key, value, quantity in values:
                if key == wanted:
                    return GeometricName(quantity, polynomial.ring.constant(_ratio(value, own)))
            for _, value, quantity in values:
                if wanted.divides(value):
                    scale = value.exact_quotient(own)
                    if self.certifier.reason(scale) is not None:
                        return GeometricName(quantity, scale)
        form = self.certifier.modulo_multiples(own)
        if (known := self._by_remainders.get(form.primitive())) is None:
            return None
        value, quantity = known
        return GeometricName(quantity, polynomial.ring.constant(_ratio(value, form)))

    @cached_property
    def _by_remainders(self) -> dict[Polynomial, tuple[Polynomial, Quantity]]:
        """The remainders of values modulo multiples of the loop equations, by their primitive forms."""
        found: dict[Polynomial, tuple[Polynomial, Quantity]] = {}
        for _, values in self._kinds():
            for _, value, quantity in values:
                form = self.certifier.modulo_multiples(value)
                if not form.is_constant:
                    found.setdefault(form.primitive(), (form, quantity))
        return found

    def _kinds(self) -> Iterator[tuple[_Candidates, _Candidates]]:
        """What the architecture suggests, and then, where that is not enough, all determinants of points."""
        yield self._suggested
        yield self._own

    def called(self, polynomial: Polynomial, quantity: Quantity) -> GeometricName | None:
        """How many times a polynomial a quantity is; None where it is no multiple, or not known here."""
        own = self.certifier.normal_form(polynomial)
        for lengths, values in self._kinds():
            for _, value, known in lengths:
                if known.text == quantity.text:
                    return self._as_length(quantity, value, own)
            for _, value, known in values:
                if known.text == quantity.text and own.divides(value):
                    return GeometricName(quantity, value.exact_quotient(own))
        return None

    def _as_length(self, quantity: Quantity, value: Polynomial, own: Polynomial) -> GeometricName | None:
        """A length with this square as a multiple of a polynomial; None where it is none."""
        square = self.certifier.normal_form(own * own)
        if not square.divides(value):
            return None
        ratio = value.exact_quotient(square)
        if any(multiplicity % 2 for _, multiplicity in ratio.factors()):
            return None
        root = prod((f ** (k // 2) for f, k in ratio.factors()), start=own.ring.one)
        number = ratio.exact_quotient(root * root).constant
        coefficient, radical = sympy.sqrt(sympy.Rational(int(number.p), int(number.q))).as_coeff_Mul()
        scale = root * Fraction(int(coefficient.p), int(coefficient.q))
        return GeometricName(quantity, scale, int(radical**2))

    def joint_roots(self, polynomial: Polynomial) -> JointRoots | None:
        """The joint that alone is in a factor, with the values where it vanishes; else None."""
        values = self.incidences.equation.values if self.incidences else {}
        return joint_roots(polynomial, values)

    @cached_property
    def _suggested(self) -> tuple[_Candidates, _Candidates]:
        """What the architecture suggests: squares of lengths, and values."""
        if self.incidences is None:
            return (), ()
        return self._normal(self.incidences.squares()), self._normal(self.incidences.values())

    @cached_property
    def _own(self) -> tuple[_Candidates, _Candidates]:
        """Squared distances in space, whose root a polynomial may be, and determinants and products."""
        dimension = len(next(iter(self._points.values()), ()))
        if dimension == 2:
            return (), self._normal(self._planar())
        if dimension == 3:
            squares = ((dot(vector, vector), quantity) for vector, quantity in self._on_lines())
            return self._normal(squares), self._normal(self._spatial())
        return (), ()

    def _normal(self, source: Iterable[tuple[Polynomial, Quantity]]) -> _Candidates:
        """Primitive and normal forms of those that are not constant."""
        found = ((self.certifier.normal_form(value), quantity) for value, quantity in source)
        return tuple((v.primitive(), v, quantity) for v, quantity in found if not v.is_constant)

    def _planar(self) -> Iterator[tuple[Polynomial, Quantity]]:
        for names in combinations(sorted(self._points), 3):
            p, q, r = (self._points[name] for name in names)
            a, b = minus(q, p), minus(r, p)
            yield a[0] * b[1] - a[1] * b[0], _determinant(names, "collinear")

    def _on_lines(self) -> Iterator[tuple[Vector, Quantity]]:
        """Vectors that vanish where three points are in line, or a point is on an axis through another."""
        names = sorted(self._points, key=lambda n: (sum(map(len, self._points[n])), n))
        axes = {n: tuple(v) for n, v in sorted(self.certifier.space.directions.items())}
        for triple in islice(combinations(names, 3), MANY // 10):
            first, *others = (self._points[name] for name in triple)
            a, b = (minus(other, first) for other in others)
            if sum(len(e) for e in (*a, *b)) < 24:
                p, q, r = triple
                latex = r" \times ".join(arrow(p, x) for x in (q, r))
                words = f"{', '.join(sorted(triple))} collinear"
                yield cross(a, b), Quantity(rf"\pm|{latex}|", f"±|{p}{q} x {p}{r}|", words)
        for base, other in islice(combinations(names, 2), MANY // 10):
            arm = minus(self._points[other], self._points[base])
            for u, axis in axes.items():
                if sum(len(e) for e in (*arm, *axis)) < 24:
                    latex = rf"{arrow(base, other)} \times {symbol(u)}"
                    words = f"{other} on the axis {u} through {base}"
                    yield (
                        cross(arm, axis),
                        Quantity(rf"\pm|{latex}|", f"±|{base}{other} x {u}|", words),
                    )

    def _spatial(self) -> Iterator[tuple[Polynomial, Quantity]]:
        count = 0
        axes = {n: tuple(v) for n, v in sorted(self.certifier.space.directions.items())}
        for u, v in combinations(axes, 2):
            latex = rf"{symbol(u)} \cdot {symbol(v)}"
            yield dot(axes[u], axes[v]), Quantity(latex, f"{u}.{v}", f"axes {u} and {v} perpendicular")
        for p, q in combinations(sorted(self._points), 2):
            difference = minus(self._points[q], self._points[p])
            for u in axes:
                if (count := count + 1) > MANY:
                    return
                latex = rf"{arrow(p, q)} \cdot {symbol(u)}"
                words = f"{p}{q} perpendicular to axis {u}"
                yield dot(difference, axes[u]), Quantity(latex, f"{p}{q}.{u}", words)
        for triple in islice(combinations(axes, 3), MANY // 10):
            one, two, three = (axes[name] for name in triple)
            if sum(len(e) for e in (*one, *two, *three)) < 24:
                latex = rf"\det[{', '.join(map(symbol, triple))}]"
                words = f"axes {', '.join(triple[:2])} and {triple[2]} parallel to a plane"
                yield determinant((one, two, three)), Quantity(latex, f"det[{' '.join(triple)}]", words)
        for names in combinations(sorted(self._points), 4):
            if (count := count + 1) > MANY:
                return
            first, *others = (self._points[name] for name in names)
            a, b, c = (minus(other, first) for other in others)
            if sum(len(e) for e in (*a, *b, *c)) < 60:
                yield determinant((a, b, c)), _determinant(names, "coplanar")


def _determinant(names: tuple[str, ...], relation: str) -> Quantity:
    inside = r"\, ".join(f"S_{{{symbol(n)}}}" if relation == "collinear" else symbol(n) for n in names)
    text = " ".join(f"S_{n}" if relation == "collinear" else n for n in names)
    return Quantity(rf"\det[{inside}]", f"det[{text}]", f"{', '.join(names)} {relation}")
