"""Lines through two ball joints of a link that meet the axes of a spatial mechanism's hinges.

Source: K. H. Hunt (1978): a force along a line does no work in a turn about an axis that it meets, or is
parallel to; ball joints bear forces alone.
"""

from __future__ import annotations

from collections.abc import Container, Iterator
from itertools import combinations

from singsym.conditions.incidences.grassmann_cayley import minus
from singsym.conditions.incidences.quantities import Quantity, arrow, bracket, symbol
from singsym.kinematics.placement import Architecture, Coordinates, cross, dot
from singsym.kinematics.velocity import VelocityEquation
from singsym.polynomials import Polynomial

MOST_TERMS = 60
"""Lines and axes with more terms in their coordinates are left out."""


def beside_hinges(equation: VelocityEquation) -> Iterator[tuple[Polynomial, Quantity]]:
    """Moments about the axes of hinges of forces along the lines through two ball joints of a link.

    >>> from singsym.kinematics.velocity import velocity_equation
    >>> from singsym.mechanism import load
    >>> found = beside_hinges(velocity_equation(load("rssr")))
    >>> for _, quantity in found:
    ...     print(quantity.words)
    line BC meets the axis a through A, or is parallel to it
    line BC meets the axis d through D, or is parallel to it
    """
    space, architecture = equation.space, equation.architecture
    if architecture is None or any(len(place) != 3 for place in space.places.values()):
        return
    lines = _lines(architecture, space.places)
    for hinge in architecture.joints:
        base = next((name for name in hinge.points if name in space.places), None)
        if [*map(_turns, hinge.screws)] != [True] or base is None or not hinge.axes:
            continue
        axis = tuple(space.directions[hinge.axes[0]])
        for start, end in lines:
            arms = [minus(space.places[name], space.places[base]) for name in (start, end)]
            if base not in (start, end) and sum(map(len, (*arms[0], *arms[1], *axis))) <= MOST_TERMS:
                yield dot(axis, cross(*arms)), _moment(start, end, base, hinge.axes[0])


def _lines(architecture: Architecture, places: Container[str]) -> list[tuple[str, str]]:
    """Points of two ball joints of one link, in the order of the joints."""
    found = dict[tuple[str, str], None]()
    balls = [joint for joint in architecture.joints if sum(map(_turns, joint.screws)) == 3]
    for one, other in combinations(balls, 2):
        if {one.first, one.second} & {other.first, other.second}:
            ends = [next((name for name in joint.points if name in places), "") for joint in (one, other)]
            if all(ends) and ends[0] != ends[1]:
                found[min(ends), max(ends)] = None
    return list(found)


def _turns(screw: Coordinates) -> bool:
    return any(screw[:3])


def _moment(start: str, end: str, base: str, axis: str) -> Quantity:
    latex = [arrow(base, start), arrow(base, end), symbol(axis)]
    words = f"line {start}{end} meets the axis {axis} through {base}, or is parallel to it"
    return bracket(latex, [f"{base}{start}", f"{base}{end}", axis], words)
