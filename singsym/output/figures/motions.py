"""Which null motions of a configuration a figure shows, and their words.

Source: the six types of Zlatanov, Fenton, Benhabib (1998), section 2.2; ranks are those that were proven,
the motions themselves are numerical, for drawing.
"""

from __future__ import annotations

from dataclasses import dataclass

from singsym.classes.configuration.null_motions import Motion, null_motions, numerical_kernels
from singsym.classes.taxonomy.types import Defects, SingularityType
from singsym.kinematics.numerical_rank import numerical_rank
from singsym.kinematics.scaling import scaled_matrix
from singsym.kinematics.velocity import VelocityEquation
from singsym.output.figures.poses import poses_along
from singsym.output.figures.scene import Scene, Stage
from singsym.output.figures.style import Floats, Velocities

WORDS = {
    SingularityType.RI: "redundant input: inputs move, the output stands still",
    SingularityType.RO: "redundant output: the output moves, inputs stand still",
    SingularityType.RPM: "redundant passive motion: passive joints move, inputs and output stand still",
}
"""The types that are shown by a motion; every class has one of them."""


@dataclass(frozen=True, eq=False)
class Moving:
    """A null motion as it is drawn: velocities as arrows, and the scene a little later if it goes there."""

    motion: Motion
    velocities: Velocities
    later: Scene | None

    @classmethod
    def of(cls, stage: Stage, point: Floats, motion: Motion) -> Moving:
        """A motion from a configuration on."""
        poses = poses_along(stage, point, motion.rates, (1.0,))
        later = stage.scene(poses[0]) if poses else None
        return cls(motion, stage.velocities(point, motion.rates), later)


def motions_at(equation: VelocityEquation, point: Floats, defects: Defects) -> tuple[Motion, ...]:
    """All null motions and restrictions of a configuration whose rank defects are known."""
    scaled = scaled_matrix(equation, point)
    seen = {name: numerical_rank(part) for name, part in scaled.submatrices().items()}
    ranks = defects.ranks(equation.N, equation.n)
    return null_motions(equation, numerical_kernels(scaled, seen, ranks), scaled.units, defects.types)


def drawn_motions(motions: tuple[Motion, ...]) -> tuple[Motion, ...]:
    """The first motion of each of the types RI, RO, RPM."""
    by_type: dict[SingularityType, Motion] = {}
    for motion in motions:
        if motion.type in WORDS:
            by_type.setdefault(motion.type, motion)
    return tuple(by_type.values())


def rates_text(motion: Motion) -> str:
    """The velocities of a motion, in proportion."""
    return ", ".join(f"{label} {value:.3g}" for label, value in motion.rates.items()).replace("-", "−")


def restriction_text(motion: Motion) -> str:
    """A restriction as an equation between velocities.

    >>> restriction_text(Motion(SingularityType.II, {"A": 1.0, "E": -0.5}, True))
    'A − 0.5 E = 0'
    >>> restriction_text(Motion(SingularityType.IO, {"x": -0.5, "y": 1.0}, True))
    '−0.5 x + y = 0'
    """
    terms = []
    for label, x in motion.rates.items():
        size = "" if abs(abs(x) - 1) < 1e-9 else f"{abs(x):.3g} "
        terms.append(f"{'−' if x < 0 else '+'} {size}{label}")
    head = terms[0].removeprefix("+ ").replace("− ", "−")
    return " ".join([head, *terms[1:]]) + " = 0"
