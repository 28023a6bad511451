"""The rank of a matrix of numbers by its singular values, in double precision or in mpmath's.

Source: Eckart, Young (1936): the r-th singular value is the distance to the nearest matrix of rank below r.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Matrix = NDArray[Any]
    """Two-dimensional: of floats, or of objects that are mpmath numbers."""

_MARGIN = 10.0


@dataclass(frozen=True)
class NumericalRank:
    """The number of singular values above a threshold; all of them are listed, largest first.

    right: the right singular vectors, one a row; those from `rank` on span the kernel.
    """

    rank: int
    singular_values: tuple[float, ...]
    threshold: float
    right: Floats

    @property
    def gap(self) -> float:
        """See `gap_below`."""
        return gap_below(self.singular_values, self.rank)

    @property
    def is_clear(self) -> bool:
        """Whether no singular value is within a factor of 10 of the threshold."""
        low, high = self.threshold / _MARGIN, self.threshold * _MARGIN
        return not any(low < value < high for value in self.singular_values)


def gap_below(singular_values: Sequence[float], rank: int) -> float:
    """The last singular value that counts over the next; infinite where either is missing or zero."""
    if not 0 < rank < len(singular_values) or singular_values[rank] <= 0:
        return float("inf")
    return singular_values[rank - 1] / singular_values[rank]


def numerical_rank(matrix: Matrix, tolerance: float = 1e-8, size: float | None = None) -> NumericalRank:
    """The rank with a threshold of `tolerance` times `size`, by default the largest singular value.

    A size of 1 is for matrices of pure numbers: what is zero up to rounding is zero, be it the whole matrix.
    A matrix of mpmath numbers is worked out in the precision of `mpmath.mp`.

    >>> import numpy as np
    >>> numerical_rank(np.array([[1.0, 2.0], [2.0, 4.0]])).rank
    1
    >>> numerical_rank(np.array([[1e-16, 1e-16]]), size=1).rank
    0
    """
    values, right = _decomposed(matrix)
    threshold = tolerance * (max(values, default=0.0) if size is None else size)
    return NumericalRank(sum(v > threshold for v in values), values, threshold, right)


def _decomposed(matrix: Matrix) -> tuple[tuple[float, ...], Floats]:
    """Singular values, and all right singular vectors."""
    import numpy as np

    height, width = matrix.shape
    if not matrix.size:
        return (), np.eye(width)
    if matrix.dtype != object:
        _, values, right = np.linalg.svd(matrix, full_matrices=height < width)
        return tuple(map(float, values)), right
    import mpmath

    _, found, vectors = mpmath.svd_r(mpmath.matrix(matrix.tolist()), full_matrices=height < width)
    return tuple(map(float, found)), np.array(vectors.tolist(), dtype=np.float64)
