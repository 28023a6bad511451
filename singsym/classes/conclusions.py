"""What the strata, and the branches that were not searched, say of loci and of the 21 classes.

Source: Zlatanov, Fenton, Benhabib (1998), section 3.2, Table 2.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import islice

from singsym.classes.realisation.curve_components import Counted
from singsym.classes.realisation.realisation import Realised
from singsym.classes.result import ClassResult, Locus, Piece
from singsym.classes.strata.search import Exploration
from singsym.classes.taxonomy.steps import excluded_in, found_in
from singsym.classes.taxonomy.types import SingularityClass, SingularityType, feasible_classes
from singsym.conditions.conditions import Conditions
from singsym.conditions.factor import Factor
from singsym.effort import chance, patience
from singsym.effort.attempts import attempt
from singsym.effort.verdict import Certainty, Verdict, weakest
from singsym.elimination.ideal import Ideal
from singsym.kinematics.mobility import check_mobility
from singsym.polynomials import Polynomial
from singsym.polynomials.latex import polynomial_latex
from singsym.varieties.real.dimension.extent import EMPTY, Extent, union
from singsym.varieties.real.numerical.sampling import is_large

MOST_TRIED = 4
MOST_FREEDOMS = 2
NOT_COUNTED = f"components of curves are counted for n <= {MOST_FREEDOMS}, and not within inequalities"


def classes_of(
    explored: Exploration, pieces: Sequence[Piece], n: int, counting: bool
) -> tuple[ClassResult, ...]:
    """The 21 classes; counting: whether components of curves were counted."""
    occurring = {p.defects.types for p in pieces if p.verdict.is_yes}
    possible = set(feasible_classes(n))
    results = []
    for candidate in feasible_classes():
        if candidate not in possible:
            no = Verdict.no(reason=f"impossible for n = {n}, by the inequalities of the four ranks")
            results.append(ClassResult(candidate, no, (), EMPTY, None, None, (), ""))
            continue
        own = [p for p in pieces if p.defects.types == candidate.types]
        results.append(_class(candidate, occurring, explored, own, counting))
    return tuple(results)


def remarks_of(conditions: Conditions) -> tuple[str, ...]:
    """Where (4) or (5) is no list of factors: it holds everywhere or nowhere, or is not written out."""
    found = []
    for label, name in (("4", "L_I"), ("5", "L_O")):
        condition = conditions[label]
        if condition.everywhere:
            found.append(f"({label}) holds in every configuration")
        elif condition.alternatives is not None:
            if not condition.alternatives:
                found.append(f"({label}) holds in no configuration")
            elif any(len(factors) > 1 for factors in condition.alternatives):
                found.append(
                    f"({label}) holds also where several polynomials vanish: no loci of these are listed"
                )
        else:
            said = f"({label}) is not written out in factors"
            seen = check_mobility(conditions.equation, chance.random("remarks").randrange(2**32))
            if seen.samples and seen.ranks[name] < conditions.equation.N:
                ranks = f"rank {name} = {seen.ranks[name]} < N = {conditions.equation.N}"
                where = f"at all {seen.samples} random configurations"
                said += f"; numerically {ranks} {where}: it seems to hold everywhere"
            found.append(said)
    return tuple(found)


def with_numbers(part: Realised, counted: Counted | None) -> list[Piece]:
    """The pieces of a stratum with the numbers of connected components of each, or why they are not known."""
    if counted is None:
        return list(part.pieces)
    if counted.components is None:
        return [replace(p, uncounted=counted.reason, countable=counted.open) for p in part.pieces]
    return [replace(p, components=k) for p, k in zip(part.pieces, counted.components, strict=True)]


def _class(
    candidate: SingularityClass,
    occurring: set[SingularityType],
    explored: Exploration,
    own: Sequence[Piece],
    counting: bool,
) -> ClassResult:
    """What its pieces say of a class, and the doubts about those and about parts that were not searched."""
    present = sorted((p for p in own if p.verdict.is_yes), key=lambda p: (-p.extent.at_least, str(p.path)))
    unexplored = explored.doubts(candidate.types)
    extent = union((p.extent for p in own if not p.verdict.is_no), unexplored)
    known = explored.certainty_of(candidate.types)
    points = components = None
    uncounted = remark = ""
    if present:
        certainty = present[0].verdict.certainty
        verdict = Verdict.yes(certainty, reason=_reservations(extent, known))
        steps: tuple[str, ...] = (found_in(candidate.types),)
        if extent.dimension == 0 or (counting and extent.dimension == 1):
            points, components, uncounted, remark = _counts(extent, own)
        elif extent.dimension == 1:
            remark = NOT_COUNTED
    elif unexplored or any(p.verdict.is_undecided for p in own):
        reasons = [*(p.verdict.reason for p in own if p.verdict.is_undecided), *unexplored]
        verdict = Verdict.undecided("; ".join(dict.fromkeys(reasons)))
        steps = (found_in(candidate.types),)
    else:
        certainty = weakest(known, *(p.verdict.certainty for p in own))
        ruled_out = "; ".join(dict.fromkeys(p.verdict.reason for p in own))
        verdict = Verdict.no(certainty, reason=ruled_out or "no stratum of the four ranks has these types")
        steps, extent = (excluded_in(candidate.types, occurring),), EMPTY
    return ClassResult(
        candidate,
        verdict,
        tuple(present),
        extent,
        points,
        components,
        steps,
        conditions_latex(present),
        uncounted,
        remark,
        tuple(p for p in own if p.verdict.is_undecided),
    )


def _counts(extent: Extent, pieces: Sequence[Piece]) -> tuple[int | None, int | None, str, str]:
    """Points and connected components of a class; or why not, if a larger budget could help, and if not.

    Points of a curve's class that are on no curve of it, closed up as equations are, are components too.
    """
    own = [p for p in pieces if not p.verdict.is_no]
    left = [p for p in own if p.verdict.is_undecided or p.components is None]
    if left:
        reasons = dict.fromkeys(p.uncounted or p.extent.open or p.verdict.reason for p in left)
        said = f"not counted: {'; '.join(reasons)}"
        return (None, None, said, "") if any(p.countable for p in left) else (None, None, "", said)
    total = sum(p.components or 0 for p in own)
    return (total if extent.dimension == 0 else None), total, "", ""


def largest_inside(factor: Factor, pieces: Sequence[Piece]) -> Piece | None:
    """The largest stratum that is seen to lie in the zeros of a factor, if one is known to have a point.

    Those on whose way down it was set to zero; without such, a few of the others are tried.
    """
    polynomial = factor.polynomial
    present = sorted((p for p in pieces if p.verdict.is_yes), key=lambda p: -p.extent.at_least)
    on_the_way = next((p for p in present if polynomial in p.path), None)
    if on_the_way is not None:
        return on_the_way
    possible = (p for p in present if p.defects.types and _may_vanish(polynomial, p))
    return next((p for p in islice(possible, MOST_TRIED) if _vanishes(polynomial, p)), None)


def _may_vanish(polynomial: Polynomial, piece: Piece) -> bool:
    names = polynomial.ring.names
    places = tuple(tuple(float(w.coordinates[name]) for name in names) for w in piece.witnesses)
    return bool(places) and not is_large(polynomial, places)


def _vanishes(polynomial: Polynomial, piece: Piece) -> bool:
    """Whether a polynomial is proven to vanish on a piece, as a member of its ideal."""
    with attempt("membership", patience.LOCUS_HOLDS_PIECE.work):
        inside = Ideal(polynomial.ring, piece.basis).contains(polynomial)
        return inside.value and inside.is_proven
    return False


def at_least(whole: Piece, inside: Piece | None) -> Piece:
    """A locus of which a stratum inside may show more than it shows by itself."""
    if inside is None or inside.extent.at_least <= whole.extent.at_least:
        return whole
    extent = replace(whole.extent, at_least=inside.extent.at_least)
    return replace(whole, verdict=inside.verdict, extent=extent, witnesses=inside.witnesses)


def locus_of(label: str, factor: Factor, piece: Piece, counted: Counted | None, counting: bool) -> Locus:
    """A locus of the result, from its piece and the count of its components, where there is one."""
    components, reason, is_open = piece.components, piece.extent.open, True
    if counted is not None:
        components = None if counted.components is None else counted.components[0]
        reason, is_open = counted.reason, counted.open
    elif piece.dimension == 1 and not counting:
        reason, is_open = NOT_COUNTED, False
    reason = "" if components is not None else reason
    return Locus(
        label,
        factor.polynomial,
        factor.words,
        factor.latex(),
        piece.verdict,
        piece.extent,
        components,
        piece.points,
        reason if is_open else "",
        "" if is_open else reason,
    )


def _reservations(extent: Extent, known: Certainty) -> str:
    """What is not known, or not proven, of a class that occurs; `known`: how it is that there is no more."""
    if extent.dimension is None:
        return f"its dimension is {extent}: {extent.open}"
    if known != "proven":
        return "that there is no more of it rests on random primes"
    if extent.bounded != "proven":
        return "that no part of it has a larger dimension rests on random primes"
    return ""


def conditions_latex(pieces: Sequence[Piece]) -> str:
    """The equations and inequations of a class as LaTeX: the factors on the way to each piece."""
    lines: dict[str, None] = {}
    for piece in pieces:
        equal = [f"{polynomial_latex(p)} = 0" for p in piece.path]
        unequal = [_nonzero_latex(e) for e in piece.exclusions]
        lines[r",\; ".join((*equal, *unequal))] = None
    return r" \quad\text{or}\quad ".join(lines)


def _nonzero_latex(exclusion: tuple[Polynomial, ...]) -> str:
    if len(exclusion) == 1:
        factors = [p for p, _ in exclusion[0].factors()]
        if len(factors) > 1:
            return r",\; ".join(f"{polynomial_latex(p)} \\ne 0" for p in factors)
        return f"{polynomial_latex(exclusion[0])} \\ne 0"
    listed = ", ".join(polynomial_latex(p, 6) for p in exclusion)
    return rf"\left({listed}\right) \ne 0"
