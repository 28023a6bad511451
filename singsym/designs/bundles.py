"""Sets over the space of parameters, and the sets that are projected there: off them all fibres look alike.

Source: C. Ehresmann, Les connexions infinitesimales dans un espace fibre differentiable (1950), also for
manifolds with corners, face by face; the rest is singsym's own.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, islice

from singsym.effort.budget import Undecided
from singsym.minors.determinant import TooManyTerms, minors
from singsym.polynomials import Equations, Polynomial, PolynomialMatrix, Ring
from singsym.varieties.decomposition import Component
from singsym.varieties.purity import PurePiece

_MOST_MINORS = 40
"""So many minors are taken; fewer may only make the border larger."""
_MOST_TERMS = 1_000_000
"""Of all minors of some rows together: with more an elimination has no prospects."""


@dataclass(frozen=True)
class Bundle:
    """The zeros of `equations` over the space of parameters, of one dimension off their folds.

    rows: polynomials that vanish on them, for gradients; size: so many of these are independent off the
    folds, by the variables `others` that are no parameters.

    Lemma: there the zeros of `size` rows are a manifold on which the parameters are independent.  It holds
    the set, and is the set where the rows are the equations, or where the set is pure of this codimension.
    """

    ring: Ring
    others: tuple[str, ...]
    equations: Equations
    rows: Equations
    size: int

    @classmethod
    def of_equations(cls, ring: Ring, others: tuple[str, ...], equations: Sequence[Polynomial]) -> Bundle:
        """All zeros of equations, each of which takes one off the dimension."""
        given = tuple(dict.fromkeys(f for f in (*ring.relations, *equations) if f))
        return cls(ring, others, given, given, len(given))

    @classmethod
    def of_component(
        cls, component: Component, others: tuple[str, ...], equations: Sequence[Polynomial]
    ) -> Bundle:
        """A pure component of the zeros of equations; raises `Undecided` where it is not known to be pure."""
        size, ring = PurePiece.of(component).codimension, component.ideal.ring
        given = tuple(dict.fromkeys(f for f in (*ring.relations, *equations) if f))
        rows = given if len(given) == size else component.generators
        return cls(ring, others, component.generators, rows, size)

    @property
    def dimension(self) -> int:
        """That of its fibres, off the folds."""
        return len(self.others) - self.size

    def folds(self) -> Iterator[Equations]:
        """Sets whose union is where gradients depend on each other, or a little more.

        Lemma: let only some rows hold some variables.  Where their gradients by these are independent, all
        gradients are, if those of the other rows are; so these are looked at without the former, as they are
        where a mechanism lacks a dyad.
        """
        if len(self.rows) == self.size and (own := self._module()) is not None:
            rows, names = own
            ends = self._minors(rows, names, len(rows))
            yield (*self.equations, *ends, *self._dependent(()))
            left = tuple(f for f in self.rows if f not in rows)
            rest = tuple(f for f in self.equations if f not in rows)
            yield from replace(self, equations=rest, rows=left, size=len(left)).folds()
        elif self.size:
            yield (*self.equations, *self._dependent(()))

    def _module(self) -> tuple[Equations, tuple[str, ...]] | None:
        """The fewest rows that alone hold as many variables, or more, and these."""
        holding = {x: frozenset(f for f in self.rows if f.degree(x) > 0) for x in self.others}
        found = []
        for rows in dict.fromkeys(filter(None, holding.values())):
            names = tuple(x for x, own in holding.items() if own and own <= rows)
            if len(rows) <= len(names):
                found.append((tuple(f for f in self.rows if f in rows), names))
        return min(found, key=lambda own: len(own[0]), default=None)

    def faces(self, limits: Sequence[Polynomial]) -> Iterator[Equations]:
        """Where limits that are zero together do not cut the set across.

        Off them the part inside all limits is a manifold with corners, and so are its fibres.
        """
        for count in range(1, min(len(limits), self.dimension + 1) + 1):
            for chosen in combinations(limits, count):
                yield (*self.equations, *chosen, *self._dependent(chosen))

    def touches(self, group: Equations) -> Equations:
        """Where all polynomials of a group vanish, none with a gradient of its own.

        Lemma: where the group vanishes on an open part of a fibre, their gradients depend there on those of
        the rows.
        """
        single = [p for g in group for p in self._dependent((g,))]
        return (*self.equations, *group, *single)

    def summits(self, group: Equations, names: Sequence[str]) -> Iterator[Equations]:
        """The same where besides a linear form of these variables has a gradient that depends on the rows'.

        Lemma: on each connected component of a bounded manifold a form has a largest value.  Where the group
        vanishes on all of a component, that is a point where it does, and no gradient is its own.
        """
        for form in _forms(self.ring, names):
            yield (*self.touches(group), *self._dependent((form,)))

    def _dependent(self, more: Sequence[Polynomial]) -> Equations:
        """What vanishes where gradients of the rows and of more are dependent."""
        return self._minors((*more, *self.rows), self.others, self.size + len(more))

    def _minors(self, rows: Sequence[Polynomial], names: Sequence[str], size: int) -> Equations:
        """Minors, none of them zero, of gradients by some variables; raises `Undecided` for long ones."""
        gradients = [[f.derivative(x) for x in names] for f in rows]
        found = minors(PolynomialMatrix.of(self.ring, gradients), size, _MOST_TERMS)
        try:
            return tuple(islice((minor for _, _, minor in found), _MOST_MINORS))
        except TooManyTerms as many:
            raise Undecided(f"gradients are not compared: {many}") from many


def _forms(ring: Ring, names: Sequence[str]) -> Iterator[Polynomial]:
    """Linear forms to look for critical points of: coordinates, then a sum of multiples of all."""
    yield from islice(map(ring.gen, names), 4)
    yield sum((ring.gen(name) * (2 * k + 3) for k, name in enumerate(names)), ring.zero)
