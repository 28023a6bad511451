"""What is to be said of many things alike, in few words: numbers of classes, loci and pieces together."""

from __future__ import annotations

from collections.abc import Iterable


def gathered(pairs: Iterable[tuple[str, str]]) -> tuple[tuple[str, str], ...]:
    """Those with the same second part together, and the numbers of what is called alike.

    >>> gathered([("class 1", "no time"), ("class 2", "no memory"), ("class 3", "no time")])
    (('class 1, 3', 'no time'), ('class 2', 'no memory'))
    >>> gathered([(f"class {number}", "no time") for number in (1, 2, 5, 6, 7, 8)])
    (('class 1, 2, 5 to 8', 'no time'),)
    """
    by_reason: dict[str, dict[str, list[int]]] = {}
    for what, reason in pairs:
        name, _, number = what.rpartition(" ")
        named = by_reason.setdefault(reason, {})
        if number.isdecimal():
            named.setdefault(name, []).append(int(number))
        else:
            named.setdefault(what, [])
    return tuple(
        (
            "; ".join(
                f"{name} {in_ranges(sorted(numbers), ' to ')}".strip() for name, numbers in named.items()
            ),
            reason,
        )
        for reason, named in by_reason.items()
    )


def in_ranges(numbers: Iterable[int], between: str = "-") -> str:
    """Numbers in order, three or more that follow each other as one range.

    >>> in_ranges([2, 3, 5, 6, 7, 9])
    '2, 3, 5-7, 9'
    """
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    return ", ".join(f"{r[0]}{between}{r[-1]}" if len(r) > 2 else ", ".join(map(str, r)) for r in runs)
