"""Interval arithmetic: polynomials on boxes, ranks from below, and the Krawczyk test.

Source: Krawczyk, Computing 4 (1969) 187-201; Neumaier, Interval Methods for Systems of Equations (1990), 5.1;
balls by Arb (https://arblib.org), through python-flint.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from fractions import Fraction
from functools import lru_cache

from flint import arb, arb_mat, ctx, fmpq

from singsym.polynomials import Equations, Polynomial

Box = tuple[arb, ...]


@contextmanager
def at_precision(bits: int) -> Iterator[None]:
    """Arb works with so many bits inside; python-flint keeps the precision per process."""
    before = ctx.prec
    ctx.prec = bits
    try:
        yield
    finally:
        ctx.prec = before


def ball(number: Fraction | int) -> arb:
    """The ball around a rational, at the current precision.

    >>> ball(Fraction(1, 2))
    0.500000000000000
    """
    number = Fraction(number)
    return arb(fmpq(number.numerator, number.denominator))


def exact_bounds(value: arb) -> tuple[Fraction, Fraction]:
    """The rational ends of a ball.

    >>> exact_bounds(ball(Fraction(1, 2)))
    (Fraction(1, 2), Fraction(1, 2))
    """
    middle, radius = (_dyadic(part) for part in (value.mid(), value.rad()))
    return middle - radius, middle + radius


def _dyadic(exact: arb) -> Fraction:
    mantissa, exponent = exact.man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


def evaluate(polynomial: Polynomial, box: Sequence[arb]) -> arb:
    """A ball that holds the values of a polynomial on a box given in the order of the ring's names.

    Powers are products: in Arb the square of a ball around 0 is not a number.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> evaluate(x * y + 1, (arb(2), arb(3)))
    7.00000000000000
    """
    value = polynomial.evaluate(list(box))
    return value if isinstance(value, arb) else arb(value)


def sign_on_box(polynomial: Polynomial, box: Sequence[arb]) -> int:
    """The sign of a polynomial on a whole box; 0 where the box does not decide it."""
    value = evaluate(polynomial, box)
    return int(value > 0) - int(value < 0)


def jacobian(equations: Sequence[Polynomial], names: Sequence[str]) -> list[list[Polynomial]]:
    """The partial derivatives, one row an equation."""
    return _jacobian(tuple(equations), tuple(names))


@lru_cache(maxsize=256)
def _jacobian(equations: Equations, names: tuple[str, ...]) -> list[list[Polynomial]]:
    return [[f.derivative(name) for name in names] for f in equations]


def rank_at_least(matrix: Sequence[Sequence[arb]], rank: int) -> bool:
    """Whether some minor of this size is proven nonzero for every choice from the balls.

    Rows and columns are chosen by pivoting on midpoints; the minor is proven by an interval elimination after
    preconditioning, so that a `True` is a proof and a `False` is nothing.
    """
    if rank == 0:
        return True
    if not matrix or min(len(matrix), len(matrix[0])) < rank:
        return False
    rows, columns = pivots([[float(e.mid()) for e in row] for row in matrix], rank, 0.0)
    if len(rows) < rank:
        return False
    return regular([[matrix[i][j] for j in columns] for i in rows])


def regular(matrix: Sequence[Sequence[arb]]) -> bool:
    """Whether a square matrix of balls is proven regular: an approximate inverse times it is near 1."""
    inverse = _approximate_inverse(matrix)
    if inverse is None:
        return False
    return is_dominant(inverse * arb_mat([list(row) for row in matrix]))


def is_dominant(matrix: arb_mat) -> bool:
    """Whether a square matrix of balls is proven regular as an H-matrix, as it is near 1.

    For some weights each entry of the diagonal is larger than the others of its row: Neumaier (1990), 3.7.

    >>> is_dominant(arb_mat([[1, 4], [arb(0, 0.2), 1]])), is_dominant(arb_mat([[1, 4], [arb(0, 0.3), 1]]))
    (True, False)
    """
    size = range(matrix.nrows())
    least = [[-matrix[i, j].abs_upper() if i != j else matrix[i, i].abs_lower() for j in size] for i in size]
    middle = arb_mat([[arb(e.mid()) for e in row] for row in least])
    try:
        solved = middle.solve(arb_mat([[1] for _ in size]))
    except ZeroDivisionError:
        return False
    weights = [arb(solved[i, 0].mid()) for i in size]
    rows = (sum((e * w for e, w in zip(row, weights, strict=True)), arb(0)) for row in least)
    return all(w > 0 for w in weights) and all(row > 0 for row in rows)


def pivots(
    matrix: Sequence[Sequence[float]], most: int | None = None, tolerance: float = 1e-7
) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Rows and columns of a well-conditioned minor, by complete pivoting.

    most: the largest size asked for; tolerance: entries not above it, relative to the largest, count as zero.

    >>> pivots([[0.0, 2.0], [0.0, 1.0]])
    ((0,), (1,))
    """
    work = [list(row) for row in matrix]
    scale = max((abs(e) for row in work for e in row), default=0.0)
    rows: list[int] = []
    columns: list[int] = []
    free_rows, free_columns = list(range(len(work))), list(range(len(work[0]) if work else 0))
    while most is None or len(rows) < most:
        size, i, j = max(
            ((abs(work[i][j]), i, j) for i in free_rows for j in free_columns), default=(0.0, -1, -1)
        )
        if not size > tolerance * scale:
            break
        rows.append(i)
        columns.append(j)
        free_rows.remove(i)
        free_columns.remove(j)
        for k in free_rows:
            factor = work[k][j] / work[i][j]
            if factor:
                work[k] = [a - factor * b for a, b in zip(work[k], work[i], strict=True)]
    return tuple(sorted(rows)), tuple(sorted(columns))


def _approximate_inverse(matrix: Sequence[Sequence[arb]]) -> arb_mat | None:
    try:
        inverse = arb_mat([[arb(e.mid()) for e in row] for row in matrix]).inv()
    except ZeroDivisionError:
        return None
    return arb_mat([[arb(inverse[i, j].mid()) for j in range(len(matrix))] for i in range(len(matrix))])


def krawczyk(
    equations: Sequence[Polynomial],
    names: Sequence[str],
    box: Sequence[arb],
    radius: Fraction,
) -> Box | None:
    """A box proven to hold exactly one zero of a square system in `names`, the other coordinates held fixed.

    box: in the order of the ring's names, midpoints near a zero; the unknowns are widened by `radius`.
    Returns the whole box with the sharpened unknowns, or `None` where the test proves nothing.  Where fixed
    coordinates are balls there is one zero for each choice from them.
    """
    if len(equations) != len(names):
        raise ValueError(f"{len(equations)} equations in {len(names)} unknowns: a square system is expected")
    if not equations:
        return tuple(box)
    ring = equations[0].ring
    places = [ring.index(name) for name in names]
    middle = list(box)
    wide = list(box)
    width = ball(radius).upper()
    for k in places:
        middle[k] = arb(box[k].mid())
        wide[k] = middle[k] + arb(0, width)
    derivatives = jacobian(equations, names)
    slopes = [[evaluate(d, wide) for d in row] for row in derivatives]
    inverse = _approximate_inverse(slopes)
    if inverse is None:
        return None
    values = arb_mat([[evaluate(f, middle)] for f in equations])
    shift = inverse * values
    defect = inverse * arb_mat(slopes)
    offsets = [wide[k] - middle[k] for k in places]
    result = list(box)
    for i, k in enumerate(places):
        total = middle[k] - shift[i, 0]
        for j in range(len(places)):
            total = total - (defect[i, j] - (1 if i == j else 0)) * offsets[j]
        if not wide[k].contains_interior(total):
            return None
        result[k] = total
    return tuple(result)
