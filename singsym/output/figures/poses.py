"""Poses for drawing: one to show a mechanism in, and those near a configuration along a null motion.

Source: clearance by singular values of L over a characteristic length, see `kinematics.scaling`; poses along
a null motion are steps along it, put back onto the loop equations by Gauss-Newton.
Numbers here are for drawing; nothing is concluded from them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TypeVar

import numpy as np

from singsym.classes.taxonomy.types import Defects
from singsym.kinematics.numerical_rank import numerical_rank
from singsym.kinematics.placement import JointValue
from singsym.kinematics.sampling import sample_configurations
from singsym.kinematics.scaling import scaled_matrix
from singsym.output.figures.scene import Stage, openness
from singsym.output.figures.style import Floats
from singsym.polynomials.compiled_map import CompiledMap
from singsym.polynomials.gauss_newton import project

SAMPLES = 24
"""Of so many random configurations one is drawn."""

_FARTHEST, _LARGEST_TURN, _SHORTER = 0.22, 0.6, (1.0, 0.5, 0.25)
"""How far the fastest point moves along a null motion, over the size of the scene, and a joint, in radians;
parts of this that are tried."""

_CONDITION = 0.3
"""What a factor e of clearance counts for, beside one of the distances of points."""

_Choice = TypeVar("_Choice")
REGULAR = Defects(0, 0, 0, 0)


def clearance(stage: Stage, point: Floats, defects: Defects = REGULAR) -> float:
    """How far a configuration with these defects is from one with larger defects, or with a leg of no length.

    The smallest of the singular values of L, L_I, L_O and L_p that are not zero, and of the lengths of legs
    over the size of the mechanism.
    """
    equation = stage.equation
    ranks = defects.ranks(equation.N, equation.n)
    scaled = scaled_matrix(equation, point)
    found = []
    for name, part in scaled.submatrices().items():
        values = (np.inf, *numerical_rank(part).singular_values)
        found.append(values[ranks[name]] if ranks[name] < len(values) else 0.0)
    scene = stage.scene(point)
    legs = [m for m in scene.marks if _is_leg(stage, m.joint.columns)]
    found += [float(np.linalg.norm(m.place - m.base)) / scene.size for m in legs]
    return min(found)


def _is_leg(stage: Stage, columns: Iterable[str]) -> bool:
    """Whether a joint is a telescope between two points, whose length is a root."""
    values = (stage.equation.values.get(column) for column in columns)
    return any(value is not None and value.square is not None for value in values)


def clearest(
    stage: Stage, choices: Iterable[_Choice], point_of: Callable[[_Choice], tuple[Floats, Defects]]
) -> _Choice:
    """Of several configurations with their defects the one with the largest `clearance`."""
    return max(choices, key=lambda choice: round(clearance(stage, *point_of(choice)), 6))


def portrait(stage: Stage, seed: int = 0) -> Floats:
    """A regular configuration with its points well apart, found numerically.

    Raises `ValueError` where none was found.
    """
    found = sample_configurations(stage.placement.space, SAMPLES, seed=seed)
    if not found:
        raise ValueError(f"{stage.mechanism.name}: no configuration was found to draw it in; give one")

    def rank(point: Floats) -> float:
        clear = max(clearance(stage, point), 1e-9)
        return openness(stage.scene(point).all_points) + _CONDITION * float(np.log(clear))

    return max(found, key=rank)


# -- along a null motion -------------------------------------------------------------------------------


def poses_along(
    stage: Stage, point: Floats, rates: Mapping[str, float], steps: Sequence[float]
) -> list[Floats]:
    """Configurations near a point along a motion with these joint rates, at steps from -1 to 1, links rigid.

    At 1 the fastest point has gone about a fifth of the size of the scene, or less where the mechanism does
    not go as far.  Empty where it does not go at all: then the motion is one of velocities alone.
    """
    change = _tangent(stage, point, rates)
    fastest = max((float(np.linalg.norm(v)) for v in stage.velocities(point, rates).values()), default=0.0)
    size = stage.scene(point).size
    reach = min(_FARTHEST * size / max(fastest, 1e-12), _LARGEST_TURN)
    space = stage.placement.space
    system = CompiledMap.balanced(space.equations, space.ring)
    sizes = np.maximum(np.abs(system.sizes), 1e-9)

    def landed(step: float) -> Floats | None:
        ahead = step * change
        found = project(system, point + ahead, stage.free) if system.count else point + ahead
        if found is None:
            return None
        missed, gone = (float(np.linalg.norm(x / sizes)) for x in (found - point - ahead, ahead))
        return found if missed <= gone / 2 else None

    for shorter in _SHORTER:
        found = [point if step == 0 else landed(shorter * reach * step) for step in steps]
        if all(pose is not None for pose in found):
            return [pose for pose in found if pose is not None]
    return []


def _tangent(stage: Stage, point: Floats, rates: Mapping[str, float]) -> Floats:
    """How the configuration variables change: as loop equations, drawn places and angles say."""
    space = stage.placement.space
    moved, slopes = stage.velocities(point, rates), stage.slopes(point)
    rows = [CompiledMap.balanced(space.equations, space.ring).jacobian(point)]
    wanted = [np.zeros(len(space.equations))]
    for key, slope in slopes.items():
        rows.append(slope)
        wanted.append(moved[key])
    for label, value in stage.equation.values.items():
        turned = _turning(value, point)
        if turned is not None:
            rows.append(turned[None])
            wanted.append(np.array([rates.get(label, 0.0)]))
    matrix = np.concatenate(rows)
    matrix[:, [i for i in range(len(point)) if i not in stage.free]] = 0
    return np.asarray(np.linalg.lstsq(matrix, np.concatenate(wanted), rcond=1e-9)[0])


def _turning(value: JointValue, point: Floats) -> Floats | None:
    """The slope of a joint's angle by the configuration variables; None where it is no angle."""
    if value.cosine is None or value.sine is None:
        return None
    (c, s), slopes = CompiledMap((value.cosine, value.sine), value.cosine.ring)(point)
    square = float(c * c + s * s)
    return np.asarray((c * slopes[1] - s * slopes[0]) / square) if square > 1e-18 else None
