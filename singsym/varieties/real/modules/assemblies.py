"""All real solutions of one module, its assemblies, over a point of its parents that is known by balls.

Source: the input-output equations of dyads, Hunt, Kinematic Geometry of Mechanisms (1978), ch. 7: two conics
with proportional terms of second degree meet where one of them meets a line.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import combinations

from flint import acb, arb, arb_poly

from singsym.effort.budget import Undecided
from singsym.minors.determinant import determinant
from singsym.polynomials import Polynomial, PolynomialMatrix, Ring
from singsym.polynomials.block_form import Module
from singsym.varieties.real.points.intervals import evaluate

Balls = Mapping[str, arb]
"""Values by name."""
_SECOND = ((2, 0), (1, 1), (0, 2))
"""The exponents of the terms of second degree in two unknowns."""
_LINEAR = ((1, 0), (0, 1), (0, 0))
"""Those of the others of a conic."""
Terms = Mapping[tuple[int, int], Polynomial]
"""A polynomial in two unknowns, its coefficients in the parents, by exponents."""


@dataclass(frozen=True)
class Dyad:
    """Two unknowns on a conic and on a line; the coefficients are polynomials in the parents.

    pivot: has to be nonzero for the line to be a consequence; without one it is an equation of its own.
    """

    unknowns: tuple[str, str]
    conic: Terms
    line: Terms
    pivot: Polynomial | None

    @property
    def _ring(self) -> Ring:
        return next(iter(self.conic.values())).ring

    @cached_property
    def line_equation(self) -> Polynomial:
        """The line as a polynomial."""
        return _joined(self.line, self._ring, self.unknowns)

    def touching(self, known: Balls) -> dict[str, arb]:
        """The point where the line touches the conic, over parents at which the discriminant is zero.

        Both the line and the tangency are linear.  Raises `Undecided` where the balls do not solve them.
        """
        x, y = self.unknowns
        rows = [_terms(p, x, y) for p in (self.line_equation, self.tangency)]
        zero = self._ring.zero
        (a, b, c), (d, e, f) = ([value_at(row.get(m, zero), known) for m in _LINEAR] for row in rows)
        scale = a * e - b * d
        if scale.contains(0) or (self.pivot is not None and value_at(self.pivot, known).contains(0)):
            raise Undecided("whether a dyad turns freely is not seen")
        return {x: (b * f - c * e) / scale, y: (c * d - a * f) / scale}

    @cached_property
    def tangency(self) -> Polynomial:
        """Zero where the line touches the conic: the functional determinant of both."""
        x, y = self.unknowns
        conic, line = _joined(self.conic, self._ring, self.unknowns), self.line_equation
        return conic.derivative(x) * line.derivative(y) - conic.derivative(y) * line.derivative(x)

    @cached_property
    def discriminant(self) -> Polynomial:
        """Positive where line and conic meet in two real points, zero where they touch, in the parents.

        The determinant of the conic's matrix bordered by the line: less that of the form on the line.
        """
        zero = self._ring.zero
        f = {m: self.conic.get(m, zero) for m in (*_SECOND, *_LINEAR)}
        a, b, c = (self.line.get(m, zero) for m in _LINEAR)
        rows = (
            (2 * f[2, 0], f[1, 1], f[1, 0], a),
            (f[1, 1], 2 * f[0, 2], f[0, 1], b),
            (f[1, 0], f[0, 1], 2 * f[0, 0], c),
            (a, b, c, zero),
        )
        return determinant(PolynomialMatrix(zero.ring, rows))


def _joined(terms: Terms, ring: Ring, names: tuple[str, str]) -> Polynomial:
    x, y = map(ring.gen, names)
    return sum((c * x**i * y**j for (i, j), c in terms.items()), ring.zero)


def is_simple(module: Module) -> bool:
    """Whether the assemblies are roots of a polynomial in one unknown, or those of a dyad."""
    return len(module.unknowns) == 1 or dyad(module) is not None


def is_circle(p: Polynomial, names: Sequence[str]) -> bool:
    """Whether it is a x^2 + a y^2 plus terms of lower degree in two unknowns, with a rational a."""
    x, y = names
    if not p.degree(x) == p.degree(y) == 2:
        return False
    one = p.coefficient(x, 2)
    return one.is_constant and one == p.coefficient(y, 2) and not p.coefficient(x, 1).coefficient(y, 1)


def is_round(module: Module) -> bool:
    """Whether a module is a dyad with a circle as its conic, so that no solution is at infinity."""
    found = dyad(module)
    if found is None:
        return False
    one, two = (found.conic.get(m) for m in ((2, 0), (0, 2)))
    return one is not None and one == two and one.is_constant and (1, 1) not in found.conic


def assemblies(module: Module, known: Balls) -> list[dict[str, arb]]:
    """All real solutions over these values of the parents, each in balls; for simple modules.

    Each ball holds the coordinate of exactly one solution, for any values from the balls of the parents.
    Raises `Undecided` where the balls do not say how many there are.

    >>> from singsym.polynomials import Ring
    >>> a, x, y = Ring(("a", "x", "y")).gens
    >>> circles = Module((x**2 + y**2 - 2, (x - a) ** 2 + y**2 - 2), ("x", "y"), ("a",))
    >>> [(float(p["x"].mid()), float(p["y"].mid())) for p in assemblies(circles, {"a": arb(2)})]
    [(1.0, -1.0), (1.0, 1.0)]
    """
    if len(module.unknowns) == 1:
        (name,) = module.unknowns
        (equation,) = module.equations
        coefficients = [
            value_at(equation.coefficient(name, k), known) for k in range(equation.degree(name) + 1)
        ]
        return [{name: root} for root in real_roots_of(coefficients)]
    found = dyad(module)
    if found is None:
        raise Undecided(f"the assemblies of a module with unknowns {', '.join(module.unknowns)}")
    return _of_dyad(found, known)


@lru_cache(maxsize=4096)
def dyad(module: Module) -> Dyad | None:
    """A module of two unknowns as a dyad, where it is one."""
    if len(module.unknowns) != 2:
        return None
    x, y = module.unknowns
    one, two = (_terms(p, x, y) for p in module.equations)
    if any(i + j > 2 for terms in (one, two) for i, j in terms):
        return None
    for conic, line in ((one, two), (two, one)):
        if not any(m in line for m in _SECOND):
            return Dyad((x, y), conic, line, None)
    zero = module.equations[0].ring.zero
    if any(
        one.get(m, zero) * two.get(k, zero) != one.get(k, zero) * two.get(m, zero)
        for m, k in combinations(_SECOND, 2)
    ):
        return None
    shared = [m for m in _SECOND if m in one and m in two]
    pivot, one, two = min(
        ((m, p, q) for m in shared for p, q in ((one, two), (two, one))),
        key=lambda choice: (not choice[1][choice[0]].is_constant, sum(map(len, choice[1].values()))),
    )
    line = {
        m: coefficient
        for m in {*one, *two}
        if (coefficient := one[pivot] * two.get(m, zero) - two[pivot] * one.get(m, zero))
    }
    return Dyad((x, y), one, line, one[pivot])


def _terms(p: Polynomial, x: str, y: str) -> dict[tuple[int, int], Polynomial]:
    found = {}
    for i in range(p.degree(x) + 1):
        part = p.coefficient(x, i)
        for j in range(part.degree(y) + 1):
            if coefficient := part.coefficient(y, j):
                found[i, j] = coefficient
    return found


def _of_dyad(found: Dyad, known: Balls) -> list[dict[str, arb]]:
    """The common points of the line and the conic, by the unknown that the line gives best."""
    if found.pivot is not None and value_at(found.pivot, known).contains(0):
        raise Undecided("whether two circles of a dyad are one is not seen")
    line = {m: value_at(c, known) for m, c in found.line.items()}
    conic = {m: value_at(c, known) for m, c in found.conic.items()}
    a, b, c = (line.get(m, arb(0)) for m in _LINEAR)
    turned = abs(a).abs_lower() > abs(b).abs_lower()
    if turned:
        a, b = b, a
        conic = {(j, i): value for (i, j), value in conic.items()}
    if b.contains(0):
        raise Undecided("whether a dyad turns freely is not seen")
    x, y = found.unknowns if not turned else found.unknowns[::-1]
    m, k = -c / b, -a / b
    f00, f10, f01, f20, f11, f02 = (
        conic.get(e, arb(0)) for e in ((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2))
    )
    roots = real_roots_of(
        [f00 + f01 * m + f02 * m * m, f10 + f01 * k + f11 * m + 2 * f02 * k * m, f20 + f11 * k + f02 * k * k]
    )
    return sorted(
        ({x: root, y: m + k * root} for root in roots), key=lambda p: [float(v.mid()) for v in p.values()]
    )


def real_roots_of(coefficients: Sequence[arb]) -> list[arb]:
    """Balls around the real roots of a polynomial with these coefficients, the constant one first.

    Raises `Undecided` where the balls leave its degree or the number of its real roots open.

    >>> real_roots_of([arb(-4), arb(0), arb(1)])
    [-2.00000000000000, 2.00000000000000]
    """
    kept = list(coefficients)
    while len(kept) > 1 and kept[-1] == 0:
        kept.pop()
    lead = kept[-1]
    if lead.contains(0):
        raise Undecided("whether a polynomial in one unknown has its full degree is not seen")
    if len(kept) == 1:
        return []
    if len(kept) == 2:
        return [-kept[0] / lead]
    if len(kept) == 3:
        return _roots_of_quadratic(*kept)
    try:
        roots = arb_poly(kept).complex_roots()
    except ValueError:
        raise Undecided("the roots of a polynomial in one unknown are not apart") from None
    return sorted((root.real for root in roots if _is_real(root, roots)), key=lambda r: float(r.mid()))


def _is_real(root: acb, roots: Sequence[acb]) -> bool:
    """Whether it is real: its ball overlaps its own mirror image, and that of no other root."""
    if not root.imag.contains(0):
        return False
    mirrored = acb(root.real, -root.imag)
    if any(other is not root and other.overlaps(mirrored) for other in roots):
        raise Undecided("whether a root is real is not seen")
    return True


def _roots_of_quadratic(c: arb, b: arb, a: arb) -> list[arb]:
    discriminant = b * b - 4 * a * c
    if discriminant < 0:
        return []
    if not discriminant > 0:
        raise Undecided("whether two assemblies are one is not seen")
    root = discriminant.sqrt()
    return sorted(((-b + sign * root) / (2 * a) for sign in (-1, 1)), key=lambda r: float(r.mid()))


def value_at(p: Polynomial, known: Balls) -> arb:
    """A ball around the value of a polynomial: everything, where a variable of it is not known."""
    if not known.keys() >= set(p.variables):
        return arb("nan")
    return evaluate(p, [known.get(name, arb(0)) for name in p.ring.names])
