"""Parts of a border without a real configuration over them, which therefore are none.

What changes over a border is a set of configurations that is projected there, see `designs.borders`.  Where
it has no real point over the zeros of a factor within the ranges, real fibres are alike on both sides, and
over these zeros.
Source: singsym's own.
"""

from __future__ import annotations

from dataclasses import replace

from singsym.designs.borders import BorderPart, Borders
from singsym.designs.families import Family
from singsym.effort import patience
from singsym.effort.attempts import attempt
from singsym.effort.budget import Undecided
from singsym.effort.verdict import Certainty, weakest
from singsym.polynomials import Equations
from singsym.varieties.real.proofs.emptiness import is_empty_over_reals
from singsym.varieties.real.system import RealSystem


def real_borders(family: Family, found: Borders) -> Borders:
    """The borders without those parts over which no real configuration changes, by a proof."""
    parts, certainties = list[BorderPart](), [found.certainty]
    for part in found.parts:
        try:
            known = _without_real_points(family, part)
        except Undecided:
            known = None
        if known is None:
            parts.append(part)
        else:
            certainties.append(known)
    return replace(found, parts=tuple(parts), certainty=weakest(*certainties))


def _without_real_points(family: Family, part: BorderPart) -> Certainty | None:
    """How it is known that nothing real is over a part of the border; None where that is not known."""
    own = (family.space.ring.convert(part.polynomial),)
    if (outside := _is_empty(family, own)) is not None:
        return outside
    known = list[Certainty]()
    # of the short ones it is soon seen that they are there
    for equations in sorted(part.sets, key=lambda own: sum(map(len, own))):
        certainty = _is_empty(family, (*equations, *own))
        if certainty is None:
            return None
        known.append(certainty)
    return weakest(*known)


def _is_empty(family: Family, equations: Equations) -> Certainty | None:
    """How it is known that equations have no real zeros for parameters inside their ranges, where it is.

    Limits may be reached: a set at a limit is among those that are projected.
    """
    space = family.space
    limits = tuple(p for p in (*space.positive, *space.nonnegative) if family.moves(p))
    with attempt("a border without real points", patience.REAL_BORDER.work):
        verdict = is_empty_over_reals(RealSystem(space.ring, equations, (), family.domain, limits))
        return verdict.certainty if verdict.is_yes else None
    return None
