"""Whether a real dimension is at most a number: variables are eliminated in turn, in all cases that come up.

Lemma.  Let p = a x^k + ..., k > 0, vanish on a set.  Off the zeros of a, over each point of the other
coordinates there are at most k points, and what follows without x from p and further equations holds for
these coordinates: the dimension is not above that of their zeros.  On the zeros of a, both a and the rest of
p vanish.  Where one coordinate too many is left, further polynomials that vanish may have no common zero over
almost all values of those left (see `triangular_fibres`).
Source: Kalkbrener, J. Symb. Comput. 15 (1993) 143-167 (triangular representations); that real sums of squares
are taken apart is singsym's own.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace

from singsym.effort.budget import current
from singsym.polynomials import Polynomial, Ring
from singsym.polynomials.remainders import pseudo_remainder
from singsym.polynomials.sums_of_squares import sum_of_squares
from singsym.varieties.real.dimension.triangular_fibres import Triangular, miss_almost_all

_LONGEST = 300
"""Longer polynomials are not factored, nor taken as equations for a variable."""
_MOST_CASES, _DEEPEST, _WAYS = 20_000, 150, 3
"""So many cases are looked at, one inside the other, and so many variables to eliminate next in each."""


def is_dimension_at_most(
    ring: Ring, equations: Sequence[Polynomial], nonzero: Sequence[Polynomial], dimension: int
) -> bool:
    """Whether the real zeros of the equations off those of `nonzero` are proven to have no larger dimension.

    False proves nothing.  Raises `BudgetExceeded`.

    >>> R = Ring(("x", "y", "z"))
    >>> x, y, z = R.gens
    >>> [is_dimension_at_most(R, [x * y, x * z], [], d) for d in (1, 2)]
    [False, True]
    >>> is_dimension_at_most(R, [x**2 + y**2 * z**2], [], 1)
    True
    """
    return _Tower(ring, dimension).holds(_case(ring, equations, nonzero, ()))


def is_image_at_most(
    ring: Ring,
    equations: Sequence[Polynomial],
    nonzero: Sequence[Polynomial],
    dimension: int,
    tower: Triangular,
    others: tuple[Polynomial, ...],
) -> bool:
    """The same of the image of a set in the coordinates that are not given by a triangular set over it.

    tower: this set, off the zeros of its leading coefficients; others: polynomials that vanish on all of it.
    Variables are only eliminated from the equations, which may be of a larger dimension.

    >>> x, y, z = Ring(("x", "y", "z")).gens
    >>> is_image_at_most(x.ring, [x**2 + y**2 - 1], [], 0, ((x * z - 1, "z"),), (z - y,))
    True
    """
    return _Tower(ring, dimension, others).holds(_case(ring, equations, nonzero, tower))


def _case(
    ring: Ring, equations: Iterable[Polynomial], nonzero: Iterable[Polynomial], tower: Triangular
) -> _Case:
    names = frozenset(ring.names).difference(name for _, name in tower)
    return _Case(tuple(equations), frozenset(p.primitive() for p in nonzero if p), names, tower=tower)


@dataclass(frozen=True)
class _Case:
    """Zeros of equations off those of `nonzero`, projected to the coordinates in `names`.

    variable: the one that is being eliminated; tower: what gives those that were, the last one at the end.
    """

    equations: tuple[Polynomial, ...]
    nonzero: frozenset[Polynomial]
    names: frozenset[str]
    variable: str = ""
    tower: Triangular = ()


@dataclass
class _Tower:
    """Bounds of cases.

    others: further polynomials that vanish, in which nothing is eliminated; with them each case is tried in
    one way, since what it comes to depends on what was eliminated before.
    """

    ring: Ring
    dimension: int
    others: tuple[Polynomial, ...] = ()
    known: dict[object, bool] = field(default_factory=dict)

    def holds(self, case: _Case, depth: int = 0) -> bool:
        """Whether the bound is proven for a case, by one of a few variables to begin with."""
        current().check("a bound of a dimension")
        split = self._split(case)
        if split != [case]:
            return all(self.holds(part, depth) for part in split)
        if len(case.names) - _independent(case.equations) <= self.dimension:
            return True
        if self.others and len(case.names) == self.dimension + 1:
            return miss_almost_all(case.tower, case.names, self.others)
        key = (frozenset(case.equations), case.nonzero, case.names, case.variable, self.others and case.tower)
        if key in self.known:
            return self.known[key]
        # until more is known: a case inside itself proves nothing
        self.known[key] = False
        if depth < _DEEPEST and len(self.known) < _MOST_CASES:
            self.known[key] = any(
                all(self.holds(part, depth + 1) for part in step) for step in self._steps(case)
            )
        return self.known[key]

    def _split(self, case: _Case) -> list[_Case]:
        """The cases of a product or a sum of squares that is zero; the case itself where there is none."""
        kept: list[Polynomial] = []
        for i, p in enumerate(case.equations):
            if p.is_zero or p in kept:
                continue
            factors = [p]
            if len(p) <= _LONGEST:
                factors = [f for f, _ in p.factors() if f not in case.nonzero]
            if p.is_constant or not factors:
                return []
            rest = case.equations[i + 1 :]
            if len(factors) > 1:
                return [
                    replace(case, equations=(*kept, f, *rest), nonzero=case.nonzero | set(factors[:k]))
                    for k, f in enumerate(factors)
                ]
            squares = sum_of_squares(factors[0]) if len(factors[0]) <= _LONGEST else None
            roots = squares[1] if squares is not None else ()
            if len(roots) > 1:
                return [replace(case, equations=(*kept, *roots, *rest))]
            kept.append(factors[0])
        return [replace(case, equations=tuple(kept))]

    def _steps(self, case: _Case) -> Iterator[tuple[_Case, ...]]:
        """The cases after one variable is eliminated, or its degree lowered; a few ways."""
        best: dict[str, tuple[tuple[int, ...], Polynomial]] = {}
        for cost, p, name in self._choices(case):
            if name not in best or cost < best[name][0]:
                best[name] = cost, p
        ordered = sorted(best.items(), key=lambda item: item[1][0])
        for name, (_, p) in ordered[: 1 if self.others else _WAYS]:
            yield self._eliminated(case, p, name)

    def _eliminated(self, case: _Case, p: Polynomial, name: str) -> tuple[_Case, ...]:
        k = p.degree(name)
        lead = p.coefficient(name, k)
        tail = p - lead * self.ring.gen(name) ** k
        others = [q for q in case.equations if q is not p]
        holding = [q for q in others if q.degree(name) > 0]
        rest = [q for q in others if q.degree(name) <= 0]
        reduced = [r for q in holding if len(r := pseudo_remainder(q, p, name)) <= _LONGEST]
        known = lead.is_constant or lead.primitive() in case.nonzero
        nonzero = case.nonzero if known else case.nonzero | {f for f, _ in lead.factors()}
        if k > 1 and any(r.degree(name) > 0 for r in reduced):
            off = _Case((p, *rest, *reduced), nonzero, case.names, name, case.tower)
        else:
            tower = (*case.tower, (p, name))
            off = _Case((*rest, *reduced), nonzero, case.names - {name}, tower=tower)
        return (off,) if known else (off, replace(case, equations=(lead, tail, *others), variable=""))

    def _choices(self, case: _Case) -> Iterator[tuple[tuple[int, ...], Polynomial, str]]:
        """Equations and variables with the cost of eliminating by them."""
        usable = [p for p in case.equations if len(p) <= _LONGEST]
        chosen = any(p.degree(case.variable) > 0 for p in usable) if case.variable else False
        for p in usable:
            for name in (case.variable,) if chosen else p.variables:
                k = p.degree(name)
                holding = [q for q in case.equations if q is not p and q.degree(name) > 0]
                if k <= 0 or any(q.degree(name) < k for q in holding):
                    continue
                lead = p.coefficient(name, k)
                free = lead.is_constant or lead.primitive() in case.nonzero
                growth = sum(map(len, holding)) * len(p)
                cost = (not free, k > 1 and bool(holding), 0 if free else len(lead), growth * k, k)
                first = (len(holding),) if self.others else ()
                yield (*first, *map(int, cost)), p, name


def _independent(equations: Iterable[Polynomial]) -> int:
    """How many equations have no variable in common: so much at least the dimension is less than of all."""
    used: set[str] = set()
    count = 0
    for p in sorted(equations, key=lambda p: (len(p.variables), len(p))):
        if used.isdisjoint(p.variables):
            used.update(p.variables)
            count += 1
    return count
