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

from flint import fmpq_mpoly

from singsym.certificates.checker.curves import components
from singsym.certificates.checker.polynomials import Rejected, determinant, remainder
from singsym.certificates.checker.ranks import bounds_on, possible_types
from singsym.certificates.checker.sets import RealSet, Statement
from singsym.certificates.checker.strata import dimension_above
from singsym.certificates.checker.table import Finding
from singsym.certificates.prover.bases import based, basis_steps, has_zeros, is_based
from singsym.certificates.prover.boxes import point_leaf, seems_in
from singsym.certificates.prover.dimensions import dimension_leaf
from singsym.certificates.prover.finite import points_leaf
from singsym.certificates.prover.loops import all_zeros, curve_leaf
from singsym.certificates.prover.passive_columns import mixed_rows, pivot
from singsym.certificates.prover.tree import Node, Tree
from singsym.certificates.prover.unit_products import (
    LONGEST_PRODUCT,
    cancelled,
    factors,
    open_factors,
    product_of_units,
    unit_form,
    units_of,
)
from singsym.certificates.prover.vanishing_squares import vanishing_squares
from singsym.effort.attempts import attempt
from singsym.effort.budget import Undecided
from singsym.elimination.ideal import intersection
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.decomposition import decompose

PART, WHOLE, EMPTY, BASIS = 60.0, 600.0, 5.0, 5.0
"""Seconds of work for one part of the configuration space, for all of it, to see that a set is empty, and for
a basis without which there may be a way."""
MOST_MINORS = 400


class _TooManyMinors(Undecided):
    """Minors of one size are not all looked at."""


@dataclass(frozen=True)
class Hints:
    """What is known beforehand, none of it as a proof.

    loci: polynomials to split on; products: multiples of determinants, on the configuration space; points:
    numerical configurations; curves: whether components of curves are wanted; columns: passive ones, in the
    order in which they may go.
    """

    loci: tuple[fmpq_mpoly, ...] = ()
    products: tuple[fmpq_mpoly, ...] = ()
    points: tuple[tuple[float, ...], ...] = ()
    curves: bool = False
    columns: tuple[int, ...] = ()


@dataclass(frozen=True)
class Proof:
    """The lines of a proof, and its curves, whose components are counted."""

    lines: list[dict[str, Any]]
    curves: tuple[Finding, ...]


def prove(about: Statement, hints: Hints, seconds: float = WHOLE) -> Proof:
    """A proof; parts on which none is found in so much work are left open, with the reason."""
    prover = _Prover(Tree(about), hints)
    prover.attempted(prover.begin, seconds)
    closed = {line["at"] for line in prover.tree.lines}
    why = "; ".join(dict.fromkeys(map(str, prover.failures)))
    left = [number for number in range(prover.tree.numbers + 1) if number not in closed]
    lines = [*prover.tree.lines, *({"at": number, "rule": "open", "why": why} for number in left)]
    return Proof(lines, tuple(prover.curves))


@dataclass
class _Prover:
    """A proof under way; curves: whose components are counted; failures: why parts are left open."""

    tree: Tree
    hints: Hints
    curves: list[Finding] = field(default_factory=list)
    failures: list[Undecided] = field(default_factory=list)

    def attempted(self, work: Callable[[], int | None], most: float = PART) -> int | None:
        """Do what may not end in time, for a number; None where parts of what it was for stay open."""
        with attempt("a certificate", most, failures=self.failures):
            try:
                return work()
            except Rejected as error:
                raise Undecided(f"the checker would not follow: {error}") from None
        return None

    def begin(self) -> None:
        """The whole configuration space."""
        node = self.reduced(self.tree.root, self.hints.columns)
        self.take_apart(node, self.hints.loci)

    def reduced(self, node: Node, first: Sequence[int] = ()) -> Node:
        """The set with a smaller matrix: passive columns go with pivots that are products of units."""
        while (found := pivot(node.at, first) or mixed_rows(node.at)) is not None:
            (left,) = self.tree.apply(node, "pivot" if "column" in found else "rows", **found)
            if (gone := found.get("column")) is not None:
                first = [j - (j > gone) for j in first if j != gone]
            node = replace(left, full=node.full)
        return node

    def take_apart(self, node: Node, loci: Sequence[fmpq_mpoly]) -> None:
        """A set split on loci in turn."""
        for k, locus in enumerate(loci):
            by = remainder(locus, node.at.equations)
            if not by or product_of_units(by, node.at, units_of(node.at)) is not None:
                continue
            if not is_based(node):
                # factors of determinants as they are
                by = locus
            split = self._split(node, by, loci[k + 1 :])
            if split is None:
                return
            node = split
        if not self._ranked_without_basis(node):
            self.attempted(lambda: self._ranked(node))

    def _split(self, node: Node, by: fmpq_mpoly, loci: Sequence[fmpq_mpoly]) -> Node | None:
        """What is left of a set off the zeros of a polynomial, which are dealt with; None if it is empty."""
        zero, rest = self.tree.apply(node, "split", by=str(by))
        dimension = self.attempted(lambda: self._on_locus(zero, loci))
        # each component of complex zeros has at least this dimension (Krull)
        least = len(node.at.variables) - len(node.at.generators)
        if dimension is not None and dimension < least and (node.full or has_zeros(node.at)):
            return replace(rest, full=True)
        return self._unless_empty(rest)

    def _on_locus(self, node: Node, loci: Sequence[fmpq_mpoly]) -> int | None:
        """A set with one more equation; its dimension over the complex numbers, where its basis is short."""
        node = self._based_if_short(node)
        if not is_based(node):
            self.take_apart(node, loci)
            return None
        dimension = dimension_above(node.at)
        self._on_basis(node, loci)
        return dimension

    def _on_basis(self, node: Node, loci: Sequence[fmpq_mpoly]) -> None:
        """A set with a Groebner basis among its equations."""
        left = self._unless_empty(node)
        if left is None:
            return
        if terms := vanishing_squares(left.at):
            (more,) = self.tree.apply(left, "squares", terms=terms)
            self._on_locus(more, loci)
        elif dimension_above(left.at) == 0:
            self.tree.leaf(left, "points", **points_leaf(left.at))
        else:
            self.take_apart(left, loci)

    def _based(self, node: Node) -> Node:
        """The set with a Groebner basis among its equations."""
        if is_based(node):
            return node
        (found,) = self.tree.apply(node, "derive", **basis_steps(node.at, node.based))
        return replace(found, based=len(found.at.equations), full=node.full)

    def _based_if_short(self, node: Node) -> Node:
        """The same set, with a Groebner basis where one is found in a short time."""
        with attempt("a short basis for a certificate", BASIS):
            return self._based(node)
        return node

    def _unless_empty(self, node: Node) -> Node | None:
        """A set, None where it is seen to be empty; then it is closed."""
        if node.full:
            return node
        at = node.at
        for place, equation in enumerate(at.equations):
            if equation and equation.is_constant():
                self.tree.leaf(node, "empty", equation=place)
                return None
        if seems_in(at, self.hints.points):
            return replace(node, full=is_based(node))
        with attempt("that a set is empty", EMPTY):
            if (found := cancelled(at.context.constant(1), at)) is not None:
                (node,) = self.tree.apply(node, "cancel", polynomial="1", **found)
                self.tree.leaf(node, "empty", equation=len(node.at.equations) - 1)
                return None
        return replace(node, full=is_based(node))

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
            try:
                found = self._rank(at, name, exact)
            except _TooManyMinors:
                # a smaller matrix has fewer, by pivots among the units, or off the zeros of an entry
                if (less := self.reduced(node)) is not node:
                    self._ranked_on_basis(less)
                    return
                if not (entries := _passive_factors(at)):
                    raise
                found = entries[0]
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
            data |= self._shown(at, types)
            lacks_curve = self._counts_curve(at) and "curve" not in data
            if ("point" not in data or lacks_curve) and self._along_components(node):
                return
            if "point" not in data and dimension_above(at) == 1:
                data |= self._curve(at, types, {})
        self.tree.leaf(node, "ranks", **data)

    def _ranked_without_basis(self, node: Node) -> bool:
        """A leaf where the determinants of L_I and L_O, as they are, decide the types; whether it is one.

        Where no loci are known the set is split on their factors instead.
        """
        at, evidence = node.at, dict[str, Any]()
        free = replace(at, equations=())
        units = units_of(free)
        for name in ("L_I", "L_O"):
            rows = at.part(at.matrix, name)
            if is_based(node) or not rows or len(rows) != len(rows[0]):
                return False
            f, every = determinant(rows, []), list(range(len(rows)))
            if (form := product_of_units(f, free, units)) is not None:
                evidence[name] = [{"rows": every, "columns": every, "divisors": [], **form}]
            elif f and (multiple := self._multiple(f, at)) is not None:
                evidence[name] = [{"below": len(rows), "divisors": [], **multiple}]
            elif f and not self.hints.loci and len(f) <= LONGEST_PRODUCT:
                rest = self._split(node, factors(f, units)[0], ())
                if rest is not None:
                    self.take_apart(rest, ())
                return True
        data: dict[str, Any] = {"ranks": evidence}
        if len(types := self._types(at, evidence)) != 1:
            return False
        if types != {""}:
            point = point_leaf(at, self.hints.points)
            bound = None if point is None else dimension_leaf(at, point[1])
            if point is None or bound is None:
                return False
            data |= {"point": point[0], "dimension": bound}
        self.tree.leaf(node, "ranks", **data)
        return True

    def _multiple(self, f: fmpq_mpoly, at: RealSet) -> dict[str, Any] | None:
        """`of` and `by` of a polynomial that is a multiple of an equation more than the statement has."""
        for place, equation in enumerate(at.equations):
            if equation not in self.tree.about.whole.equations:
                quotient, rest = divmod(f, equation)
                if not rest:
                    return {"of": place, "by": str(quotient)}
        return None

    def _shown(self, at: RealSet, types: frozenset[str]) -> dict[str, Any]:
        """`point` and `curve` of a set, as far as they are found."""
        point = point_leaf(at, self.hints.points)
        shown: dict[str, Any] = {} if point is None else {"point": point[0]}
        if point is not None and point[1] == 1 and self._counts_curve(at):
            shown |= self._curve(at, types, point[0])
        return shown

    def _curve(self, at: RealSet, types: frozenset[str], point: Mapping[str, Any]) -> dict[str, Any]:
        """`curve` of a set with a point, or without one where it has no real points, if it is found."""
        # refused where a loop is not in the set: a unit vanishes on a component
        with attempt("components of a curve", PART, failures=self.failures), suppress(Rejected):
            curve = curve_leaf(at, point, based)
            if curve is not None:
                loops = components(at, {**point, **curve})
                own = Finding(at, types, None, 1, 1, loops, line=self.tree.next_line)
                meets = list(self._meetings(own))
                self.curves.append(own)
                return {"curve": curve | ({"meets": meets} if meets else {})}
        return {}

    def _counts_curve(self, at: RealSet) -> bool:
        return self.hints.curves and dimension_above(at) == 1

    def _meetings(self, curve: Finding) -> Iterator[dict[str, Any]]:
        """All points that a curve has in common with others of its types, where tubes overlap."""
        for other in self.curves:
            if other.types == curve.types and other.overlaps(curve):
                zeros = all_zeros(curve.at.within(other.at.equations), based, len(curve.at.equations))
                if zeros is not None:
                    yield {"line": other.line, **zeros}

    def _along_components(self, node: Node) -> bool:
        """A set with all that vanishes on its components, or split on what vanishes on one of them.

        Where equations hold with multiplicity, or there are more components, their gradients are dependent.
        False where there is nothing to do.
        """
        at, ring = node.at, Ring(node.at.variables)
        equations, units = ([Polynomial(ring, p) for p in group if p] for group in (at.equations, at.units))
        parts = decompose(equations, units, ring=ring).value
        closure = intersection(ring, [p.ideal for p in parts]).value
        if (closed := self._with(node, [g.value for g in closure.generators])) is not node:
            self._on_locus(closed, ())
            return True
        lists = [[g.value for g in p.generators if remainder(g.value, at.equations)] for p in parts]
        new = sorted(next(filter(None, lists), []), key=len)
        if not new:
            return False
        rest = self._split(node, new[0], new[1:])
        if rest is not None:
            self._ranked(rest)
        return True

    def _with(self, node: Node, polynomials: Sequence[fmpq_mpoly]) -> Node:
        """The set with more equations: those of which a power times units is seen to be in the ideal."""
        for f in sorted(polynomials, key=len):
            with attempt("that a polynomial vanishes on a set", EMPTY):
                if remainder(f, node.at.equations) and (found := cancelled(f, node.at)) is not None:
                    (node,) = self.tree.apply(node, "cancel", polynomial=str(f), **found)
        return node

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
        rows = [[remainder(e, at.equations) for e in row] for row in at.part(at.matrix, name)]
        most, units = min(len(rows), len(rows[0]) if rows else 0), units_of(at)
        for size in range(most, 0, -1):
            left: list[list[fmpq_mpoly]] = []
            for own, chosen, block in _blocks(rows, size):
                form = unit_form(block, at, self.hints.products, units)
                if form is not None:
                    full = {} if size == most else {"exact": True}
                    return {"rows": own, "columns": chosen, **form, **full}
                if factors := open_factors(block, at, self.hints.products, units):
                    left.append(factors)
            if left:
                return min(left, key=lambda own: (len(own), len(own[0])))[0]
            if not exact:
                return {"below": size}
        return {"below": 1}


def _questions(at: RealSet, about: Statement) -> Iterator[tuple[str, bool]]:
    """The ranks in the order in which they are asked for, and whether exactly."""
    if len(at.matrix) > about.N - at.eliminated:
        yield "L", True
    yield from (("L_I", False), ("L_O", False), ("L", True), ("L_p", True), ("L_I", True), ("L_O", True))


def _blocks(
    rows: Sequence[Sequence[fmpq_mpoly]], size: int
) -> Iterator[tuple[list[int], list[int], list[list[fmpq_mpoly]]]]:
    """The square blocks of a size without rows or columns of zeros; raises `_TooManyMinors`."""
    height = [i for i, row in enumerate(rows) if any(row)]
    width = [j for j, column in enumerate(zip(*rows, strict=True)) if any(column)]
    if comb(len(height), size) * comb(len(width), size) > MOST_MINORS:
        raise _TooManyMinors(f"a matrix has more than {MOST_MINORS} minors of size {size}")
    for own in combinations(height, size):
        for columns in combinations(width, size):
            yield list(own), list(columns), [[rows[i][j] for j in columns] for i in own]


def _passive_factors(at: RealSet) -> list[fmpq_mpoly]:
    """Factors of passive entries that are not known to vanish nowhere on a set, short ones first."""
    passive = [j for j, role in enumerate(at.roles) if role == "passive"]
    entries = [remainder(row[j], at.equations) for row in at.matrix for j in passive]
    units = units_of(at)
    found = (factor for entry in entries for factor in factors(entry, units))
    return sorted(found, key=lambda f: (len(f), f.total_degree(), str(f)))
