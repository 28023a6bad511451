"""Groebner bases of lists of polynomials, made small before an engine sees them.

Source: D. Cox, J. Little, D. O'Shea, Ideals, Varieties, and Algorithms, chapters 2 and 3.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from flint import fmpq_mpoly, fmpz_mpoly_vec

from singsym.effort.budget import Budget, current
from singsym.effort.verdict import Known, Premises
from singsym.elimination import engines
from singsym.elimination.engines.division import remainder
from singsym.elimination.linear_substitution import connected
from singsym.elimination.memo import remember
from singsym.polynomials import Polynomial, Ring


@dataclass(frozen=True)
class Basis:
    """A reduced Groebner basis in the ring's order, and who computed it."""

    ring: Ring
    polynomials: tuple[Polynomial, ...]
    engine: str

    @property
    def is_unit(self) -> bool:
        """Whether the ideal is the whole ring."""
        return any(p.is_constant for p in self.polynomials)

    def leading_monomials(self) -> tuple[tuple[int, ...], ...]:
        """The exponents of the leading monomials."""
        return tuple(p.leading_term[0] for p in self.polynomials)

    def reduce(self, polynomial: Polynomial) -> Polynomial:
        """The normal form up to a non-zero scalar, primitive."""
        if not self.polynomials or not polynomial:
            return polynomial.primitive() if polynomial else polynomial
        value = remainder(polynomial.integer(), _vector(self.ring, self.polynomials))
        return Polynomial(self.ring, fmpq_mpoly(value)).primitive()


def canonical(ring: Ring, polynomials: Iterable[Polynomial]) -> tuple[Polynomial, ...]:
    """Non-zero primitive polynomials without repetition; (1,) where one is constant."""
    found = dict.fromkeys(p.primitive() for p in polynomials if p)
    return (ring.one,) if any(p.is_constant for p in found) else tuple(found)


def groebner_basis(
    ring: Ring, polynomials: Sequence[Polynomial], budget: Budget | None = None
) -> Known[Basis]:
    """The reduced Groebner basis; linear equations and unconnected groups are taken apart first.

    Raises `engines.EngineFailure`, `engines.EngineUnavailable`, `BudgetExceeded`.
    """
    generators = canonical(ring, polynomials)
    key = (ring, frozenset(generators))
    return remember("groebner", key, lambda: _groebner_basis(ring, generators, current(budget)), budget)


def _groebner_basis(ring: Ring, generators: tuple[Polynomial, ...], budget: Budget) -> Known[Basis]:
    budget.check("a Groebner basis")
    linear, rest = _linear_part(ring, list(generators))
    if not rest:
        return Known(Basis(ring, _sorted(ring, linear), "linear algebra"))
    if rest == [ring.one]:
        return Known(Basis(ring, (ring.one,), "linear algebra"))
    found: list[Polynomial] = []
    names: set[str] = set()
    premises = Premises()
    for group in connected(rest):
        if len(group) == 1:
            found += group
            continue
        answer = _ask(engines.Task("groebner", ring, tuple(group)), budget)
        basis = premises.take(answer.known)[0]
        names.add(answer.engine)
        if any(p.is_constant for p in basis):
            return Known(Basis(ring, (ring.one,), answer.engine), answer.certainty)
        found += basis
    if any(p.total_degree == 1 for p in found):
        vector = _vector(ring, tuple(found))
        reduced = [remainder(p.integer(), vector) for p in linear]
        linear = [Polynomial(ring, fmpq_mpoly(p)).primitive() for p in reduced]
    whole = _sorted(ring, [*linear, *found])
    return premises.conclude(Basis(ring, whole, ", ".join(sorted(names)) or "flint"))


def _ask(task: engines.Task, budget: Budget) -> engines.EngineAnswer:
    key = (task.ring, frozenset(task.generators))
    return remember("engine groebner", key, lambda: engines.ask(task, budget), budget)


def _linear_part(ring: Ring, generators: list[Polynomial]) -> tuple[list[Polynomial], list[Polynomial]]:
    """The linear equations in echelon form, and the others without their leading variables.

    Lemma: with leading variables v_i of the linear l_i, and G a Groebner basis free of all v_i, the l_i and
    G together are a Groebner basis, since their leading monomials are coprime.
    """
    linear: list[Polynomial] = []
    rest = generators
    while True:
        found = next((p for p in rest if p.total_degree == 1), None)
        if found is None:
            return linear, rest
        exponents, c = found.leading_term
        i = exponents.index(1)
        value = ring.gens[i] - found / c
        images = (p.substitute({ring.names[i]: value}) if p.degrees[i] > 0 else p for p in rest)
        rest = list(canonical(ring, images))
        linear = [p.substitute({ring.names[i]: value}).primitive() for p in linear] + [found]
        if rest == [ring.one]:
            return linear, rest


def _sorted(ring: Ring, polynomials: Iterable[Polynomial]) -> tuple[Polynomial, ...]:
    """Smallest leading monomial first, whichever engine computed them."""
    found = list(polynomials)
    if not found:
        return ()
    leading = {p.leading_term[0]: p for p in found}
    order = [m for m, _ in ring.from_dict(dict.fromkeys(leading, 1)).terms()]
    return tuple(leading[m] for m in reversed(order))


def _vector(ring: Ring, polynomials: tuple[Polynomial, ...]) -> fmpz_mpoly_vec:
    key = (ring, polynomials)
    return remember(
        "vector", key, lambda: fmpz_mpoly_vec([p.integer() for p in polynomials], ring.integer_context)
    )
