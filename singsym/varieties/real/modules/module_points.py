"""All real points of a square system, module by module.

Source: the block triangular form; first modules by exact algebra in their own rings, the others in balls, and
a Krawczyk test of the whole system for each point at the end.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from math import prod

from flint import arb

from singsym.effort import patience
from singsym.effort.attempts import attempt
from singsym.effort.budget import Undecided, current
from singsym.effort.verdict import Known, Premises
from singsym.elimination.engines.base import NotZeroDimensional
from singsym.elimination.linear_substitution import Substitution, solved_variable
from singsym.elimination.memo import remember
from singsym.polynomials import Equations, Polynomial, Ring
from singsym.polynomials.block_form import Module, SolvingOrder, block_form
from singsym.varieties.real.modules.assemblies import assemblies, dyad, is_simple, value_at
from singsym.varieties.real.modules.coverings import Covering, coverings
from singsym.varieties.real.modules.lifted_curve import is_tower, points_on_tower
from singsym.varieties.real.modules.towers import towers
from singsym.varieties.real.modules.triads import triad
from singsym.varieties.real.points.boxed_point import BoxPoint, box_around
from singsym.varieties.real.points.exact_point import RealPoint
from singsym.varieties.real.points.finite_sets import real_points
from singsym.varieties.real.points.intervals import at_precision

PRECISIONS = (256, 1024)
"""Bits of the balls of a first module, tried in turn where something is not seen."""

FEW_SOLUTIONS = 100
"""Where the bound of Bezout is larger simple modules are solved in balls first."""

MOST_SOLUTIONS = 1000
"""A module by itself with a larger bound of Bezout is not solved by algebra; it may be a tower."""


def module_points(equations: Equations) -> Known[tuple[BoxPoint, ...]]:
    """All real points of equations that come apart into modules, each certified.

    The certainty is that of there being no others.

    Lemma: the real points of all equations are those of the first modules with, over each, the assemblies of
    the next module, and so on; equations that are left over hold at them or not.
    Where two assemblies of a dyad are one, and for equations left over, exact algebra is asked in the ring
    of what is concerned.  Raises `Undecided` where a module is neither first nor simple, or where all this
    leaves a number open, as at other points with a multiplicity.

    >>> from singsym.polynomials import Ring
    >>> x, y, z = Ring(("x", "y", "z")).gens
    >>> [p.decimals(4)["z"] for p in module_points((x**2 - 3, y * x - 1, y**2 + z**2 - 1)).value]
    ['-0.8165', '0.8165', '-0.8165', '0.8165']
    """
    key = (equations[0].ring, equations)
    return remember("points by modules", key, lambda: _points(equations))


def curves_over_circle(equations: Equations) -> Known[tuple[Covering, ...]] | None:
    """All curves of equations that are a circle with dyads over it; None where they are not.

    Raises `Undecided` as `coverings` does.
    """
    found = next(towers(equations), None)
    if found is None:
        return None
    key = (equations[0].ring, equations)
    return remember("curves over a circle", key, lambda: coverings(found, points_of, current()))


def points_of(equations: Equations) -> Known[tuple[RealPoint, ...]] | Known[tuple[BoxPoint, ...]]:
    """All real points of finitely many: by algebra where they are few, so that they may be multiple."""
    many = _bezout(equations)
    if many > FEW_SOLUTIONS and all(map(_is_simple, in_order(equations[0].ring, equations).modules)):
        with attempt("a finite set by modules", share=1 / 2):
            return module_points(equations)
    if many <= MOST_SOLUTIONS:
        with attempt("a finite set by algebra", patience.FIRST_MODULE.work):
            return _exactly(equations)
    return module_points(equations)


def comes_apart(equations: Equations) -> bool:
    """Whether no module needs all variables at once.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> comes_apart((x**2 - 2, y - x)), comes_apart((x**2 - y, y**2 + x))
    (True, False)
    """
    whole = len(equations[0].ring.names)
    return all(len(m.unknowns) < whole for m in in_order(equations[0].ring, equations).modules)


def _points(equations: Equations) -> Known[tuple[BoxPoint, ...]]:
    """Those of the equations in the variables that no equation of first degree gives, with all values."""
    left, given = without_given(equations)
    if any(p.is_constant for p in left):
        return Known(())
    if not given or not left:
        return _of_modules(equations)
    ring = equations[0].ring
    found = _of_modules(left)

    def whole(point: BoxPoint) -> BoxPoint:
        zeros = tuple(map(ring.convert, point.zeros))
        return replace(with_values(point, given, ring), zeros=(*zeros, *equations))

    return found.map(lambda points: tuple(map(whole, points)))


def without_given(equations: Equations) -> tuple[Equations, list[Substitution]]:
    """Equations in the variables that no equation of first degree gives, and what these give.

    Each gives the variable that is in the fewest others.
    """
    left, given = equations, list[Substitution]()
    while (step := next(filter(None, (_given_by(p, left) for p in left)), None)) is not None:
        left = tuple(p for p in step.apply(left) if p)
        given.append(step)
    ring, names = equations[0].ring, {step.name for step in given}
    own = ring.with_names(tuple(n for n in ring.names if n not in names))
    return tuple(map(own.convert, left)), given


def _given_by(equation: Polynomial, equations: Equations) -> Substitution | None:
    constants = {c.name for c in equation.ring.constants}
    if equation.total_degree != 1 or constants.intersection(equation.variables):
        return None
    rarest = min(equation.variables, key=lambda name: sum(p.degree(name) > 0 for p in equations))
    return solved_variable(equation, (rarest,))


def with_values(point: BoxPoint, given: Sequence[Substitution], ring: Ring) -> BoxPoint:
    """The point in a larger ring, with the values of the variables that were given, the last one first."""
    with at_precision(PRECISIONS[0]):
        known = _balls(point, PRECISIONS[0])
        for step in reversed(given):
            known[step.name] = value_at(step.value, known)
    equations = (*map(ring.convert, point.equations), *(step.equation for step in given))
    return box_around(equations, known)


def in_order(ring: Ring, equations: Equations) -> SolvingOrder:
    """The modules of equations; fixed numbers are determined by their own minimal polynomials."""
    return block_form(tuple(dict.fromkeys((*ring.relations, *equations))))


def _of_modules(equations: Equations) -> Known[tuple[BoxPoint, ...]]:
    ring = equations[0].ring
    form = in_order(ring, equations)
    if any(triad(m) is not None for m in form.modules):
        with attempt("points by modules, triads in balls", share=1 / 2):
            return _in_balls(_Solving(ring, form, triads=True))
    return _in_balls(_Solving(ring, form))


def _in_balls(solving: _Solving) -> Known[tuple[BoxPoint, ...]]:
    failure = Undecided("no precision was tried")
    for bits in PRECISIONS:
        try:
            with at_precision(bits):
                return solving.premises.conclude(tuple(solving.points(bits)))
        except _Unsolved:
            raise
        except Undecided as reason:
            current().check("points by modules")
            failure = reason
    raise failure


class _Unsolved(Undecided):
    """A step that needs no values is not solved: balls of more bits do not help."""


@dataclass(frozen=True)
class _Step:
    """Modules that are solved together: one of them, or a hard one with all that it needs.

    alone: whether no values of other modules are needed, fixed numbers aside.
    """

    modules: tuple[Module, ...]
    alone: bool

    @property
    def unknowns(self) -> set[str]:
        return {name for m in self.modules for name in m.unknowns}


@dataclass
class _Solving:
    """A square system under way.

    triads: whether these are solved in balls as well; else as any hard module.
    solved: the points of steps that need nothing; premises: what all this rests on.
    """

    ring: Ring
    form: SolvingOrder
    triads: bool = False
    solved: dict[_Step, tuple[BoxPoint, ...]] = field(default_factory=dict)
    premises: Premises = field(default_factory=Premises)

    @cached_property
    def steps(self) -> tuple[_Step, ...]:
        """The modules in order, without those that depend on unknowns that nothing determines."""
        constants = {c.name for c in self.ring.constants}
        loose, steps = set(self.form.free), list[_Step]()
        for module in self.form.modules:
            if loose & set(module.parents):
                loose |= set(module.unknowns)
                continue
            alone = constants.issuperset(module.parents) and dyad(module) is None
            if alone or (_is_simple(module) if self.triads else is_simple(module)):
                steps.append(_Step((module,), alone))
                continue
            group = _Step((*self.form.ancestors(module), module), True)
            inside = [k for k, step in enumerate(steps) if step.unknowns & group.unknowns]
            if any(not steps[k].unknowns <= group.unknowns for k in inside):
                raise Undecided("two modules that are not simple have ancestors in common")
            # what stands between its parts may need them, and none of these needs what stands there
            steps[inside[0] : inside[0]] = [group]
            steps = [step for step in steps if step is group or not step.unknowns & group.unknowns]
        return tuple(steps)

    def points(self, bits: int) -> Iterator[BoxPoint]:
        """All points; raises `Undecided` where the balls of so many bits do not tell them."""
        for found in self._extended(self.steps, _Partial(), self.form.left_over, bits):
            if len(found.values) < len(self.ring.names):
                raise Undecided("there are fewer equations than unknowns")
            yield found.certified

    def _extended(
        self, steps: Sequence[_Step], known: _Partial, left_over: Sequence[Polynomial], bits: int
    ) -> Iterator[_Partial]:
        """What is known with the values of further unknowns, where no equation left over fails."""
        current().check("points by modules")
        ready = [p for p in left_over if known.values.keys() >= set(p.variables)]
        if not all(_may_vanish(p, known.values) for p in ready):
            return
        for p in ready:
            if not self._is_zero(p, known):
                raise Undecided("whether an equation left over holds at a point is not seen")
        known = replace(known, zeros=(*known.zeros, *ready))
        if not steps:
            yield known
            return
        waiting = [p for p in left_over if p not in ready]
        for further in self._further(steps[0], known, bits):
            yield from self._extended(steps[1:], further, waiting, bits)

    def _further(self, step: _Step, known: _Partial, bits: int) -> Iterator[_Partial]:
        if step.alone:
            if step not in self.solved:
                try:
                    self.solved[step] = self.premises.take(_alone(step, self.ring))
                except Undecided as reason:
                    current().check("points by modules")
                    raise _Unsolved(*reason.args) from None
            for point in self.solved[step]:
                equations, zeros = (tuple(map(self.ring.convert, g)) for g in (point.equations, point.zeros))
                yield replace(known, zeros=(*known.zeros, *zeros)).plus(_balls(point, bits), equations)
            return
        module = step.modules[-1]
        found = dyad(module)
        if found is not None and _may_vanish(found.discriminant, known.values):
            if not self._is_zero(found.discriminant, known):
                raise Undecided("whether two assemblies are one is not seen")
            touching = replace(known, zeros=(*known.zeros, *module.equations))
            yield touching.plus(found.touching(known.values), (found.line_equation, found.tangency))
            return
        three = triad(module)
        solutions = assemblies(module, known.values) if three is None else three.solutions(known.values)
        for values in solutions:
            yield known.plus(values, module.equations)

    def _is_zero(self, p: Polynomial, known: _Partial) -> bool:
        """Whether a polynomial vanishes at what is known: by exact algebra in the ring of what it needs."""
        if p.is_zero:
            return True
        form = in_order(self.ring, known.equations)
        equations = tuple(q for m in form.determining(p.variables) for q in m.equations)
        own = self.ring.with_names(
            tuple(n for n in self.ring.names if any(n in e.variables for e in equations))
        )
        system = tuple(map(own.convert, equations))
        here = box_around(system, known.values)
        with attempt("a zero at a point", patience.FIRST_MODULE.work):
            zeros = self.premises.take(_exactly((*system, own.convert(p))))
            return any(_is_in(point, here) for point in zeros)
        raise Undecided("whether a polynomial is zero at a point is not found in time")


def _is_in(point: RealPoint, box: BoxPoint) -> bool:
    return all(b.contains(a) for a, b in zip(point.refine(96).box, box.box, strict=True))


@dataclass(frozen=True)
class _Partial:
    """The values of some unknowns at a point, in balls.

    equations: as many, of which it is a solution without multiplicity; zeros: more that vanish there.
    """

    values: Mapping[str, arb] = field(default_factory=dict)
    equations: Equations = ()
    zeros: Equations = ()

    def plus(self, values: Mapping[str, arb], equations: Equations) -> _Partial:
        """With further values, and the equations that they solve."""
        together = tuple(dict.fromkeys((*self.equations, *equations)))
        return replace(self, values={**self.values, **values}, equations=together)

    @property
    def certified(self) -> BoxPoint:
        """The whole point in a box of its own."""
        return replace(box_around(self.equations, self.values), zeros=self.zeros)


def _is_simple(module: Module) -> bool:
    """Whether a module is solved in balls, if no two of its solutions are one."""
    return is_simple(module) or triad(module) is not None


def _may_vanish(p: Polynomial, known: Mapping[str, arb]) -> bool:
    return bool(value_at(p, known).contains(0))


def _alone(step: _Step, ring: Ring) -> Known[tuple[BoxPoint, ...]]:
    """All real points of a step that needs nothing, with its fixed numbers, in boxes quick to refine."""
    names = {name for m in step.modules for name in (*m.unknowns, *m.parents)}
    own = ring.subring(names)
    given = (own.convert(p) for m in step.modules for p in m.equations)
    equations = tuple(dict.fromkeys((*given, *own.relations)))
    many = _bezout(equations) > MOST_SOLUTIONS
    if (many or len(step.modules) > 1) and is_tower(equations):
        return points_on_tower(equations, module_points, current())
    if many:
        raise Undecided("a module by itself may have too many complex points")
    found = remember("the points of a module", (own, equations), partial(_by_algebra, equations))
    return points_on_tower(equations, module_points, current()) if found is None else found


def _by_algebra(equations: Equations) -> Known[tuple[BoxPoint, ...]] | None:
    """The real points of a module by itself in boxes; None where they are not found in time."""
    with attempt("the points of a module by algebra", patience.FIRST_MODULE.work):
        points = _exactly(equations)
        return points.map(lambda found: tuple(box_around(equations, _balls(p, 96)) for p in found))
    return None


def _bezout(equations: Equations) -> int:
    relations = equations[0].ring.relations
    return prod(p.total_degree for p in equations if p not in relations)


def _exactly(equations: Equations) -> Known[tuple[RealPoint, ...]]:
    try:
        return real_points(equations)
    except NotZeroDimensional as reason:
        raise Undecided(f"a module by itself: {reason}") from None


def _balls(point: RealPoint | BoxPoint, bits: int) -> dict[str, arb]:
    return dict(zip(point.ring.names, point.refine(bits).box, strict=True))
