"""The quotient algebra of a zero-dimensional system when a Groebner basis of all of it is too dear.

A basis of the easy equations is known; the hard ones enter by linear algebra in growing degree.
Source: Mourrain, AAECC-13, LNCS 1719 (1999) 430-443 (commuting multiplication matrices); Lazard, EUROCAL 83.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import lcm

from flint import fmpq, fmpq_mat, nmod_mat

from singsym.effort.chance import random_primes
from singsym.effort.verdict import Known, Premises
from singsym.elimination.ideal import Ideal
from singsym.elimination.monomial_ideals import divides
from singsym.polynomials import Exponents, Polynomial, Ring
from singsym.varieties.real.points.quotient_algebra import Algebra, Check, degrevlex, quotient_algebra

_MOST_COLUMNS = 1200
Vector = dict[Exponents, fmpq]


def quotient_algebra_over(
    easy: Ideal, hard: Sequence[Polynomial], check: Check = lambda: None
) -> Known[Algebra | None]:
    """Multiplication matrices of Q[names]/(easy + hard) on spanning monomials; `None` where it grows too big.

    The rewriting rules are exact elements of the ideal, so the monomials span the quotient and no point is
    missing; the matrices commute modulo a prime only, so that points found with them must be substituted.
    """
    premises = Premises()
    unit, known = premises.take(easy.is_unit()), premises.take(easy.groebner_basis())
    if unit:
        return premises.conclude(quotient_algebra(easy.ring, known, check))
    rows = _Rows(easy.ring, known, [premises.take(easy.normal_form(f)) for f in hard])
    for degree in range(rows.first, rows.first + 12):
        check()
        rows.extend_to(degree, check)
        if len(rows.columns) > _MOST_COLUMNS:
            break
        reduced = rows.reduced_modulo_prime()
        if reduced is None:
            continue
        pivots, chosen = reduced
        basis = rows.basis(pivots)
        if basis is not None and rows.commute(basis, pivots, chosen):
            return premises.conclude(rows.algebra(basis, pivots, chosen, check))
    return Known(None)


class _Rows:
    """Normal forms of monomial multiples of the hard equations modulo the easy ones, up to a degree.

    easy: a Groebner basis; hard: normal forms by it.
    """

    def __init__(self, ring: Ring, easy: Sequence[Polynomial], hard: Sequence[Polynomial]) -> None:
        self.ring = ring
        self.rules: dict[Exponents, Vector] = {}
        for g in easy:
            (head, lead), *tail = _terms(g)
            self.rules[head] = {m: -c / lead for m, c in tail}
        self.forms: dict[Exponents, Vector] = {}
        self.layers: list[list[Exponents]] = [[(0,) * len(self.ring.names)]]
        self.hard = [dict(_terms(f)) for f in hard if f]
        self.degrees = [max(map(sum, f)) for f in self.hard]
        self.first = max(self.degrees, default=1)
        self.multiples: list[dict[Exponents, Vector]] = [{} for _ in self.hard]
        self.degree = 0
        self.bound = 0
        self.primes = random_primes("multiplication", bits=62)
        self.prime = next(self.primes)

    # -- growing -----------------------------------------------------------------------------------

    def extend_to(self, degree: int, check: Check) -> None:
        """Add the monomials and the rows up to a degree."""
        size = len(self.ring.names)
        while len(self.layers) <= degree:
            grown = {(*m[:i], m[i] + 1, *m[i + 1 :]) for m in self.layers[-1] for i in range(size)}
            kept = [m for m in grown if not any(divides(h, m) for h in self.rules)]
            self.layers.append(sorted(kept, key=degrevlex))
        for k, f in enumerate(self.hard):
            for layer in self.layers[: degree - self.degrees[k] + 1]:
                for m in layer:
                    if m not in self.multiples[k]:
                        check()
                        self.multiples[k][m] = self._multiple(k, m, f)
        self.degree = degree

    def _multiple(self, k: int, m: Exponents, f: Vector) -> Vector:
        for i, e in enumerate(m):
            if e:
                return self.times(i, self.multiples[k][(*m[:i], e - 1, *m[i + 1 :])])
        return f

    def times(self, i: int, vector: Vector) -> Vector:
        """The normal form of a variable times a normal form."""
        total: Vector = {}
        for m, c in vector.items():
            for t, d in self.form((*m[:i], m[i] + 1, *m[i + 1 :])).items():
                total[t] = total.get(t, fmpq(0)) + c * d
        return {m: c for m, c in total.items() if c}

    def form(self, m: Exponents) -> Vector:
        """The normal form of a monomial modulo the easy equations."""
        known = self.forms.get(m)
        if known is not None:
            return known
        if m in self.rules:
            found = self.rules[m]
        elif not any(divides(h, m) for h in self.rules):
            found = {m: fmpq(1)}
        else:
            i, rest = self._reducible_part(m)
            found = self.times(i, self.form(rest))
        self.forms[m] = found
        return found

    def _reducible_part(self, m: Exponents) -> tuple[int, Exponents]:
        for i, e in enumerate(m):
            if e:
                rest = (*m[:i], e - 1, *m[i + 1 :])
                if any(divides(h, rest) for h in self.rules):
                    return i, rest
        raise ArithmeticError(f"{m} is a leading monomial that no rule has")

    # -- linear algebra ------------------------------------------------------------------------------

    @property
    def columns(self) -> list[Exponents]:
        """All monomials up to the degree, largest first."""
        return [m for layer in reversed(self.layers[: self.degree + 1]) for m in reversed(layer)]

    def vectors(self) -> Iterator[Vector]:
        """The rows whose multiplier and equation stay within the degree."""
        for multiples in self.multiples:
            yield from multiples.values()

    def reduced_modulo_prime(self) -> tuple[list[Exponents], list[Vector]] | None:
        """Leading monomials of the rows' span modulo a prime, and as many independent rows.

        `None` until all monomials of some degree, the `bound`, are among them.
        """
        columns = self.columns
        vectors = list(self.vectors())
        while _divides_a_denominator(self.prime, vectors):
            self.prime = next(self.primes)
        matrix = _modular(vectors, columns, self.prime)
        echelon, rank = matrix.rref()
        pivots = [columns[next(j for j in range(len(columns)) if echelon[r, j])] for r in range(rank)]
        transposed, _ = matrix.transpose().rref()
        chosen = [vectors[next(j for j in range(len(vectors)) if transposed[r, j])] for r in range(rank)]
        pivot_set = set(pivots)
        for bound in range(self.degree + 1):
            if pivot_set.issuperset(self.layers[bound]):
                self.bound = bound
                return pivots, chosen
        return None

    def basis(self, pivots: Sequence[Exponents]) -> list[Exponents] | None:
        """The monomials that are no pivots, smallest first; `None` where one is not a multiple of another."""
        pivot_set = set(pivots)
        found = [m for layer in self.layers[: self.bound] for m in layer if m not in pivot_set]
        known = set(found)
        for m in found:
            below = [(*m[:i], e - 1, *m[i + 1 :]) for i, e in enumerate(m) if e]
            if below and not any(b in known for b in below):
                return None
        return found

    def commute(
        self, basis: Sequence[Exponents], pivots: Sequence[Exponents], chosen: Sequence[Vector]
    ) -> bool:
        """Whether the multiplication matrices commute modulo the prime."""
        if not basis:
            return True
        prime = self.prime
        left, right = _modular(chosen, pivots, prime), _modular(chosen, basis, prime)
        try:
            solved = left.solve(right)
        except ZeroDivisionError:
            return False
        index = {m: r for r, m in enumerate(pivots)}
        place = {m: k for k, m in enumerate(basis)}
        count = len(basis)
        matrices = []
        for i in range(len(self.ring.names)):
            entries = [0] * (count * count)
            for j, b in enumerate(basis):
                form = self.form((*b[:i], b[i] + 1, *b[i + 1 :]))
                if _divides_a_denominator(prime, [form]):
                    return False
                for m, c in form.items():
                    c_p = int(c.p) * pow(int(c.q), -1, prime)
                    if m in place:
                        entries[place[m] * count + j] += c_p
                        continue
                    for k in range(count):
                        entries[k * count + j] -= c_p * int(solved[index[m], k])
            matrices.append(nmod_mat(count, count, [e % prime for e in entries], prime))
        return all(a * b == b * a for k, a in enumerate(matrices) for b in matrices[:k])

    def algebra(
        self, basis: Sequence[Exponents], pivots: Sequence[Exponents], chosen: Sequence[Vector], check: Check
    ) -> Algebra | None:
        """The multiplication matrices over Q; `None` where a rewriting rule holds modulo the prime only."""
        check()
        count = len(basis)
        index = {m: r for r, m in enumerate(pivots)}
        place = {m: k for k, m in enumerate(basis)}
        pivots_and_basis = {*pivots, *basis}
        targets = [*basis, *(m for m in self.columns if m not in pivots_and_basis)]
        solved = _solved(chosen, pivots, targets)
        low = [index[m] for m in pivots if sum(m) <= self.bound]
        if any(solved[r, k] for r in low for k in range(count, len(targets))):
            return None
        matrices = []
        for i in range(len(self.ring.names)):
            matrix = fmpq_mat(count, count)
            for j, b in enumerate(basis):
                check()
                for m, c in self.form((*b[:i], b[i] + 1, *b[i + 1 :])).items():
                    if m in place:
                        matrix[place[m], j] += c
                    else:
                        for k in range(count):
                            matrix[k, j] -= c * solved[index[m], k]
            matrices.append(matrix)
        one = fmpq_mat(count, 1)
        if count:
            one[0, 0] = fmpq(1)
        return Algebra(self.ring, tuple(matrices), one)


def _terms(polynomial: Polynomial) -> list[tuple[Exponents, fmpq]]:
    return [(tuple(map(int, m)), c) for m, c in polynomial.terms()]


def _divides_a_denominator(prime: int, vectors: Sequence[Vector]) -> bool:
    return any(int(c.q) % prime == 0 for vector in vectors for c in vector.values())


def _modular(vectors: Sequence[Vector], columns: Sequence[Exponents], prime: int) -> nmod_mat:
    place = {m: j for j, m in enumerate(columns)}
    entries = [0] * (len(vectors) * len(columns))
    for r, vector in enumerate(vectors):
        for m, c in vector.items():
            if m in place:
                entries[r * len(columns) + place[m]] = int(c.p) * pow(int(c.q), -1, prime) % prime
    return nmod_mat(len(vectors), len(columns), entries, prime)


def _solved(chosen: Sequence[Vector], pivots: Sequence[Exponents], targets: Sequence[Exponents]) -> fmpq_mat:
    """What each pivot monomial is, up to sign, in the target monomials, by the independent rows."""
    if not pivots or not targets:
        return fmpq_mat(len(pivots), len(targets))
    scales = [lcm(*(int(c.q) for c in vector.values())) for vector in chosen]
    left, right = fmpq_mat(len(chosen), len(pivots)), fmpq_mat(len(chosen), len(targets))
    for matrix, columns in ((left, pivots), (right, targets)):
        place = {m: j for j, m in enumerate(columns)}
        for r, (vector, scale) in enumerate(zip(chosen, scales, strict=True)):
            for m, c in vector.items():
                if m in place:
                    matrix[r, place[m]] = c * scale
    return left.solve(right)
