"""Pieces of a variety that are proven to have one dimension: what a real manifold near a point is read from.

Source: the unmixedness theorem, in D. Eisenbud, Commutative Algebra (1995), 18.14.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from singsym.effort.budget import Undecided
from singsym.effort.verdict import Known
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.decomposition import Component


@dataclass(frozen=True)
class PurePiece:
    """A piece all of whose components over C have its dimension, and why; made by `PurePiece.of`.

    Lemma: let c be its codimension.  Where c polynomials that vanish on it have independent gradients, their
    zeros are a smooth irreducible germ of its dimension that holds the piece, and so is the piece.
    """

    component: Component
    reason: str

    @classmethod
    def of(cls, component: Component) -> PurePiece:
        """The piece, where its purity is proven; raises `Undecided` where it is not.

        >>> x, y, z = Ring(("x", "y", "z")).gens
        >>> PurePiece.of(Component(Ideal(x.ring, (x**2 - y, z)), False, 1)).reason
        'as many generators as its codimension'
        >>> PurePiece.of(Component(Ideal(x.ring, (x * z, y * z)), False, 2))
        Traceback (most recent call last):
        ...
        singsym.effort.budget.Undecided: a part of dimension 2 may hold smaller ones beside it: \
Component(x*z, y*z = 0, dimension 2, not proven prime)
        """
        if component.prime:
            return cls(component, "a prime ideal")
        if component.is_pure:
            return cls(component, f"an ideal proven {component.purity}")
        if component.dimension <= 0:
            return cls(component, "finitely many points")
        if len(component.ideal.ring.names) - component.dimension == len(component.generators):
            return cls(component, "as many generators as its codimension")
        raise Undecided(
            f"a part of dimension {component.dimension} may hold smaller ones beside it: {component!r}"
        )

    @property
    def ideal(self) -> Ideal:
        """The ideal of the component."""
        return self.component.ideal

    @property
    def ring(self) -> Ring:
        """Its ring."""
        return self.component.ideal.ring

    @property
    def dimension(self) -> int:
        """Its complex dimension."""
        return self.component.dimension

    @property
    def codimension(self) -> int:
        """The number of variables less the dimension."""
        return len(self.ring.names) - self.dimension


def pure_or_whole(
    components: Sequence[Component], equations: Sequence[Polynomial], ring: Ring
) -> Known[tuple[Component, ...]]:
    """The components of V(equations), or all of it as one where that is pure and one of them is not.

    >>> x, y = Ring(("x", "y")).gens
    >>> doubtful = Component(Ideal(x.ring, (x * y, x**2 * y, x * y**2)), False, 1)
    >>> pure_or_whole([doubtful], [x * y], x.ring).value
    (Component(x*y = 0, dimension 1, not proven prime),)
    """
    given = tuple(dict.fromkeys(f for f in equations if f))
    dimension = len(ring.names) - len(given)
    if all(map(_is_pure, components)) or max(c.dimension for c in components) != dimension:
        return Known(tuple(components))
    whole = Ideal(ring, given)
    known = whole.dimension
    pure = (Component(whole, False, dimension),)
    return Known(pure if known.value == dimension else tuple(components), known.certainty)


def _is_pure(component: Component) -> bool:
    try:
        PurePiece.of(component)
    except Undecided:
        return False
    return True
