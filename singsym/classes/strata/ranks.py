"""Strata of the configuration space on which the four ranks are constant.

Source: Zlatanov, Fenton, Benhabib (1998), sections 2.3 and 3.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from singsym.classes.strata.block_rank import block_rank, numerical_minor, union_of_loci
from singsym.classes.strata.ground import Ground
from singsym.classes.taxonomy.types import Defects, SingularityType
from singsym.effort.verdict import Known, Premises
from singsym.minors.rank import simplest_blocks
from singsym.polynomials import Equations, Polynomial, PolynomialMatrix
from singsym.varieties.decomposition import Component
from singsym.varieties.real.system import RealSystem


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
class Stratum:
    """The zeros of `equations` off some loci: there the types are constant.

    loci: of each tuple, not all polynomials vanish on the stratum.
    component: the equations' zero set where it comes from a decomposition, else None.
    elsewhere: loci whose points another branch counts, in a stratum of the same types.
    """

    equations: tuple[Polynomial, ...]
    defects: Defects
    loci: tuple[tuple[Polynomial, ...], ...] = ()
    component: Component | None = None
    elsewhere: tuple[tuple[Polynomial, ...], ...] = ()


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


DefectBounds = Mapping[str, int]
"""Of some matrices, how far at least they are below full rank on a set."""


@dataclass(frozen=True)
class Ranked:
    """What the ranks on a ground come to: a stratum where the types are constant, and what is left of it.

    stratum: None where its configurations are known without a search.
    loci: closed sets whose points have to be looked at by themselves, with what is known of the ranks there;
        the stratum lies off all of them.
    """

    stratum: Stratum | None
    loci: Mapping[tuple[Polynomial, ...], DefectBounds]


def ranked(
    problem: RankProblem,
    ground: Ground,
    feasible: RealSystem,
    first_matrix: str = "L_O",
    defect_bounds: DefectBounds | None = None,
    complete_types: tuple[SingularityType, ...] = (),
) -> Known[Ranked]:
    """The generic ranks on a ground off its exclusions, and the loci of lower rank that matter for the types.

    Matrix by matrix, each taken apart anew with what is solved for put in, and with the loci of those before
    known not to vanish.
    first_matrix: `L_O` or `L_I`; where it has full rank, there is neither IIM nor RPM.
    defect_bounds: what is known of the ranks; complete_types: those whose strata are all known.

    >>> from singsym.classes.strata.patches import Patch
    >>> from singsym.polynomials import Ring
    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> row = PolynomialMatrix.of(R, [[x, y]])
    >>> parts = {name: row.select(columns=c) for name, c in (("L_I", [0]), ("L_O", [1]), ("L_p", []))}
    >>> plane = Ground(Patch(R, {}, ()), ((1.0, 2.0),))
    >>> ranked(RankProblem({"L": row, **parts}, 0, 1, 1), plane, RealSystem(R, ())).value.loci
    {(y,): {'L_O': 1}, (x,): {'L_I': 1}}
    """
    other = {"L_O": "L_I", "L_I": "L_O"}[first_matrix]
    ranks = _Ranks(problem, ground, feasible, dict(defect_bounds or {}))
    ranks.examine(first_matrix)
    if ranks.defect[first_matrix]:
        ranks.examine("L_p")
        ranks.examine("L")
    if not ranks.defect["L"] and not ranks.defect["L_p"]:
        own = _OWN[first_matrix]
        possible = (own, _BOTH) if ranks.defect[first_matrix] else (SingularityType(0), _OWN[other])
        if set(possible) <= set(complete_types):
            return ranks.premises.conclude(Ranked(None, ranks.loci))
    before = {locus: dict(there) for locus, there in ranks.loci.items()}
    ranks.examine(other)
    defect = ranks.defect
    defects = Defects(defect["L"], defect["L_p"], defect["L_I"], defect["L_O"])
    matters = other in relevant(defects) or not ranks.is_highest(other)
    loci = ranks.loci if matters else before
    found = Stratum(ground.equations, defects, tuple(loci), ground.component)
    return ranks.premises.conclude(Ranked(None if defects.types in complete_types else found, loci))


@dataclass
class _Ranks:
    """What is found out of the four ranks on a ground, matrix by matrix.

    defect_bounds: how far at least each is below full rank; defect: how far it is, off the loci; highest:
        whether it is proven nowhere higher; loci: of lower rank, with how far at least the matrices are below
        full rank there; premises: what all this rests on.
    """

    problem: RankProblem
    ground: Ground
    feasible: RealSystem
    defect_bounds: dict[str, int]
    defect: dict[str, int] = field(default_factory=lambda: {"L": 0, "L_p": 0})
    seen_off: dict[str, list[Polynomial]] = field(default_factory=dict)
    loci: dict[Equations, dict[str, int]] = field(default_factory=dict)
    premises: Premises = field(default_factory=Premises)

    def examine(self, name: str) -> None:
        """The rank of one matrix; it is taken apart off the loci known before, and says nothing on them."""
        ground, earlier = self.ground, frozenset(self.loci)
        certifier = ground.certifier(self.feasible, self.loci)
        matrix = self.problem.matrices[name].map(ground.patch.restrict)
        parts = simplest_blocks(matrix, certifier, self.problem.outputs(name))
        full = self.problem.full(name) - parts.constant
        starts = [numerical_minor(block, ground.samples, certifier) for block in parts.blocks]
        most = sum(min(block.shape) for block in parts.blocks)
        self.defect_bounds[name] = max(
            full - most, *(self.defect_bounds.get(other, 0) for other in _BELOW[name])
        )
        largest = sum(len(rows) for rows, _ in starts) == full - self.defect_bounds[name]
        found = [
            self.premises.take(block_rank(block, ground, certifier, start, largest))
            for block, start in zip(parts.blocks, starts, strict=True)
        ]
        self.defect[name] = full - sum(block.rank for block in found)
        self.seen_off[name] = [block.seen_off for block in found if block.seen_off is not None]
        for block, whole in zip(found, parts.blocks, strict=True):
            lower = full - (most - min(whole.shape) + block.rank - 1)
            alternatives, exact = union_of_loci(block.minors, certifier)
            for locus in alternatives:
                there = self.loci.setdefault(locus, {})
                if block.exact and exact and lower > 0 and locus not in earlier:
                    there[name] = max(lower, there.get(name, 0))

    def is_highest(self, name: str) -> bool:
        """Whether the rank of a matrix is proven to be nowhere higher on the ground."""
        return all(
            self.premises.take(self.ground.has_no_zeros_inside(p)) for p in self.seen_off.get(name, ())
        )
