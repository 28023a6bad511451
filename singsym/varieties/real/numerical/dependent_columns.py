"""Which columns of a matrix of slopes the others determine: coordinates that equations give.

Source: Gram-Schmidt with column pivoting, Golub, Van Loan, Matrix Computations (2013), section 5.4.2.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from singsym.polynomials.compiled_map import Floats


def dependent_columns(slope: Floats, rank: int, first: Sequence[int]) -> list[int]:
    """Columns that the others determine, by pivoted orthogonalisation, those in `first` before others."""
    work = np.array(slope, dtype=np.float64)
    threshold = 1e-9 * float(np.linalg.norm(work, axis=0).max(initial=0.0))
    chosen: list[int] = []
    for k in range(rank):
        norms = np.linalg.norm(work, axis=0)
        candidates = [j for j in first if j not in chosen and norms[j] > threshold] if k < len(first) else []
        j = candidates[0] if candidates else int(np.argmax(norms))
        chosen.append(j)
        length = float(norms[j])
        if length == 0:
            break
        direction = work[:, j] / length
        work = work - np.outer(direction, direction @ work)
        work[:, chosen] = 0
    return sorted(chosen)
