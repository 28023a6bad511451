"""A leaf with finitely many points: all of them by one univariate polynomial, and what each is.

Source: Rouillier, Solving zero-dimensional systems through the rational univariate representation (1999);
real roots are isolated by FLINT's `arb_fmpz_poly_complex_roots`, which leaves them without an imaginary part.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial, reduce
from typing import Any

from flint import arb, arb_poly, ctx, fmpq_mpoly, fmpq_poly, fmpz, nmod_poly

from singsym.certificates.checker.polynomials import Rejected, polynomial, rational, remainder, repeated
from singsym.certificates.checker.ranks import Defects, borders, is_possible, types_of
from singsym.certificates.checker.sets import MATRICES, MOST, RealSet, Statement, listed, named, whole_number

BITS = tuple(2**k for k in range(6, 13))
PRIME = 2**61 - 1

Found = tuple[str, int, Callable[[fmpq_mpoly], bool]]
"""The types of points, their number, and whether a polynomial vanishes at them, conjugate as they are."""


def points(at: RealSet, about: Statement, line: Mapping[str, Any]) -> list[Found]:
    """All real points of a set; raises `Rejected`.

    form: a linear polynomial u; minimal: rational coefficients, constant term first, of a polynomial m
        without double roots; coordinates: of each variable those of a polynomial r.
    Powers of m(u) and of x m'(u) - r(u) have remainder zero by the equations, so that each point of the set
    is r / m' of a root; the roots at which a generator does not vanish, or a unit does, are left out.
    """
    chart, there = chart_of(at, line)
    for unit in at.units:
        there = there // there.gcd(chart.value(unit, there))
    return [
        (types_of(_defects(chart, about, factor)), roots, partial(chart.vanishes, factor))
        for factor in map(fmpq_poly, (f for f, _ in there.numer().factor()[1]))
        if (roots := chart.feasible_roots(factor))
    ]


def chart_of(at: RealSet, line: Mapping[str, Any]) -> tuple[Chart, fmpq_poly]:
    """All zeros of the equations of a set, and the polynomial of their roots; raises `Rejected`."""
    form, minimal = polynomial(line.get("form", ""), at.context), _univariate(line, "minimal")
    if minimal.degree() < 1 or minimal.gcd(minimal.derivative()).degree() > 0:
        raise Rejected("minimal: expected a polynomial of positive degree without double roots")
    given = named(line, "coordinates")
    if set(given) != set(at.variables):
        raise Rejected(f"coordinates: expected one for each of {list(at.variables)}")
    coordinates = {name: _univariate(given, name) % minimal for name in at.variables}
    chart, there = Chart(at, minimal, coordinates), minimal
    _check_all(chart, form, whole_number(line, "power", 1, MOST))
    if (chart.value(form, minimal) - fmpq_poly([0, 1]) * minimal.derivative() ** degree(form)) % minimal:
        raise Rejected("form: it is not the root at its points")
    for equation in at.generators:
        there = there.gcd(chart.value(equation, there))
    return chart, there


def _univariate(data: Mapping[str, Any], key: str) -> fmpq_poly:
    return fmpq_poly([rational(text) for text in listed(data, key, str)])


def _check_all(chart: Chart, form: fmpq_mpoly, exponent: int) -> None:
    """Whether each complex point of the equations is one of the chart's; raises `Rejected`."""
    at, powers = chart.at, [chart.at.context.constant(1)]
    for _ in range(chart.minimal.degree()):
        powers.append(remainder(powers[-1] * form, at.equations))

    def put(f: fmpq_poly) -> fmpq_mpoly:
        return sum((p * c for p, c in zip(powers, f.coeffs(), strict=False)), start=at.context.constant(0))

    *coordinates, below = map(put, chart.images)
    pairs = zip(at.context.gens(), coordinates, strict=True)
    for f in (put(chart.minimal), *(gen * below - r for gen, r in pairs)):
        product = at.context.constant(1)
        for _ in range(exponent):
            product = remainder(product * f, at.equations)
        if product:
            raise Rejected("there may be more points: a power is not seen to be in the ideal")


def degree(*polynomials: fmpq_mpoly) -> int:
    """The least even number that is not below the degree of any of these."""
    return -(-max(int(f.total_degree()) for f in polynomials) // 2) * 2


class Chart:
    """The points r(u) / m'(u) of a set, for the roots u of a polynomial m."""

    def __init__(self, at: RealSet, minimal: fmpq_poly, coordinates: Mapping[str, fmpq_poly]) -> None:
        self.at, self.minimal = at, minimal
        self.images = [*(coordinates[name] for name in at.context.names()), minimal.derivative()]

    def value(self, f: fmpq_mpoly, modulus: fmpq_poly, even: int | None = None) -> fmpq_poly:
        """f at its points, modulo a polynomial in u, times an even power of m', not below its degree.

        Even powers are positive, as m' vanishes at no root.
        """
        even = degree(f) if even is None else even
        total, known = fmpq_poly([]), dict[tuple[int, ...], fmpq_poly]({(): fmpq_poly([1])})
        for exponents, coefficient in f.terms():
            places = repeated((*exponents, even - sum(exponents)))
            for k, i in enumerate(places):
                # quotients have longer numbers than products: only the sum is reduced
                if places[: k + 1] not in known:
                    known[places[: k + 1]] = known[places[:k]] * self.images[i]
            total = total + known[places] * coefficient
        return total % modulus

    def vanishes(self, factor: fmpq_poly, f: fmpq_mpoly) -> bool:
        """Whether f is zero at the points of the roots of an irreducible polynomial."""
        return not self.value(f, factor)

    def feasible_roots(self, factor: fmpq_poly) -> int:
        """How many real roots of an irreducible polynomial satisfy the inequalities."""
        strict = [self.value(p, factor) for p in self.at.positive]
        weak = [self.value(p, factor) for p in self.at.nonnegative]
        if not all(strict):
            return 0
        signs = [value for value in (*strict, *weak) if value]
        for bits in BITS:
            with ctx.workprec(bits):
                roots = real_roots(factor)
                decided = [[arb_poly(value)(root).sgn() for value in signs] for root in roots]
            if all(sign.is_exact() for own in decided for sign in own):
                return sum(all(sign > 0 for sign in own) for own in decided)
        raise Rejected(f"a sign at a point is not seen with {BITS[-1]} bits")

    def balls(self, there: fmpq_poly) -> list[list[arb]]:
        """Balls around the points of the real roots of a polynomial without double roots."""
        values = [[arb_poly(f)(root) for f in self.images] for root in real_roots(there)]
        return [[value / below for value in own] for *own, below in values]


def real_roots(factor: fmpq_poly) -> list[arb]:
    """The real roots of a polynomial without double roots, in balls of the precision that holds."""
    roots: Any = factor.numer().complex_roots()
    return [root.real for root, _ in roots if root.imag == 0]


def _defects(chart: Chart, about: Statement, factor: fmpq_poly) -> Defects:
    """The defects at the roots of an irreducible polynomial, one of them real, which are all alike."""
    at = chart.at
    values = [[chart.value(entry, factor, degree(*row)) for entry in row] for row in at.matrix]
    whole = reduce(fmpz.lcm, (e.denom() for row in values for e in row), fmpz(1))
    residues = [[nmod_poly((e * whole).numer(), PRIME) for e in row] for row in values]
    found = []
    for name in MATRICES:
        rows, columns = pivots(at.part(residues, name), nmod_poly(factor.numer(), PRIME))
        if not all(chart.vanishes(factor, f) for f in borders(at, at.part(at.matrix, name), rows, columns)):
            raise Rejected("a rank at a point is not seen modulo a prime")
        found.append(about.full_rank(name) - at.eliminated - len(rows))
    delta, p, inputs, outputs = found
    if min(found) < 0 or not is_possible((delta, p, inputs, outputs), about.n):
        raise Rejected(f"defects {found} at a point: N and n are not those of L")
    return delta, p, inputs, outputs


def pivots(rows: Sequence[Sequence[nmod_poly]], factor: nmod_poly) -> tuple[list[int], list[int]]:
    """Rows and columns of a minor that is not zero modulo a factor, by elimination that leaves minors
    (Bareiss).

    All modulo a prime: of whole polynomials such a minor is no multiple of the primitive factor, which would
    have a whole cofactor (Gauss).
    """
    left = {i: dict(enumerate(row)) for i, row in enumerate(rows)}
    chosen, before = list[tuple[int, int]](), nmod_poly([1], PRIME)
    while place := next(((i, j) for i, row in left.items() for j, e in row.items() if e % factor), None):
        i, j = place
        pivot = left.pop(i)
        left = {
            k: {c: (pivot[j] * e - row[j] * pivot[c]) // before for c, e in row.items() if c != j}
            for k, row in left.items()
        }
        before = pivot[j]
        chosen.append(place)
    return [i for i, _ in chosen], [j for _, j in chosen]
