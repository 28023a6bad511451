"""Lines between points of a planar mechanism that are perpendicular or parallel to its slides.

Source: K. H. Hunt (1978): a slide is a turn about a point at infinity, so that these are collinear points.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from singsym.conditions.incidences.grassmann_cayley import minus
from singsym.conditions.incidences.quantities import Quantity, arrow, bracket, symbol
from singsym.kinematics.placement import dot
from singsym.kinematics.velocity import VelocityEquation
from singsym.polynomials import Polynomial


def beside_slides(equation: VelocityEquation) -> Iterator[tuple[Polynomial, Quantity]]:
    """Products of the vector between two points with the direction of a slide, and with its normal.

    >>> from singsym.kinematics.velocity import velocity_equation
    >>> from singsym.mechanism import load
    >>> found = beside_slides(velocity_equation(load("slider-crank")))
    >>> next((str(p), q.words) for p, q in found if q.text == "BC.u_P")
    ('-Bx + d_P', 'BC perpendicular to slide P')
    """
    named = sorted(equation.space.places.items())
    if equation.architecture is None or any(len(place) != 2 for _, place in named):
        return
    joints = equation.architecture.joints
    slides = [joint for joint in joints if len(joint.screws) == 1 and not joint.screws[0][0]]
    found = [(slide, *pair) for slide in slides for pair in combinations(named, 2)]
    # points of the slide's own leg before others
    found.sort(key=lambda own: not {own[1][0], own[2][0]} & {*own[0].points})
    for slide, (start, p), (end, q) in found:
        _, x, y = slide.screws[0]
        vector, name = minus(q, p), f"{start}{end}"
        direction = rf"u_{{{symbol(slide.name)}}}"
        across = Quantity(
            rf"{arrow(start, end)} \cdot {direction}",
            f"{name}.u_{slide.name}",
            f"{name} perpendicular to slide {slide.name}",
        )
        yield dot(vector, (x, y)), across
        words = f"{name} parallel to slide {slide.name}"
        latex = [direction, arrow(start, end)]
        yield dot(vector, (-y, x)), bracket(latex, [f"u_{slide.name}", name], words)
