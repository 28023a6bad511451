"""Reflections, changes of sign of some variables, that leave a mechanism's equations and ranks as they are.

A leg turned half about a base joint and bent the other way, or a mirror image: what is found on one part of
the configuration space holds on its images.
Source: singsym's own.  Linear algebra over GF(2): zeros of a polynomial stay where all its monomials change
sign or none does, and the rank of a matrix where each entry changes as its row and its column do.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache, reduce
from itertools import combinations

from flint import nmod_mat

from singsym.polynomials import Polynomial, PolynomialMatrix
from singsym.varieties.real.system import RealSystem

Reflection = tuple[str, ...]
"""The variables whose sign changes, sorted."""
IDENTITY: Reflection = ()
MOST_GENERATORS = 6


def reflections(
    feasible: RealSystem, equations: Sequence[Polynomial], matrices: Iterable[PolynomialMatrix]
) -> tuple[Reflection, ...]:
    """All that keep the zeros of the equations, the feasible set and the ranks; the identity first.

    >>> from singsym.polynomials import Ring
    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> reflections(RealSystem(R, (), positive=(y,)), (x**2 + y - 1,), ())
    ((), ('x',))
    """
    ring = feasible.ring
    names, rows = ring.names, set(_parities(feasible, equations))
    width = len(names)
    entries: list[tuple[tuple[int, ...], int, int]] = []
    for matrix in matrices:
        height = matrix.shape[0]
        for i, row in enumerate(matrix.rows):
            for j, entry in enumerate(row):
                rows.update(_differences(entry))
                if entry:
                    entries.append((_odd(entry.leading_term[0]), width + i, width + height + j))
        width += sum(matrix.shape)
    table = [[*row, *[0] * (width - len(names))] for row in rows]
    for odd, i, j in entries:
        own = [*odd, *[0] * (width - len(names))]
        own[i] = own[j] = 1
        table.append(own)
    table.append([0] * width)
    basis, nullity = nmod_mat(len(table), width, [e for row in table for e in row], 2).nullspace()
    changes = nmod_mat(
        nullity, len(names), [int(basis[i, k]) for k in range(nullity) for i in range(len(names))], 2
    )
    reduced, rank = changes.rref()
    generators = [
        tuple(sorted(name for i, name in enumerate(names) if int(reduced[k, i])))
        for k in range(min(rank, MOST_GENERATORS))
    ]
    return tuple(
        reduce(compose, chosen, IDENTITY)
        for size in range(len(generators) + 1)
        for chosen in combinations(generators, size)
    )


def _parities(feasible: RealSystem, equations: Sequence[Polynomial]) -> Iterator[tuple[int, ...]]:
    """Of each condition on the configuration space, which sums of the unknown changes have to be even."""
    ring = feasible.ring
    for constant in ring.constants:
        yield tuple(int(name == constant.name) for name in ring.names)
    for p in (*equations, *(g for group in feasible.exclusions for g in group)):
        yield from _differences(p)
    for p in (*feasible.positive, *feasible.nonnegative):
        yield from (_odd(m) for m, _ in p.terms())


def _odd(exponents: Sequence[int]) -> tuple[int, ...]:
    return tuple(int(e) % 2 for e in exponents)


def _differences(p: Polynomial) -> Iterator[tuple[int, ...]]:
    monomials = [_odd(m) for m, _ in p.terms()]
    for other in monomials[1:]:
        yield tuple(a ^ b for a, b in zip(monomials[0], other, strict=True))


def compose(one: Reflection, two: Reflection) -> Reflection:
    """One after the other.

    >>> compose(("x", "y"), ("y", "z"))
    ('x', 'z')
    """
    return tuple(sorted(set(one) ^ set(two)))


def image(equations: Iterable[Polynomial], reflection: Reflection) -> tuple[Polynomial, ...]:
    """The equations of the image of a zero set, with leading coefficients as they are.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> image((x * y, x + y), ("x",))
    (x*y, x - y)
    """
    return tuple(_reflected(p, reflection) for p in equations)


@lru_cache(maxsize=2**15)
def _reflected(p: Polynomial, reflection: Reflection) -> Polynomial:
    """Kept, because the same few polynomials are compared with their images again and again."""
    changed = p.reflect(reflection)
    return changed if not p or changed.value.coeffs()[0] == p.value.coeffs()[0] else -changed


def keeps(reflection: Reflection, equations: Iterable[Polynomial]) -> bool:
    """Whether a set of equations is its own image, up to signs of the equations."""
    known = {p.primitive() for p in equations}
    return all(_reflected(p, reflection).primitive() in known for p in known)


def permuting(sets: Sequence[tuple[Polynomial, ...]], group: Iterable[Reflection]) -> tuple[Reflection, ...]:
    """Those that carry each of some zero sets over to one of them.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> permuting([(x - 1, y - 1), (x + 1, y - 1)], [(), ("x",), ("y",)])
    ((), ('x',))
    """
    known = set(map(_zeros, sets))
    return tuple(r for r in group if all(_zeros(image(equations, r)) in known for equations in sets))


def _zeros(equations: Iterable[Polynomial]) -> frozenset[Polynomial]:
    return frozenset(p.primitive() for p in equations)


def representatives(
    sets: Sequence[tuple[Polynomial, ...]], group: Iterable[Reflection]
) -> list[tuple[int, tuple[Reflection, ...]]]:
    """One of each orbit of zero sets, by its place, with the reflections that lead to all members.

    group: closed under composition; those that do not permute the sets are not used.  The reflections that
    lead to the members are closed too: a complement of those that keep the first one.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> representatives([(x - 1, y), (x + 1, y), (x, y)], [(), ("x",), ("y",), ("x", "y")])
    [(0, ((), ('x',))), (2, ((),))]
    """
    places = {_zeros(equations): k for k, equations in enumerate(sets)}
    permutations = permuting(sets, group)
    found: list[tuple[int, tuple[Reflection, ...]]] = []
    reached: set[int] = set()
    for k, equations in enumerate(sets):
        if k in reached:
            continue
        members = {k: IDENTITY}
        for reflection in permutations:
            if places[_zeros(image(equations, reflection))] in members:
                continue
            cosets = [compose(reflection, r) for r in members.values()]
            members |= {places[_zeros(image(equations, r))]: r for r in cosets}
        reached |= members.keys()
        found.append((k, tuple(members.values())))
    return found
