"""Real points on every connected component of a real algebraic set, by critical points of a distance.

Source: Rouillier, Roy, Safey El Din, J. Complexity 16 (2000) 716-750; Aubry, Rouillier, Safey El Din,
J. Symb. Comput. 34 (2002) 543-560 (recursion on the singular locus).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from random import Random

from singsym.elimination.budget import Budget, Undecided, current
from singsym.elimination.ideal import Ideal
from singsym.minors.determinant import minors
from singsym.polynomials import Polynomial, PolynomialMatrix, Ring
from singsym.varieties.decomposition import Component, decompose
from singsym.varieties.real.intervals import jacobian
from singsym.varieties.real.points import RealPoint
from singsym.varieties.real.zerodim import NotZeroDimensional, pinned, real_points

_CENTRES = 3


def sample_points(
    ring: Ring, equations: Sequence[Polynomial], budget: Budget | None = None
) -> tuple[RealPoint, ...]:
    """At least one real point on every connected component of the real zero set; none proves it empty.

    Raises `Undecided` (pieces not known to be reduced and of one dimension, no time left).

    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> sample_points(R, [x**2 + y**2 + 1])
    ()
    >>> len(sample_points(R, [(x**2 + y**2 - 1) * ((x - 4) ** 2 + y**2 - 1)])) >= 2
    True
    """
    system = [f for f in (*equations, *ring.relations) if not f.is_zero]
    found: list[RealPoint] = []
    with current(budget).part() as limited:
        for component in decompose(system, ring=ring, budget=limited):
            found.extend(component_samples(component, system, limited))
    return tuple(p for p in dict.fromkeys(found) if pinned(p, ring.constants))


def component_samples(
    component: Component, equations: Sequence[Polynomial] = (), budget: Budget | None = None
) -> tuple[RealPoint, ...]:
    """The same for one piece of V(equations), without what other pieces of that set have as well.

    The piece must be known to have one dimension; or the equations to be as many as its codimension: by
    Krull's height theorem V(equations) then has no smaller irreducible component, and what is lower in this
    piece belongs to other ones.
    """
    budget = current(budget)
    budget.check("real points on every component")
    ring, dimension = component.ideal.ring, component.dimension
    if dimension < 0:
        return ()
    if dimension == 0:
        return real_points(component.ideal, budget)
    generators = component.generators
    codimension = len(ring.names) - dimension
    if codimension == 0:
        return (_origin(ring),)
    known = component.prime or component.cohen_macaulay
    if not known and codimension not in (len(generators), len(equations)):
        raise Undecided(f"{component!r} is not known to have one dimension only")
    # finitely many critical and singular points together: then the piece is reduced and nothing is left
    chosen = next(_choices(component, equations, codimension))
    try:
        return real_points(Ideal(ring, _critical_system(component, chosen, Random(5))), budget)
    except NotZeroDimensional:
        local, singular = regular_generators(component, equations, codimension, budget)
    found = list(_critical_points(component, local, singular, budget))
    if singular.dimension > 0:
        found.extend(sample_points(ring, singular.generators, budget))
    return tuple(found)


def _origin(ring: Ring) -> RealPoint:
    return RealPoint(ring, (0, 1), (1,), ((),) * len(ring.names), Fraction(0), Fraction(0))


def regular_generators(
    component: Component, equations: Sequence[Polynomial], codimension: int, budget: Budget
) -> tuple[tuple[Polynomial, ...], Ideal]:
    """As many elements of the ideal as its codimension, and where their gradients are dependent.

    Outside that smaller set the piece is a manifold, given by these elements.
    """
    for chosen in _choices(component, equations, codimension):
        budget.check("real points on every component")
        matrix = PolynomialMatrix.of(component.ideal.ring, jacobian(chosen, component.ideal.ring.names))
        found = [component.ideal.reduce(m) for _, _, m in minors(matrix, codimension)]
        if not any(found):
            continue
        # on a prime every minor that is not in the ideal cuts the dimension down
        singular = component.ideal + Ideal(component.ideal.ring, [m for m in found if m])
        if component.prime or singular.dimension < component.dimension:
            return chosen, singular
    raise Undecided(f"no reduced generators were found for {component!r}")


def _choices(
    component: Component, equations: Sequence[Polynomial], codimension: int
) -> Iterator[tuple[Polynomial, ...]]:
    known = tuple(f for f in equations if not f.is_zero)
    if len(known) == codimension:
        yield known
    generators = sorted(component.generators, key=lambda f: (f.total_degree, len(f)))
    if len(generators) == codimension:
        yield tuple(generators)
        return
    random = Random(2)
    yield _independent(generators, codimension, random)
    for _ in range(3):
        yield tuple(
            sum((g * random.randint(-3, 3) for g in generators), start=component.ideal.ring.zero)
            for _ in range(codimension)
        )


def _independent(generators: Sequence[Polynomial], count: int, random: Random) -> tuple[Polynomial, ...]:
    """The first generators whose gradients are independent at a random point of the whole space."""
    from flint import nmod_mat

    prime = 2**31 - 1
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
    component: Component, local: Sequence[Polynomial], singular: Ideal, budget: Budget
) -> Iterator[RealPoint]:
    """Where the distance from a generic point is critical; finitely many singular points as well."""
    ring = component.ideal.ring
    random = Random(5)
    for _ in range(_CENTRES):
        budget.check("critical points of a distance")
        system = _critical_system(component, local, random)
        try:
            if singular.dimension <= 0:
                yield from real_points(Ideal(ring, system), budget)
            else:
                for piece in _away_from(component, system, singular, budget):
                    yield from (_dropped(p, ring) for p in real_points(piece, budget))
        except NotZeroDimensional:
            continue
        return
    raise Undecided(
        f"the critical points of the distance on {component!r} are not finite for {_CENTRES} centres"
    )


def _critical_system(
    component: Component, local: Sequence[Polynomial], random: Random
) -> tuple[Polynomial, ...]:
    """Where the gradients of `local` and the direction to a random rational point are dependent."""
    ring = component.ideal.ring
    centre = [ring.constant(random.randint(-40, 40)) / random.randint(7, 13) for _ in ring.names]
    rows = [*jacobian(local, ring.names), [x - a for x, a in zip(ring.gens, centre, strict=True)]]
    found = [m for _, _, m in minors(PolynomialMatrix.of(ring, rows), len(local) + 1)]
    return (*component.generators, *map(component.ideal.reduce, found))


def _away_from(
    component: Component, system: Sequence[Polynomial], singular: Ideal, budget: Budget
) -> Iterator[Ideal]:
    """For each minor the critical points where it is not zero: together all that are not singular."""
    ring = component.ideal.ring
    wide = ring.with_names((*ring.names, "1/minor"))
    t = wide.gens[-1]
    base = [wide.convert(f) for f in system]
    known = set(component.generators)
    for minor in singular.generators:
        if minor not in known:
            budget.check("critical points of a distance")
            yield Ideal(wide, (*base, t * wide.convert(minor) - 1))


def _dropped(point: RealPoint, ring: Ring) -> RealPoint:
    """The point without its further coordinates."""
    numerators = tuple(point.numerators[point.ring.index(n)] for n in ring.names)
    return RealPoint(ring, point.minimal, point.denominator, numerators, point.low, point.high, point.bits)
