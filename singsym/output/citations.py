"""What is printed once of a mechanism's conditions and cited after: equal conditions, and polynomials.

Source: Zlatanov, Fenton, Benhabib (1998), (vii) and (viii) repeat (4) and (5); minors share factors.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from singsym.conditions.conditions import Condition
from singsym.conditions.factor import Factor
from singsym.polynomials import Polynomial

SHORT = 24
"""A polynomial without words whose text is not longer is repeated: a name would not say it better."""

_TWINS = {"vii": "4", "viii": "5"}


@dataclass(frozen=True)
class Entry:
    """A condition as it is printed.

    same_as: the label of one before it with the same content, or "".
    alternatives: its factors, with those that are printed in full there.
    below: factors that are printed in full after the alternatives, of which several make one.
    """

    condition: Condition
    same_as: str = ""
    alternatives: tuple[tuple[tuple[Factor, bool], ...], ...] = ()
    below: tuple[Factor, ...] = ()


@dataclass(frozen=True)
class Citations:
    """Conditions in order, and the numbers of polynomials that are cited by a name."""

    entries: tuple[Entry, ...]
    numbers: Mapping[Polynomial, int]

    def numbers_of(self, factors: Iterable[Factor]) -> tuple[int, ...]:
        """The numbers of those of some factors that are cited by a name, in order."""
        return tuple(sorted(self.numbers[f.polynomial] for f in factors if f.polynomial in self.numbers))


def cited(conditions: Iterable[Condition]) -> Citations:
    """What is printed in full at its first place, and cited after it.

    A factor stands by itself where it alone makes an alternative; where several do, they are cited.  It is
    cited by its words, by a short polynomial itself, else by a name with a number.

    >>> from singsym.conditions.conditions import conditions
    >>> from singsym.kinematics.velocity import velocity_equation
    >>> from singsym.mechanism import load
    >>> found = cited(conditions(velocity_equation(load("fourbar"))))
    >>> [entry.same_as for entry in found.entries][-2:], found.numbers
    (['4', '5'], {})
    """
    entries: list[Entry] = []
    before: dict[str, Condition] = {}
    printed: dict[Polynomial, None] = {}
    named: set[Polynomial] = set()
    for condition in conditions:
        twin = _TWINS.get(condition.label, "")
        if twin in before and _content(before[twin]) == _content(condition):
            entries.append(Entry(condition, twin))
            continue
        before[condition.label] = condition
        alternatives, below = [], []
        for alternative in condition.alternatives or ():
            shown = []
            for factor in alternative:
                polynomial = factor.polynomial
                full = len(alternative) == 1 and polynomial not in printed
                shown.append((factor, full))
                if not full and not is_short(factor):
                    if not factor.words:
                        named.add(polynomial)
                    if polynomial not in printed:
                        below.append(factor)
                printed.setdefault(polynomial)
            alternatives.append(tuple(shown))
        entries.append(Entry(condition, "", tuple(alternatives), tuple(below)))
    numbers = {p: i for i, p in enumerate((p for p in printed if p in named), 1)}
    return Citations(tuple(entries), numbers)


def is_short(factor: Factor) -> bool:
    """Whether a factor without words is cited by itself."""
    return not factor.words and len(str(factor.polynomial)) <= SHORT


def _content(condition: Condition) -> object:
    return condition.alternatives, condition.everywhere, condition.units
