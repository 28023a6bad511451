"""Variables that a polynomial gives at once: c x + h with a constant c, replaced everywhere.

Source: the isomorphism Q[x, y]/(c x + h(y), I) = Q[y]/I(-h/c, y).
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass

from singsym.polynomials import Polynomial

_GROWTH = 4
_ALLOWANCE = 200


@dataclass(frozen=True)
class Substitution:
    """A variable that an equation gives as a polynomial in the others."""

    name: str
    value: Polynomial

    @property
    def equation(self) -> Polynomial:
        """The polynomial that vanishes where the variable has this value, primitive."""
        return (self.value.ring.gen(self.name) - self.value).primitive()

    def apply(self, polynomials: Iterable[Polynomial]) -> tuple[Polynomial, ...]:
        """Polynomials with the value put in."""
        put = {self.name: self.value}
        return tuple(p.substitute(put) if p.degree(self.name) > 0 else p for p in polynomials)


def solved_variable(polynomial: Polynomial, names: Collection[str] | None = None) -> Substitution | None:
    """The first variable (among `names`) that occurs once, alone and to the first power, with its value.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> solved_variable(2 * x - y**2)
    Substitution(name='x', value=1/2*y^2)
    """
    if 1 not in polynomial.degrees:
        return None
    ring, terms = polynomial.ring, polynomial.terms()
    for i, (name, degree) in enumerate(zip(ring.names, polynomial.degrees, strict=True)):
        if degree == 1 and (names is None or name in names):
            holding = [(m, c) for m, c in terms if m[i]]
            if len(holding) == 1 and sum(holding[0][0]) == 1:
                return Substitution(name, ring.gens[i] - polynomial / holding[0][1])
    return None


def shortest_substitution(equations: Sequence[Polynomial]) -> Substitution | None:
    """What the simplest equation that gives a variable says of it; the ring's constants are none.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> shortest_substitution([x * y + y**3 - x, x**2 + 2 * y - 1]).value
    -1/2*x^2 + 1/2
    """
    for p in sorted(equations, key=lambda p: (p.total_degree, len(p))):
        constants = {constant.name for constant in p.ring.constants}
        found = solved_variable(p, [name for name in p.ring.names if name not in constants])
        if found is not None:
            return found
    return None


def substitute_solved(
    polynomials: Sequence[Polynomial], names: Collection[str] | None = None, bounded: bool = True
) -> tuple[list[Polynomial], list[Substitution]]:
    """The polynomials without the variables (among `names`) that some of them give, and what was replaced.

    With `bounded`, a substitution that would make the system much longer is not made.
    """
    rest = [p for p in polynomials if p]
    made: list[Substitution] = []
    refused: set[Substitution] = set()
    while True:
        candidates = [(len(p), k, found) for k, p in enumerate(rest) if (found := solved_variable(p, names))]
        candidates = [c for c in candidates if c[2] not in refused]
        if not candidates:
            return rest, made
        _, k, found = min(candidates, key=lambda c: c[:2])
        changed = list(dict.fromkeys(p.primitive() for p in found.apply(rest[:k] + rest[k + 1 :]) if p))
        if bounded and sum(map(len, changed)) > _GROWTH * sum(map(len, rest)) + _ALLOWANCE:
            refused.add(found)
            continue
        rest = changed
        made.append(found)


def connected(polynomials: Sequence[Polynomial]) -> list[list[Polynomial]]:
    """The polynomials in groups that share no variable with each other.

    >>> from singsym.polynomials import Ring
    >>> x, y, z = Ring(("x", "y", "z")).gens
    >>> connected([x + y, z**2, y**2])
    [[z^2], [x + y, y^2]]
    """
    groups: list[tuple[set[str], list[Polynomial]]] = []
    for p in polynomials:
        names = set(p.variables)
        touching = [g for g in groups if g[0] & names]
        groups = [g for g in groups if not g[0] & names]
        names.update(*(g[0] for g in touching))
        groups.append((names, [*(q for g in touching for q in g[1]), p]))
    return [members for _, members in groups]
