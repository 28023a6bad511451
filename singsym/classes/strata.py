"""Strata of the configuration space on which the four ranks are constant.

Source: Zlatanov, Fenton, Benhabib (1998), sections 2.3 and 3; the bordered minors are Kronecker's theorem.

Lemma (Kronecker). Where an r-minor of a matrix does not vanish, the rank is r exactly if all (r+1)-minors
that border it vanish.  So one minor outside an ideal and its bordering minors inside it fix the rank on
V(ideal) minus V(minor), whether the ideal is prime or not.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from math import comb

from singsym.classes.patches import Patch
from singsym.classes.types import Defects
from singsym.elimination.budget import Undecided
from singsym.kinematics.nonzero import Certifier
from singsym.kinematics.placement import ConfigurationSpace
from singsym.minors.blocks import easy_columns
from singsym.minors.determinant import determinant
from singsym.minors.factored import factored
from singsym.minors.rank import alternatives, rank_blocks
from singsym.polynomials import Polynomial, PolynomialMatrix
from singsym.varieties.decomposition import Component
from singsym.varieties.real.witness import RealSystem

ALL_MINORS = 24
"""Up to this many minors of a block, its rank locus is written with all of them."""
EASY_MINORS = 24
"""Of a larger block, so many minors that are products of small determinants are used."""


@dataclass(frozen=True)
class RankProblem:
    """The four matrices of a mechanism, each split into blocks whose ranks add.

    matrices: `L L_I L_O L_p` of the reduced velocity equation, with ranks lower by `eliminated`.
    blocks: for each of `L L_I L_O L_p` the blocks of a matrix with the same rank up to `constants`.
    N, n: the number of 1-DOF joints and the mobility.
    """

    matrices: Mapping[str, PolynomialMatrix]
    eliminated: int
    blocks: Mapping[str, tuple[PolynomialMatrix, ...]]
    constants: Mapping[str, int]
    N: int
    n: int

    def defects(self, ranks: Mapping[str, int]) -> Defects:
        """(delta, p, k_I, k_O) from the summed ranks of the blocks.

        Source: theory of the four ranks; conditions (i)-(vi) of the paper, section 2.3.
        """
        full = {name: ranks[name] + self.constants[name] for name in ranks}
        return Defects.of_ranks(full["L"], full["L_I"], full["L_O"], full["L_p"], self.N, self.n)


@dataclass(frozen=True)
class BlockRank:
    """The rank of a block where the `minors` of that size do not all vanish."""

    rank: int
    minors: tuple[Polynomial, ...]


@dataclass(frozen=True)
class Stratum:
    """The zeros of `equations` minus the loci where the ranks drop: there the types are constant.

    loci: for each of the four matrices, the loci to be taken out whose loss of rank would change the types;
        of each tuple, not all polynomials vanish on the stratum.
    component: the equations' zero set where it comes from a decomposition, else None.
    elsewhere: loci whose points in the stratum belong to another stratum of the same types as well.
    """

    equations: tuple[Polynomial, ...]
    defects: Defects
    loci: Mapping[str, tuple[tuple[Polynomial, ...], ...]]
    component: Component | None = None
    elsewhere: tuple[tuple[Polynomial, ...], ...] = ()

    @property
    def degenerate(self) -> tuple[tuple[Polynomial, ...], ...]:
        """All loci of all matrices, without repetitions."""
        seen = {tuple(locus): None for name in sorted(self.loci) for locus in self.loci[name]}
        return tuple(seen)


Samples = tuple[tuple[float, ...], ...]
"""Numerical real points of a set: they guide the choice of minors, they prove nothing."""


class NotEvident(Undecided):
    """A polynomial seems to vanish on a set, and substitution alone does not show it."""


@dataclass(frozen=True)
class Ground:
    """Where ranks are asked for: a component, with points on it to guess from."""

    component: Component
    samples: Samples = ()

    def vanishes(self, polynomial: Polynomial) -> bool:
        """Whether a polynomial is zero on the component, where True is proven and False may be a guess.

        A wrong False is harmless: it only makes a stratum empty and sends its closure down as a locus again.
        """
        ideal = self.component.ideal
        if ideal.contains(polynomial):
            return True
        if self.component.prime or is_large(polynomial, self.samples):
            return False
        return ideal.radical_contains(polynomial)


@dataclass(frozen=True)
class PatchGround:
    """The same on a patch, where only what substitution and the circles show is known to vanish."""

    patch: Patch
    certifier: Certifier
    samples: Samples

    def vanishes(self, polynomial: Polynomial) -> bool:
        """Whether a polynomial is zero on the patch; raises `NotEvident` where it seems to be, unproven."""
        if self.certifier.normal_form(self.patch.restrict(polynomial)).is_zero:
            return True
        if is_large(polynomial, self.samples):
            return False
        raise NotEvident("a minor seems to vanish on a part of the configuration space")


def is_large(polynomial: Polynomial, samples: Samples) -> bool:
    """Whether a polynomial is certainly not small at one of the points, relative to its coefficients."""
    size = max((abs(float(c.p) / float(c.q)) for _, c in polynomial.terms()), default=0.0)
    return any(abs(polynomial.evaluate(x)) > 1e-6 * size for x in samples)


def _start(block: PolynomialMatrix, samples: Samples) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Rows and columns of a minor that is as large as the numerical rank at the samples."""
    best: tuple[tuple[int, ...], tuple[int, ...]] = ((), ())
    for x in samples:
        found = pivots([[float(e) for e in row] for row in block.evaluate(x)])
        if len(found[0]) > len(best[0]):
            best = found
    return best


def _bordered(
    shape: tuple[int, int], rows: Sequence[int], columns: Sequence[int]
) -> Iterator[tuple[tuple[int, ...], tuple[int, ...]]]:
    for i in range(shape[0]):
        if i in rows:
            continue
        for j in range(shape[1]):
            if j not in columns:
                yield tuple(sorted((*rows, i))), tuple(sorted((*columns, j)))


def block_rank(block: PolynomialMatrix, ground: Ground | PatchGround) -> BlockRank:
    """The rank of a matrix on V(ideal) minus the common zeros of the minors returned.

    Grows a nonvanishing minor border by border until all bordering minors vanish (lemma above); of several
    nonvanishing ones the one with the simplest factors is taken.

    >>> from singsym.polynomials import Ring
    >>> from singsym.varieties.decomposition import decompose
    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> (line,) = decompose([y], ring=R)
    >>> block_rank(PolynomialMatrix.of(R, [[x, y], [x, y]]), Ground(line))
    BlockRank(rank=1, minors=(x,))
    """
    rows, columns = _start(block, ground.samples)
    last = determinant(block.select(rows, columns)) if rows else None
    if last is not None and ground.vanishes(last):
        rows, columns, last = (), (), None
    while True:
        candidates = []
        for r, c in _bordered(block.shape, rows, columns):
            minor = determinant(block.select(r, c))
            if minor and not ground.vanishes(minor):
                candidates.append((_weight(minor), r, c, minor))
                if minor.is_constant:
                    break
        if not candidates:
            break
        _, rows, columns, last = min(candidates, key=lambda t: t[:3])
    if last is None:
        return BlockRank(0, ())
    if last.is_constant:
        return BlockRank(len(rows), ())
    return BlockRank(len(rows), _locus(block, ground, rows, columns))


def _weight(minor: Polynomial) -> tuple[int, int]:
    return (minor.total_degree, len(minor))


def _locus(
    block: PolynomialMatrix, ground: Ground | PatchGround, rows: tuple[int, ...], columns: tuple[int, ...]
) -> tuple[Polynomial, ...]:
    """r-minors whose common zeros on V(ideal) contain the locus of lower rank: all where they are few."""
    r = len(rows)
    choices: list[tuple[tuple[int, ...], tuple[int, ...]]] = []
    if comb(block.shape[0], r) * comb(block.shape[1], r) <= ALL_MINORS:
        choices = [
            (i, j)
            for i in combinations(range(block.shape[0]), r)
            for j in combinations(range(block.shape[1]), r)
        ]
    elif r == block.shape[0] and (easy := easy_columns(block)):
        choices = [(rows, c) for c in easy[:EASY_MINORS]]
    else:
        choices = [(rows, columns), *_swapped(block.shape, rows, columns)]
    minors: dict[Polynomial, None] = {}
    for i, j in choices:
        minor = determinant(block.select(i, j))
        if not minor or ground.vanishes(minor):
            continue
        if minor.is_constant:
            return ()
        minors[minor.squarefree_part()] = None
    return tuple(sorted(minors, key=lambda m: (_weight(m), str(m))))


def _swapped(
    shape: tuple[int, int], rows: tuple[int, ...], columns: tuple[int, ...]
) -> Iterator[tuple[tuple[int, ...], tuple[int, ...]]]:
    """Index sets that differ from the given ones in one row or one column."""
    for out in rows:
        for new in range(shape[0]):
            if new not in rows:
                yield tuple(sorted({*rows, new} - {out})), columns
    for out in columns:
        for new in range(shape[1]):
            if new not in columns:
                yield rows, tuple(sorted({*columns, new} - {out}))


def relevant(defects: Defects) -> tuple[str, ...]:
    """The matrices whose further loss of rank can change the singularity types.

    With k_O = 0 there is neither IIM nor RPM, and the types depend on whether k_I is zero only (vii); dually.

    >>> relevant(Defects(0, 0, 1, 0))
    ('L_O',)
    """
    delta, p, k_I, k_O = defects.delta, defects.p, defects.k_I, defects.k_O
    if k_O == 0 and k_I == 0:
        return ("L_I", "L_O")
    if k_O == 0:
        return ("L_O",)
    if k_I == 0:
        return ("L_I",)
    names = ["L_p", "L"]
    if k_I == max(p, delta):
        names.append("L_I")
    if k_O == max(p, delta):
        names.append("L_O")
    return tuple(names)


def stratum(problem: RankProblem, ground: Ground) -> Stratum:
    """The generic stratum of V(ideal): its defects, and the loci that have to be taken out.

    For a square matrix of full rank the locus is its determinant's zero set, block by block.
    """
    ranks: dict[str, int] = {}
    loci: dict[str, tuple[tuple[Polynomial, ...], ...]] = {}
    known: dict[PolynomialMatrix, BlockRank] = {}
    for name, blocks in problem.blocks.items():
        for block in blocks:
            if block not in known:
                known[block] = block_rank(block, ground)
        ranks[name] = sum(known[block].rank for block in blocks)
        loci[name] = tuple(known[block].minors for block in blocks if known[block].minors)
    defects = problem.defects(ranks)
    component = ground.component
    return Stratum(component.generators, defects, {name: loci[name] for name in relevant(defects)}, component)


def patch_stratum(problem: RankProblem, patch: Patch, feasible: RealSystem, samples: Samples) -> Stratum:
    """The same for a patch: the matrices are taken apart anew with the solved variables put in.

    A locus of lower rank is a union of common zeros of factors of minors, each a locus of its own.
    """
    groups = (tuple(map(patch.restrict, group)) for group in feasible.exclusions)
    space = ConfigurationSpace(
        feasible.ring,
        patch.rest,
        tuple(g for g in groups if any(g)),
        tuple(map(patch.restrict, feasible.positive)),
    )
    ground = PatchGround(patch, Certifier(space), samples)
    ranks: dict[str, int] = {}
    loci: dict[str, tuple[tuple[Polynomial, ...], ...]] = {}
    for name, matrix in problem.matrices.items():
        parts = rank_blocks(matrix.map(patch.restrict), ground.certifier)
        found = [block_rank(block, ground) for block in parts.blocks]
        ranks[name] = parts.constant + problem.eliminated + sum(block.rank for block in found)
        loci[name] = tuple(e for block in found for e in union_of_loci(block.minors, ground.certifier))
    defects = Defects.of_ranks(ranks["L"], ranks["L_I"], ranks["L_O"], ranks["L_p"], problem.N, problem.n)
    return Stratum(patch.generators, defects, {name: loci[name] for name in relevant(defects)})


def union_of_loci(minors: tuple[Polynomial, ...], certifier: Certifier) -> tuple[tuple[Polynomial, ...], ...]:
    """Common zeros of factors, not proved nonzero, whose union holds the common zeros of the minors.

    Minors with few factors come first; where the choices are too many, the last are left out.
    """
    products = []
    for minor in minors:
        parts = factored((minor,), certifier)
        if parts.vanishes:
            continue
        if not parts.factors:
            return ()
        products.append(parts.polynomials)
    if not products:
        return ()
    products.sort(key=lambda factors: (len(factors), sum(len(p) for p in factors)))
    found = alternatives(tuple(products), certifier)
    while found is None:
        # fewer equations hold on a larger set: still all of the locus
        products = products[: len(products) * 2 // 3]
        found = alternatives(tuple(products), certifier)
    return found


def pivots(matrix: list[list[float]]) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Rows and columns of a well-conditioned minor of a numerical matrix, by complete pivoting.

    >>> pivots([[0.0, 2.0], [0.0, 1.0]])
    ((0,), (1,))
    """
    work = [row[:] for row in matrix]
    scale = max((abs(e) for row in work for e in row), default=0.0)
    rows: list[int] = []
    columns: list[int] = []
    while True:
        rest = [
            (abs(work[i][j]), i, j)
            for i in range(len(work))
            if i not in rows
            for j in range(len(work[i]))
            if j not in columns
        ]
        size, i, j = max(rest, default=(0.0, -1, -1))
        if size <= 1e-7 * scale or scale == 0.0:
            return tuple(sorted(rows)), tuple(sorted(columns))
        rows.append(i)
        columns.append(j)
        for k in range(len(work)):
            if k not in rows:
                factor = work[k][j] / work[i][j]
                work[k] = [a - factor * b for a, b in zip(work[k], work[i], strict=True)]
