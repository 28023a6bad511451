"""The configuration space: its pieces, and whether it is smooth where the mobility is increased.

Source: Zlatanov, Fenton, Benhabib (1998), section 2.3 (IIM); the second lemma is singsym's own, from the
unmixedness theorem (Matsumura, Commutative Ring Theory (1986), theorem 17.6).

Lemma 1.  Where rank L = N and L has N rows, the loop equations are independent: the space is a manifold of
dimension n there.  With more rows there are n independent tangents, and the space is a manifold where its
dimension is n; so it is everywhere where all components over C are proven to have that dimension.
So a stratum of dimension n or more is a piece of its own: it has inner points, or is larger than all regular
configurations together.

Lemma 2.  Let L have N rows, so that the loops of the mechanism ask for as many conditions as there are
freedoms more than n.  Let no complex solution set of the loop equations be larger than n, and that of
det L_I = 0 with them (or of det L_O = 0) be smaller.  Then the loops are a complete intersection with rank
L = N almost everywhere on each component, so without multiple components, and wherever rank L < N there are
more tangents than n: the space is singular exactly in the configurations with IIM.  With parameters as
variables, it is singular exactly where all gradients, also by the parameters, are dependent.
"""

from __future__ import annotations

from collections.abc import Sequence

from singsym.classes.result import ClassResult, Piece, SpacePiece
from singsym.classes.taxonomy.types import Defects, SingularityType
from singsym.conditions.conditions import Conditions
from singsym.effort import patience
from singsym.effort.attempts import attempt
from singsym.effort.verdict import Known, Premises, Verdict
from singsym.elimination.ideal import Ideal
from singsym.mechanism.model import Mechanism
from singsym.minors.determinant import maximal_minors
from singsym.polynomials import Equations, PolynomialMatrix, Ring
from singsym.varieties.decomposition import decompose
from singsym.varieties.real.dimension.extent import Extent, union
from singsym.varieties.real.modules.dimension import dimension_bound
from singsym.varieties.real.points.intervals import jacobian
from singsym.varieties.real.proofs.emptiness import is_empty_over_reals
from singsym.varieties.real.system import RealSystem

_UNKNOWN = "it is not known whether they lie in the closure of larger pieces"


def configuration_space(
    mechanism: Mechanism | None,
    conditions: Conditions,
    pieces: Sequence[Piece],
    classes: Sequence[ClassResult],
    whole: tuple[str, str],
) -> tuple[SpacePiece, ...]:
    """The pieces of the configuration space, those of singular configurations alone included.

    whole: what `smoothness` says of it.

    Without regular configurations, the classes of the largest dimension are the pieces, if no class is open.
    Where a class may be as large, a last piece, undecided, says so, and of smaller parts on which the search
    put no condition: they may lie in the closure of a larger one.
    """
    smooth, why = whole
    kept = ", ".join(mechanism.translating) if mechanism else ""
    usual = conditions.equation.n + conditions.equation.space.varying
    regular = [p for p in pieces if not p.path and not p.verdict.is_no and not _is_small(p, usual)]
    found = []
    for piece in regular:
        remarks = [] if piece.dimension is not None else [piece.extent.open]
        if piece.defects.delta:
            remarks.append(f"rank L is {piece.defects.delta} below N in every configuration")
        elif piece.defects.types:
            remarks.append(f"every configuration is singular: {piece.defects.types}")
        remarks += [why, f"only where these links keep their orientation: {kept}" if kept else ""]
        remark = "; ".join(filter(None, remarks))
        found.append(SpacePiece(piece.extent, smooth, piece.defects, piece.verdict, piece.basis, remark))
    small = {p.defects.types for p in pieces if not p.path and _is_small(p, usual)}
    singular = [p for p in pieces if (p.path or _is_small(p, usual)) and p.verdict.is_yes]
    at_least = usual if found else max((p.extent.at_least for p in singular), default=0)
    known = bool(found) or not any(c.verdict.is_undecided for c in classes)
    largest_classes = [c for c in classes if c.verdict.is_yes and c.extent.at_least >= at_least]
    for result in largest_classes if known else ():
        inside = [p for p in singular if p.defects.types == result.types and p.extent.at_least >= at_least]
        if inside:
            largest = max(inside, key=lambda p: p.extent.at_least)
            extent = union(p.extent for p in inside)
            remark = f"every configuration of this piece is singular: {result.types}"
            found.append(SpacePiece(extent, smooth, largest.defects, largest.verdict, largest.basis, remark))
    open_ones = [c for c in classes if _may_be_a_piece(c, at_least) or c.types in small]
    beside = [c for c in open_ones if c not in largest_classes]
    if known and found and beside:
        found.append(_perhaps(beside, smooth))
    elif not known and largest_classes:
        found.append(_perhaps([*largest_classes, *beside], smooth))
    return tuple(found)


def _is_small(piece: Piece, usual: int) -> bool:
    """Whether a piece of singular configurations is smaller than all regular ones together may be."""
    return bool(piece.defects.types) and piece.verdict.is_yes and piece.extent.at_least < usual


def _may_be_a_piece(result: ClassResult, at_least: int) -> bool:
    """Whether a class is not known to be as large as a piece of the space, nor to be smaller."""
    if result.verdict.is_no or result.extent.at_least >= at_least:
        return False
    return result.extent.at_most is None or result.extent.at_most >= at_least


def _perhaps(results: Sequence[ClassResult], smooth: str) -> SpacePiece:
    """Classes that may be pieces of the space by themselves: nothing is known of these pieces."""
    reasons = dict.fromkeys(c.extent.open or c.verdict.reason or _UNKNOWN for c in results)
    named = "; ".join(str(c.types) for c in results)
    verdict = Verdict.undecided("; ".join(reasons))
    remark = f"perhaps a piece of singular configurations alone: {named}"
    return SpacePiece(Extent(open=verdict.reason), smooth, Defects(0, 0, 0, 0), verdict, (), remark)


def smoothness(
    mechanism: Mechanism | None, conditions: Conditions, classes: Sequence[ClassResult]
) -> tuple[str, str]:
    """Whether the whole space is smooth, and what is to be said of it."""
    increased = [c for c in classes if SingularityType.IIM in c.types]
    parameters = conditions.equation.space.parameters
    # of a mode alone the loop equations are not all, and an L of one's own need not be their derivative: the
    # lemmas say nothing of these, nor does the second of a space of all mountings
    if mechanism is not None and not mechanism.translating:
        if all(c.verdict.is_no for c in increased):
            if not _is_of_one_dimension(conditions):
                return "undecided", "the loops are over-constrained, and may leave points without a motion"
            return "yes", _resting_on_primes(increased)
        mounted = conditions.equation.space.mountings
        if any(c.verdict.is_yes for c in increased) and not mounted and _is_complete_intersection(conditions):
            if not parameters:
                return "no", "singular exactly where there is IIM"
            names = ", ".join(parameters)
            why = f"smooth or not with {names} as variables; for fixed values singular where there is IIM"
            return _with_parameters(conditions), why
    return "undecided", ""


def _is_of_one_dimension(conditions: Conditions) -> bool:
    """Whether the space is seen to have the dimension of its tangents wherever rank L = N."""
    equation, space = conditions.equation, conditions.equation.space
    if len(equation.matrix.rows) == equation.N:
        return True
    with attempt("the dimensions of the loop equations", patience.SMOOTHNESS.work):
        found = decompose(space.equations, ring=space.ring)
        usual = equation.n + space.varying
        return found.certainty == "proven" and all(c.is_pure and c.dimension == usual for c in found.value)
    return False


def _resting_on_primes(increased: Sequence[ClassResult]) -> str:
    proven = all(c.verdict.certainty == "proven" for c in increased)
    return "" if proven else "that it is smooth rests on random primes"


def _with_parameters(conditions: Conditions) -> str:
    """Whether the gradients by all variables and parameters are independent at all real points."""
    space = conditions.equation.space
    equations = tuple(f for f in space.equations if f)
    matrix = PolynomialMatrix.of(space.ring, jacobian(equations, space.ring.names))
    with attempt("whether a space is smooth", patience.SMOOTHNESS.work):
        minors = tuple(minor for _, _, minor in maximal_minors(matrix))
        system = RealSystem(
            space.ring, (*equations, *minors), space.exclusions, space.positive, space.nonnegative
        )
        verdict = is_empty_over_reals(system)
        if not verdict.is_undecided:
            return "yes" if verdict.is_yes else "no"
    return "undecided"


def _is_complete_intersection(conditions: Conditions) -> bool:
    """Whether lemma 2 is proven to hold; False also where that takes long."""
    equation = conditions.equation
    space = equation.space
    if len(equation.matrix.rows) != equation.N:
        return False
    usual = equation.n + len(space.parameters)
    with attempt("the dimensions of the loop equations", patience.SMOOTHNESS.work):
        whole = _dimension(space.ring, space.equations, usual)
        if whole.value > usual:
            return False
        for label in ("5", "4"):
            alternatives = conditions[label].polynomials
            if conditions[label].alternatives is None or conditions[label].everywhere:
                continue
            premises = Premises(whole.certainty)
            systems = ((*space.equations, *locus) for locus in alternatives)
            parts = (_dimension(space.ring, system, usual - 1) for system in systems)
            smaller = all(premises.take(part) < usual for part in parts)
            if smaller and premises.certainty == "proven":
                return True
    return False


def _dimension(ring: Ring, equations: Equations, most: int) -> Known[int]:
    """That of the complex zeros, or a bound of it that is no larger than `most`."""
    bound = dimension_bound(tuple(filter(None, equations)), complex_too=True)
    if bound is not None and bound.value <= most:
        return bound
    return Ideal(ring, equations).dimension
