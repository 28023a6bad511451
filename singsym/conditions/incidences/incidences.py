"""What the architecture of a mechanism says of the factors of its conditions.

Source: see `platforms` and `arms`; singsym's own in what is tried first.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from singsym.conditions.incidences.arms import Arm, arm
from singsym.conditions.incidences.hinges import beside_hinges
from singsym.conditions.incidences.platforms import Platform, platform
from singsym.conditions.incidences.poles import through_poles
from singsym.conditions.incidences.quantities import Quantity
from singsym.conditions.incidences.slides import beside_slides
from singsym.kinematics.nonzero import Certifier
from singsym.kinematics.velocity import VelocityEquation
from singsym.polynomials import Polynomial


@dataclass(frozen=True, eq=False)
class Incidences:
    """Quantities of a mechanism that its determinants consist of, by its legs or as a serial arm."""

    equation: VelocityEquation
    certifier: Certifier

    @cached_property
    def platform(self) -> Platform | None:
        """The moved link on its legs, where these say all of L_I."""
        return platform(self.equation, self.certifier)

    @cached_property
    def arm(self) -> Arm | None:
        """The mechanism as a serial arm."""
        return arm(self.equation, self.certifier)

    def parts_of(self, name: str) -> tuple[Polynomial, ...] | None:
        """Polynomials whose product is the determinant of a matrix; None where legs do not say it."""
        return self.platform.polynomials if name == "L_I" and self.platform else None

    def bracket_of(self, name: str) -> Quantity | None:
        """Of such a determinant with too many terms the bracket that vanishes where it does."""
        on_legs = self.platform if name == "L_I" else None
        return on_legs.bracket if on_legs is not None and on_legs.stays_unexpanded else None

    def squares(self) -> Iterator[tuple[Polynomial, Quantity]]:
        """Squares of lengths that may be factors up to their sign, with their names."""
        if self.arm is not None:
            yield from self.arm.squares()

    def values(self) -> Iterator[tuple[Polynomial, Quantity]]:
        """Brackets and volumes that may be factors, with their names."""
        if self.arm is not None:
            yield from self.arm.values()
        elif self.platform is not None:
            yield from self.platform.values()
        yield from beside_slides(self.equation)
        yield from through_poles(self.equation)
        yield from beside_hinges(self.equation)

    @property
    def output_at_rest(self) -> str:
        """What L_O being singular says of a planar mechanism with one output component, in words; else ""."""
        found, rows = self.equation.architecture, self.equation.rows
        planar = all(len(place) == 2 for place in self.equation.space.points.values())
        outputs = [row.removeprefix("output ") for row in rows if row.startswith("output ")]
        if found is None or not found.moved or not planar or len(outputs) != 1:
            return ""
        if outputs[0] == "w":
            return f"{found.moved} does not turn"
        along = outputs[0].removeprefix("v")
        return (
            f"pole of {found.moved} on the line through {found.point} along {along}, or {found.moved} at rest"
        )
