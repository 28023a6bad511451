"""The configuration space: its components, and whether it is smooth where the mobility is increased.

Source: Zlatanov, Fenton, Benhabib (1998), section 2.3 (IIM); the second lemma is singsym's own, from the
unmixedness theorem (Matsumura, Commutative Ring Theory (1986), theorem 17.6).

Lemma 1.  Where rank L = N, the loop equations are independent: the space is a manifold of dimension n there.

Lemma 2.  Let L have N rows, so that the loops of the mechanism ask for as many conditions as there are
freedoms more than n.  Let no complex solution set of the loop equations be larger than n, and that of
det L_I = 0 with them (or of det L_O = 0) be smaller.  Then the loops are a complete intersection with rank
L = N almost everywhere on each component, so without multiple components, and wherever rank L < N there are
more tangents than n: the space is singular exactly in the configurations with IIM.
"""

from __future__ import annotations

from collections.abc import Sequence

from singsym.classes.result import ClassResult, Piece, SpacePiece
from singsym.classes.types import SingularityType
from singsym.elimination.attempts import attempt
from singsym.elimination.conditions import Conditions
from singsym.elimination.ideal import Ideal
from singsym.elimination.verdict import unnoted, weakest
from singsym.mechanism.model import Mechanism

SECONDS = 5.0
"""So long the dimensions of lemma 2 are waited for."""


def configuration_space(
    mechanism: Mechanism | None,
    conditions: Conditions,
    pieces: Sequence[Piece],
    classes: Sequence[ClassResult],
) -> tuple[SpacePiece, ...]:
    """The pieces of the configuration space that no locus was put on, with their generic defects."""
    smooth = _is_smooth(mechanism, conditions, classes)
    kept = ", ".join(mechanism.translating) if mechanism else ""
    found = []
    for piece in (p for p in pieces if not p.path):
        defects = piece.defects
        remarks = []
        if defects.delta:
            remarks.append(f"rank L is {defects.delta} below N in every configuration")
        elif defects.types:
            remarks.append(f"every configuration is singular: {defects.types}")
        elif smooth == "no":
            remarks.append("singular exactly where there is IIM")
        if kept:
            remarks.append(f"only where these links keep their orientation: {kept}")
        remark = "; ".join(remarks)
        found.append(SpacePiece(piece.dimension, smooth, defects, piece.verdict, piece.basis, remark))
    return tuple(found)


def _is_smooth(mechanism: Mechanism | None, conditions: Conditions, classes: Sequence[ClassResult]) -> str:
    increased = [c for c in classes if SingularityType.IIM in c.types]
    if mechanism is None or not mechanism.translating:
        # of a mode alone the loop equations are not all, so that the lemmas say nothing of it
        if all(c.verdict.is_no for c in increased):
            return "yes"
        if any(c.verdict.is_yes for c in increased) and mechanism and _is_complete_intersection(conditions):
            return "no"
    return "undecided"


def _is_complete_intersection(conditions: Conditions) -> bool:
    """Whether lemma 2 is proven to hold; False also where that takes long."""
    equation = conditions.equation
    space = equation.space
    if len(equation.matrix.rows) != equation.N:
        return False
    usual = equation.n + len(space.parameters)
    with attempt("the dimensions of the loop equations", SECONDS), unnoted() as seen:
        if Ideal(space.ring, space.equations).dimension > usual:
            return False
        for label in ("5", "4"):
            alternatives = conditions[label].polynomials
            if conditions[label].alternatives is None or conditions[label].everywhere:
                continue
            parts = (Ideal(space.ring, (*space.equations, *locus)) for locus in alternatives)
            if all(part.dimension < usual for part in parts) and weakest(*seen) == "proven":
                return True
    return False
