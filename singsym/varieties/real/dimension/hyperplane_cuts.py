"""The dimension of a set given by dependent equations: cut by hyperplanes until points are left.

Lemma: off a hyperplane h = 0, the components of V(I) that meet it do so in dimension one less (Krull).  So a
point of the d-th cut, each made after the components inside the hyperplane were left out (I : h^oo), lies on
a component of dimension d at least.  Where V(I) has no larger ones and the gradients have rank n - d, it is a
manifold of dimension d there.
Source: Eisenbud, Commutative Algebra (1995), ch. 10; numerical points guide the choice of the hyperplanes.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction

from flint import fmpq

from singsym.effort import chance, patience
from singsym.effort.attempts import attempt
from singsym.effort.verdict import Known, Premises, Verdict
from singsym.elimination.engines import EngineUnavailable
from singsym.elimination.ideal import Ideal
from singsym.elimination.modulo_primes import residues
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.dimension.real_dimension import has_rank
from singsym.varieties.real.points.certified_point import Witness, frozen_values, samples
from singsym.varieties.real.points.exact_point import RealPoint
from singsym.varieties.real.points.finite_sets import real_points
from singsym.varieties.real.system import RealSystem
from singsym.varieties.splitting import factor_equations, irreducible_factors, used_ring

CUTS = 6
TRIES = 40


@dataclass(frozen=True)
class Cut:
    """A bound of a set's complex dimension, -1 when empty, and a real point where it is reached, if found.

    Where there is a point, the bound is the dimension.
    """

    dimension: int
    point: Witness | None


def dimension_by_cuts(system: RealSystem) -> Known[Cut]:
    """The dimension of a system's solutions off its exclusions, as a `Cut`; raises `Undecided` out of budget.

    >>> R = Ring(("x", "y", "z"))
    >>> x, y, z = R.gens
    >>> lines = RealSystem(R, (x * y, x * z, x * y * z), exclusions=((x,),))
    >>> cut = dimension_by_cuts(lines).value
    >>> cut.dimension, cut.point is not None
    (1, True)
    """
    ring = used_ring(system.ring, system.closed_equations)
    free = len(system.ring.names) - len(ring.names)
    premises = Premises()
    ideal = premises.take(stripped(Ideal(system.ring, system.closed_equations), system.nonzero))
    if free and any(set(g.variables) - set(ring.names) for group in _conditions(system) for g in group):
        ring, free = system.ring, 0
    ideal = Ideal(ring, map(ring.convert, ideal.generators))
    dimension = premises.take(ideal.dimension)
    if dimension < 0:
        return premises.conclude(Cut(-1, None))
    small = RealSystem(
        ring,
        ideal.generators,
        tuple(tuple(map(ring.convert, group)) for group in system.exclusions),
        tuple(map(ring.convert, system.positive)),
        tuple(map(ring.convert, system.nonnegative)),
    )
    point = premises.take(_cut_point(small, ideal, dimension))
    return premises.conclude(Cut(dimension + free, point))


def seems_at_most(ring: Ring, equations: Sequence[Polynomial], dimension: int) -> Verdict:
    """Whether no complex zero is left on more random hyperplanes than a dimension, modulo random primes.

    Each hyperplane meets every component of positive dimension unless its slope is one of few: what a prime
    is to coefficients, it is to hyperplanes.  A yes is hardly ever wrong, and "modular"; else it is
    undecided.  Raises `Undecided` out of budget.

    >>> R = Ring(("x", "y", "z"))
    >>> x, y, z = R.gens
    >>> seems_at_most(R, [x * y, x * z], 1).answer
    <Answer.UNDECIDED: 'undecided'>
    """
    small = used_ring(ring, equations)
    cuts = dimension + 1 - (len(ring.names) - len(small.names))
    if cuts < 0:
        return Verdict.undecided("more variables are free")
    drawing, fixed = chance.random("hyperplanes", *equations), {c.name for c in ring.constants}
    free = [small.gen(name) for name in small.names if name not in fixed]
    planes = [
        sum((g * drawing.randint(1, 2**30) for g in free), start=small.one * drawing.randint(1, 2**30))
        for _ in range(cuts)
    ]
    cut = Ideal(small, (*map(small.convert, equations), *planes))
    with suppress(EngineUnavailable):
        if all(residue.is_unit for residue in residues(cut, limited=False)):
            return Verdict.yes("modular", reason="random hyperplanes meet no zero")
    return Verdict.undecided("random hyperplanes meet a zero, or nobody can say")


def _conditions(system: RealSystem) -> tuple[tuple[Polynomial, ...], ...]:
    return (*system.exclusions, system.positive, system.nonnegative)


def stripped(ideal: Ideal, nonzero: Sequence[Polynomial]) -> Known[Ideal]:
    """A larger ideal with the same zeros off those of some polynomials, given by a Groebner basis.

    Factors that are among them are left out of the basis, again and again.

    >>> x, y = Ring(("x", "y")).gens
    >>> stripped(Ideal(x.ring, (x * y, x**2 * y + x)), [x]).value.generators
    (1,)
    """
    nonzero_factors, premises = irreducible_factors(nonzero), Premises()
    while True:
        basis = premises.take(ideal.groebner_basis())
        factored = None if nonzero_factors is None else factor_equations(basis, nonzero_factors)
        if factored is None:
            return premises.conclude(Ideal(ideal.ring, (ideal.ring.one,)))
        products = []
        for factors in factored:
            product = ideal.ring.one
            for factor in factors:
                product = product * factor
            products.append(product.primitive())
        if set(products) <= set(basis):
            return premises.conclude(Ideal(ideal.ring, basis))
        ideal = Ideal(ideal.ring, products)


def _cut_point(system: RealSystem, ideal: Ideal, dimension: int) -> Known[Witness | None]:
    ring, done = system.ring, 0
    for sample in samples(system, system.equations, 0, TRIES):
        for values in frozen_values(system, system.equations, sample, dimension):
            done += 1
            points: tuple[RealPoint, ...] = ()
            premises = Premises()
            with attempt("cutting by hyperplanes", patience.HYPERPLANE_CUTS.work):
                cut = premises.take(_cut(ideal, values, dimension))
                # each is a point of the cut; whether there are others is no matter
                points = real_points(cut).value
            for point in points:
                if system.admits(point) and has_rank(ideal.generators, point, len(ring.names) - dimension):
                    return premises.conclude(Witness(point, tuple(values)))
            if done == CUTS:
                return Known(None)
    return Known(None)


def _cut(ideal: Ideal, values: dict[str, Fraction], dimension: int) -> Known[Ideal]:
    """The cut by so many of the hyperplanes in turn, and at once by the others."""
    ring, premises = ideal.ring, Premises()
    planes = [_plane(ring, name, value) for name, value in values.items()]
    for plane in planes[:dimension]:
        ideal = premises.take(ideal.saturate(plane)) + plane
    return premises.conclude(Ideal(ring, (*ideal.generators, *planes[dimension:])))


def _plane(ring: Ring, name: str, value: Fraction) -> Polynomial:
    return ring.gen(name) - ring.constant(fmpq(value.numerator, value.denominator))
