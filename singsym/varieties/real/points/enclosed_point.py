"""What exact and boxed points have in common: balls that hold the coordinates and can be made smaller.

Source: F. Johansson, Arb: efficient arbitrary-precision midpoint-radius interval arithmetic, IEEE Trans.
Computers 66 (2017) 1281-1292.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, fields
from typing import Any, Self

from flint import arb

from singsym.polynomials import Ring


@dataclass(frozen=True, repr=False)
class EnclosedPoint(ABC):
    """A real point of the space of a ring's names, by balls around it."""

    ring: Ring

    def __getstate__(self) -> dict[str, Any]:
        """Without the balls, which cannot be pickled and are found again."""
        return {f.name: getattr(self, f.name) for f in fields(self)}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)

    @property
    @abstractmethod
    def box(self) -> tuple[arb, ...]:
        """Balls that hold the coordinates, in the order of the ring's names."""

    @abstractmethod
    def refine(self, bits: int) -> Self:
        """The same point in smaller balls."""

    @abstractmethod
    def decimals(self, digits: int = 12) -> dict[str, str]:
        """The coordinates by name to so many digits."""

    def __getitem__(self, name: str) -> arb:
        """The ball of one coordinate."""
        return self.box[self.ring.index(name)]

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value}" for name, value in self.decimals(6).items())
        return f"{type(self).__name__}({values})"
