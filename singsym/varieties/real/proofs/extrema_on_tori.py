"""Polynomials in unit vectors that have one sign everywhere: their zeros are where they are extreme.

Lemma: the unit vectors of k circles are a torus, which is compact, so a polynomial has its least value on it
where its derivatives along all circles vanish.  These values are the real zeros of one polynomial in one
variable; where none is negative, every zero on the torus is such a place.
Source: Milnor, Morse Theory (1963), section 2 (critical points); Sard (1942): the critical values are finite.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, sin

from flint import fmpz_poly

from singsym.effort import chance, patience
from singsym.effort.attempts import attempt
from singsym.effort.verdict import Known
from singsym.elimination.ideal import Ideal
from singsym.elimination.memo import remember
from singsym.polynomials import Polynomial
from singsym.polynomials.unit_circles import Pair, circle
from singsym.varieties.irreducibility import relation
from singsym.varieties.real.points.roots import has_real_root
from singsym.varieties.splitting import used_ring

MOST_TERMS, MOST_CIRCLES = 60, 8
_TRIES = 100


def extreme_zeros(f: Polynomial, circles: Sequence[Pair]) -> Known[tuple[Polynomial, ...]]:
    """What vanishes with f on the circles: its derivatives along them, where f has no two signs there.

    (1,) where f has no zero at all; () where nothing is known.

    >>> from singsym.polynomials import Ring
    >>> c, s, x, y = Ring(("c", "s", "x", "y")).gens
    >>> extreme_zeros(c * x + s * y - 1, (("c", "s"), ("x", "y"))).value
    (-s*x + c*y, s*x - c*y)
    >>> extreme_zeros(c * x + s * y - 2, (("c", "s"), ("x", "y"))).value
    (1,)
    """
    own = tuple(pair for pair in circles if {*pair} & {*f.variables})
    names = {name for pair in own for name in pair} | {constant.name for constant in f.ring.constants}
    if len(f) > MOST_TERMS or not 0 < len(own) <= MOST_CIRCLES or not {*f.variables} <= names:
        return Known(())
    if _has_two_signs(f, own):
        return Known(())
    return remember("extreme values", (f, own), lambda: _searched(f, own))


def _has_two_signs(f: Polynomial, circles: Sequence[Pair]) -> bool:
    """Whether values of both signs are found."""
    ring, drawing, signs = f.ring, chance.random("signs", f), set()
    point = [0.0] * len(ring.names)
    for constant in ring.constants:
        point[ring.index(constant.name)] = float((constant.low + constant.high) / 2)
    for _ in range(_TRIES):
        for x, y in circles:
            angle = drawing.uniform(0, 6.3)
            point[ring.index(x)], point[ring.index(y)] = cos(angle), sin(angle)
        signs.add(f.evaluate(point) > 0)
        if len(signs) == 2:
            return True
    return False


def _searched(f: Polynomial, circles: tuple[Pair, ...]) -> Known[tuple[Polynomial, ...]]:
    """The polynomials of `extreme_zeros`."""
    ring = f.ring
    derivatives = [ring.gen(x) * f.derivative(y) - ring.gen(y) * f.derivative(x) for x, y in circles]
    fixed = [p for p in ring.relations if {*p.variables} & {*f.variables}]
    equations = [*(circle(*map(ring.gen, pair)) for pair in circles), *(p for p in derivatives if p), *fixed]
    small = used_ring(ring, equations)
    ideal = Ideal(small, tuple(map(small.convert, equations)))
    values = None
    with attempt("extreme values", patience.EXTREMA.work):
        basis = ideal.groebner_basis()
        values = relation(basis.value, (small.convert(f),))
    if values is None:
        return Known(())
    coefficients = [int(values.coefficient("t0", k).constant.p) for k in range(values.total_degree + 1)]
    first = next(k for k, c in enumerate(coefficients) if c)
    others = coefficients[first:]
    if _has_negative_root(others) and _has_negative_root([c * (-1) ** k for k, c in enumerate(others)]):
        return Known(())
    return Known(tuple(dict.fromkeys(filter(None, derivatives))) if first else (ring.one,), basis.certainty)


def _has_negative_root(coefficients: Sequence[int]) -> bool:
    """Whether a polynomial, not zero at 0, has a negative zero: p(-y^2) has a real one."""
    doubled = [0] * (2 * len(coefficients) - 1)
    doubled[::2] = [c * (-1) ** k for k, c in enumerate(coefficients)]
    return has_real_root(fmpz_poly(doubled))
