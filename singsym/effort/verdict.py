"""Answers that say how they are known: values with their certainty, and yes, no or undecided with a reason.

Source: the contract between numerics and proofs; numerics may find, they never conclude.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, Generic, Literal, TypeVar

from singsym.effort.chance import PRIMES

Certainty = Literal["proven", "certified", "modular", "undecided"]
Value = TypeVar("Value", covariant=True)
T = TypeVar("T")


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


@dataclass(frozen=True)
class Known(Generic[Value]):
    """A value and how it is known: what is answered to a question that is not one of yes, no and undecided.

    It has no truth value of its own and is no number and no sequence, so that nobody takes it for the value.

    >>> Known(2, "modular").value
    2
    >>> bool(Known(False))
    Traceback (most recent call last):
    ...
    TypeError: what is known has no truth value: take its value, which is proven
    """

    value: Value
    certainty: Certainty = "proven"

    @property
    def is_proven(self) -> bool:
        """Whether it is proven by exact algebra."""
        return self.certainty == "proven"

    def map(self, function: Callable[[Value], T]) -> Known[T]:
        """What follows from the value alone.

        >>> Known(2, "modular").map(float)
        Known(value=2.0, certainty='modular')
        """
        return Known(function(self.value), self.certainty)

    def __bool__(self) -> bool:
        raise TypeError(f"what is known has no truth value: take its value, which is {self.certainty}")


class Premises:
    """What a conclusion rests on, so far: local to what draws the conclusion.

    certainty: of what follows from all of it.

    >>> premises = Premises()
    >>> premises.take(Known(2)) + premises.take(Known(3, "modular"))
    5
    >>> premises.conclude("odd")
    Known(value='odd', certainty='modular')
    """

    def __init__(self, *certainties: Certainty) -> None:
        self.certainty: Certainty = weakest(*certainties)

    def rest_on(self, certainty: Certainty) -> None:
        """What follows is no more certain than this."""
        self.certainty = weakest(self.certainty, certainty)

    def take(self, known: Known[T]) -> T:
        """The value; what follows rests on it."""
        self.rest_on(known.certainty)
        return known.value

    def grants(self, verdict: Verdict) -> bool:
        """Whether the answer is yes, and what follows rests on it; without a yes nothing follows.

        >>> premises = Premises()
        >>> premises.grants(Verdict.yes("modular")), premises.grants(Verdict.undecided("no time"))
        (True, False)
        >>> premises.certainty
        'modular'
        """
        if verdict.is_yes:
            self.rest_on(verdict.certainty)
        return verdict.is_yes

    def conclude(self, value: T) -> Known[T]:
        """What follows, as certain as the weakest of what it rests on."""
        return Known(value, self.certainty)

    def pass_on(self, known: Known[T]) -> Known[T]:
        """An answer that rests on all of this as well."""
        return self.conclude(self.take(known))


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
