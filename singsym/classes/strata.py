"""Strata of the configuration space on which the four ranks are constant.

Source: Zlatanov, Fenton, Benhabib (1998), sections 2.3 and 3; the bordered minors are Kronecker's theorem.

Lemma (Kronecker). Where an r-minor of a matrix does not vanish, the rank is r exactly if all (r+1)-minors
that border it vanish.  So one minor outside an ideal and its bordering minors inside it fix the rank on
V(ideal) minus V(minor), whether the ideal is prime or not.  Off the common zeros of several r-minors the rank
is r only where that holds for each of them: no minor is larger, or the larger ones vanish on the whole set.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, product
from math import comb, prod

from singsym.classes.patches import Patch, is_combination
from singsym.classes.types import Defects, SingularityType
from singsym.elimination import engines
from singsym.elimination.attempts import attempt
from singsym.elimination.budget import Undecided
from singsym.elimination.ideal import Ideal
from singsym.elimination.verdict import unnoted, weakest
from singsym.kinematics.nonzero import Certifier
from singsym.kinematics.placement import ConfigurationSpace
from singsym.minors.blocks import easy_columns
from singsym.minors.determinant import determinant
from singsym.minors.factored import factored
from singsym.minors.rank import alternatives, simplest_blocks
from singsym.polynomials import Polynomial, PolynomialMatrix
from singsym.varieties.decomposition import Component, decompose
from singsym.varieties.real.cartesian import Cartesian
from singsym.varieties.real.intervals import pivots
from singsym.varieties.real.sampling import Points, is_large
from singsym.varieties.real.witness import RealSystem

MEMBERSHIP_SECONDS = 2.0
"""So long a Groebner basis of a patch as a whole is waited for, to prove that minors vanish on it."""
IRREDUCIBLE_SECONDS = 3.0
"""So long it is waited for that a patch is proven irreducible."""
ALL_MINORS = 24
"""Up to this many minors of a block, its rank locus is written with all of them."""
EASY_MINORS = 24
"""Of a larger block, so many minors that are products of small determinants are used."""


@dataclass(frozen=True)
class RankProblem:
    """The four matrices of a mechanism.

    matrices: `L L_I L_O L_p` of the reduced velocity equation, with ranks lower by `eliminated`.
    N, n: the number of 1-DOF joints and the mobility.
    """

    matrices: Mapping[str, PolynomialMatrix]
    eliminated: int
    N: int
    n: int

    def outputs(self, name: str) -> int:
        """How many columns of a matrix, the first ones, are the output's."""
        return self.n if name in ("L", "L_I") else 0

    def full(self, name: str) -> int:
        """The full rank of a reduced matrix: how far its rank is below is delta, p, k_I or k_O."""
        return (self.N - self.n if name == "L_p" else self.N) - self.eliminated


@dataclass(frozen=True)
class BlockRank:
    """The rank of a block where the `minors` of that size do not all vanish.

    exact: whether all minors of that size vanish where these do; highest: whether the rank is nowhere larger.
    """

    rank: int
    minors: tuple[Polynomial, ...]
    exact: bool = True
    highest: bool = True


@dataclass(frozen=True)
class Stratum:
    """The zeros of `equations` off some loci: there the types are constant.

    loci: of each tuple, not all polynomials vanish on the stratum.
    component: the equations' zero set where it comes from a decomposition, else None.
    elsewhere: loci whose points in the stratum belong to another stratum of the same types as well.
    """

    equations: tuple[Polynomial, ...]
    defects: Defects
    loci: tuple[tuple[Polynomial, ...], ...] = ()
    component: Component | None = None
    elsewhere: tuple[tuple[Polynomial, ...], ...] = ()


class NotEvident(Undecided):
    """What a polynomial does on a set has to be known before more can be said of it."""

    def __init__(self, polynomial: Polynomial, reason: str) -> None:
        super().__init__(reason)
        self.polynomial = polynomial

    def __reduce__(self) -> tuple[type[NotEvident], tuple[Polynomial, str]]:
        return NotEvident, (self.polynomial, str(self))


@dataclass(frozen=True)
class Ground:
    """Where ranks are asked for: a patch or one component of it, with points on it to guess from.

    system: the patch off the exclusions.
    """

    patch: Patch
    samples: Points = ()
    component: Component | None = None
    system: RealSystem | None = None

    @cached_property
    def _chart(self) -> tuple[Cartesian, tuple[Ideal, ...]] | None:
        if self.system is None:
            return None
        chart = Cartesian.of(self.system)
        return chart, chart.based(MEMBERSHIP_SECONDS * engines.proof_patience())

    @property
    def equations(self) -> tuple[Polynomial, ...]:
        return self.component.generators if self.component else self.patch.generators

    def has_no_zeros_inside(self, polynomial: Polynomial) -> bool:
        """Whether the zeros of a polynomial are proven to hold no open part of the ground.

        On an irreducible ground those are such that do not vanish on all of it; then what vanishes off their
        zeros vanishes on the whole ground.
        """
        if self.component is not None:
            return self.component.prime and not self.component.ideal.contains(polynomial)
        left = self.patch.restrict(polynomial)
        return bool(left) and self._prime is not None and not self._prime.contains(left)

    @cached_property
    def _prime(self) -> Ideal | None:
        """The ideal of the patch in the variables that are not solved for, where it is soon proven prime."""
        with attempt("whether a part is irreducible", IRREDUCIBLE_SECONDS), unnoted() as seen:
            components = decompose(self.patch.rest, ring=self.patch.ring)
            if len(components) == 1 and components[0].prime and weakest(*seen) == "proven":
                return components[0].ideal
        return None

    def certifier(self, feasible: RealSystem, loci: Iterable[tuple[Polynomial, ...]]) -> Certifier:
        """What is known of signs and zeros on the ground off the exclusions and off some loci."""
        restrict = self.patch.restrict
        groups = (tuple(map(restrict, group)) for group in (*feasible.exclusions, *loci))
        rest = self.component.generators if self.component else self.patch.rest
        positive = tuple(map(restrict, feasible.positive))
        exclusions = tuple(group for group in groups if any(group))
        return Certifier(ConfigurationSpace(feasible.ring, rest, exclusions, positive))

    def vanishes(self, polynomial: Polynomial, certifier: Certifier) -> bool:
        """Whether a polynomial is zero on the ground, where True is proven.

        On a component False may be a guess, which only makes a stratum empty and sends its closure down as a
        locus again.  Raises `NotEvident` on a patch where it seems to be, unproven.
        """
        restricted = self.patch.restrict(polynomial)
        if certifier.normal_form(restricted).is_zero or certifier.shorten(restricted).is_zero:
            return True
        if is_large(polynomial, self.samples):
            return False
        if self.component is not None and self.component.ideal.contains(polynomial):
            return True
        if is_combination(restricted, self.equations if self.component else self.patch.rest):
            return True
        if self.component is None:
            if self._chart is not None and self._chart[0].vanishes(restricted, self._chart[1]):
                return True
            raise NotEvident(restricted, "a minor seems to vanish on a part of the configuration space")
        return not self.component.prime and self.component.ideal.radical_contains(polynomial)


MOST_PRODUCTS = 10**10
"""A determinant whose rows have more terms, multiplied with each other, is not expanded."""


def expanded(square: PolynomialMatrix) -> Polynomial:
    """The determinant; raises `NotEvident` with a short entry where it would be too large.

    Where that entry is known not to vanish, it is a pivot, and the matrix gets smaller.
    """
    if prod(sum(map(len, row)) for row in square.rows) > MOST_PRODUCTS:
        entries = (e for row in square.rows for e in row if not e.is_constant)
        shortest = min(entries, key=lambda e: (*_weight(e), str(e)))
        raise NotEvident(shortest, f"a minor of size {square.width} is too large to be expanded")
    return determinant(square)


Places = tuple[tuple[int, ...], tuple[int, ...]]
"""Rows and columns of a minor."""


def numerical_minor(block: PolynomialMatrix, samples: Points) -> Places:
    """A minor that is as large as the rank of the block at one of the samples, and not small there."""
    best: Places = ((), ())
    for x in samples:
        found = pivots([[float(e) for e in row] for row in block.evaluate(x)])
        if len(found[0]) > len(best[0]) and is_large(expanded(block.select(*found)), (x,)):
            best = found
    return best


def _bordered(shape: tuple[int, int], rows: Sequence[int], columns: Sequence[int]) -> Iterator[Places]:
    for i in range(shape[0]):
        if i in rows:
            continue
        for j in range(shape[1]):
            if j not in columns:
                yield tuple(sorted((*rows, i))), tuple(sorted((*columns, j)))


def block_rank(
    block: PolynomialMatrix,
    ground: Ground,
    certifier: Certifier,
    start: Places = ((), ()),
    largest: bool = False,
) -> BlockRank:
    """The rank of a matrix on the ground minus the common zeros of the minors returned.

    Grows a nonvanishing minor border by border until all bordering minors vanish (lemma above); of several
    nonvanishing ones the one with the simplest factors is taken.
    start: a nonvanishing minor to start from; largest: whether no rank on the ground is known to be larger.

    >>> from singsym.polynomials import Ring
    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> line = Ground(Patch(R, {"y": R.zero}, ()), ((1.0, 0.0),))
    >>> matrix = PolynomialMatrix.of(R, [[x, y], [x, y]])
    >>> block_rank(matrix, line, line.certifier(RealSystem(R, ()), ()))
    BlockRank(rank=1, minors=(x,), exact=True, highest=True)
    """
    rows, columns = start
    last = expanded(block.select(rows, columns)) if rows else None
    while not largest:
        candidates = []
        for r, c in _bordered(block.shape, rows, columns):
            minor = expanded(block.select(r, c))
            if minor and not ground.vanishes(minor, certifier):
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
    highest = largest or len(rows) == min(block.shape) or ground.has_no_zeros_inside(last)
    return _with_locus(block, ground, certifier, (rows, columns), highest)


def _is_rank(block: PolynomialMatrix, ground: Ground, certifier: Certifier, places: Places) -> bool:
    """Whether all minors that border one are proven to vanish on the ground."""
    try:
        borders = (expanded(block.select(*border)) for border in _bordered(block.shape, *places))
        return all(not minor or ground.vanishes(minor, certifier) for minor in borders)
    except NotEvident:
        return False


def _weight(minor: Polynomial) -> tuple[int, int]:
    return (minor.total_degree, len(minor))


def _with_locus(
    block: PolynomialMatrix, ground: Ground, certifier: Certifier, largest: Places, highest: bool
) -> BlockRank:
    """r-minors whose common zeros on the ground contain the locus of lower rank: all where they are few.

    largest: one of them, whose bordering minors vanish; highest: whether no rank on the ground is larger.
    """
    rows, columns = largest
    r = len(rows)
    height, width = block.shape
    exact = comb(height, r) * comb(width, r) <= ALL_MINORS
    choices: Iterable[Places]
    if exact:
        choices = product(combinations(range(height), r), combinations(range(width), r))
    elif r == height and (easy := easy_columns(block)):
        choices = ((rows, c) for c in easy[:EASY_MINORS])
    else:
        choices = (largest, *_swapped(block.shape, rows, columns))
    minors: dict[Polynomial, None] = {}
    for i, j in choices:
        minor = expanded(block.select(i, j))
        if not minor:
            continue
        if not (highest or (i, j) == largest or _is_rank(block, ground, certifier, (i, j))):
            # the rank may be higher where only this minor does not vanish
            exact = False
            continue
        try:
            with unnoted() as seen:
                if ground.vanishes(minor, certifier):
                    exact = exact and weakest(*seen) == "proven"
                    continue
        except NotEvident:
            # with fewer minors the zeros are a larger set
            exact = False
            continue
        if minor.is_constant:
            return BlockRank(r, ())
        minors[minor.squarefree_part()] = None
    return BlockRank(r, tuple(sorted(minors, key=lambda m: (_weight(m), str(m)))), exact, highest)


def _swapped(shape: tuple[int, int], rows: tuple[int, ...], columns: tuple[int, ...]) -> Iterator[Places]:
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


_BELOW = {"L": ("L",), "L_p": ("L_p",), "L_I": ("L_I", "L_p", "L"), "L_O": ("L_O", "L_p", "L")}
"""The matrices that are no further below full rank than one is: k_I, k_O >= max(p, delta) (Table 1)."""
_OWN = {
    "L_O": SingularityType.RI | SingularityType.IO,
    "L_I": SingularityType.RO | SingularityType.II,
}
"""The types where only this matrix has less than full rank: conditions (vii), (viii)."""
_BOTH = _OWN["L_O"] | _OWN["L_I"]


Least = Mapping[str, int]
"""Of some matrices, how far at least they are below full rank on a set."""


@dataclass(frozen=True)
class Ranked:
    """What the ranks on a ground come to: a stratum where the types are constant, and what is left of it.

    stratum: None where its configurations are known without a search.
    loci: closed sets whose points have to be looked at by themselves, with what is known of the ranks there;
        the stratum lies off all of them.
    """

    stratum: Stratum | None
    loci: Mapping[tuple[Polynomial, ...], Least]


def ranked(
    problem: RankProblem,
    ground: Ground,
    feasible: RealSystem,
    first: str = "L_O",
    least: Least | None = None,
    evident: tuple[SingularityType, ...] = (),
) -> Ranked:
    """The generic ranks on a ground off its exclusions, and the loci of lower rank that matter for the types.

    Matrix by matrix, each taken apart anew with what is solved for put in, and with the loci of those before
    known not to vanish.  first: `L_O` or `L_I`; where it has full rank, there is neither IIM nor RPM.
    least: what is known of the ranks; evident: the types whose strata are known.

    >>> from singsym.polynomials import Ring
    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> row = PolynomialMatrix.of(R, [[x, y]])
    >>> parts = {name: row.select(columns=c) for name, c in (("L_I", [0]), ("L_O", [1]), ("L_p", []))}
    >>> plane = Ground(Patch(R, {}, ()), ((1.0, 2.0),))
    >>> ranked(RankProblem({"L": row, **parts}, 0, 1, 1), plane, RealSystem(R, ())).loci
    {(y,): {'L_O': 1}, (x,): {'L_I': 1}}
    """
    other = {"L_O": "L_I", "L_I": "L_O"}[first]
    defect = {"L": 0, "L_p": 0}
    highest = dict.fromkeys(_BELOW, True)
    known = dict.fromkeys(_BELOW, 0) | dict(least or {})
    loci: dict[tuple[Polynomial, ...], dict[str, int]] = {}

    def examine(name: str) -> None:
        # the matrix is taken apart off these, so that nothing follows for its rank on them
        earlier = frozenset(loci)
        certifier = ground.certifier(feasible, loci)
        matrix = problem.matrices[name].map(ground.patch.restrict)
        parts = simplest_blocks(matrix, certifier, problem.outputs(name))
        full = problem.full(name) - parts.constant
        starts = [numerical_minor(block, ground.samples) for block in parts.blocks]
        most = sum(min(block.shape) for block in parts.blocks)
        known[name] = max(full - most, *(known[other] for other in _BELOW[name]))
        largest = sum(len(rows) for rows, _ in starts) == full - known[name]
        found = [
            block_rank(block, ground, certifier, start, largest)
            for block, start in zip(parts.blocks, starts, strict=True)
        ]
        defect[name] = full - sum(block.rank for block in found)
        highest[name] = all(block.highest for block in found)
        for block, whole in zip(found, parts.blocks, strict=True):
            lower = full - (most - min(whole.shape) + block.rank - 1)
            alternatives, exact = union_of_loci(block.minors, certifier)
            for locus in alternatives:
                there = loci.setdefault(locus, {})
                if block.exact and exact and lower > 0 and locus not in earlier:
                    there[name] = max(lower, there.get(name, 0))

    examine(first)
    if defect[first]:
        examine("L_p")
        examine("L")
    if not defect["L"] and not defect["L_p"]:
        possible = (_OWN[first], _BOTH) if defect[first] else (SingularityType(0), _OWN[other])
        if set(possible) <= set(evident):
            return Ranked(None, loci)
    before = {locus: dict(there) for locus, there in loci.items()}
    examine(other)
    defects = Defects(defect["L"], defect["L_p"], defect["L_I"], defect["L_O"])
    if other not in relevant(defects) and highest[other]:
        loci = before
    found = Stratum(ground.equations, defects, tuple(loci), ground.component)
    return Ranked(None if defects.types in evident else found, loci)


def union_of_loci(
    minors: tuple[Polynomial, ...], certifier: Certifier
) -> tuple[tuple[tuple[Polynomial, ...], ...], bool]:
    """Common zeros of factors, not proved nonzero, whose union holds the common zeros of the minors.

    Minors with few factors come first; where the choices are too many, the last are left out, and the union
    may be larger: the second value is False then.
    """
    products = []
    for minor in minors:
        parts = factored((minor,), certifier)
        if parts.vanishes:
            continue
        if not parts.factors:
            return (), True
        products.append(parts.polynomials)
    if not products:
        return (), True
    products.sort(key=lambda factors: (len(factors), sum(len(p) for p in factors)))
    found, count = alternatives(tuple(products), certifier), len(products)
    while found is None:
        # fewer equations hold on a larger set: still all of the locus
        products = products[: len(products) * 2 // 3]
        found = alternatives(tuple(products), certifier)
    return found, len(products) == count
