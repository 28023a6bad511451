"""Answers withheld at random, for tests: what comes out then may be less decided, never different.

Source: fault injection, as in A. Basiri et al., Chaos Engineering, IEEE Software 33 (2016) 35-41.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from random import Random

VARIABLE = "SINGSYM_CHAOS"
"""The environment variable, "seed:probability", for the command line and for worker processes."""


class Chaos:
    """How often an answer is withheld, and how often it was: `asked` and `withheld` count.

    seed: the same for the same sequence; probability: of withholding an answer, from 0 to 1.
    """

    def __init__(self, seed: int, probability: float) -> None:
        if not 0 <= probability <= 1:
            raise ValueError(f"a probability is from 0 to 1, not {probability}")
        self.probability = probability
        self.asked = self.withheld = 0
        self._random = Random(seed)

    @classmethod
    def read(cls, text: str) -> Chaos | None:
        """That of "seed:probability"; None for an empty text, `ValueError` for another.

        >>> Chaos.read("7:0.25").probability
        0.25
        """
        if not text:
            return None
        seed, _, probability = text.partition(":")
        try:
            return cls(int(seed), float(probability))
        except ValueError as error:
            raise ValueError(f'{VARIABLE} is "seed:probability", not {text!r}: {error}') from None

    def strikes(self) -> bool:
        """Whether the next answer is withheld."""
        struck = self._random.random() < self.probability
        self.asked += 1
        self.withheld += struck
        return struck


_reigning: Chaos | None = Chaos.read(os.environ.get(VARIABLE, ""))


@contextmanager
def chaos(seed: int, probability: float) -> Iterator[Chaos]:
    """Withhold answers for the work inside, in all threads of this process and in those forked off it.

    >>> with chaos(1, 1.0) as seen:
    ...     strikes(), seen.withheld
    (True, 1)
    >>> strikes()
    False
    """
    global _reigning
    outer, _reigning = _reigning, Chaos(seed, probability)
    try:
        yield _reigning
    finally:
        _reigning = outer


def reigns() -> bool:
    """Whether answers are withheld here at all."""
    return _reigning is not None


def strikes() -> bool:
    """Whether whoever asks at this door goes away without an answer: never, but in tests."""
    return _reigning is not None and _reigning.strikes()
