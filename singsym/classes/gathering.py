"""What is to be said of many things alike, in few words: numbers of classes, loci and pieces together."""

from __future__ import annotations

from collections.abc import Iterable, Sequence


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
        ("; ".join(f"{name} {', '.join(_spans(numbers))}".strip() for name, numbers in named.items()), reason)
        for reason, named in by_reason.items()
    )


def _spans(numbers: Sequence[int]) -> list[str]:
    """Numbers as text, three and more that follow each other by the first and the last."""
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    return [text for run in runs for text in ([f"{run[0]} to {run[-1]}"] if len(run) > 2 else map(str, run))]
