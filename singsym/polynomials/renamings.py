"""Renamings of variables that carry polynomials over to others: the same question, asked of another leg.

Source: colour refinement with individualisation, as in McKay, Piperno, J. Symbolic Computation 60 (2014);
what it finds is checked term by term.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

from singsym.polynomials.polynomial import Polynomial
from singsym.polynomials.ring import Ring

MOST_TERMS = 4000
"""Longer families are not looked at."""
MOST_TRIES = 60
"""So many places for variables that look alike are tried."""


@dataclass(frozen=True)
class Group:
    """Some polynomials, and what they are for: those of another label are never theirs.

    signed: whether their signs and factors matter, as in inequalities.
    """

    label: str
    members: tuple[Polynomial, ...]
    signed: bool = False

    @cached_property
    def normal(self) -> frozenset[Polynomial]:
        """The polynomials, up to factors where these do not matter."""
        return frozenset(p if self.signed else p.primitive() for p in self.members if p)

    def rename(self, names: Mapping[str, str]) -> Group:
        """The group with other variables."""
        return Group(self.label, tuple(p.rename(names) for p in self.normal), self.signed)


@dataclass
class Likeness:
    """Families of groups of polynomials in one ring, compared with each other.

    Constants of the ring keep their names.
    """

    ring: Ring
    _numbers: dict[Hashable, int] = field(default_factory=dict)
    _tries: int = 0

    def mark(self, family: Sequence[Group]) -> Hashable | None:
        """What families that a renaming carries over to each other have in common; None of long ones.

        >>> x, y, z = Ring(("x", "y", "z")).gens
        >>> one, two, three = ((Group("", (p,)),) for p in (x**2 + y, z**2 - x, x**2 + 2 * y))
        >>> likeness = Likeness(x.ring)
        >>> [likeness.mark(one) == likeness.mark(other) for other in (two, three)]
        [True, False]
        """
        if sum(len(p) for group in family for p in group.members) > MOST_TERMS:
            return None
        return self._refined(_tables(family), self._start)[1]

    def renaming(self, one: Sequence[Group], other: Sequence[Group]) -> dict[str, str] | None:
        """Names that carry one family over to the other; None where none is found.

        >>> x, y, z = Ring(("x", "y", "z")).gens
        >>> circles = [(Group("zero", (p**2 + y - 1,)), Group("off", (p,))) for p in (x, z)]
        >>> Likeness(x.ring).renaming(*circles)
        {'x': 'z', 'y': 'y', 'z': 'x'}
        """
        self._tries = 0
        there = Counter((g.label, g.normal) for g in other)
        for names in self._candidates(_tables(one), _tables(other), self._start, self._start):
            if Counter((g.label, g.rename(names).normal) for g in one) == there:
                return names
        return None

    @property
    def _start(self) -> list[int]:
        constants = {c.name for c in self.ring.constants}
        return [self._number(("constant", n) if n in constants else ()) for n in self.ring.names]

    def _number(self, key: Hashable) -> int:
        return self._numbers.setdefault(key, len(self._numbers))

    def _refined(self, tables: Sequence[_Table], colours: list[int]) -> tuple[list[int], Hashable]:
        """Colours of the variables by what they stand beside, and how often each occurs."""
        while True:
            seen: list[list[Hashable]] = [[] for _ in colours]
            groups = []
            for label, polynomials in tables:
                own = [
                    self._number(
                        tuple(sorted((c, tuple(sorted((colours[i], e) for i, e in m))) for c, m in terms))
                    )
                    for terms in polynomials
                ]
                group = self._number((label, tuple(sorted(own))))
                groups.append(group)
                for colour, terms in zip(own, polynomials, strict=True):
                    for c, m in terms:
                        term = c, tuple(sorted((colours[i], e) for i, e in m))
                        for i, e in m:
                            seen[i].append(self._number((group, colour, term, e)))
            finer = [
                self._number(("finer", colour, tuple(sorted(Counter(own).items()))))
                for colour, own in zip(colours, seen, strict=True)
            ]
            if len(set(finer)) == len(set(colours)):
                return finer, (tuple(sorted(groups)), tuple(sorted(finer)))
            colours = finer

    def _candidates(
        self, one: Sequence[_Table], other: Sequence[_Table], here: list[int], there: list[int]
    ) -> Iterator[dict[str, str]]:
        """Renamings that respect the colours, with variables that are alike told apart in turn."""
        self._tries += 1
        (here, mark), (there, marked) = self._refined(one, here), self._refined(other, there)
        if mark != marked or self._tries > MOST_TRIES:
            return
        used = {i for _, polynomials in one for terms in polynomials for _, m in terms for i, _ in m}
        sizes = Counter(here[i] for i in used)
        alike = [i for i in sorted(used) if sizes[here[i]] > 1]
        if not alike:
            yield self._by_colours(here, there)
            return
        first = min(alike, key=lambda i: (sizes[here[i]], i))
        chosen = self._number(("chosen", here[first]))
        for k in [k for k, colour in enumerate(there) if colour == here[first]]:
            yield from self._candidates(one, other, _with(here, first, chosen), _with(there, k, chosen))

    def _by_colours(self, here: list[int], there: list[int]) -> dict[str, str]:
        names, free = {}, dict[int, list[str]]()
        for name, colour in zip(self.ring.names, there, strict=True):
            free.setdefault(colour, []).append(name)
        for name, colour in zip(self.ring.names, here, strict=True):
            own = free[colour]
            names[name] = own.pop(own.index(name) if name in own else 0)
        return names


_Table = tuple[str, list[list[tuple[tuple[int, int], list[tuple[int, int]]]]]]
"""The label of a group, and the terms of its polynomials: coefficients, and places with exponents."""


def _tables(family: Sequence[Group]) -> list[_Table]:
    tables = []
    for group in family:
        polynomials = [
            [
                (
                    (int(c.p) if group.signed else abs(int(c.p)), int(c.q)),
                    [(i, int(e)) for i, e in enumerate(m) if e],
                )
                for m, c in p.terms()
            ]
            for p in group.normal
        ]
        tables.append((group.label, polynomials))
    return tables


def _with(colours: list[int], place: int, colour: int) -> list[int]:
    return [colour if i == place else known for i, known in enumerate(colours)]
