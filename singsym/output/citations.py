"""What is printed once of a mechanism's conditions and cited after: equal conditions, and polynomials.

Source: Zlatanov, Fenton, Benhabib (1998), the proposition of section 2.3.  (vii) and (viii) repeat (4) and
(5), and say that a configuration of (5) is RI or RPM, and IO or IIM: so (i) is (5) where (iii) does not hold;
in the same way (ii) is (4) off (iii), (iv) is (4) off (vi), and (v) is (5) off (vi).  Minors share factors.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from singsym.conditions.conditions import TWINS, Condition
from singsym.conditions.factor import Factor
from singsym.polynomials import Polynomial

SHORT = 24
"""A polynomial without words whose text is not longer is repeated: a name would not say it better."""

FEW = 2
"""More factors than these that were taken away are counted, unless all is asked for."""

MOST_ALTERNATIVES, MOST_NAMES = 6, 3
"""More alternatives, or more names in those of (vi), are counted unless all is asked for."""

_NEARLY = {"i": ("5", "iii"), "ii": ("4", "iii"), "iv": ("4", "vi"), "v": ("5", "vi")}


@dataclass(frozen=True)
class Entry:
    """A condition as it is printed.

    same_as: the label of one with the same content, or "".
    off: the label of the condition off which it is the same; "" for everywhere.
    nowhere: whether it holds in no configuration.
    left_out: the number of alternatives that are not among those of the condition, which are too many.
    alternatives: its factors, with those that are printed in full there.
    below: factors that are printed in full after the alternatives, of which several make one.
    """

    condition: Condition
    same_as: str = ""
    off: str = ""
    nowhere: bool = False
    left_out: int = 0
    alternatives: tuple[tuple[tuple[Factor, bool], ...], ...] = ()
    below: tuple[Factor, ...] = ()

    @property
    def more(self) -> str:
        """How many alternatives are left out."""
        number, plural = self.left_out, "" if self.left_out == 1 else "s"
        if self.alternatives:
            return f"{number} more way{plural}, of several factors each"
        return f"written out: {number} set{plural} of factors that vanish together"


@dataclass(frozen=True)
class Citations:
    """Conditions in order, and the numbers of polynomials that are cited by a name."""

    entries: tuple[Entry, ...]
    numbers: Mapping[Polynomial, int]

    def numbers_of(self, factors: Iterable[Factor]) -> tuple[int, ...]:
        """The numbers of those of some factors that are cited by a name, in order."""
        return tuple(sorted(self.numbers[f.polynomial] for f in factors if f.polynomial in self.numbers))


def printed_labels(conditions: Iterable[Condition], expand: bool) -> tuple[str, ...]:
    """The labels of the conditions whose factors are printed."""
    return tuple(entry.condition.label for entry in cited(conditions, expand).entries if entry.alternatives)


def cited(conditions: Iterable[Condition], expand: bool = True) -> Citations:
    """What is printed in full at its first place, and cited after it.

    A factor stands by itself where it alone makes an alternative; where several do, they are cited.  It is
    cited by its words, by a short polynomial itself, else by a name with a number.
    expand: all alternatives; else a few, and of (vi) none where its screws say the same in a line.

    >>> from singsym.conditions.conditions import conditions
    >>> from singsym.kinematics.velocity import velocity_equation
    >>> from singsym.mechanism import load
    >>> found = cited(conditions(velocity_equation(load("fourbar"))))
    >>> [entry.same_as for entry in found.entries][-2:], found.numbers
    (['4', '5'], {})
    """
    whole = {condition.label: condition for condition in conditions}
    entries: list[Entry] = []
    printed: dict[Polynomial, None] = {}
    named: set[Polynomial] = set()
    for label, full_condition in whole.items():
        twin = TWINS.get(label, "")
        if twin in whole and _content(whole[twin]) == _content(full_condition):
            entries.append(Entry(full_condition, twin))
            continue
        if label in _NEARLY and (entry := _comparison(full_condition, whole)):
            entries.append(entry)
            continue
        condition = full_condition if expand else _shortened(full_condition)
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
        left_out = len(full_condition.alternatives or ()) - len(alternatives)
        entries.append(
            Entry(
                condition,
                nowhere=full_condition.is_nowhere,
                left_out=left_out,
                alternatives=tuple(alternatives),
                below=tuple(below),
            )
        )
    numbers = {p: i for i, p in enumerate((p for p in printed if p in named), 1)}
    return Citations(tuple(entries), numbers)


def _comparison(condition: Condition, known: Mapping[str, Condition]) -> Entry | None:
    """What a comparison of ranks comes to; None where the conditions that tell are not known."""
    same, off = (known.get(label) for label in _NEARLY[condition.label])
    if same is None or off is None or off.everywhere:
        return None
    if same.is_nowhere:
        return Entry(condition, nowhere=True)
    return Entry(condition, same.label, "" if off.is_nowhere else off.label)


def _shortened(condition: Condition) -> Condition:
    """The condition with a few alternatives; with none where its screws say it and these cite polynomials."""
    alternatives = condition.alternatives
    if not alternatives:
        return condition
    names = {f.polynomial for f in condition.all_factors if not (f.words or is_short(f))}
    if condition.equilibrium and (len(alternatives) > MOST_ALTERNATIVES or len(names) > MOST_NAMES):
        return replace(condition, alternatives=())
    if len(alternatives) <= MOST_ALTERNATIVES or any(len(a) == 1 for a in alternatives[MOST_ALTERNATIVES:]):
        return condition
    return replace(condition, alternatives=alternatives[:MOST_ALTERNATIVES])


def is_short(factor: Factor) -> bool:
    """Whether a factor without words is cited by itself."""
    return not factor.words and len(str(factor.polynomial)) <= SHORT


def _content(condition: Condition) -> object:
    return condition.alternatives, condition.everywhere, condition.units
