"""What can be wrong with a mechanism, said so that its author can put it right.

Source: singsym's own.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

LONGEST_PLACE, LONGEST_PART = 120, 1000
"""Characters of a place, and of what was found or expected, that are shown."""


def shorten(found: object, limit: int = 60) -> str:
    """Text of what was found, cut in the middle where it is long.

    >>> shorten("x" * 100, 11)
    'xxxx...xxxx'
    """
    text = str(found)
    half = (limit - 3) // 2
    return text if len(text) <= limit else f"{text[:half]}...{text[-half:]}"


@dataclass(frozen=True)
class Problem:
    """One fault: where it is, what is there, what should be there, and what to do about it.

    >>> print(Problem("links.AB", "length 0", "a positive length", "give the link a length", "four.toml"))
    four.toml: links.AB: found length 0; expected a positive length; give the link a length
    """

    place: str
    found: str
    expected: str
    advice: str = ""
    file: str = ""

    def __str__(self) -> str:
        where = ": ".join(part for part in (self.file, shorten(self.place, LONGEST_PLACE)) if part)
        found, expected = (shorten(part, LONGEST_PART) for part in (self.found, self.expected))
        said = f"{where}: found {found}; expected {expected}"
        return _printable(said + (f"; {self.advice}" if self.advice else ""))


def _printable(text: str) -> str:
    """Text of a file as a terminal may show it: control characters escaped."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)


class MechanismError(ValueError):
    """A mechanism, or a file of one, that cannot be used; `problems` lists everything found."""

    def __init__(self, problems: Iterable[Problem]) -> None:
        self.problems = tuple(problems)
        super().__init__(self.problems)

    def __str__(self) -> str:
        return "\n".join(str(problem) for problem in self.problems)
