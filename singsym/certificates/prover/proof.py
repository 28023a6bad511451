"""The proof of a table: the configuration space taken apart until the types of each part are known.

Source: Zlatanov, Fenton, Benhabib (1998), section 3.2: loci of (4) and (5) first, then those of further
minors.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from itertools import combinations
from math import comb
from typing import Any

from flint import fmpq, fmpq_mpoly

from singsym.certificates.checker.curves import components
from singsym.certificates.checker.polynomials import Rejected, remainder
from singsym.certificates.checker.ranks import bounds_on, possible_types
from singsym.certificates.checker.rules import derive
from singsym.certificates.checker.sets import RealSet, Statement
from singsym.certificates.checker.strata import dimension_above
from singsym.certificates.prover.boxes import point_leaf
from singsym.certificates.prover.finite import points_leaf
from singsym.certificates.prover.loops import curve_leaf
from singsym.certificates.prover.traced_basis import traced_basis
from singsym.certificates.prover.tree import Node, Tree
from singsym.certificates.prover.unit_products import open_factors, product_of_units, unit_form
from singsym.effort.attempts import attempt
from singsym.effort.budget import Undecided, current
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Polynomial, Ring
from singsym.polynomials.sums_of_squares import squares_less_constant
from singsym.varieties.decomposition import decompose
from singsym.varieties.real.proofs.real_consequences import combined

PART, WHOLE = 60.0, 600.0
"""Seconds of work for one part of the configuration space, and for all of it."""
HIGHEST_POWER = 4
MOST_MINORS = 400


@dataclass(frozen=True)
class Hints:
    """What is known beforehand, none of it as a proof.

    loci: polynomials to split on; products: multiples of determinants, on the configuration space; points:
    numerical configurations; curves: whether components of curves are wanted.
    """

    loci: tuple[fmpq_mpoly, ...] = ()
    products: tuple[fmpq_mpoly, ...] = ()
    points: tuple[tuple[float, ...], ...] = ()
    curves: bool = False


def prove(about: Statement, hints: Hints) -> list[dict[str, Any]]:
    """The lines of a proof; parts on which none is found are left open, with the reason."""
    prover = _Prover(Tree(about), hints)
    prover.attempted(lambda: prover.take_apart(prover.reduced(prover.tree.root), hints.loci), WHOLE)
    closed = {line["at"] for line in prover.tree.lines}
    why = "; ".join(dict.fromkeys(map(str, prover.failures)))
    left = [number for number in range(prover.tree.numbers + 1) if number not in closed]
    return [*prover.tree.lines, *({"at": number, "rule": "open", "why": why} for number in left)]


@dataclass
class _Prover:
    """A proof under way; failures: why parts are left open."""

    tree: Tree
    hints: Hints
    failures: list[Undecided] = field(default_factory=list)

    def attempted(self, work: Callable[[], int | None], most: float = PART) -> int | None:
        """Do what may not end in time, for a number; None where parts of what it was for stay open."""
        with attempt("a certificate", most, failures=self.failures):
            try:
                return work()
            except Rejected as error:
                raise Undecided(f"the checker would not follow: {error}") from None
        return None

    def reduced(self, node: Node) -> Node:
        """The set with a smaller matrix: passive columns go with pivots that are products of units."""
        while (found := _pivot(node.at)) is not None:
            (node,) = self.tree.apply(node, "pivot", **found)
        return node

    def take_apart(self, node: Node, loci: Sequence[fmpq_mpoly]) -> None:
        """A set split on loci in turn."""
        for k, locus in enumerate(loci):
            by = remainder(locus, node.at.equations)
            if not by or product_of_units(by, node.at) is not None:
                continue
            split = self._split(node, by, loci[k + 1 :])
            if split is None:
                return
            node = split
        self.attempted(lambda: self._ranked(node))

    def _split(self, node: Node, by: fmpq_mpoly, loci: Sequence[fmpq_mpoly]) -> Node | None:
        """What is left of a set off the zeros of a polynomial, which are dealt with; None if it is empty."""
        zero, rest = self.tree.apply(node, "split", by=str(by))
        dimension = self.attempted(lambda: self._on_locus(zero, loci))
        # each component of complex zeros has at least this dimension (Krull)
        least = len(node.at.variables) - len(node.at.generators)
        if dimension is not None and dimension < least and (node.full or _has_zeros(node.at)):
            return replace(rest, full=True)
        return self._unless_empty(rest)

    def _on_locus(self, node: Node, loci: Sequence[fmpq_mpoly]) -> int:
        """A set with one more equation; its dimension over the complex numbers."""
        node = self._based(node)
        dimension = dimension_above(node.at)
        self._on_basis(node, loci)
        return dimension

    def _on_basis(self, node: Node, loci: Sequence[fmpq_mpoly]) -> None:
        """A set with a Groebner basis among its equations."""
        left = self._unless_empty(node)
        if left is None:
            return
        if terms := _squares(left.at):
            (more,) = self.tree.apply(left, "squares", terms=terms)
            self._on_locus(more, loci)
        elif dimension_above(left.at) == 0:
            self.tree.leaf(left, "points", **points_leaf(left.at))
        else:
            self.take_apart(left, loci)

    def _based(self, node: Node) -> Node:
        """The set with a Groebner basis among its equations."""
        if _is_based(node):
            return node
        (found,) = self.tree.apply(node, "derive", **_basis_steps(node.at, node.based))
        return replace(found, based=len(found.at.equations), full=node.full)

    def _unless_empty(self, node: Node) -> Node | None:
        """A set, None where it is seen to be empty; then it is closed."""
        if node.full:
            return node
        at = node.at
        for place, equation in enumerate(at.equations):
            if equation and equation.is_constant():
                self.tree.leaf(node, "empty", equation=place)
                return None
        ways = [[place] for place in range(len(at.units))]
        ways += [list(range(len(at.units)))] if len(at.units) > 1 else []
        for way in ways:
            product = at.context.constant(1)
            for power in range(1, HIGHEST_POWER + 1):
                for place in way:
                    product = remainder(product * at.units[place], at.equations)
                if not product:
                    data = {"polynomial": "1", "units": way * power, "power": 1}
                    (node,) = self.tree.apply(node, "cancel", **data)
                    self.tree.leaf(node, "empty", equation=len(node.at.equations) - 1)
                    return None
        return replace(node, full=_is_based(node))

    # -- ranks ---------------------------------------------------------------------------------------

    def _ranked(self, node: Node) -> None:
        """A leaf with the ranks of a set, or the set split where a minor vanishes."""
        left = self._unless_empty(self._based(node))
        if left is not None:
            self._ranked_on_basis(left)

    def _ranked_on_basis(self, node: Node) -> None:
        """The same of a set with points, with a Groebner basis among its equations."""
        at, evidence = node.at, dict[str, list[dict[str, Any]]]()
        for name, exact in _questions(at, self.tree.about):
            if len(self._types(at, evidence)) == 1:
                break
            found = self._rank(at, name, exact)
            if isinstance(found, dict):
                evidence.setdefault(name, []).append(found)
            else:
                rest = self._split(node, found, ())
                if rest is not None:
                    self._ranked(rest)
                return
        types = self._types(at, evidence)
        if not types:
            raise Undecided("the rank of a matrix is not seen to be at most N")
        data: dict[str, Any] = {"ranks": evidence}
        if types != {""}:
            data |= self._shown(at)
            lacks_curve = self._counts_curve(at) and "curve" not in data
            if ("point" not in data or lacks_curve) and self._along_components(node, "point" in data):
                return
        self.tree.leaf(node, "ranks", **data)

    def _shown(self, at: RealSet) -> dict[str, Any]:
        """`point` and `curve` of a set, as far as they are found."""
        point = point_leaf(at, self.hints.points)
        if point is None:
            return {}
        shown = {"point": point[0]}
        if point[1] == 1 and self._counts_curve(at):
            # refused where a loop is not in the set: a unit vanishes on a component
            with attempt("components of a curve", PART, failures=self.failures), suppress(Rejected):
                if (curve := curve_leaf(at, point[0], based)) is not None:
                    components(at, curve, point[0])
                    shown["curve"] = curve
        return shown

    def _counts_curve(self, at: RealSet) -> bool:
        return self.hints.curves and dimension_above(at) == 1

    def _along_components(self, node: Node, apart: bool) -> bool:
        """A set split on what vanishes on a component, but not on all of it; False where there is nothing.

        Where equations hold with multiplicity, or there are more components, their gradients are dependent.
        apart: only if no two components meet; otherwise the components of what is split are not counted, as a
        table counts those of the set as it was.
        """
        at, ring, hints = node.at, Ring(node.at.variables), self.hints
        equations, units = ([Polynomial(ring, p) for p in group if p] for group in (at.equations, at.units))
        parts = decompose(equations, units, ring=ring).value
        meet = not all((a.ideal + b.ideal).is_unit().value for a, b in combinations(parts, 2))
        lists = [[g.value for g in p.generators if remainder(g.value, at.equations)] for p in parts]
        new = sorted(next(filter(None, lists), []), key=len)
        if not new or (apart and meet):
            return False
        self.hints = replace(hints, curves=hints.curves and not meet)
        try:
            rest = self._split(node, new[0], new[1:])
            if rest is not None:
                self._ranked(rest)
        finally:
            self.hints = hints
        return True

    def _types(self, at: RealSet, evidence: Mapping[str, Any]) -> frozenset[str]:
        """The types that are left; none where a rank is not seen to be at most N yet."""
        try:
            return possible_types(bounds_on(at, self.tree.about, evidence), self.tree.about.n)
        except Rejected:
            return frozenset()

    def _rank(self, at: RealSet, name: str, exact: bool) -> dict[str, Any] | fmpq_mpoly:
        """Evidence for the rank of a matrix on a set, or a polynomial to split on.

        exact: the rank itself, not only whether it is full.
        """
        columns = at.columns_of(name)
        rows = [[remainder(row[j], at.equations) for j in columns] for row in at.matrix]
        most = min(len(rows), len(columns))
        for size in range(most, 0, -1):
            left: list[list[fmpq_mpoly]] = []
            for own, chosen, block in _blocks(rows, size):
                form = unit_form(block, at, self.hints.products)
                if form is not None:
                    full = {} if size == most else {"exact": True}
                    return {"rows": own, "columns": chosen, **form, **full}
                if factors := open_factors(block, at, self.hints.products):
                    left.append(factors)
            if left:
                return min(left, key=lambda own: (len(own), len(own[0])))[0]
            if not exact:
                return {"below": size}
        return {"below": 1}


def _is_based(node: Node) -> bool:
    """Whether the equations of a set hold a Groebner basis of their ideal."""
    return node.based == len(node.at.equations)


def _basis_steps(at: RealSet, known: int) -> dict[str, Any]:
    """The rule `derive` to a Groebner basis, and the equations there are where they are not all of it.

    known: so many of the first equations may hold a basis of their own ideal.
    """
    own = Ring(at.variables)
    ideal = Ideal(own, [Polynomial(own, e) for e in at.equations if e])
    target = [tuple(map(int, m)) for m in ideal.leading_monomials().value]
    found = traced_basis(at.equations, current(), target, known)
    if {*target} - {tuple(map(int, e.monomial(0))) for e in found.basis}:
        found = traced_basis(at.equations, current(), target)
    is_unit = bool(found.basis) and found.basis[0].is_constant()
    kept = [] if is_unit else [k for k in range(len(at.equations)) if k not in found.equations]
    return {"steps": found.steps, "equations": [*kept, *found.equations]}


def _has_zeros(at: RealSet) -> bool:
    """Whether the equations of a set that excludes nothing have complex zeros."""
    own = Ring(at.variables)
    return not at.units and Ideal(own, [Polynomial(own, e) for e in at.equations if e]).dimension.value >= 0


def _squares(at: RealSet) -> list[list[str]]:
    """Weights and polynomials whose squares add up to zero on a set, where not all vanish there anyway."""
    ring = Ring(at.variables)
    for f in combined([Polynomial(ring, g) for g in at.generators if g]):
        _, squares, less = squares_less_constant(f) or (0, (), fmpq(1))
        terms = [*squares, *([(-less, ring.one)] if less < 0 else [])]
        if less <= 0 and any(remainder(root.value, at.equations) for _, root in terms):
            return [[str(weight), str(root)] for weight, root in terms]
    return []


def based(at: RealSet, known: int = 0) -> tuple[RealSet, dict[str, Any]]:
    """The set with a Groebner basis, and the steps to it; known: as `_basis_steps` has it."""
    steps = _basis_steps(at, known)
    return derive(at, steps)[0], steps


def _questions(at: RealSet, about: Statement) -> Iterator[tuple[str, bool]]:
    """The ranks in the order in which they are asked for, and whether exactly."""
    if len(at.matrix) > about.N - at.eliminated:
        yield "L", True
    yield from (("L_I", False), ("L_O", False), ("L", True), ("L_p", True), ("L_I", True), ("L_O", True))


def _blocks(
    rows: Sequence[Sequence[fmpq_mpoly]], size: int
) -> Iterator[tuple[list[int], list[int], list[list[fmpq_mpoly]]]]:
    """The square blocks of a size, with their rows and columns; raises `Undecided` where there are many."""
    width = len(rows[0]) if rows else 0
    if comb(len(rows), size) * comb(width, size) > MOST_MINORS:
        raise Undecided(f"a matrix has more than {MOST_MINORS} minors of size {size}")
    for own in combinations(range(len(rows)), size):
        for columns in combinations(range(width), size):
            yield list(own), list(columns), [[rows[i][j] for j in columns] for i in own]


def _pivot(at: RealSet) -> dict[str, Any] | None:
    """The pivot in a passive column that leaves the fewest entries, constants first."""
    best: tuple[tuple[int, ...], dict[str, Any]] | None = None
    for j in (j for j, role in enumerate(at.roles) if role == "passive"):
        below = [i for i, row in enumerate(at.matrix) if row[j]]
        for i in below:
            row = at.matrix[i]
            entry = row[j]
            cost = (len(below) - 1) * (sum(map(bool, row)) - 1)
            key = (int(not entry.is_constant()), cost, sum(map(len, row)))
            if (best is None or key < best[0]) and (form := product_of_units(entry, at)) is not None:
                best = key, {"row": i, "column": j, **form}
    return None if best is None else best[1]
