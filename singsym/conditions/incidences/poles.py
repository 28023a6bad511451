"""Lines along which links of a planar mechanism bear forces; three of them may meet in a point.

Source: K. H. Hunt, *Kinematic Geometry of Mechanisms* (1978): a link with two turning joints bears a force
along the line through both alone, one with a turning joint and a slide a force across the slide; three
forces balance where their lines meet or are parallel.  The lines of two such links between a third and the
ground meet in its pole.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations, islice

from singsym.conditions.incidences.grassmann_cayley import Vector, along, determinant, join
from singsym.conditions.incidences.quantities import Quantity, bracket, symbol
from singsym.kinematics.modules.words import listed
from singsym.kinematics.placement import PlacedJoint
from singsym.kinematics.velocity import VelocityEquation
from singsym.polynomials import Polynomial

MOST = 500
"""Not more than this many triples of lines are tried."""

MOST_TERMS = 40
"""Lines with more terms in their coordinates are left out."""


@dataclass(frozen=True)
class _Force:
    """A link's line of force: the names of its points or slide, how it is written, and its coordinates."""

    ends: frozenset[str]
    latex: str
    text: str
    words: str
    line: Vector


def through_poles(equation: VelocityEquation) -> Iterator[tuple[Polynomial, Quantity]]:
    """Brackets of three lines of force, of which no two have a point in common.

    >>> from singsym.kinematics.velocity import velocity_equation
    >>> from singsym.mechanism import load
    >>> [q.words for _, q in through_poles(velocity_equation(load("stephenson-six-bar")))]
    ['lines AB, CD and EF through a point or parallel', 'lines AB, CD and FG through a point or parallel']
    """
    free = (t for t in combinations(_forces(equation), 3) if _are_apart(t))
    for triple in islice(free, MOST):
        words = f"lines {listed([f.words for f in triple])} through a point or parallel"
        named = bracket([f.latex for f in triple], [f.text for f in triple], words)
        yield determinant([f.line for f in triple]), named


def _are_apart(forces: tuple[_Force, ...]) -> bool:
    return all(one.ends.isdisjoint(two.ends) for one, two in combinations(forces, 2))


def _forces(equation: VelocityEquation) -> list[_Force]:
    """The lines of all links with two joints, of which one turns or both do."""
    places = {name: tuple(place) for name, place in equation.space.points.items()}
    if equation.architecture is None or not places or any(len(place) != 2 for place in places.values()):
        return []
    joined = defaultdict[str, list[PlacedJoint]](list)
    for joint in equation.architecture.joints:
        for link in (joint.first, joint.second):
            joined[link].append(joint)
    joined.pop(equation.architecture.ground, None)
    found = (_force(own[0], own[1], places) for own in joined.values() if len(own) == 2)
    return [f for f in found if f is not None and sum(map(len, f.line)) <= MOST_TERMS]


def _force(one: PlacedJoint, two: PlacedJoint, places: dict[str, Vector]) -> _Force | None:
    if any(len(joint.screws) != 1 for joint in (one, two)):
        return None
    turning = [joint for joint in (one, two) if joint.screws[0][0]]
    if not all(joint.points for joint in turning):
        return None
    if len(turning) == 2:
        p, q = (joint.points[0] for joint in turning)
        name = p + q
        return _Force(frozenset((p, q)), symbol(p) + symbol(q), name, name, join(places[p], places[q]))
    if len(turning) != 1:
        return None
    (slide,) = (joint for joint in (one, two) if joint is not turning[0])
    p = turning[0].points[0]
    _, x, y = slide.screws[0]
    words = f"the normal of slide {slide.name} at {p}"
    latex = rf"{symbol(p)}{{:}}n_{{{symbol(slide.name)}}}"
    return _Force(frozenset((p, slide.name)), latex, f"{p}:n_{slide.name}", words, along(places[p], (-y, x)))
