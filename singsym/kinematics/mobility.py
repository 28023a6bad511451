"""Generic ranks of L and its submatrices at random configurations, and what they say against the author's n.

Source: Zlatanov, Fenton, Benhabib (1998), section 2.1; generic ranks: theory of the four integers, 2.3.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from singsym.kinematics.sampling import numerical_matrix, sample_configurations
from singsym.kinematics.velocity import VelocityEquation

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


@dataclass(frozen=True)
class Mobility:
    """Largest ranks seen at random configurations, numerically: hints for the user, not proofs.

    ranks: of L, L_I, L_O, L_p; gap: the smallest ratio between a singular value that was counted and the next
    one; samples: how many configurations were found, regular: how many of them are nonsingular.  Fewer than
    all point to components of another mobility.  messages: what contradicts N, n, inputs or outputs.
    """

    ranks: dict[str, int]
    gap: float
    samples: int
    regular: int
    messages: tuple[str, ...]


def check_mobility(equation: VelocityEquation, seed: int = 0, count: int = 12) -> Mobility:
    """Compare the ranks at `count` random configurations with N and n.

    >>> from singsym.kinematics.velocity import velocity_equation
    >>> from singsym.mechanism import load
    >>> check_mobility(velocity_equation(load("zlatanov-2dof"))).ranks
    {'L': 8, 'L_I': 8, 'L_O': 8, 'L_p': 6}
    """
    points = sample_configurations(equation.space, count, seed)
    matrices = {"L": equation.L, "L_I": equation.L_I, "L_O": equation.L_O, "L_p": equation.L_p}
    ranks = dict.fromkeys(matrices, 0)
    gap, regular = float("inf"), 0
    for point in points:
        here = {name: numerical_rank(numerical_matrix(matrix, point)) for name, matrix in matrices.items()}
        ranks = {name: max(ranks[name], rank) for name, (rank, _) in here.items()}
        gap = min(gap, *(distance for _, distance in here.values()))
        regular += here["L_I"][0] == here["L_O"][0] == equation.N
    if not points:
        nothing = "no configuration was found numerically: the loops may be impossible to close"
        return Mobility(ranks, gap, 0, 0, (nothing,))
    return Mobility(ranks, gap, len(points), regular, tuple(_messages(equation, ranks)))


def numerical_rank(matrix: NDArray[np.float64], tolerance: float = 1e-8) -> tuple[int, float]:
    """The rank of a matrix of floats, and the gap between the last counted singular value and the next.

    >>> import numpy as np
    >>> numerical_rank(np.diag([2.0, 1.0, 0.0]))
    (2, inf)
    """
    import numpy as np

    if not matrix.size:
        return 0, float("inf")
    rows = np.linalg.norm(matrix, axis=1, keepdims=True)
    # rows are scaled to length one, so that the choice of the unit of length changes little
    values = np.linalg.svd(matrix / np.where(rows > 0, rows, 1.0), compute_uv=False)
    rank = int((values > tolerance * max(1.0, float(values[0]))).sum())
    if rank == 0 or rank == len(values) or values[rank] == 0:
        return rank, float("inf")
    return rank, float(values[rank - 1] / values[rank])


def _messages(equation: VelocityEquation, ranks: dict[str, int]) -> list[str]:
    N, n = equation.N, equation.n
    roles = [column.role for column in equation.columns]
    found = []
    for role in ("input", "output"):
        number = roles.count(role)
        if number != n:
            found.append(f"{number} {role}s, expected n = {n}: as many as the mobility")
    freedoms = len(roles) - ranks["L"]
    if freedoms > n:
        found.append(
            f"at random configurations {freedoms} independent motions are possible, but n = {n}: "
            f"rank L = {ranks['L']}, expected N = {N}; state the mobility that is meant, or expect a "
            "mechanism that is shaky in every configuration"
        )
    if freedoms < n:
        found.append(
            f"at random configurations only {freedoms} independent motions are possible, but n = {n}: "
            f"rank L = {ranks['L']}, expected N = {N}; lower the mobility or free a joint"
        )
    if ranks["L_I"] < ranks["L"]:
        names = [c.label for c in equation.columns if c.role == "input"]
        found.append(
            f"{', '.join(names)} cannot be the inputs: rank L_I = {ranks['L_I']} < rank L = {ranks['L']} "
            "at random configurations, so their rates depend on each other; choose others"
        )
    if ranks["L_O"] < ranks["L"]:
        names = [c.label for c in equation.columns if c.role == "output"]
        found.append(
            f"{', '.join(names)} cannot be the outputs: rank L_O = {ranks['L_O']} < rank L = {ranks['L']} "
            "at random configurations, so they depend on each other; choose others"
        )
    return found
