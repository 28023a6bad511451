"""A bound of a real dimension: that of a core in few variables, and what the dyads over it add.

Source: fibres, as in Bochnak, Coste, Roy, Real Algebraic Geometry (1998), 2.8: a set is not larger than its
image and the largest fibre together.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

from singsym.effort import patience
from singsym.effort.attempts import attempt
from singsym.effort.verdict import Known, Premises
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Equations, Polynomial
from singsym.polynomials.block_form import Module, with_last_modules
from singsym.varieties.real.modules.assemblies import dyad, is_round


def dimension_bound(equations: Equations) -> Known[int] | None:
    """A bound of the dimension of the real zeros; `None` where it is not found.

    Lemma: over a point of the core a dyad on a circle has two real solutions at most where not all
    coefficients of its line vanish, and a circle of them at most where they do.

    >>> from singsym.polynomials import Ring
    >>> c, s, x, y = Ring(("c", "s", "x", "y")).gens
    >>> four_bar = (c**2 + s**2 - 1, (x - c) ** 2 + (y - s) ** 2 - 9, (x - 3) ** 2 + y**2 - 4)
    >>> dimension_bound(four_bar)
    Known(value=1, certainty='proven')
    >>> dimension_bound((c**2 + s**2 - 9, (x - c) ** 2 + (y - s) ** 2 - 4, (x - 3) ** 2 + y**2 - 4))
    Known(value=1, certainty='proven')
    """
    core, dyads = _apart(*with_last_modules(equations, 2))
    if not dyads or not core:
        return None
    premises = Premises()
    with attempt("the dimension of a core", patience.FIRST_MODULE.work):
        return premises.conclude(_bound(core, dyads, core[0].ring.names, premises))
    return None


def _apart(core: Equations, modules: Sequence[Module]) -> tuple[Equations, tuple[Module, ...]]:
    """With the modules that are no dyads on circles in the core, and what these need."""
    needed, dyads = set[str](), list[Module]()
    for module in reversed(modules):
        if _lines(module) is None or needed.intersection(module.unknowns):
            core = (*core, *module.equations)
            needed.update(module.parents)
        else:
            dyads.append(module)
    return core, tuple(reversed(dyads))


def _lines(module: Module) -> tuple[Polynomial, ...] | None:
    """The coefficients of a dyad's line, where its conic is a circle."""
    found = dyad(module)
    if found is None or not is_round(module) or (found.pivot is not None and not found.pivot.is_constant):
        return None
    return tuple(found.line.values())


def _bound(core: Equations, dyads: Sequence[Module], names: Collection[str], premises: Premises) -> int:
    """A bound for the zeros of a core and dyads in these coordinates."""
    ring = core[0].ring
    if not dyads:
        below = ring.subring(names)
        return premises.take(Ideal(below, tuple(map(below.convert, core))).dimension)
    *others, last = dyads
    left = [n for n in names if n not in last.unknowns]
    finite = _bound(core, others, left, premises)
    line = _lines(last)
    assert line is not None
    if premises.take(Ideal(ring, line).is_unit()):
        return finite
    needed = {name for p in line for name in p.variables}
    grown, kept = (*core, *line), list[Module]()
    for module in reversed(others):
        if needed.intersection(module.unknowns):
            grown = (*grown, *module.equations)
            needed.update(module.parents)
        else:
            kept.append(module)
    return max(finite, 1 + _bound(grown, kept[::-1], left, premises))
