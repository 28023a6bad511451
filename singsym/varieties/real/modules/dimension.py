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
from singsym.polynomials.remainders import pseudo_remainder
from singsym.varieties.real.dimension.elimination_towers import is_image_at_most
from singsym.varieties.real.dimension.triangular_fibres import Triangular
from singsym.varieties.real.modules.assemblies import dyad, is_round


def dimension_bound(equations: Equations, *, complex_too: bool = False) -> Known[int] | None:
    """A bound of the dimension of the real zeros; `None` where it is not found.

    Lemma: over a point of the core a dyad on a circle has two real solutions at most where not all
    coefficients of its line vanish, and a circle of them at most where they do.  So it is over C where the
    square of the radius is a number other than zero: such a circle contains no line.
    complex_too: whether it has to be a bound of the complex zeros.

    >>> from singsym.polynomials import Ring
    >>> c, s, x, y = Ring(("c", "s", "x", "y")).gens
    >>> four_bar = (c**2 + s**2 - 1, (x - c) ** 2 + (y - s) ** 2 - 9, (x - 3) ** 2 + y**2 - 4)
    >>> dimension_bound(four_bar)
    Known(value=1, certainty='proven')
    >>> dimension_bound((c**2 + s**2 - 9, (x - c) ** 2 + (y - s) ** 2 - 4, (x - 3) ** 2 + y**2 - 4))
    Known(value=1, certainty='proven')
    """
    core, dyads = _apart(*with_last_modules(equations, 2))
    if not dyads or not core or (complex_too and not all(map(_contains_no_line, dyads))):
        return None
    premises = Premises()
    with attempt("the dimension of a core", patience.FIRST_MODULE.work):
        return premises.conclude(_bound(core, dyads, core[0].ring.names, premises))
    return None


def is_dimension_at_most(equations: Equations, nonzero: Sequence[Polynomial], dimension: int) -> Known[bool]:
    """Whether the real zeros off those of `nonzero` are shown to have no larger dimension.

    Of as many short equations as leave one dimension too many, the others cut out less: at almost all points
    of the core, with the dyads over it, they have no common zero.  False proves nothing.

    >>> from singsym.polynomials import Ring
    >>> c, s, x, y = Ring(("c", "s", "x", "y")).gens
    >>> dyad_over_a_plane = ((x - c) ** 2 + (y - s) ** 2 - 4, (x - 3) ** 2 + y**2 - 4)
    >>> is_dimension_at_most((*dyad_over_a_plane, c * x * y**2 + s * x**2 - y), (), 1).value
    True
    """
    if not equations:
        return Known(False)
    ring, premises = equations[0].ring, Premises()
    shortest, most = sorted(equations, key=len), len(ring.names) - dimension - 1
    others = tuple(shortest[max(most, 0) :])
    core, dyads = _apart(*with_last_modules([p for p in equations if p not in others], 2))
    if not core or not others:
        return Known(False)
    with attempt("the dimension of a core", patience.FIRST_MODULE.work):
        left, tower = list(ring.names), list[tuple[Polynomial, str]]()
        for k in reversed(range(len(dyads))):
            left = [n for n in left if n not in dyads[k].unknowns]
            if _bound_where_free(core, dyads[:k], dyads[k], left, premises) > dimension:
                return Known(False)
            tower += _triangular(dyads[k])
        return premises.conclude(is_image_at_most(ring, core, nonzero, dimension, tuple(tower), others))
    return Known(False)


def _triangular(module: Module) -> Triangular:
    """A dyad, one unknown after the other, off the zeros of a coefficient of its line."""
    found = dyad(module)
    assert found is not None
    line = found.line_equation
    x, y = module.unknowns if line.degree(module.unknowns[0]) > 0 else module.unknowns[::-1]
    conic = next(p for p in module.equations if p.degree(x) > 1 or p.degree(y) > 1)
    return (line, x), (pseudo_remainder(conic, line, x), y)


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


def _contains_no_line(module: Module) -> bool:
    """Whether the square of the radius of a dyad's circle is a number other than zero."""
    found = dyad(module)
    assert found is not None
    zero = module.equations[0].ring.zero
    a, b, c, d = (found.conic.get(m, zero) for m in ((2, 0), (1, 0), (0, 1), (0, 0)))
    square = b * b + c * c - 4 * a * d
    return square.is_constant and not square.is_zero


def _bound(core: Equations, dyads: Sequence[Module], names: Collection[str], premises: Premises) -> int:
    """A bound for the zeros of a core and dyads in these coordinates."""
    ring = core[0].ring
    if not dyads:
        below = ring.subring(names)
        return premises.take(Ideal(below, tuple(map(below.convert, core))).dimension)
    *others, last = dyads
    left = [n for n in names if n not in last.unknowns]
    return max(_bound(core, others, left, premises), _bound_where_free(core, others, last, left, premises))


def _bound_where_free(
    core: Equations, others: Sequence[Module], last: Module, left: Collection[str], premises: Premises
) -> int:
    """A bound for the zeros over which the last dyad turns freely; -1 where there are none.

    left: the coordinates without its unknowns.
    """
    ring, line = core[0].ring, _lines(last)
    assert line is not None
    if premises.take(Ideal(ring, line).is_unit()):
        return -1
    needed = {name for p in line for name in p.variables}
    grown, kept = (*core, *line), list[Module]()
    for module in reversed(others):
        if needed.intersection(module.unknowns):
            grown = (*grown, *module.equations)
            needed.update(module.parents)
        else:
            kept.append(module)
    return 1 + _bound(grown, kept[::-1], left, premises)
