"""The null motions that make a configuration singular, one list for each type present.

Source: Zlatanov, Fenton, Benhabib (1998), section 2.2, the definitions of the six types.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from singsym.classes.types import SingularityType
from singsym.kinematics.velocity import VelocityEquation

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

_NONZERO = 1e-6


@dataclass(frozen=True)
class Motion:
    """Evidence of a type: a null motion, or an equation that restricts inputs or outputs.

    rates: column label -> rate, the largest 1 (angles per time, lengths per time), zeros left out.
    restriction: whether `rates` are coefficients of an equation "sum = 0" on inputs (II) or outputs (IO).
    """

    type: SingularityType
    rates: Mapping[str, float]
    restriction: bool = False


def null_motions(
    equation: VelocityEquation,
    matrix: Floats,
    units: Floats,
    ranks: Mapping[str, int],
    types: SingularityType,
) -> tuple[Motion, ...]:
    """RI, RO, RPM: bases of the motions that show them; II, IO: the restrictions; IIM: all free motions.

    matrix: L in floats with scaled columns, units: what turns its rates into those of L; ranks: of the four.
    """
    import numpy as np

    roles = [c.role for c in equation.columns]
    kernel = _Kernel(matrix, roles)
    everything = kernel.of((), ranks["L"])
    without_input = kernel.of(("input",), ranks["L_I"])
    without_output = kernel.of(("output",), ranks["L_O"])
    passive = kernel.of(("input", "output"), ranks["L_p"])
    found: list[Motion] = []
    shown = {
        SingularityType.RI: _modulo(without_output, passive),
        SingularityType.RO: _modulo(without_input, passive),
        SingularityType.RPM: passive,
        SingularityType.IIM: everything,
    }
    for kind in SingularityType:
        if kind not in types:
            continue
        if kind in shown:
            rows = _readable(shown[kind] * units)
            found += [Motion(kind, _named(equation, row)) for row in rows]
        else:
            role = "input" if kind is SingularityType.II else "output"
            places = [j for j, r in enumerate(roles) if r == role]
            defect = (ranks["L"] - ranks["L_I"]) if role == "input" else (ranks["L"] - ranks["L_O"])
            rows = np.zeros((defect, len(roles)))
            rows[:, places] = _complement((everything * units)[:, places], defect)
            found += [Motion(kind, _named(equation, row), True) for row in _readable(rows)]
    return tuple(found)


class _Kernel:
    """Null spaces of L without some columns, as rows of full length with zeros there."""

    def __init__(self, matrix: Floats, roles: Sequence[str]) -> None:
        self.matrix, self.roles = matrix, roles

    def of(self, without: tuple[str, ...], rank: int) -> Floats:
        import numpy as np

        kept = [j for j, role in enumerate(self.roles) if role not in without]
        found = np.zeros((len(kept) - rank, len(self.roles)))
        if kept:
            _, _, right = np.linalg.svd(self.matrix[:, kept], full_matrices=True)
            found[:, kept] = right[rank:]
        return found


def _modulo(space: Floats, part: Floats) -> Floats:
    """A basis of what a space has at right angles to a part of it."""
    import numpy as np

    rest = space - (space @ part.T) @ part
    _, _, right = np.linalg.svd(rest, full_matrices=False)
    return np.asarray(right[: len(space) - len(part)])


def _complement(vectors: Floats, count: int) -> Floats:
    """`count` vectors at right angles to those given."""
    import numpy as np

    _, _, right = np.linalg.svd(vectors, full_matrices=True)
    return np.asarray(right[len(right) - count :])


def _readable(rows: Floats) -> Floats:
    """The same span by an echelon form with largest pivots, each row's largest entry 1."""
    import numpy as np

    rows = rows.copy()
    for i in range(len(rows)):
        place = np.unravel_index(np.abs(rows[i:]).argmax(), rows[i:].shape)
        pivot_row, column = int(place[0]) + i, int(place[1])
        rows[[i, pivot_row]] = rows[[pivot_row, i]]
        if abs(rows[i, column]) < _NONZERO:
            continue
        rows[i] /= rows[i, column]
        for k in range(len(rows)):
            if k != i:
                rows[k] -= rows[k, column] * rows[i]
    largest = np.take_along_axis(rows, np.abs(rows).argmax(axis=1)[:, None], axis=1) if len(rows) else rows
    return np.asarray(rows / np.where(np.abs(largest) > _NONZERO, largest, 1.0))


def _named(equation: VelocityEquation, row: Floats) -> dict[str, float]:
    return {
        c.label: float(rate) for c, rate in zip(equation.columns, row, strict=True) if abs(rate) > _NONZERO
    }
