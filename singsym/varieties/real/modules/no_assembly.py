"""Whether modules show that there is no real point: some of them, with all that they need, have no assembly.

Source: the block triangular form, see `module_points`; what some of the equations exclude, all of them do.
"""

from __future__ import annotations

from singsym.effort import patience
from singsym.effort.attempts import attempt
from singsym.effort.verdict import Known, Premises, Verdict
from singsym.polynomials import Equations
from singsym.polynomials.block_form import independent_parts
from singsym.varieties.disjoint_parts import disjoint_parts
from singsym.varieties.real.modules.module_points import (
    comes_apart,
    curves_over_circle,
    in_order,
    module_points,
    without_given,
)
from singsym.varieties.splitting import used_ring

_OPEN = Verdict.undecided("modules do not show that there is no real point")


def has_no_assembly(equations: Equations) -> Verdict:
    """Whether some modules that determine their unknowns have no real solution: yes, or undecided.

    So it is of a curve, a circle with dyads over it, where no loop is left; and of equations without a
    variable in common, where it is so of some of them.

    >>> from singsym.polynomials import Ring
    >>> x, y, z = Ring(("x", "y", "z")).gens
    >>> has_no_assembly((x**2 - 4, (y - x) ** 2 - x - 1, y * z - 1, x + 1)).is_yes
    True
    """
    if not equations:
        return Verdict.undecided("there are no equations")
    own = used_ring(equations[0].ring, equations)
    premises, reasons = Premises(), dict[str, None]()
    for piece in disjoint_parts(tuple(map(own.convert, equations))):
        parts = map(_has_no_assembly, independent_parts(without_given(piece)[0]))
        found = next((answer for answer in parts if answer.is_yes), None)
        if found is None:
            return _OPEN
        premises.rest_on(found.certainty)
        reasons[found.reason] = None
    return Verdict.yes(premises.certainty, reason="; ".join(reasons))


def _has_no_assembly(equations: Equations) -> Verdict:
    own = used_ring(equations[0].ring, equations)
    equations = tuple(dict.fromkeys((*own.relations, *map(own.convert, equations))))
    if comes_apart(equations):
        with attempt("modules without an assembly", patience.ASSEMBLIES.work):
            return _told(module_points(equations).map(bool), "modules of the equations")
    with attempt("modules over a circle without an assembly", patience.ASSEMBLIES.work):
        curves = curves_over_circle(equations)
        if curves is not None:
            return _told(curves.map(lambda found: any(c.points for c in found)), "modules over a circle")
    with attempt("some modules without an assembly", patience.ASSEMBLIES.work):
        for part in _closed_parts(equations):
            with attempt("modules and all that they need", share=1 / 2):
                found = _told(module_points(part).map(bool), "some of the modules")
                if found.is_yes:
                    return found
    return _OPEN


def _told(has_points: Known[bool], what: str) -> Verdict:
    known = Verdict.yes(has_points.certainty, reason=f"{what} have no common assembly")
    return _OPEN if has_points.value else known


def _closed_parts(equations: Equations) -> list[Equations]:
    """The equations of each module with all that it needs, the small ones first; not all of them at once."""
    form = in_order(equations[0].ring, equations)
    loose, found = set(form.free), list[Equations]()
    for module in form.modules:
        if loose & set(module.parents):
            loose |= set(module.unknowns)
            continue
        names = {name for m in (*form.ancestors(module), module) for name in m.unknowns}
        part = tuple(p for p in equations if names.issuperset(p.variables))
        if len(part) < len(equations):
            found.append(tuple(map(used_ring(part[0].ring, part).convert, part)))
    return sorted(found, key=lambda part: len(part[0].ring.names))
