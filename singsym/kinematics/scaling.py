"""L as a matrix of pure numbers: lengths over a characteristic length, joints by unit screws.

Source: characteristic lengths: Angeles, Fundamentals of Robotic Mechanical Systems (2007), section 5.8.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from singsym.kinematics.velocity import VelocityEquation

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from singsym.kinematics.numerical_rank import Matrix

    Floats = NDArray[np.float64]

_DROPPED: dict[str, tuple[str, ...]] = {
    "L": (),
    "L_I": ("input",),
    "L_O": ("output",),
    "L_p": ("input", "output"),
}
_LINEAR = ("vx", "vy", "vz", "x", "y", "z")


@dataclass(frozen=True)
class Scaled:
    """L at a configuration, in pure numbers.

    units: what each column was multiplied by, so that rates = scaled rates * units; length: the
    characteristic length, the root mean square distance of the named points from their centre.
    Of many configurations (B, variables) the arrays have a first axis of these, and the length is an array.
    """

    equation: VelocityEquation
    matrix: Matrix
    units: Floats
    length: Any

    def columns(self, name: str) -> list[int]:
        """The places of the columns of L, L_I, L_O or L_p."""
        return [j for j, c in enumerate(self.equation.columns) if c.role not in _DROPPED[name]]

    def submatrices(self) -> dict[str, Matrix]:
        """L, L_I, L_O and L_p."""
        return {name: self.matrix[..., self.columns(name)] for name in _DROPPED}


def scaled_matrix(equation: VelocityEquation, point: Sequence[Any] | Floats) -> Scaled:
    """L at a point, of floats or of mpmath numbers, with rows and columns scaled by their kind.

    point: of floats it may be an array of many points, one a row.

    Velocities are over the characteristic length, and taken at the centre of the named points; a slide has a
    unit direction and the length as its unit, a rotation the radian.  No row or column is scaled by its own
    size unless that is nonzero on the feasible set: the direction of a slide, and of a rod's idle spin.  So
    the matrix does not depend on the unit of length, nor on where the fixed frame stands.
    Equations of one's own, whose kinds are not known, are divided by the largest singular value of L.
    """
    import numpy as np

    matrix = _evaluated(equation, point)
    many, width = matrix.shape[:-2], matrix.shape[-1]
    places = _places(equation, point)
    if equation.space.formulation == "given":
        whole = _ones_for_zeros(np.linalg.norm(matrix.astype(np.float64), 2, axis=(-2, -1)))
        pure = matrix / np.asarray(whole)[..., None, None]
        return Scaled(equation, pure, np.ones((*many, width)), _number(_ones_for_zeros(_spread(places))))
    blocks = _loops(equation)
    slides = [_is_slide(equation, j, blocks) for j in range(width)]
    for angular, linear in blocks:
        if angular and linear and places.size:
            _move(matrix, angular, linear, np.mean(places, axis=-2))
    length = _spread(places)
    length = np.where(length == 0, _reach(equation, matrix, slides), length)
    length = _ones_for_zeros(length)
    units = np.where(slides, length[..., None], 1.0)
    for j in np.flatnonzero(slides):
        sizes = [_norm(matrix[..., linear, j]) for _, linear in blocks]
        if sizes:
            units[..., j] /= _ones_for_zeros(np.max(sizes, axis=0))
    rows = np.ones((*many, len(equation.rows)))
    for i, name in enumerate(equation.rows):
        followed = _followed_joint(equation, i)
        if followed is not None:
            rows[..., i] = units[..., i] = units[..., followed]
        elif name.rpartition(" ")[2] in _LINEAR and name.startswith(("output", "loop")):
            rows[..., i] = length
            if name.startswith("output"):
                units[..., i] = length
        elif name.startswith("coupling"):
            terms = [j for j in range(width) if equation.matrix[i, j]]
            rows[..., i] = units[..., terms].max(axis=-1)
        elif name.startswith("no idle spin"):
            rows[..., i] = _ones_for_zeros(_norm(matrix[..., i, :]))
    return Scaled(equation, matrix * units[..., None, :] / rows[..., :, None], units, _number(length))


def _evaluated(equation: VelocityEquation, point: Sequence[Any] | Floats) -> Matrix:
    import numpy as np

    if isinstance(point, np.ndarray):
        return equation.compiled.values(point).reshape(*point.shape[:-1], *equation.matrix.shape)
    zero = point[0] * 0 if point else 0.0
    rows = [[e + zero for e in row] for row in equation.matrix.evaluate(point)]
    return np.array(rows, dtype=object).reshape(equation.matrix.shape)


def _places(equation: VelocityEquation, point: Sequence[Any] | Floats) -> Floats:
    """The coordinates of the named points, with the last two axes of points and coordinates."""
    import numpy as np

    named = list(equation.space.points.values())
    if isinstance(point, np.ndarray):
        many = point.shape[:-1]
        return equation.compiled_points.values(point).reshape(*many, len(named), -1 if named else 0)
    here = list(point)
    return np.array([[float(p.evaluate(here)) for p in place] for place in named], dtype=np.float64)


def _loops(equation: VelocityEquation) -> list[tuple[list[int], list[int]]]:
    """For each loop its angular and its linear rows."""
    found: list[tuple[list[int], list[int]]] = []
    for rows in equation.loop_rows:
        found.append(([], []))
        for i in rows:
            found[-1][equation.rows[i].rpartition(" ")[2] in _LINEAR].append(i)
    return found


def _is_slide(equation: VelocityEquation, j: int, blocks: Sequence[tuple[list[int], list[int]]]) -> bool:
    """Whether a joint's rate is a length: by its value, or because it turns nothing in a loop."""
    value = equation.values.get(equation.columns[j].label)
    if value is not None and (value.length is not None or value.square is not None):
        return True
    for angular, linear in blocks:
        if any(equation.matrix[i, j] for i in linear):
            return not any(equation.matrix[i, j] for i in angular)
    return False


def _followed_joint(equation: VelocityEquation, i: int) -> int | None:
    """The column of the joint whose rate is the output of row i, None for other rows."""
    kind, _, name = equation.rows[i].partition(" ")
    if kind != "output":
        return None
    entries = [j for j in range(equation.matrix.width) if j != i and equation.matrix[i, j]]
    if len(entries) != 1 or equation.columns[entries[0]].label != name:
        return None
    return entries[0] if equation.matrix[i, entries[0]] == -equation.space.ring.one else None


def _move(matrix: Matrix, angular: list[int], linear: list[int], centre: Floats) -> None:
    """Take the velocities of a loop at another point: v + w x c."""
    at = centre[..., None, :]
    if len(angular) == 1:
        spin = matrix[..., angular[0], :]
        matrix[..., linear[0], :] = matrix[..., linear[0], :] - spin * at[..., 1]
        matrix[..., linear[1], :] = matrix[..., linear[1], :] + spin * at[..., 0]
        return
    for k in range(3):
        first, second = (k + 1) % 3, (k + 2) % 3
        turned = (
            matrix[..., angular[first], :] * at[..., second]
            - matrix[..., angular[second], :] * at[..., first]
        )
        matrix[..., linear[k], :] = matrix[..., linear[k], :] + turned


def _reach(equation: VelocityEquation, matrix: Matrix, slides: Sequence[bool]) -> Floats:
    """The largest velocity that a unit rotation gives, where the points are all in one place."""
    import numpy as np

    rows = [i for i, name in enumerate(equation.rows) if name.rpartition(" ")[2] in _LINEAR]
    turns = [j for j, c in enumerate(equation.columns) if c.role != "output" and not slides[j]]
    sizes = [_norm(matrix[..., rows, j]) for j in turns]
    return np.max(sizes, axis=0) if sizes else np.zeros(matrix.shape[:-2])


def _spread(places: Floats) -> Floats:
    """The root mean square distance of points from their centre; 0 where they differ by rounding only."""
    import numpy as np

    if not places.size:
        return np.zeros(places.shape[:-2])
    offsets = places - places.mean(axis=-2, keepdims=True)
    spread = np.sqrt((offsets**2).sum(axis=-1).mean(axis=-1))
    return np.where(spread > 1e-12 * np.abs(places).max(axis=(-2, -1)), spread, 0.0)


def _norm(entries: Matrix) -> Floats:
    """Along the last axis."""
    import numpy as np

    return np.asarray(np.sqrt((entries.astype(np.float64) ** 2).sum(axis=-1)))


def _ones_for_zeros(sizes: Floats) -> Floats:
    import numpy as np

    return np.where(sizes == 0, 1.0, sizes)


def _number(length: Floats) -> Any:
    """A float where there is one configuration."""
    return length if length.ndim else float(length)
