"""The null motions that make a configuration singular, one list for each type present.

Source: Zlatanov, Fenton, Benhabib (1998), section 2.2, the definitions of the six types.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from singsym.classes.taxonomy.types import SingularityType
from singsym.kinematics.numerical_rank import NumericalRank
from singsym.kinematics.scaling import Scaled
from singsym.kinematics.velocity import VelocityEquation

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

_NEGLIGIBLE = 1e-9
"""Rates below this fraction of the largest, lengths over the characteristic length, are left out."""


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
    equation: VelocityEquation, kernels: Mapping[str, Floats], units: Floats, types: SingularityType
) -> tuple[Motion, ...]:
    """RI, RO, RPM: bases of the motions that show them; II, IO: the restrictions; IIM: all free motions.

    kernels: of L, L_I, L_O and L_p, orthonormal rows of scaled rates, as long as L is wide; units: what turns
    scaled rates into rates.
    """
    import numpy as np

    roles = [c.role for c in equation.columns]
    everything, passive = kernels["L"], kernels["L_p"]
    found: list[Motion] = []
    shown = {
        SingularityType.RI: _modulo(kernels["L_O"], passive),
        SingularityType.RO: _modulo(kernels["L_I"], passive),
        SingularityType.RPM: passive,
        SingularityType.IIM: everything,
    }
    for kind in SingularityType:
        if kind not in types:
            continue
        if kind in shown:
            found += [Motion(kind, rates) for rates in _named(equation, shown[kind], units)]
        else:
            role, dropped = ("input", "L_I") if kind is SingularityType.II else ("output", "L_O")
            places = [j for j, r in enumerate(roles) if r == role]
            # as many restrictions as rank L is larger than that of the matrix without these columns
            defect = len(places) - len(everything) + len(kernels[dropped])
            rows = np.zeros((defect, len(roles)))
            rows[:, places] = _complement(everything[:, places], defect)
            found += [Motion(kind, rates, True) for rates in _named(equation, rows, 1 / units)]
    return tuple(found)


def numerical_kernels(
    scaled: Scaled, seen: Mapping[str, NumericalRank], ranks: Mapping[str, int]
) -> dict[str, Floats]:
    """The kernels that `null_motions` expects, by the singular vectors of the smallest singular values.

    seen: the decompositions of L, L_I, L_O, L_p; ranks: theirs, as they are known.
    """
    import numpy as np

    found = {}
    for name, here in seen.items():
        found[name] = np.zeros((here.right.shape[1] - ranks[name], len(scaled.units)))
        found[name][:, scaled.columns(name)] = here.right[ranks[name] :]
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
    """The same span by an echelon form with largest pivots; what is negligible beside them is zero."""
    import numpy as np

    rows = rows.copy()
    for i in range(len(rows)):
        place = np.unravel_index(np.abs(rows[i:]).argmax(), rows[i:].shape)
        pivot_row, column = int(place[0]) + i, int(place[1])
        rows[[i, pivot_row]] = rows[[pivot_row, i]]
        rows[i] /= rows[i, column]
        for k in range(len(rows)):
            if k != i:
                rows[k] -= rows[k, column] * rows[i]
    largest = np.abs(rows).max(axis=1, keepdims=True, initial=0.0)
    return np.where(np.abs(rows) > _NEGLIGIBLE * largest, rows, 0.0)


def _named(equation: VelocityEquation, rows: Floats, units: Floats) -> list[dict[str, float]]:
    """By column label, the largest 1."""
    found = []
    for row in _readable(rows) * units:
        largest = row[abs(row).argmax()]
        found.append({c.label: float(x / largest) for c, x in zip(equation.columns, row, strict=True) if x})
    return found
