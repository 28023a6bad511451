"""Elimination of passive velocities that stay uniquely determined at every feasible configuration.

Source: Zlatanov, Fenton, Benhabib (1998), section 4.2 and, as an example, (7)-(9) of section 5.2.

Lemma (pivot).  If a column is zero but for one entry and that entry is nonzero, then taking away its row
and the column lowers the rank by 1; row operations invertible at q do not change ranks.  L, L_I, L_O and L_p
have the same rows, and all contain the passive columns: a pivot in a passive column lowers all four ranks.

Lemma (block).  Let k columns be zero outside k + 1 rows, B these rows, w the vector of the signed k-minors
of B.  Then w B = 0, w w = det(B^T B), and where w w is nonzero the square matrix of rows B^T, w is
invertible: it may act on the k + 1 rows.  The first k then go with the columns, the one with w stays.

Lemma (content).  A column may be divided by a factor of its entries that is nonzero: no rank changes.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, permutations
from math import prod

from flint import fmpq, fmpz

from singsym.kinematics.loop_frames import in_link_frames
from singsym.kinematics.nonzero import Certifier
from singsym.kinematics.velocity import VelocityEquation
from singsym.polynomials import Polynomial, PolynomialMatrix

LARGEST_BLOCK = 3
"""Up to this many columns are eliminated together: the spins of a spherical joint."""

LONGEST_BLOCK = 160
"""Blocks with more terms in all their entries are not tried."""

LONGEST_PAIR = 12
"""Two entries with more terms together are not tried as a pair."""


@dataclass(frozen=True)
class Elimination:
    """Columns eliminated with as many rows, the polynomial that had to be nonzero, and why it is."""

    columns: tuple[str, ...]
    rows: tuple[str, ...]
    pivot: Polynomial
    reason: str

    def __str__(self) -> str:
        which = ", ".join(self.columns)
        if len(self.rows) == 1:
            how = f"by row {self.rows[0]}, pivot {self.pivot.short_text()}"
        else:
            how = f"from rows {', '.join(self.rows)}, sum of squares {self.pivot.short_text()}"
        why = "" if self.pivot.is_constant else f": {self.reason}"
        return f"{which} {how}{why}"


@dataclass(frozen=True)
class Reduced:
    """A matrix with columns eliminated: its rank is that of `matrix` plus `constant` at every feasible q.

    rows, columns: where the rows and columns that are left come from; a combination of rows bears the index
    of one of them.
    """

    matrix: PolynomialMatrix
    rows: tuple[int, ...]
    columns: tuple[int, ...]
    record: tuple[Elimination, ...]

    @property
    def constant(self) -> int:
        """The number of eliminated columns."""
        return sum(len(step.columns) for step in self.record)


@dataclass(frozen=True)
class Reduction:
    """A velocity equation without the passive velocities that could be eliminated.

    rank L = rank(reduced L) + constant at every feasible configuration, and the same for L_I, L_O and L_p.
    """

    equation: VelocityEquation
    constant: int
    record: tuple[Elimination, ...]

    @property
    def lines(self) -> tuple[str, ...]:
        """The record in words, one line an elimination and one for the ranks."""
        size = f"{self.equation.matrix.shape[0]}x{self.equation.matrix.shape[1]}"
        last = f"every rank is that of the reduced matrix ({size}) + {self.constant}"
        return (*(str(step) for step in self.record), last)


class _Elimination:
    """The matrix at work: dense rows of polynomials with the labels of what is left."""

    def __init__(
        self,
        matrix: PolynomialMatrix,
        candidates: Sequence[int],
        certifier: Certifier,
        row_labels: Sequence[str],
        column_labels: Sequence[str],
        thorough: bool,
    ) -> None:
        self.ring = matrix.ring
        self.certifier = certifier
        self.entries = [list(row) for row in matrix.rows]
        self.rows = list(range(matrix.shape[0]))
        self.columns = list(range(matrix.width))
        self.candidates = set(candidates)
        self.row_labels, self.column_labels = row_labels, column_labels
        self.thorough = thorough
        self.record: list[Elimination] = []

    def run(self) -> None:
        """Sparser rows, then unit pivots while there are any, then one block, and again."""
        while self._sparsify():
            pass
        while self._pivot() or self._block() or (self.thorough and self._pair()):
            if self.thorough:
                self._tidy_columns()

    def _column(self, j: int) -> list[int]:
        return [i for i, row in enumerate(self.entries) if row[j]]

    def _eligible(self) -> list[int]:
        return [j for j, origin in enumerate(self.columns) if origin in self.candidates]

    def _sparsify(self) -> bool:
        """Add rows to others, or take them away, where a spherical joint goes: loops of one leg each."""
        joints = [self._joint(c) for c in self.columns]
        spherical = {j: joint for j, joint in enumerate(joints) if joints.count(joint) >= 3}
        done = False
        for k, i in permutations(range(len(self.entries)), 2):
            old = self.entries[k]
            if not any(old[j] and self.entries[i][j] for j in spherical):
                continue
            for sign in (1, -1):
                new = [a - b * sign if b else a for a, b in zip(old, self.entries[i], strict=True)]
                met = [{joint for j, joint in spherical.items() if row[j]} for row in (new, old)]
                if len(met[0]) < len(met[1]) and sum(map(bool, new)) < sum(map(bool, old)):
                    self.entries[k] = old = new
                    done = True
        return done

    # -- single pivots -------------------------------------------------------------------------------

    def _group(self, j: int) -> tuple[bool, int]:
        """Spins of a spherical joint go before single pins, and one joint after another."""
        joint = self._joint(self.columns[j])
        left = sum(self._joint(c) == joint for c in self.columns)
        size = sum(label.split(".")[0] == joint for label in self.column_labels)
        return not left < size, -size

    def _joint(self, column: int) -> str:
        return self.column_labels[column].split(".")[0]

    def _pivot(self) -> bool:
        best: tuple[tuple[float, ...], int, int] | None = None
        for j in self._eligible():
            support = self._column(j)
            group = self._group(j)
            for i in support:
                entry = self.entries[i][j]
                row = [e for e in self.entries[i] if e]
                cost = (len(row) - 1) * (len(support) - 1)
                degree = max(
                    max(e.total_degree for e in row), *(self.entries[k][j].total_degree for k in support)
                )
                key = (not entry.is_constant, *group, cost, degree, i, j)
                if (best is None or key < best[0]) and self.certifier.reason(entry) is not None:
                    best = key, i, j
        if best is None:
            return False
        _, i, j = best
        pivot = self.entries[i][j]
        self._note((j,), (i,), pivot)
        for k in self._column(j):
            if k != i:
                factor = self.entries[k][j]
                combined = [
                    pivot * a - factor * b for a, b in zip(self.entries[k], self.entries[i], strict=True)
                ]
                self.entries[k] = self._tidy(combined)
        self._drop((i,), (j,))
        return True

    # -- blocks --------------------------------------------------------------------------------------

    def _blocks(self) -> Iterator[tuple[tuple[int, ...], tuple[int, ...]]]:
        supports = {j: frozenset(self._column(j)) for j in self._eligible()}
        for k in range(1, LARGEST_BLOCK + 1):
            small = [j for j, support in supports.items() if 0 < len(support) <= k + 1]
            for columns in combinations(small, k):
                rows = frozenset().union(*(supports[j] for j in columns))
                if len(rows) in (k, k + 1):
                    yield tuple(sorted(rows)), columns

    def _block(self) -> bool:
        for rows, columns in self._blocks():
            block = [[self.entries[i][j] for j in columns] for i in rows]
            if sum(len(e) for row in block for e in row) > LONGEST_BLOCK:
                continue
            if len(rows) == len(columns):
                pivot = self.certifier.shorten(_small_determinant(block, self.ring.one))
                kernel = None
            else:
                kernel = self._tidy(_signed_minors(block, self.ring.one))
                pivot = self.certifier.shorten(sum((w * w for w in kernel), start=self.ring.zero))
            if self.certifier.reason(pivot) is None:
                continue
            self._note(columns, rows, pivot)
            if kernel is not None:
                keep = next(p for p, w in enumerate(kernel) if w)
                weighted = [[w * e for e in self.entries[i]] for w, i in zip(kernel, rows, strict=True)]
                self.entries[rows[keep]] = self._tidy(
                    [sum(terms, start=self.ring.zero) for terms in zip(*weighted, strict=True)]
                )
                rows = (*rows[:keep], *rows[keep + 1 :])
            self._drop(rows, columns)
            return True
        return False

    def _pair(self) -> bool:
        """A column with entries v, w for which v^2 + w^2 is nonzero: rotate the two rows, then a pivot."""
        for j in self._eligible():
            for i, k in combinations(self._column(j), 2):
                v, w = self.entries[i][j], self.entries[k][j]
                if len(v) + len(w) > LONGEST_PAIR:
                    continue
                if self.certifier.reason(pivot := self.certifier.shorten(v * v + w * w)) is None:
                    continue
                self._note((j,), (i, k), pivot)
                first, second = self.entries[i], self.entries[k]
                along = [v * a + w * b for a, b in zip(first, second, strict=True)]
                self.entries[k] = self._tidy([v * b - w * a for a, b in zip(first, second, strict=True)])
                for m in self._column(j):
                    if m not in (i, k):
                        factor = self.entries[m][j]
                        pairs = list(zip(self.entries[m], along, strict=True))
                        raw = [(v * v + w * w) * a - factor * b for a, b in pairs]
                        if _is_multiple(raw, self.entries[k]):
                            self.entries[m] = [self.ring.zero] * len(raw)
                        else:
                            self.entries[m] = self._tidy([pivot * a - factor * b for a, b in pairs])
                self._drop((i,), (j,))
                return True
        return False

    # -- common --------------------------------------------------------------------------------------

    def _tidy(self, row: list[Polynomial]) -> list[Polynomial]:
        """The row in short forms, divided by its content where that is nonzero everywhere.

        The content is taken out before and after, because short forms of the entries may hide it.
        """
        return self._primitive([self.certifier.shorten(e) for e in self._primitive(row)])

    def _primitive(self, row: list[Polynomial]) -> list[Polynomial]:
        units = self._units(row)
        if not units.is_constant:
            row = [e.exact_quotient(units) for e in row]
        content = _rational_content(row)
        return [e * content for e in row]

    def _units(self, entries: Sequence[Polynomial]) -> Polynomial:
        """The common factors of some polynomials that are nonzero everywhere."""
        common = self.ring.zero
        for e in entries:
            common = common.gcd(e) if common else e
            if common.is_constant and common:
                return self.ring.one
        if not common:
            return self.ring.one
        parts = (f**k for f, k in common.factors() if self.certifier.reason(f) is not None)
        return prod(parts, start=self.ring.one)

    def _tidy_columns(self) -> None:
        """Columns without their contents: where pivots came as factors into others, these get short again.

        Single terms stay: with them entries are still seen as coordinates of vectors.
        """
        for j in range(len(self.columns)):
            support = self._column(j)
            entries = [self.entries[i][j] for i in support]
            if len(entries) < 2 or any(len(e) == 1 for e in entries):
                continue
            units = self._units(entries)
            if len(units) > 1:
                for i in support:
                    self.entries[i][j] = self.entries[i][j].exact_quotient(units)

    def _note(self, columns: Sequence[int], rows: Sequence[int], pivot: Polynomial) -> None:
        self.record.append(
            Elimination(
                tuple(self.column_labels[self.columns[j]] for j in columns),
                tuple(self.row_labels[self.rows[i]] for i in rows),
                pivot,
                self.certifier.reason(pivot) or "",
            )
        )

    def _drop(self, rows: Sequence[int], columns: Sequence[int]) -> None:
        kept = [j for j in range(len(self.columns)) if j not in columns]
        self.entries = [[row[j] for j in kept] for i, row in enumerate(self.entries) if i not in rows]
        self.rows = [r for i, r in enumerate(self.rows) if i not in rows]
        self.columns = [self.columns[j] for j in kept]


def _is_multiple(row: Sequence[Polynomial], other: Sequence[Polynomial]) -> bool:
    """Whether a row is a polynomial times another: then a row operation makes it zero."""
    place = next((j for j, e in enumerate(other) if e), None)
    if place is None or not other[place].divides(row[place]):
        return False
    quotient = row[place].exact_quotient(other[place])
    return all(a == quotient * b for a, b in zip(row, other, strict=True))


def _rational_content(row: Sequence[Polynomial]) -> fmpq:
    """The positive rational that makes the coefficients of a row coprime integers; 1 for a zero row."""
    numerator, denominator = fmpz(0), fmpz(1)
    for e in row:
        for c in e.value.coeffs():
            numerator, denominator = numerator.gcd(c.p), denominator.lcm(c.q)
    return fmpq(denominator, numerator) if numerator else fmpq(1)


def _small_determinant(block: list[list[Polynomial]], one: Polynomial) -> Polynomial:
    """The determinant of a block of up to three rows, by its first row."""
    if not block:
        return one
    total = one - one
    for j, entry in enumerate(block[0]):
        if entry:
            rest = [row[:j] + row[j + 1 :] for row in block[1:]]
            total = total + (-1) ** j * entry * _small_determinant(rest, one)
    return total


def _signed_minors(block: list[list[Polynomial]], one: Polynomial) -> list[Polynomial]:
    """The vector w with w B = 0 for a matrix B of one row more than columns."""
    return [(-1) ** i * _small_determinant(block[:i] + block[i + 1 :], one) for i in range(len(block))]


def eliminate(
    matrix: PolynomialMatrix,
    candidates: Sequence[int],
    certifier: Certifier,
    row_labels: Sequence[str] | None = None,
    column_labels: Sequence[str] | None = None,
    thorough: bool = False,
) -> Reduced:
    """Eliminate those of the candidate columns for which a pivot is proved nonzero everywhere.

    The rank of every submatrix that keeps all rows and the candidate columns drops by `constant`.
    thorough: also where the degrees of what is left may grow.

    >>> from singsym.kinematics.placement import ConfigurationSpace
    >>> from singsym.polynomials import Ring
    >>> R = Ring(("c", "s"))
    >>> c, s = R.gens
    >>> circle = Certifier(ConfigurationSpace(R, (c**2 + s**2 - 1,)))
    >>> reduced = eliminate(PolynomialMatrix.of(R, [[c, 1], [s, 0]]), (0,), circle)
    >>> reduced.matrix.rows, reduced.constant
    (((s,),), 1)
    """
    work = _Elimination(
        matrix,
        candidates,
        certifier,
        row_labels or [f"{i + 1}" for i in range(matrix.shape[0])],
        column_labels or [f"{j + 1}" for j in range(matrix.width)],
        thorough,
    )
    work.run()
    rows = tuple(tuple(row) for row in work.entries)
    result = PolynomialMatrix(matrix.ring, rows, len(work.columns))
    return Reduced(result, tuple(work.rows), tuple(work.columns), tuple(work.record))


def reduce_submatrix(matrix: PolynomialMatrix, certifier: Certifier) -> Reduced:
    """The same for one matrix alone, whose columns may all go; zero rows and zero columns go as well.

    Source: (11)-(13) of the paper, where each of the four matrices is simplified on its own.
    """
    found = eliminate(matrix, range(matrix.width), certifier, thorough=True)
    rows = [i for i, row in enumerate(found.matrix.rows) if any(row)]
    columns = [j for j in range(found.matrix.width) if any(row[j] for row in found.matrix.rows)]
    return Reduced(
        found.matrix.select(rows, columns),
        tuple(found.rows[i] for i in rows),
        tuple(found.columns[j] for j in columns),
        found.record,
    )


def reduce(equation: VelocityEquation, certifier: Certifier | None = None) -> Reduction:
    """The velocity equation without the passive velocities that are determined everywhere (section 4.2).

    Outputs and inputs stay.  N of the reduced equation is lower by `constant`, n is the same, so that the
    conditions (4), (5), (i)-(viii) read the same.
    """
    equation = in_link_frames(equation)
    labels = tuple(column.label for column in equation.columns)
    passive = [j for j, column in enumerate(equation.columns) if column.role == "passive"]
    found = eliminate(equation.matrix, passive, certifier or Certifier(equation.space), equation.rows, labels)
    reduced = replace(
        equation,
        matrix=found.matrix,
        columns=tuple(equation.columns[j] for j in found.columns),
        rows=tuple(equation.rows[i] for i in found.rows),
        N=equation.N - found.constant,
    )
    return Reduction(reduced, found.constant, found.record)
