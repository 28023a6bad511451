"""The six singularity types, the four integers that decide them, and the 21 classes of Table 1.

Source: Zlatanov, Fenton, Benhabib (1998), section 2.2, Table 1, and the proposition of section 2.3.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Flag
from functools import cache
from itertools import combinations
from typing import NamedTuple


class SingularityType(Flag):
    """A set of the six types, in the order in which they are shown; empty for a regular configuration.

    >>> str(SingularityType.II | SingularityType.RO)
    'RO, II'
    >>> str(SingularityType(0))
    'regular'
    """

    RI = 1
    RO = 2
    RPM = 4
    II = 8
    IO = 16
    IIM = 32

    def __str__(self) -> str:
        return ", ".join(self.names) or "regular"

    @property
    def names(self) -> tuple[str, ...]:
        """The abbreviations of the types in the set."""
        return tuple(str(t.name) for t in self)

    @property
    def explained(self) -> tuple[str, ...]:
        """A line for each type in the set: its name, and what it says of velocities at the configuration.

        >>> print(*SingularityType.RO.explained)
        RO, redundant output: the output can move with all inputs locked
        """
        return tuple(f"{t.name}, {_MEANING[t]}: {IN_WORDS[t]}" for t in self)

    @classmethod
    def named(cls, text: str) -> SingularityType:
        """The set whose types a text names, in any order; raises `KeyError` for other words.

        >>> SingularityType.named("II, RO")
        <SingularityType.RO|II: 10>
        """
        found = cls(0)
        for word in text.replace(",", " ").split():
            found |= cls[word]
        return found


_T = SingularityType
_MEANING = {
    _T.RI: "redundant input",
    _T.RO: "redundant output",
    _T.RPM: "redundant passive motion",
    _T.II: "impossible input",
    _T.IO: "impossible output",
    _T.IIM: "increased instantaneous mobility",
}
IN_WORDS = {
    _T.RI: "some motion of the inputs leaves the output at rest",
    _T.RO: "the output can move with all inputs locked",
    _T.RPM: "passive joints can move with the inputs and the output at rest",
    _T.II: "some motion of the inputs is impossible",
    _T.IO: "some motion of the output is impossible",
    _T.IIM: "more independent motions than the mobility n",
}
"""What the types say of the velocities m with L m = 0; motions here are velocities, at the configuration."""


class Defects(NamedTuple):
    """The rank defects of a configuration: of L, L_p, L_I and L_O, against N, N - n, N and N.

    >>> Defects.of_ranks(rank_L=8, rank_L_I=7, rank_L_O=8, rank_L_p=6, N=8, n=2)
    Defects(delta=0, p=0, k_I=1, k_O=0)
    """

    delta: int
    p: int
    k_I: int
    k_O: int

    @classmethod
    def of_ranks(cls, rank_L: int, rank_L_I: int, rank_L_O: int, rank_L_p: int, N: int, n: int) -> Defects:
        """From the four ranks, N joints and mobility n."""
        return cls(N - rank_L, N - n - rank_L_p, N - rank_L_I, N - rank_L_O)

    def ranks(self, N: int, n: int) -> dict[str, int]:
        """The ranks of L, L_I, L_O and L_p with N joints and mobility n.

        >>> Defects(delta=0, p=0, k_I=1, k_O=0).ranks(N=8, n=2)
        {'L': 8, 'L_I': 7, 'L_O': 8, 'L_p': 6}
        """
        return {"L": N - self.delta, "L_I": N - self.k_I, "L_O": N - self.k_O, "L_p": N - n - self.p}

    @property
    def types(self) -> SingularityType:
        """The types of a configuration with these defects: conditions (i)-(vi).

        >>> Defects(0, 0, 1, 0).types
        <SingularityType.RO|II: 10>
        """
        conditions = {
            _T.RI: self.k_O > self.p,
            _T.RO: self.k_I > self.p,
            _T.RPM: self.p > 0,
            _T.II: self.k_I > self.delta,
            _T.IO: self.k_O > self.delta,
            _T.IIM: self.delta > 0,
        }
        found = SingularityType(0)
        for kind, holds in conditions.items():
            if holds:
                found |= kind
        return found

    def is_feasible(self, n: int) -> bool:
        """Whether some matrix L of a mechanism of mobility n can have these defects.

        L_p arises from L_I (from L_O) by dropping n columns, and L_I, L_O from L; ranks are submodular:
        rank L + rank L_p <= rank L_I + rank L_O.
        """
        delta, p, k_I, k_O = self
        return (
            min(self) >= 0
            and min(k_I, k_O) >= max(delta, p)
            and max(k_I, k_O) <= n + p
            and k_I + k_O <= n + delta + p
        )


def feasible_defects(n: int) -> Iterator[Defects]:
    """The defects possible for mobility n with min(delta, p) <= 1; one of each class is among them.

    Lemma: lowering all four by 1 keeps feasibility, and keeps the types as long as delta, p > 1.
    |delta - p| <= n follows from the inequalities.
    """
    for delta in range(n + 2):
        for p in range(n + 2):
            if min(delta, p) <= 1:
                for k_I in range(2 * n + 2):
                    for k_O in range(2 * n + 2):
                        if (defects := Defects(delta, p, k_I, k_O)).is_feasible(n):
                            yield defects


@dataclass(frozen=True)
class SingularityClass:
    """A class of configurations: exactly these types. `number` is its place in Table 1, from 1 to 21.

    >>> feasible_classes(2)[1]
    2 (RO, II)
    """

    number: int
    types: SingularityType

    def __repr__(self) -> str:
        return f"{self.number} ({self.types})"

    @property
    def name(self) -> str:
        """The types in the order RI RO RPM II IO IIM: "RO, II"."""
        return str(self.types)

    @property
    def words(self) -> str:
        """The types spelled out."""
        return ", ".join(_MEANING[t] for t in self.types)

    def contains(self, defects: Defects) -> bool:
        """Whether a configuration with these defects is of this class."""
        return defects.types == self.types

    def defects(self, n: int) -> tuple[Defects, ...]:
        """The defects with min(delta, p) <= 1 that give this class; empty where n forbids it.

        >>> SingularityClass(2, SingularityType.RO | SingularityType.II).defects(1)
        (Defects(delta=0, p=0, k_I=1, k_O=0),)
        """
        return tuple(d for d in feasible_defects(n) if self.contains(d))


def _order(types: SingularityType) -> tuple[bool, bool, bool, int, int]:
    """Table 1's numbering: neither, RPM, IIM, both; then RI and RO together last; then columns, then rows."""
    impossible = 2 * (_T.II in types) + (_T.IO in types)
    redundant = 2 * (_T.RO in types) + (_T.RI in types)
    return (_T.IIM in types, _T.RPM in types, redundant == 3, impossible, redundant)


@cache
def feasible_classes(n: int = 3) -> tuple[SingularityClass, ...]:
    """The classes that mobility n allows, derived from the rank inequalities: 9, 19, 21 for n = 1, 2, 3.

    From n = 3 on all are there; for smaller n the numbers of Table 1 stay. Raises `ValueError` for n < 1.

    Lemma: n only bounds defects from above, so that a larger one forbids nothing more. Types are kept where
    the larger of delta and p becomes 1 more than the other, if it was more, and k_I, k_O that number, or 1
    more where they were larger; then all are lowered until min(delta, p) <= 1. That is feasible for n = 3.

    >>> [len(feasible_classes(n)) for n in (1, 2, 3, 4)]
    [9, 19, 21, 21]
    """
    if n < 1:
        raise ValueError(f"mobility {n}: a mechanism with inputs and outputs has n >= 1")
    if n >= 3:
        found = {d.types for d in feasible_defects(3)} - {SingularityType(0)}
        return tuple(SingularityClass(i, t) for i, t in enumerate(sorted(found, key=_order), 1))
    possible = {d.types for d in feasible_defects(n)}
    return tuple(c for c in feasible_classes(3) if c.types in possible)


def class_of(types: SingularityType) -> SingularityClass | None:
    """The class with exactly these types; None for a regular configuration.

    Raises `ValueError` for a combination that no mechanism has.

    >>> class_of(SingularityType.RI | SingularityType.IO)
    1 (RI, IO)
    """
    if not types:
        return None
    for candidate in feasible_classes(3):
        if candidate.types == types:
            return candidate
    raise ValueError(f"{types}: no configuration has exactly these types; Table 1 lists the 21 that occur")


def _subsets(kinds: tuple[SingularityType, ...]) -> tuple[SingularityType, ...]:
    """The nonempty subsets, small ones first."""
    found = []
    for size in range(1, len(kinds) + 1):
        for chosen in combinations(kinds, size):
            subset = SingularityType(0)
            for kind in chosen:
                subset |= kind
            found.append(subset)
    return tuple(found)


@dataclass(frozen=True)
class Table:
    """Table 1's layout: rows are subsets of RI, RO, RPM, of IO, II, IIM columns; None: impossible."""

    rows: tuple[SingularityType, ...]
    columns: tuple[SingularityType, ...]
    cells: tuple[tuple[SingularityClass | None, ...], ...]


def table(n: int = 3) -> Table:
    """Table 1 for mobility n.

    >>> [sum(cell is not None for cell in row) for row in table(3).cells]
    [1, 1, 3, 5, 3, 3, 5]
    """
    by_types = {c.types: c for c in feasible_classes(n)}
    rows, columns = _subsets((_T.RI, _T.RO, _T.RPM)), _subsets((_T.IO, _T.II, _T.IIM))
    return Table(rows, columns, tuple(tuple(by_types.get(r | c) for c in columns) for r in rows))
