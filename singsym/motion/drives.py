"""Values of joints and coordinates of points that are given, as equations beside the loop equations.

Source: driving constraints, Nikravesh, Computer-Aided Analysis of Mechanical Systems (1988), section 3.2.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from singsym.kinematics.placement import JointValue
from singsym.kinematics.velocity import VelocityEquation
from singsym.mechanism.problems import MechanismError, Problem
from singsym.polynomials import Equations, Polynomial, Ring


@dataclass(frozen=True)
class Drive:
    """One value that is given: of a joint by its column label, or of a point's coordinate as `C.x`.

    names: what stands for the value in the wider ring: cosine and sine of an angle, or the length itself.
    cosine, sine, scale: of an angle; side: what has to be the length, or its square, in the wider ring.
    """

    label: str
    names: tuple[str, ...]
    cosine: Polynomial
    sine: Polynomial
    scale: Polynomial
    side: Polynomial

    @property
    def is_angle(self) -> bool:
        """Whether the value is an angle, in radians; else it is a length."""
        return len(self.names) == 2

    @property
    def equations(self) -> Equations:
        """Of an angle its cosine and its sine, of a length one: the value is the given one."""
        if not self.is_angle:
            return (self.side,)
        c, s = map(self.side.ring.gen, self.names)
        return self.cosine - self.scale * c, self.sine - self.scale * s

    @property
    def equation(self) -> Polynomial:
        """One equation: of an angle it says that the given one is the joint's, or half a turn away."""
        if not self.is_angle:
            return self.side
        c, s = map(self.side.ring.gen, self.names)
        return self.cosine * s - self.sine * c

    @property
    def agreement(self) -> Polynomial:
        """Positive for an angle that is less than a quarter of a turn from the joint's; 1 for a length."""
        if not self.is_angle:
            return self.side.ring.one
        c, s = map(self.side.ring.gen, self.names)
        return self.cosine * c + self.sine * s


@dataclass(frozen=True)
class DrivenSystem:
    """The loop equations with drives, over a ring whose last names stand for the given values.

    unknowns: the names that are to be determined.
    """

    ring: Ring
    loops: Equations
    drives: tuple[Drive, ...]
    unknowns: tuple[str, ...]


def driven_system(
    equation: VelocityEquation, labels: Sequence[str], more: Mapping[str, JointValue] | None = None
) -> DrivenSystem:
    """The loop equations with the values of these joints and coordinates given.

    labels: column labels of joints, and coordinates of named points as `C.x`, or those of `more`,
    further values by label.  Raises `MechanismError` for
    others, and for a mechanism with symbolic parameters.

    >>> from singsym.kinematics.velocity import velocity_equation
    >>> from singsym.mechanism import load
    >>> [d.names for d in driven_system(velocity_equation(load("slider-crank")), ["A", "C.x"]).drives]
    [('cos A', 'sin A'), ('value C.x',)]
    """
    space = equation.space
    if space.parameters:
        found, expected = (
            ", ".join(space.parameters),
            "values, as mechanism.with_parameters(a=2) or --set a=2",
        )
        raise MechanismError([Problem("parameters", f"no value of {found}", expected)])
    known = {f"{p}.{x}": c for p, v in space.points.items() for x, c in zip("xyz", v, strict=False)}
    values = {**equation.values, **(more or {})}
    names: list[tuple[str, ...]] = []
    for label in labels:
        value = values.get(label)
        if value is None and label not in known:
            listed = ", ".join([*equation.values, *known])
            raise MechanismError([Problem("values", label, f"joints or coordinates of points: {listed}")])
        angle = value is not None and value.length is None and value.square is None
        names.append((f"cos {label}", f"sin {label}") if angle else (f"value {label}",))
    if len({*labels}) < len(labels):
        raise MechanismError([Problem("values", ", ".join(labels), "each label once")])
    ring = space.ring.with_names((*space.ring.names, *(n for own in names for n in own)))
    drives = tuple(
        _drive(label, own, values.get(label), known.get(label), ring)
        for label, own in zip(labels, names, strict=True)
    )
    constants = {c.name for c in space.ring.constants}
    unknowns = tuple(n for n in space.ring.names if n not in constants)
    return DrivenSystem(ring, tuple(map(ring.convert, space.equations)), drives, unknowns)


def _drive(
    label: str, names: tuple[str, ...], value: JointValue | None, coordinate: Polynomial | None, ring: Ring
) -> Drive:
    if value is None or value.cosine is None or value.sine is None:
        given = ring.gen(names[0])
        if value is not None and value.square is not None:
            side = ring.convert(value.square) - given**2
        else:
            length = value.length if value is not None else coordinate
            side = ring.convert(length if length is not None else ring.zero) - given
        return Drive(label, names, ring.zero, ring.zero, ring.one, side)
    scale = ring.one if value.scale is None else ring.convert(value.scale)
    return Drive(label, names, ring.convert(value.cosine), ring.convert(value.sine), scale, ring.zero)
