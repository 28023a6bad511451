"""Real points on every connected component of a real algebraic set or of an open part of it.

They are critical points of H^2 / q^k, q a random sum of squares and H zero on the border of the part; with
H = 1 those of a distance.  Lemma: with deg q^k > deg H^2 the function tends to 0 at infinity and at the
border, so that it has a maximum on every connected component of H != 0; random q have finitely many (Sard).
A maximum is critical where the set is a manifold given by independent gradients: hence only a `PurePiece`
will do, of which no part of a smaller dimension is overlooked.
Source: Rouillier, Roy, Safey El Din, J. Complexity 16 (2000) 716-750; Aubry, Rouillier, Safey El Din,
J. Symb. Comput. 34 (2002) 543-560 (recursion on the singular locus); Harris, Hauenstein, Szanto, Smooth
points on semi-algebraic sets, J. Symb. Comput. 116 (2023) 183-212.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from math import comb, prod
from random import Random

from singsym.effort import chance, patience
from singsym.effort.attempts import attempt
from singsym.effort.budget import Budget, Undecided, current
from singsym.effort.verdict import Known, Premises
from singsym.elimination.engines.base import NotZeroDimensional
from singsym.elimination.ideal import Ideal
from singsym.minors.determinant import minors
from singsym.polynomials import Polynomial, PolynomialMatrix, Ring
from singsym.varieties.decomposition import Component, decompose
from singsym.varieties.purity import PurePiece, pure_or_whole
from singsym.varieties.real.points.exact_point import RealPoint
from singsym.varieties.real.points.finite_sets import pinned, real_points
from singsym.varieties.real.points.intervals import jacobian

_CENTRES = 3
_MOST_MINORS = 2000
_MOST_PRODUCTS = 10**12


def sample_points(
    ring: Ring,
    equations: Sequence[Polynomial],
    budget: Budget | None = None,
    *,
    nonzero: Sequence[Polynomial] = (),
) -> Known[tuple[RealPoint, ...]]:
    """At least one real point on every connected component of the real zero set; none proves it empty.

    nonzero: polynomials whose zeros are removed before components are counted.
    Raises `Undecided` (pieces not proven to be reduced and of one dimension, no time left).

    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> sample_points(R, [x**2 + y**2 + 1]).value
    ()
    >>> len(sample_points(R, [(x**2 + y**2 - 1) * ((x - 4) ** 2 + y**2 - 1)]).value) >= 2
    True
    """
    system = [f for f in (*equations, *ring.relations) if not f.is_zero]
    found: list[RealPoint] = []
    premises = Premises()
    with current(budget).part() as limited:
        pieces = premises.take(decompose(system, nonzero, ring=ring, budget=limited))
        for component in premises.take(pure_or_whole(pieces, system, ring)):
            found += premises.take(component_samples(component, system, limited, nonzero=nonzero))
    return premises.conclude(tuple(dict.fromkeys(found)))


def component_samples(
    component: Component,
    equations: Sequence[Polynomial] = (),
    budget: Budget | None = None,
    *,
    nonzero: Sequence[Polynomial] = (),
) -> Known[tuple[RealPoint, ...]]:
    """The same for one piece; raises `Undecided` where it is not proven to have one dimension.

    equations: some that vanish on it, which may be simpler than its generators; others are not used.
    """
    budget = current(budget)
    budget.check("real points on every component")
    ring, dimension = component.ideal.ring, component.dimension
    if dimension < 0:
        return Known(())
    premises = Premises()
    if dimension == 0:
        points = premises.take(real_points(component.ideal, budget))
        return premises.conclude(_pinned(points, nonzero))
    piece = PurePiece.of(component)
    if not piece.codimension and not nonzero:
        return Known((_origin(ring),))
    known = premises.take(_holding(component, equations))
    # finitely many critical and singular points together: then the piece is reduced and nothing is left
    chosen = next(_choices(piece, known))
    try:
        random = chance.random("critical points")
        critical = _critical_points(piece, known, chosen, nonzero, random, budget)
        return premises.pass_on(critical)
    except NotZeroDimensional:
        found, singular = premises.take(regular_samples(piece, known, budget, nonzero=nonzero))
    others = premises.take(sample_points(ring, singular.generators, budget, nonzero=nonzero))
    return premises.conclude((*found, *others))


def regular_samples(
    piece: PurePiece,
    equations: Sequence[Polynomial] = (),
    budget: Budget | None = None,
    *,
    nonzero: Sequence[Polynomial] = (),
) -> Known[tuple[tuple[RealPoint, ...], Ideal]]:
    """A point on every connected component of the part where some gradients are independent; and the rest.

    The rest is an ideal of the piece's other points.  Where the first part has no real point, the real piece
    has a smaller dimension than the complex one.  equations: as in `component_samples`.

    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> [len(regular_samples(PurePiece.of(c)).value[0]) for c in decompose([x**2 + y**2], ring=R).value]
    [0]
    """
    budget = current(budget)
    premises = Premises()
    known = premises.take(_holding(piece.component, equations))
    chosen, border, singular = premises.take(_regular_part(piece, known, budget))
    random = chance.random("critical points")
    for _ in range(_CENTRES):
        try:
            outside = (*nonzero, *border)
            points = premises.take(_critical_points(piece, known, chosen, outside, random, budget))
            return premises.conclude((points, singular))
        except NotZeroDimensional:
            continue
    what = f"the critical points on {piece.component!r} are not finite"
    raise Undecided(f"{what} for {_CENTRES} centres in {piece.ring!r}")


def _origin(ring: Ring) -> RealPoint:
    return RealPoint(ring, (0, 1), (1,), ((),) * len(ring.names), Fraction(0), Fraction(0))


def _holding(component: Component, equations: Sequence[Polynomial]) -> Known[tuple[Polynomial, ...]]:
    """Those of the equations that are not zero and vanish on the whole piece."""
    premises = Premises()
    found = tuple(f for f in equations if not f.is_zero and premises.take(component.vanishes(f)))
    return premises.conclude(found)


def _regular_part(
    piece: PurePiece, known: tuple[Polynomial, ...], budget: Budget
) -> Known[tuple[tuple[Polynomial, ...], tuple[Polynomial, ...], Ideal]]:
    """As many polynomials zero on the piece as its codimension, and where their gradients are dependent.

    Between the two: a polynomial that vanishes there, and not on a whole component of the piece, if needed.
    Outside of its zeros the piece is a manifold, given by the polynomials, and all of its regular points have
    such points near them.
    """
    ring, ideal = piece.ring, piece.ideal
    if not piece.codimension:
        return Known(((), (), Ideal(ring, (ring.one,))))
    premises = Premises()
    for chosen in _choices(piece, known):
        budget.check("real points on every component")
        matrix = PolynomialMatrix.of(ring, jacobian(chosen, ring.names))
        dependent = _all_minors(matrix, piece.codimension)
        found = [m for minor in dependent if (m := premises.take(ideal.reduce(minor)))]
        if not found:
            continue
        singular = ideal + Ideal(ring, found)
        if premises.take(singular.is_unit()):
            return premises.conclude((chosen, (), singular))
        for minor in sorted((m.squarefree_part() for m in found), key=lambda m: (m.total_degree, len(m))):
            # on a prime every minor that is not in the ideal cuts the dimension down
            if (
                piece.component.prime
                or premises.take((ideal + Ideal(ring, (minor,))).dimension) < piece.dimension
            ):
                return premises.conclude((chosen, (minor,), singular))
    raise Undecided(f"no reduced generators were found for {piece.component!r}")


def _choices(piece: PurePiece, known: tuple[Polynomial, ...]) -> Iterator[tuple[Polynomial, ...]]:
    codimension = piece.codimension
    if len(known) == codimension:
        yield known
    generators = sorted(piece.ideal.generators, key=lambda f: (f.total_degree, len(f)))
    if len(generators) == codimension:
        yield tuple(generators)
        return
    random = chance.random("choices of equations")
    if len(independent := _independent(generators, codimension, random)) == codimension:
        yield independent
    for _ in range(3):
        yield tuple(
            sum((g * random.randint(-3, 3) for g in generators), start=piece.ring.zero)
            for _ in range(codimension)
        )


def _independent(generators: Sequence[Polynomial], count: int, random: Random) -> tuple[Polynomial, ...]:
    """The first generators whose gradients are independent at a random point of the whole space."""
    from flint import nmod_mat

    prime = chance.sparing_prime()
    ring = generators[0].ring
    point = [random.randrange(prime) for _ in ring.names]
    chosen: list[Polynomial] = []
    rows: list[list[int]] = []
    for g in generators:
        row = [_modulo(d, point, prime) for d in jacobian([g], ring.names)[0]]
        if nmod_mat([*rows, row], prime).rank() > len(rows):
            rows.append(row)
            chosen.append(g)
        if len(chosen) == count:
            break
    return tuple(chosen)


def _modulo(polynomial: Polynomial, point: Sequence[int], prime: int) -> int:
    total = 0
    for exponents, c in polynomial.integer().terms():
        term = int(c) % prime
        for x, e in zip(point, exponents, strict=True):
            term = term * pow(x, int(e), prime) % prime
        total += term
    return total % prime


def _critical_points(
    piece: PurePiece,
    known: tuple[Polynomial, ...],
    local: Sequence[Polynomial],
    nonzero: Sequence[Polynomial],
    random: Random,
    budget: Budget,
) -> Known[tuple[RealPoint, ...]]:
    """The real points outside the zeros of `nonzero` where H^2 / q^k is critical or `local` not regular.

    Raises `NotZeroDimensional` where they are infinitely many.
    """
    budget.check("critical points")
    ring, premises = piece.ring, Premises()
    border = prod((premises.take(piece.ideal.reduce(p)) for p in nonzero), start=ring.one)
    if border.is_zero:
        return premises.conclude(())
    border = border.squarefree_part()
    equations = premises.take(_few_equations(piece, known))
    if border.is_constant:
        system = (*equations, *premises.take(_dependences(piece, local, ring.one, random)))
        return premises.conclude(_pinned(premises.take(real_points(Ideal(ring, system), budget))))
    wide = ring.with_names((*ring.names, "1/border"))
    system = (*equations, *premises.take(_dependences(piece, local, border, random)))
    outside = wide.gens[-1] * wide.convert(border) - 1
    points = premises.take(real_points(Ideal(wide, (*map(wide.convert, system), outside)), budget))
    return premises.conclude(_pinned([dropped(p, ring) for p in points]))


def _all_minors(matrix: PolynomialMatrix, size: int) -> list[Polynomial]:
    """All minors of a Jacobian matrix; raises `Undecided` where they are too many or too large."""
    count = comb(matrix.shape[0], size) * comb(matrix.width, size)
    lengths = sorted((sum(map(len, row)) for row in matrix.rows), reverse=True)
    if count > _MOST_MINORS or prod(lengths[:size]) > _MOST_PRODUCTS:
        raise Undecided(f"the {count} minors of size {size} of a Jacobian matrix are too many or too large")
    return [minor for _, _, minor in minors(matrix, size)]


def _few_equations(piece: PurePiece, known: tuple[Polynomial, ...]) -> Known[tuple[Polynomial, ...]]:
    """A few equations of the piece in place of a long Groebner basis, where some are quickly seen to do."""
    generators = piece.ideal.generators
    shortest = sorted(generators, key=lambda f: (f.total_degree, len(f)))
    for chosen in (known, tuple(shortest[: 2 * piece.codimension])):
        if not 0 < 2 * len(chosen) < len(generators):
            continue
        with attempt("the equations of a piece", patience.CHOICE.work):
            enough = Ideal(chosen[0].ring, chosen).contains(piece.ideal)
            if enough.value:
                return Known(chosen, enough.certainty)
    return Known(generators)


def _dependences(
    piece: PurePiece, local: Sequence[Polynomial], border: Polynomial, random: Random
) -> Known[tuple[Polynomial, ...]]:
    """Where the gradients of `local` and of 2 log H - k log q, times H q, are dependent."""
    ring = piece.ring
    centre = [ring.constant(random.randint(-40, 40)) / random.randint(7, 13) for _ in ring.names]
    offsets = [x - a for x, a in zip(ring.gens, centre, strict=True)]
    if border.is_constant:
        direction = offsets
    else:
        q = sum((random.randint(1, 5) * d**2 for d in offsets), start=ring.one)
        k = border.total_degree + 1
        direction = [2 * q * border.derivative(n) - k * border * q.derivative(n) for n in ring.names]
    rows = [*jacobian(local, ring.names), direction]
    found = _all_minors(PolynomialMatrix.of(ring, rows), len(local) + 1)
    premises = Premises()
    return premises.conclude(tuple(premises.take(piece.ideal.reduce(minor)) for minor in found))


def _pinned(points: Sequence[RealPoint], nonzero: Sequence[Polynomial] = ()) -> tuple[RealPoint, ...]:
    """The points that have the ring's constants at their own values and are outside some zeros."""
    return tuple(p for p in points if pinned(p, p.ring.constants) and all(p.sign(f) for f in nonzero))


def dropped(point: RealPoint, ring: Ring) -> RealPoint:
    """The point without its further coordinates."""
    numerators = tuple(point.numerators[point.ring.index(n)] for n in ring.names)
    return RealPoint(ring, point.minimal, point.denominator, numerators, point.low, point.high, point.bits)
