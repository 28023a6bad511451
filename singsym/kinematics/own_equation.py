"""A velocity equation of one's own: L and the loop equations as SymPy objects.

Source: Zlatanov, Fenton, Benhabib (1998), (1): any L(q) with L m = 0 if and only if m is feasible will do.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence, Set
from dataclasses import dataclass, field, replace
from typing import Any

import sympy

from singsym.kinematics.dimensions import Dimensions
from singsym.kinematics.placement import ConfigurationSpace
from singsym.kinematics.velocity import Column, Role, VelocityEquation
from singsym.mechanism.model import Parameter
from singsym.polynomials import PolynomialMatrix


@dataclass(frozen=True)
class SymbolicSpace:
    """A configuration space as SymPy expressions, polynomial but for sines and cosines of symbols.

    equations: expressions that vanish; exclusions: groups that must not vanish together.
    positive, nonnegative: p > 0, p >= 0.
    variables: the configuration variables in the order wanted, by default all symbols, sorted.
    parameters: names, or `Parameter` with a range.
    points: coordinates of the named points of space, 2 (planar) or 3.
    """

    equations: Sequence[Any] = ()
    exclusions: Sequence[Sequence[Any]] = ()
    positive: Sequence[Any] = ()
    nonnegative: Sequence[Any] = ()
    variables: Sequence[str] = ()
    parameters: Sequence[str | Parameter] = ()
    points: Mapping[str, Sequence[Any]] = field(default_factory=dict)


def from_sympy(
    L: sympy.MatrixBase, columns: Sequence[tuple[str, Role]], space: SymbolicSpace, n: int | None = None
) -> VelocityEquation:
    """A velocity equation from L and the configuration space.

    L: N rows or more, N + n columns; columns: (label, role) each, roles output, input, passive.
    Entries are polynomial in the variables, in parameters, and in exact real numbers such as sqrt(3); the
        sine and cosine of a symbol t become variables c_t, s_t with c_t^2 + s_t^2 = 1.
    n: the mobility, by default the number of inputs.
    Raises `ValueError` where shapes do not fit or an entry is no polynomial.

    >>> t = sympy.Symbol("t")
    >>> L = sympy.Matrix([[1, -sympy.sin(t)]])
    >>> from_sympy(L, [("T", "output"), ("A", "input")], SymbolicSpace())
    VelocityEquation(1x2, N=1, n=1)
    """
    mobility = _mobility(L, columns, n)
    given = _Given()
    rows = [given.read_all(L.row(i)) for i in range(L.rows)]
    read = _read(space, given)
    ranged = [p if isinstance(p, Parameter) else Parameter(p) for p in space.parameters]
    dimensions = Dimensions.of_expressions(given.seen, ranged)
    fixed = {p.name for p in ranged}
    _check_polynomial(dimensions, fixed)
    free = {s.name for e in (*given.seen, *read.equations) for s in e.free_symbols} - fixed
    ring = dimensions.ring(_ordered(free, space.variables))
    configurations = ConfigurationSpace(
        ring,
        (*dimensions.vector(ring, read.equations), *dimensions.relations(ring)),
        tuple(dimensions.vector(ring, group) for group in read.exclusions),
        (*dimensions.vector(ring, read.positive), *dimensions.positive(ring)),
        (*dimensions.vector(ring, read.nonnegative), *dimensions.nonnegative(ring)),
        parameters=dimensions.parameters,
        points={name: dimensions.vector(ring, xs) for name, xs in read.points.items()},
        formulation="given",
    )
    matrix = PolynomialMatrix.of(ring, [dimensions.vector(ring, row) for row in rows], len(columns))
    labels = tuple(f"row {i}" for i in range(1, len(rows) + 1))
    found = tuple(Column(label, role) for label, role in columns)
    return VelocityEquation(configurations, matrix, found, labels, len(columns) - mobility, mobility)


def _read(space: SymbolicSpace, given: _Given) -> SymbolicSpace:
    """The same space without sines and cosines, with the circles on which these are."""
    read = replace(
        space,
        equations=given.read_all(space.equations),
        exclusions=[given.read_all(group) for group in space.exclusions],
        positive=given.read_all(space.positive),
        nonnegative=given.read_all(space.nonnegative),
        points={name: given.read_all(xs) for name, xs in space.points.items()},
    )
    circles = [c**2 + s**2 - 1 for c, s in given.angles.values()]
    return replace(read, equations=[*read.equations, *circles])


def _check_polynomial(dimensions: Dimensions, parameters: Set[str]) -> None:
    """Raises where a root or a quotient is of more than parameters."""
    for auxiliary in dimensions.auxiliaries:
        if not {s.name for s in auxiliary.base.free_symbols} <= parameters:
            raise ValueError(
                f"a root or a quotient of {auxiliary.base}: L and the equations must be polynomial"
            )


def _ordered(symbols: Set[str], wanted: Sequence[str]) -> tuple[str, ...]:
    """The configuration variables: those wanted, of which no symbol may be missing, or else all, sorted."""
    missing = sorted(symbols - set(wanted)) if wanted else []
    if missing:
        raise ValueError(
            f"the symbols {missing} are neither among the variables {tuple(wanted)} nor parameters"
        )
    return tuple(wanted) or tuple(sorted(symbols))


def _mobility(L: sympy.MatrixBase, columns: Sequence[tuple[str, Role]], n: int | None) -> int:
    """n, checked against the shape of L and the roles of its columns."""
    if L.shape[1] != len(columns):
        raise ValueError(f"L has {L.shape[1]} columns, but {len(columns)} labels were given: one for each")
    wrong = sorted({str(role) for _, role in columns} - {"output", "input", "passive"})
    if wrong:
        raise ValueError(f"roles {wrong}: expected output, input or passive")
    inputs = sum(role == "input" for _, role in columns)
    outputs = sum(role == "output" for _, role in columns)
    mobility = inputs if n is None else n
    if inputs != mobility or outputs != mobility:
        raise ValueError(f"{inputs} inputs and {outputs} outputs, expected {mobility} of each (the mobility)")
    return mobility


class _Given:
    """Reads expressions, replacing sines and cosines of symbols; keeps what it has seen."""

    def __init__(self) -> None:
        self.angles: dict[sympy.Symbol, tuple[sympy.Symbol, sympy.Symbol]] = {}
        self.seen: list[Any] = []

    def read(self, entry: Any) -> Any:
        """The entry, polynomial in c_t, s_t for every angle t in it."""
        expression = sympy.sympify(entry, strict=True)
        if expression.has(sympy.sin, sympy.cos) and expression.free_symbols:
            expression = sympy.expand_trig(expression)
            circular = sorted(expression.atoms(sympy.sin, sympy.cos), key=str)
            replaced = {f: self._angle(f) for f in circular if f.free_symbols}
            expression = expression.xreplace(replaced)
        self.seen.append(expression)
        return expression

    def read_all(self, entries: Iterable[Any]) -> list[Any]:
        """Several entries, one after the other."""
        return [self.read(entry) for entry in entries]

    def _angle(self, f: Any) -> sympy.Symbol:
        t = f.args[0]
        if not t.is_Symbol:
            raise ValueError(f"{f}: sines and cosines are taken of symbols, their sums and whole multiples")
        names = (sympy.Symbol(f"c_{t.name}"), sympy.Symbol(f"s_{t.name}"))
        return self.angles.setdefault(t, names)[0 if isinstance(f, sympy.cos) else 1]
