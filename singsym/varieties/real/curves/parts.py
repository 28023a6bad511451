"""The connected components of a part of a real curve that is a union of its irreducible components.

Lemma: a smooth arc on which a polynomial vanishes near one point lies in its zeros as a whole.  Where every
point of the curve is in one of two closed sets, the arc lies in that which is known by a point off the other.
Source: Bochnak, Coste, Roy, Real Algebraic Geometry (1998), 2.8 (real analytic arcs).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction

import networkx as nx
from flint import arb

from singsym.effort.budget import Undecided
from singsym.polynomials import Polynomial
from singsym.varieties.real.curves.arithmetic import Array
from singsym.varieties.real.curves.real_curve import RealCurve
from singsym.varieties.real.points.intervals import at_precision, ball, sign_on_box

_NEAR = Fraction(1, 10**8)
"""Vertices of arcs are within 1e-9 of the curve."""
_VERTICES = 9


def components_outside(
    curve: RealCurve, groups: Iterable[Sequence[Polynomial]], rest: Sequence[Polynomial]
) -> int:
    """How many components that are no points are left without the arcs in the zeros of some group.

    Each point of the curve is a zero of all polynomials of some group, or of all of `rest`.
    Raises `Undecided` where the topology is not proven, or an arc is not seen to be in one part.

    >>> from singsym.polynomials import Ring
    >>> from singsym.varieties.real.curves.real_curve import real_curve
    >>> x, y = Ring(("x", "y")).gens
    >>> circle = x**2 + y**2 - 1
    >>> components_outside(real_curve([circle * (x - 5)]), [[x - 5]], [circle])
    1
    """
    if curve._proof is None:
        raise Undecided(f"the topology of the curve is {curve.verdict}")
    parts = [tuple(group) for group in groups]
    kept = nx.Graph()
    for edge in curve._proof.edges:
        if _is_outside(edge.chain.points, parts, rest):
            kept.add_edge(*edge.ends)
    return int(nx.number_connected_components(kept))


def _is_outside(vertices: Array, groups: Sequence[Sequence[Polynomial]], rest: Sequence[Polynomial]) -> bool:
    """Whether an arc is in none of the groups' zeros; the vertices in its middle are looked at."""
    count = len(vertices)
    for k in range(1, _VERTICES + 1):
        place = [float(x) for x in vertices[k * (count - 1) // (_VERTICES + 1)]]
        with at_precision(128):
            box = tuple(
                ball(Fraction(x)) + arb(0, ball(_NEAR * (1 + abs(Fraction(x)))).upper()) for x in place
            )
            if all(any(sign_on_box(g, box) for g in group) for group in groups):
                return True
            if any(sign_on_box(h, box) for h in rest):
                return False
    raise Undecided("an arc of the curve is not seen to be in one class")
