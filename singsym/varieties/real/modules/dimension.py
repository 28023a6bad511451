"""A bound of a real dimension: that of a core in few variables, where the dyads over it turn nowhere freely.

Source: fibres, as in Bochnak, Coste, Roy, Real Algebraic Geometry (1998), 2.8: a set is not larger than its
image where all fibres are finite.
"""

from __future__ import annotations

from singsym.effort import patience
from singsym.effort.attempts import attempt
from singsym.effort.verdict import Known, Premises
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Equations
from singsym.polynomials.block_form import Module, with_last_modules
from singsym.varieties.real.modules.assemblies import dyad, is_round


def dimension_bound(equations: Equations) -> Known[int] | None:
    """A bound of the dimension of the real zeros; `None` where it is not found.

    Lemma: over a point of the core a dyad on a circle has two real solutions at most where not all
    coefficients of its line vanish, nor the coefficient that the line was combined with.

    >>> from singsym.polynomials import Ring
    >>> c, s, x, y = Ring(("c", "s", "x", "y")).gens
    >>> four_bar = (c**2 + s**2 - 1, (x - c) ** 2 + (y - s) ** 2 - 9, (x - 3) ** 2 + y**2 - 4)
    >>> dimension_bound(four_bar)
    Known(value=1, certainty='proven')
    """
    core, dyads = with_last_modules(equations, 2)
    if not dyads or not core:
        return None
    ring, premises, earlier = core[0].ring, Premises(), core
    for module in dyads:
        if not _is_finite(module, earlier, premises):
            return None
        earlier = (*earlier, *module.equations)
    solved = {name for module in dyads for name in module.unknowns}
    below = ring.with_names(tuple(n for n in ring.names if n not in solved))
    with attempt("the dimension of a core", patience.FIRST_MODULE.work):
        return premises.pass_on(Ideal(below, tuple(map(below.convert, core))).dimension)
    return None


def _is_finite(module: Module, earlier: Equations, premises: Premises) -> bool:
    """Whether a dyad is seen to turn freely over no solution of the equations before it."""
    found = dyad(module)
    if found is None or not is_round(module) or (found.pivot is not None and not found.pivot.is_constant):
        return False
    line = tuple(found.line.values())
    for known in ((), earlier):
        with attempt("whether a dyad turns freely", patience.FIRST_MODULE.work / 2):
            empty = Ideal(line[0].ring, (*line, *known)).is_unit()
            if empty.value:
                premises.rest_on(empty.certainty)
                return True
    return False
