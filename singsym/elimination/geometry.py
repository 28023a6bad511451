"""Factors of conditions recognised as determinants of named points and axes.

Source: section 4.1 of Zlatanov, Fenton, Benhabib (1998): conditions are linear dependences of screws; a
3x3 determinant of planar screws vanishes where their points are collinear, section 3.3.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, islice

from singsym.kinematics.nonzero import Certifier
from singsym.polynomials import Polynomial

MANY = 5000
"""Not more than this many combinations of names are tried in space."""

Vector = tuple[Polynomial, ...]


@dataclass(frozen=True)
class GeometricName:
    """How a factor is written, up to a constant, and what its vanishing says."""

    latex: str
    text: str
    words: str


def _symbol(name: str) -> str:
    """A name as LaTeX: one letter with an index, or text."""
    head, index = name[:1], name[1:].lstrip("_")
    if head.isalpha() and (not index or index.isalnum()) and len(index) <= 2:
        return rf"{head}_{{{index}}}" if index else head
    return rf"\mathrm{{{name.replace('_', ' ')}}}"


def _subtract(a: Vector, b: Vector) -> Vector:
    return tuple(p - q for p, q in zip(a, b, strict=True))


def _dot(a: Vector, b: Vector) -> Polynomial:
    return sum((p * q for p, q in zip(a[1:], b[1:], strict=True)), start=a[0] * b[0])


def _cross(a: Vector, b: Vector) -> Vector:
    return tuple(a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3))


@dataclass(frozen=True, eq=False)
class PointNames:
    """Recognises polynomials as determinants of a configuration space's named points and axes.

    A name is given only where the polynomial and the determinant agree, on the circles and spheres of the
    configuration space, up to a factor proved nonzero.

    >>> from singsym.kinematics.placement import ConfigurationSpace
    >>> from singsym.polynomials import Ring
    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> points = {"A": (R.zero, R.zero), "B": (R.one, R.one), "C": (x, y)}
    >>> PointNames(Certifier(ConfigurationSpace(R, (), points=points))).recognise(x - y).words
    'A, B, C collinear'
    """

    certifier: Certifier

    @cached_property
    def _points(self) -> dict[str, Vector]:
        """The named points, one name for each place."""
        found: dict[Vector, str] = {}
        for name, place in self.certifier.space.points.items():
            found.setdefault(tuple(place), name)
        return {name: place for place, name in found.items()}

    def recognise(self, polynomial: Polynomial) -> GeometricName | None:
        """The name of a factor; None where none of the determinants of named points is it."""
        wanted = self.certifier.normal_form(polynomial).primitive()
        square = self.certifier.normal_form(wanted * wanted).primitive()
        for value, name in self._lengths:
            if value == square:
                return name
        for value, name in self._candidates:
            if value == wanted:
                return name
        for value, name in self._candidates:
            if wanted.divides(value) and self.certifier.reason(value.exact_quotient(wanted)) is not None:
                return name
        return None

    @cached_property
    def _lengths(self) -> tuple[tuple[Polynomial, GeometricName], ...]:
        """Squared distances in space: a polynomial whose square is one vanishes exactly where it does."""
        if len(next(iter(self._points.values()), ())) != 3:
            return ()
        found = []
        for vector, name in self._on_lines():
            normal = self.certifier.normal_form(_dot(vector, vector))
            if not normal.is_constant:
                found.append((normal.primitive(), name))
        return tuple(found)

    @cached_property
    def _candidates(self) -> tuple[tuple[Polynomial, GeometricName], ...]:
        found = []
        dimension = len(next(iter(self._points.values()), ()))
        source = self._planar() if dimension == 2 else self._spatial() if dimension == 3 else iter(())
        for value, name in source:
            normal = self.certifier.normal_form(value)
            if not normal.is_constant:
                found.append((normal.primitive(), name))
        return tuple(found)

    def _planar(self) -> Iterator[tuple[Polynomial, GeometricName]]:
        for names in combinations(sorted(self._points), 3):
            p, q, r = (self._points[name] for name in names)
            a, b = _subtract(q, p), _subtract(r, p)
            yield a[0] * b[1] - a[1] * b[0], _determinant(names, "collinear")

    def _on_lines(self) -> Iterator[tuple[Vector, GeometricName]]:
        """Vectors that vanish where three points are in line, or a point is on an axis through another."""
        names = sorted(self._points, key=lambda n: (sum(map(len, self._points[n])), n))
        axes = {n: tuple(v) for n, v in sorted(self.certifier.space.directions.items())}
        for triple in islice(combinations(names, 3), MANY // 10):
            first, *others = (self._points[name] for name in triple)
            a, b = (_subtract(other, first) for other in others)
            if sum(len(e) for e in (*a, *b)) < 24:
                p, q, r = triple
                latex = r" \times ".join(rf"\overrightarrow{{{_symbol(p)}{_symbol(x)}}}" for x in (q, r))
                words = f"{', '.join(sorted(triple))} collinear"
                yield _cross(a, b), GeometricName(rf"\pm|{latex}|", f"±|{p}{q} x {p}{r}|", words)
        for base, other in islice(combinations(names, 2), MANY // 10):
            away = _subtract(self._points[other], self._points[base])
            for u, axis in axes.items():
                if sum(len(e) for e in (*away, *axis)) < 24:
                    latex = rf"\overrightarrow{{{_symbol(base)}{_symbol(other)}}} \times {_symbol(u)}"
                    words = f"{other} on the axis {u} through {base}"
                    yield (
                        _cross(away, axis),
                        GeometricName(rf"\pm|{latex}|", f"±|{base}{other} x {u}|", words),
                    )

    def _spatial(self) -> Iterator[tuple[Polynomial, GeometricName]]:
        count = 0
        axes = {n: tuple(v) for n, v in sorted(self.certifier.space.directions.items())}
        for u, v in combinations(axes, 2):
            latex = rf"{_symbol(u)} \cdot {_symbol(v)}"
            yield _dot(axes[u], axes[v]), GeometricName(latex, f"{u}.{v}", f"axes {u} and {v} perpendicular")
        for p, q in combinations(sorted(self._points), 2):
            difference = _subtract(self._points[q], self._points[p])
            for u in axes:
                if (count := count + 1) > MANY:
                    return
                latex = rf"\overrightarrow{{{_symbol(p)}{_symbol(q)}}} \cdot {_symbol(u)}"
                words = f"{p}{q} perpendicular to axis {u}"
                yield _dot(difference, axes[u]), GeometricName(latex, f"{p}{q}.{u}", words)
        for triple in islice(combinations(axes, 3), MANY // 10):
            one, two, three = (axes[name] for name in triple)
            if sum(len(e) for e in (*one, *two, *three)) < 24:
                latex = rf"\det[{', '.join(map(_symbol, triple))}]"
                words = f"axes {', '.join(triple[:2])} and {triple[2]} parallel to a plane"
                yield _dot(one, _cross(two, three)), GeometricName(latex, f"det[{' '.join(triple)}]", words)
        for names in combinations(sorted(self._points), 4):
            if (count := count + 1) > MANY:
                return
            first, *others = (self._points[name] for name in names)
            a, b, c = (_subtract(other, first) for other in others)
            if sum(len(e) for e in (*a, *b, *c)) < 60:
                yield _dot(a, _cross(b, c)), _determinant(names, "coplanar")


def _determinant(names: tuple[str, ...], relation: str) -> GeometricName:
    inside = r"\, ".join(f"S_{{{_symbol(n)}}}" if relation == "collinear" else _symbol(n) for n in names)
    text = " ".join(f"S_{n}" if relation == "collinear" else n for n in names)
    return GeometricName(rf"\det[{inside}]", f"det[{text}]", f"{', '.join(names)} {relation}")
