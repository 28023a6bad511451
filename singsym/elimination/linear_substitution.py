"""Variables that a polynomial gives at once: c x + h with a constant c, replaced everywhere.

Source: the isomorphism Q[x, y]/(c x + h(y), I) = Q[y]/I(-h/c, y).
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

from singsym.polynomials import Polynomial

_GROWTH = 4
_ALLOWANCE = 200

Substitution = tuple[str, Polynomial, Polynomial]


def solved_variable(
    polynomial: Polynomial, names: Collection[str] | None = None
) -> tuple[str, Polynomial] | None:
    """A variable that occurs once, alone and to the first power, and the polynomial that it equals.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> solved_variable(2 * x - y**2)
    ('x', 1/2*y^2)
    """
    ring, degrees = polynomial.ring, polynomial.degrees
    terms = polynomial.terms()
    for exponents, c in terms:
        if sum(exponents) != 1:
            continue
        i = exponents.index(1)
        alone = degrees[i] == 1 and sum(1 for m, _ in terms if m[i]) == 1
        if alone and (names is None or ring.names[i] in names):
            return ring.names[i], ring.gens[i] - polynomial / c
    return None


def substitute_solved(
    polynomials: Sequence[Polynomial], names: Collection[str] | None = None, bounded: bool = True
) -> tuple[list[Polynomial], list[Substitution]]:
    """The polynomials without the variables (among `names`) that some of them give, and what was replaced.

    Each substitution is (name, value, polynomial it came from).  With `bounded`, one that would make the
    system much longer is not made.
    """
    rest = [p for p in polynomials if p]
    made: list[Substitution] = []
    refused: set[tuple[str, Polynomial]] = set()
    while True:
        candidates = [(len(p), k, found) for k, p in enumerate(rest) if (found := solved_variable(p, names))]
        candidates = [c for c in candidates if c[2] not in refused]
        if not candidates:
            return rest, made
        _, k, (name, value) = min(candidates, key=lambda c: c[:2])
        source = rest[k]
        changed = _replaced(rest[:k] + rest[k + 1 :], name, value)
        if bounded and sum(map(len, changed)) > _GROWTH * sum(map(len, rest)) + _ALLOWANCE:
            refused.add((name, value))
            continue
        rest = changed
        made.append((name, value, source))


def _replaced(polynomials: Sequence[Polynomial], name: str, value: Polynomial) -> list[Polynomial]:
    found: dict[Polynomial, None] = {}
    for p in polynomials:
        image = p.substitute({name: value}) if p.degree(name) > 0 else p
        if image:
            found[image.primitive()] = None
    return list(found)


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
