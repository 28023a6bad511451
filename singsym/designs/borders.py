"""Border polynomials: off their zeros the table of classes is locally constant.

A stratum of the family is a set over the space of parameters.  Where its fibres are bounded and smooth of one
dimension, and move smoothly, it is a locally trivial bundle (Ehresmann's lemma; for points a covering), so
that over a connected cell all fibres look alike.  What is projected into the space of parameters, by
elimination: where gradients by the configuration variables depend on each other, where it meets what is
taken out of it or the border of a limit, and a stratum that is there for special values only.
Source: D. Lazard, F. Rouillier, J. Symb. Comput. 42 (2007) 636-667 (discriminant varieties); C. Ehresmann,
Les connexions infinitesimales dans un espace fibre differentiable (1950); the rest is singsym's own.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, islice

from singsym.classes.strata.ranks import Stratum
from singsym.classes.taxonomy.types import SingularityType, feasible_classes
from singsym.designs.families import Family
from singsym.effort.budget import Budget, Undecided
from singsym.effort.verdict import Certainty, Premises
from singsym.elimination.ideal import Ideal
from singsym.minors.determinant import minors
from singsym.polynomials import Equations, Polynomial, PolynomialMatrix, Ring
from singsym.varieties.decomposition import Component, decompose
from singsym.varieties.purity import PurePiece
from singsym.varieties.real.curves.critical_points import is_bounded

_MOST_MINORS = 40
"""So many minors are taken; fewer may only make the border larger."""

_ALL = 3
"""A mobility that allows all classes."""

TOGETHER = "fall together"
MEETS = "meets another class"
SPECIAL = "only there"
LIMIT = "at a limit"


@dataclass(frozen=True)
class BorderPart:
    """One irreducible factor of the border, with the types of the strata that it comes from, and why."""

    polynomial: Polynomial
    reasons: tuple[tuple[SingularityType, str], ...]


@dataclass(frozen=True)
class Borders:
    """Where in the space of parameters the table of classes may change.

    parts: factors, in the ring of the parameters; the zeros of other polynomials are no borders.
    open: for types, why it is not proven that nothing else is a border of theirs.
    certainty: of all this.
    """

    parts: tuple[BorderPart, ...]
    open: tuple[tuple[SingularityType, str], ...]
    certainty: Certainty


class _Collected:
    """Factors and doubts on the way, each with the strata that they come from."""

    def __init__(self, family: Family) -> None:
        self.family = family
        known = family.exploration
        self.premises = Premises(known.certainty, "modular" if known.modular else "proven")
        self.reasons: dict[Polynomial, dict[tuple[SingularityType, str], None]] = {}
        self.open: dict[tuple[SingularityType, str], None] = {}

    def project(self, equations: Iterable[Polynomial], types: SingularityType, reason: str) -> bool:
        """Add the projection of a set to the borders; whether it is a border, not all of the space."""
        found = self.projection(equations)
        if found is None:
            return False
        for factor, _ in found.factors():
            self.reasons.setdefault(factor, {})[types, reason] = None
        return True

    def projection(self, equations: Iterable[Polynomial]) -> Polynomial | None:
        """A polynomial in the parameters that vanishes on the set, one if it is empty; None for zero."""
        ring, family = self.family.space.ring, self.family
        whole = Ideal(ring, equations).eliminate(family.others)
        known = self.premises.take(whole).generators
        found = [family.base.convert(p) for p in known if p]
        return min(found, key=lambda p: (p.total_degree, len(p)), default=None)


def borders(family: Family, seconds: float | None = 60.0) -> Borders:
    """The borders of all strata; seconds: of work for each of them.

    Of the regular configurations only whether there are any, as of all configurations together.
    What comes to no end is open for the types of its stratum.
    """
    found = _Collected(family)
    for kind in feasible_classes(_ALL):
        found.open |= {(kind.types, reason): None for reason in family.exploration.doubts(kind.types)}
    bounded = _is_bounded(family)
    for part in family.exploration.found:
        types = part.stratum.defects.types
        try:
            with Budget(work=seconds):
                _add(found, part.stratum, types, bounded)
        except Undecided as reason:
            found.open[types, str(reason)] = None
    return Borders(
        tuple(BorderPart(p, tuple(why)) for p, why in found.reasons.items()),
        tuple(found.open),
        found.premises.certainty,
    )


def _is_bounded(family: Family) -> bool:
    """Whether all configurations are bounded, for parameters in a compact set.

    Lemma: so they are where a sum of quadrics has a leading form in the configuration variables that is
    positive definite and free of parameters: what is left of lower degree is bounded by them.
    """
    ring = family.space.ring
    small = ring.with_names(family.space.variables)
    places = [ring.index(name) for name in small.names]
    quadrics = []
    for p in family.space.equations:
        top = {m: c for m, c in p.terms() if sum(m[i] for i in places) >= 2}
        if top and all(sum(m) == sum(m[i] for i in places) == 2 for m in top):
            quadrics.append(small.convert(ring.from_dict(top)))
    return bool(quadrics) and is_bounded(quadrics)


def _add(found: _Collected, stratum: Stratum, types: SingularityType, bounded: bool) -> None:
    """The borders of one stratum; raises `Undecided`."""
    family = found.family
    ring, space = family.space.ring, family.space
    removed = (*stratum.loci, *stratum.elsewhere, *space.exclusions) if types else ()
    single = [group[0] for group in removed if len(group) == 1]
    pieces = found.premises.take(decompose(stratum.equations, single, ring=ring))
    there: list[Component] = []
    for component in pieces:
        left = [_not_zero(found, component, group) for group in removed]
        if not all(left):
            continue
        if found.project(component.generators, types, SPECIAL):
            continue
        _add_piece(found, component, stratum.equations, types, [g for g in left if g], bounded)
        there.append(component)
    for one, two in combinations(there, 2):
        if not found.project((*one.generators, *two.generators), types, TOGETHER):
            raise Undecided("two parts of it meet for all values of the parameters")


def _not_zero(found: _Collected, component: Component, group: Equations) -> Equations:
    """Those of some polynomials that do not vanish on all of a component."""
    return tuple(p for p in group if not found.premises.take(component.vanishes(p)))


def _add_piece(
    found: _Collected,
    component: Component,
    equations: Equations,
    types: SingularityType,
    removed: Sequence[Equations],
    bounded: bool,
) -> None:
    """The borders of a component that is there for almost all values; raises `Undecided`.

    Lemma: let c be the codimension.  Where c polynomials that vanish on a pure piece have independent
    gradients by the configuration variables, their zeros are a manifold on which the parameters are
    independent, of the dimension of the piece, which holds the piece and so is the piece.
    """
    family = found.family
    ring = family.space.ring
    piece = PurePiece.of(component)
    if not bounded:
        raise Undecided("the configurations are not proven bounded by sums of squares")
    size = piece.codimension
    dimension = len(family.others) - size
    rows = _rows(component, (*ring.relations, *equations), size)
    gradients = PolynomialMatrix.of(ring, [[f.derivative(x) for x in family.others] for f in rows])
    dependent = _some_minors(gradients, size)
    if not found.project((*component.generators, *dependent), types, TOGETHER):
        raise Undecided("a part of it is singular for all values of the parameters")
    for g in (*family.space.positive, *family.space.nonnegative):
        if not family.moves(g) or not _not_zero(found, component, (g,)):
            continue
        if dimension or not found.project((*component.generators, g), types, LIMIT):
            raise Undecided("where limits cut it is not told for a part that is no set of points")
    for group in removed:
        if dimension:
            _off_curves(found, component, gradients, size, group, types)
        elif not found.project((*component.generators, *group), types, MEETS):
            raise Undecided("a part of it is in another class for all values of the parameters")


def _rows(component: Component, equations: Equations, size: int) -> Equations:
    """Polynomials that vanish on a component: the equations where they are as many as its codimension."""
    given = tuple(dict.fromkeys(f for f in equations if f))
    return given if len(given) == size else component.generators


def _some_minors(matrix: PolynomialMatrix, size: int) -> tuple[Polynomial, ...]:
    """Minors of this size that are not zero; none is like one that is zero."""
    return tuple(islice((minor for _, _, minor in minors(matrix, size)), _MOST_MINORS))


def _off_curves(
    found: _Collected,
    component: Component,
    gradients: PolynomialMatrix,
    size: int,
    group: Equations,
    types: SingularityType,
) -> None:
    """No connected component of a fibre lies in what is taken out of it; raises `Undecided`.

    Lemma: on a bounded manifold a coordinate has a largest value on each connected component, where its
    gradient depends on those of the equations.  A connected component on which a polynomial vanishes
    throughout has such a point among its zeros; on others the zeros have an empty interior.
    """
    ring, others = found.family.space.ring, found.family.others
    for form in _forms(ring, found.family.space.variables):
        row = [form.derivative(x) for x in others]
        wider = PolynomialMatrix.of(ring, [*gradients.rows, row])
        critical = _some_minors(wider, size + 1)
        if found.project((*component.generators, *critical, *group), types, MEETS):
            return
    raise Undecided("that it does not lie in another class was not seen")


def _forms(ring: Ring, names: Sequence[str]) -> Iterator[Polynomial]:
    """Linear forms to look for critical points of: coordinates, then a sum of multiples of all."""
    yield from islice(map(ring.gen, names), 4)
    yield sum((ring.gen(name) * (2 * k + 3) for k, name in enumerate(names)), ring.zero)
