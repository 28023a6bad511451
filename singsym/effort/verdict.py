"""Answers that say how they are known: yes, no or undecided, with a certificate or a reason.

Source: the contract between numerics and proofs; numerics may find, they never conclude.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, Literal

from singsym.effort.chance import PRIMES

Certainty = Literal["proven", "certified", "modular", "undecided"]


def described(certainty: Certainty) -> str:
    """The certainty for readers, with what it rests on.

    >>> described("modular")
    'modular, 3 primes'
    """
    return f"modular, {PRIMES} primes" if certainty == "modular" else certainty


def weakest(*certainties: Certainty) -> Certainty:
    """What is left of the certainty of a conclusion from several results.

    >>> weakest("proven", "modular")
    'modular'
    """
    order: tuple[Certainty, ...] = ("proven", "certified", "modular", "undecided")
    return max(certainties, key=order.index, default="proven")


_seen: ContextVar[list[Certainty] | None] = ContextVar("certainties", default=None)


@contextmanager
def certainties() -> Iterator[list[Certainty]]:
    """A list of how everything is known that engines, or results remembered of theirs, answer inside.

    >>> with certainties() as seen:
    ...     note("modular")
    >>> seen
    ['modular']
    """
    outer, seen = _seen.get(), list[Certainty]()
    token = _seen.set(seen)
    try:
        yield seen
    finally:
        _seen.reset(token)
        if outer is not None:
            outer.extend(seen)


def note(certainty: Certainty) -> None:
    """Add to the innermost list of `certainties`, and so to those around it."""
    seen = _seen.get()
    if seen is not None and certainty not in seen:
        seen.append(certainty)


@contextmanager
def unnoted() -> Iterator[list[Certainty]]:
    """Like `certainties`, but nothing of it reaches the lists around: for answers that may not be used.

    >>> with certainties() as outer, unnoted() as seen:
    ...     note("modular")
    >>> outer, seen
    ([], ['modular'])
    """
    seen = list[Certainty]()
    token = _seen.set(seen)
    try:
        yield seen
    finally:
        _seen.reset(token)


def noted_if_true(question: Callable[[], bool]) -> bool:
    """The answer to a question of which a False has no consequences: then it does not matter how it is known.

    >>> with certainties() as seen:
    ...     noted_if_true(lambda: note("modular") is not None)
    False
    >>> seen
    []
    """
    with unnoted() as seen:
        answer = question()
    if answer:
        for certainty in seen:
            note(certainty)
    return answer


class Answer(StrEnum):
    """What is answered to a yes-or-no question."""

    YES = "yes"
    NO = "no"
    UNDECIDED = "undecided"


@dataclass(frozen=True)
class Verdict:
    """The answer to a question about a set, and how it is known.

    certainty: "proven" by exact algebra, "certified" by interval arithmetic, "modular" where it rests on
    `PRIMES` random primes, "undecided" without an answer.
    engine: who computed it; witness: a point or polynomial that shows it; reason: one sentence.

    >>> Verdict.no("proven", reason="the ideal contains 1").is_no
    True
    >>> bool(Verdict.undecided("out of time"))
    Traceback (most recent call last):
    ...
    TypeError: a Verdict has no truth value: ask .is_yes, .is_no or .is_undecided (undecided: out of time)
    """

    answer: Answer
    certainty: Certainty = "proven"
    engine: str = ""
    witness: Any = None
    reason: str = ""

    @classmethod
    def yes(
        cls, certainty: Certainty = "proven", *, engine: str = "", witness: Any = None, reason: str = ""
    ) -> Verdict:
        """The answer yes."""
        return cls(Answer.YES, certainty, engine, witness, reason)

    @classmethod
    def no(
        cls, certainty: Certainty = "proven", *, engine: str = "", witness: Any = None, reason: str = ""
    ) -> Verdict:
        """The answer no."""
        return cls(Answer.NO, certainty, engine, witness, reason)

    @classmethod
    def undecided(cls, reason: str, *, engine: str = "") -> Verdict:
        """No answer, and why."""
        return cls(Answer.UNDECIDED, "undecided", engine, None, reason)

    @property
    def is_yes(self) -> bool:
        """Whether the answer is yes."""
        return self.answer is Answer.YES

    @property
    def is_no(self) -> bool:
        """Whether the answer is no."""
        return self.answer is Answer.NO

    @property
    def is_undecided(self) -> bool:
        """Whether there is no answer."""
        return self.answer is Answer.UNDECIDED

    def __invert__(self) -> Verdict:
        """The verdict on the opposite question.

        >>> (~Verdict.yes()).is_no
        True
        """
        opposite = {Answer.YES: Answer.NO, Answer.NO: Answer.YES, Answer.UNDECIDED: Answer.UNDECIDED}
        return Verdict(opposite[self.answer], self.certainty, self.engine, self.witness, self.reason)

    def __bool__(self) -> bool:
        raise TypeError(f"a Verdict has no truth value: ask .is_yes, .is_no or .is_undecided ({self})")

    def __str__(self) -> str:
        if self.is_undecided:
            return f"undecided: {self.reason}" if self.reason else "undecided"
        by = f" by {self.engine}" if self.engine else ""
        return f"{self.answer} ({described(self.certainty)}{by})" + (
            f": {self.reason}" if self.reason else ""
        )
