"""How long each kind of answer is waited for, in seconds of `processor_time`, and what happens after.

Source: the measurements behind the routing of questions to engines.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass

PATIENT = 10.0
"""Proofs get so many times as long where they are worth waiting for."""

_longer: ContextVar[tuple[float, float]] = ContextVar("patience", default=(1.0, 1.0))


@dataclass(frozen=True)
class Patience:
    """So many seconds of work, and what happens when they are used up.

    is_proof: whether it is longer inside `patiently`.
    """

    seconds: float
    then: str
    is_proof: bool = False

    @property
    def work(self) -> float:
        """The seconds that are waited here."""
        everything, proofs = _longer.get()
        return self.seconds * everything * (proofs if self.is_proof else 1.0)


# who is asked first
FIRST = {
    "flint": Patience(1.5, "Singular is asked"),
    "msolve": Patience(300.0, "Singular is asked"),
    "singular": Patience(300.0, "the engine named next is asked"),
    "sympy": Patience(300.0, "the engine named next is asked"),
}
FLINT_BEFORE_MSOLVE = Patience(0.3, "msolve is asked")
LAST = Patience(3600.0, "undecided; for the last engine, where the caller set no limit")
LAST_DECOMPOSITION = Patience(120.0, "the same for minimal primes and the like")

# proofs of what is known
LEAST_PROOF = Patience(1.0, "what rests on primes stays modular", is_proof=True)
MOST_PROOF = Patience(3.0, "the same, where the answer modulo primes took long", is_proof=True)
SHORT_PROOF = Patience(10.0, "the same of a short basis, often found by way of short ones", is_proof=True)
SECOND_OPINION = Patience(20.0, "an answer that nobody confirms is modular")
RESIDUES = Patience(3.0, "what takes so long modulo a prime is not tried over Q")
SPLITTING = Patience(10.0, "a piece is not proven prime")


@contextmanager
def patiently() -> Iterator[None]:
    """Proofs over Q of what is known modulo primes may take much longer for the work inside.

    >>> with patiently():
    ...     proof_patience(), MOST_PROOF.work
    (10.0, 30.0)
    """
    with _set(_longer.get()[0], PATIENT):
        yield


@contextmanager
def scaled(factor: float) -> Iterator[None]:
    """All of the table times a factor, for the work inside: 0 for answers that come at once.

    >>> with scaled(0.5):
    ...     SPLITTING.work
    5.0
    """
    with _set(factor, _longer.get()[1]):
        yield


@contextmanager
def _set(everything: float, proofs: float) -> Iterator[None]:
    token = _longer.set((everything, proofs))
    try:
        yield
    finally:
        _longer.reset(token)


def proof_patience() -> float:
    """So many times as long as usual proofs are waited for here."""
    return _longer.get()[1]


def in_force() -> tuple[float, float]:
    """What everything, and what proofs further, are multiplied with here."""
    return _longer.get()
