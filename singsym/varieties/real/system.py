"""Systems of equations, exclusions and inequalities, of which real solutions are looked for.

Source: basic semialgebraic sets, as in Bochnak, Coste, Roy, Real Algebraic Geometry (1998), 2.1.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol

from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.bounds_of_solutions import sign_within


class SignedPoint(Protocol):
    """A real point at which the sign of any polynomial is decided exactly."""

    @property
    def floats(self) -> tuple[float, ...]:
        """The coordinates in double precision."""

    def sign(self, polynomial: Polynomial) -> int:
        """-1, 0 or 1."""


@dataclass(frozen=True)
class RealSystem:
    """The real points with equations = 0, no exclusion group all zero, positive > 0 and nonnegative >= 0.

    exclusions: groups of polynomials; a point is excluded where all polynomials of some group vanish.
    The ring's constants have their own values, never those of conjugates.
    """

    ring: Ring
    equations: tuple[Polynomial, ...]
    exclusions: tuple[tuple[Polynomial, ...], ...] = ()
    positive: tuple[Polynomial, ...] = ()
    nonnegative: tuple[Polynomial, ...] = ()

    @property
    def closed_equations(self) -> tuple[Polynomial, ...]:
        """The equations that are not zero, with the relations of the ring's constants."""
        found = [f for f in (*self.equations, *self.ring.relations) if not f.is_zero]
        return tuple(dict.fromkeys(found))

    @property
    def nonzero(self) -> tuple[Polynomial, ...]:
        """Single polynomials that do not vanish on any solution.

        >>> R = Ring(("a", "x"))
        >>> a, x = R.gens
        >>> RealSystem(R, (), exclusions=((x,),), positive=(a - 1,)).nonzero
        (a - 1, x, a)
        """
        single = (group[0] for group in self.exclusions if len(group) == 1)
        return tuple(dict.fromkeys((*self.positive, *single, *self._not_at_zero)))

    @property
    def exclusion_polynomials(self) -> tuple[Polynomial, ...]:
        """For each exclusion a polynomial with the same real zeros: the sum of its squares.

        >>> R = Ring(("x", "y"))
        >>> x, y = R.gens
        >>> RealSystem(R, (), exclusions=((x,), (x, y))).exclusion_polynomials
        (x, x^2 + y^2)
        """
        return tuple(
            g[0] if len(g) == 1 else sum((p * p for p in g), self.ring.zero) for g in self.exclusions
        )

    @property
    def _not_at_zero(self) -> Iterator[Polynomial]:
        """Variables of which an inequality in them alone leaves out zero, as the range of a parameter may."""
        constants = {c.name: (c.low, c.high) for c in self.ring.constants}
        for p in self.positive:
            names = set(p.variables) - set(constants)
            if len(names) == 1:
                (name,) = names
                if sign_within(p.substitute({name: self.ring.zero}), constants) < 0:
                    yield self.ring.gen(name)

    @property
    def with_slack(self) -> RealSystem:
        """The inequalities as equations p = s^2 with more variables, which come last in the ring."""
        sided = (*self.positive, *self.nonnegative)
        wide = self.ring.with_names((*self.ring.names, *(f"slack {k}" for k in range(len(sided)))))
        slack = [wide.convert(p) - wide.gen(f"slack {k}") ** 2 for k, p in enumerate(sided)]
        return RealSystem(wide, (*map(wide.convert, self.equations), *slack), self.exclusions)

    def admits(self, point: SignedPoint) -> bool:
        """Whether a point that solves the equations meets all other conditions, by exact signs."""
        return (
            all(_is_off(point, group) for group in self.exclusions)
            and all(point.sign(p) > 0 for p in self.positive)
            and all(point.sign(p) >= 0 for p in self.nonnegative)
        )


def _is_off(point: SignedPoint, group: Sequence[Polynomial]) -> bool:
    """Whether some polynomial is not zero; the largest first, whose sign is decided soonest."""
    sizes = [abs(g.evaluate(point.floats)) for g in group]
    return any(point.sign(group[k]) for k in sorted(range(len(group)), key=lambda k: -sizes[k]))
