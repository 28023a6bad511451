"""A velocity equation of one's own: L and the loop equations as SymPy objects.

Source: Zlatanov, Fenton, Benhabib (1998), (1): any L(q) with L m = 0 if and only if m is feasible will do.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import sympy

from singsym.kinematics.dimensions import Dimensions
from singsym.kinematics.placement import ConfigurationSpace
from singsym.kinematics.velocity import Column, Role, VelocityEquation
from singsym.mechanism.model import Parameter
from singsym.polynomials import Polynomial, PolynomialMatrix


def from_sympy(
    L: sympy.MatrixBase,
    columns: Sequence[tuple[str, Role]],
    equations: Iterable[Any],
    *,
    variables: Sequence[str] = (),
    parameters: Sequence[str | Parameter] = (),
    exclusions: Iterable[Sequence[Any]] = (),
    positive: Iterable[Any] = (),
    nonnegative: Iterable[Any] = (),
    points: Mapping[str, Sequence[Any]] | None = None,
    n: int | None = None,
) -> VelocityEquation:
    """A velocity equation from L and the loop equations.

    L: N rows or more, N + n columns; columns: (label, role) each, roles output, input, passive.
    Entries are polynomial in the variables, in parameters, and in exact real numbers such as sqrt(3); the
        sine and cosine of a symbol t become variables c_t, s_t with c_t^2 + s_t^2 = 1.
    equations: expressions that vanish; exclusions: groups that must not vanish together; positive: p > 0.
    variables: in the order wanted, by default all symbols, sorted.
    parameters: names, or `Parameter` with a range.
    Raises `ValueError` where shapes do not fit or an entry is no polynomial.

    >>> t = sympy.Symbol("t")
    >>> from_sympy(sympy.Matrix([[1, -sympy.sin(t)]]), [("T", "output"), ("A", "input")], [])
    VelocityEquation(1x2, N=1, n=1)
    """
    mobility = _mobility(L, columns, n)
    given = _Given()
    rows = [[given.read(L[i, j]) for j in range(L.shape[1])] for i in range(L.shape[0])]
    loops = [given.read(e) for e in equations]
    groups = [[given.read(e) for e in group] for group in exclusions]
    above, least = [given.read(e) for e in positive], [given.read(e) for e in nonnegative]
    places = {name: [given.read(x) for x in xs] for name, xs in (points or {}).items()}
    loops += [c**2 + s**2 - 1 for c, s in given.angles.values()]
    ranged = [p if isinstance(p, Parameter) else Parameter(p) for p in parameters]
    dimensions = Dimensions.of_expressions(given.seen, ranged)
    named = {p.name for p in ranged}
    for auxiliary in dimensions.auxiliaries:
        if not {s.name for s in auxiliary.base.free_symbols} <= named:
            raise ValueError(
                f"a root or a quotient of {auxiliary.base}: L and the equations must be polynomial"
            )
    symbols = {s.name for e in (*given.seen, *loops) for s in e.free_symbols} - named
    missing = sorted(symbols - set(variables)) if variables else []
    if missing:
        raise ValueError(
            f"the symbols {missing} are neither among the variables {tuple(variables)} nor parameters"
        )
    ring = dimensions.ring(tuple(variables) or tuple(sorted(symbols)))

    def polynomials(expressions: Iterable[Any]) -> tuple[Polynomial, ...]:
        return tuple(dimensions.polynomial(ring, e) for e in expressions)

    space = ConfigurationSpace(
        ring,
        (*polynomials(loops), *dimensions.relations(ring)),
        tuple(polynomials(group) for group in groups),
        (*polynomials(above), *dimensions.positive(ring)),
        (*polynomials(least), *dimensions.nonnegative(ring)),
        parameters=dimensions.parameters,
        points={name: polynomials(xs) for name, xs in places.items()},
        formulation="given",
    )
    matrix = PolynomialMatrix.of(ring, [polynomials(row) for row in rows], len(columns))
    labels = tuple(f"row {i}" for i in range(1, len(rows) + 1))
    found = tuple(Column(label, role) for label, role in columns)
    return VelocityEquation(space, matrix, found, labels, len(columns) - mobility, mobility)


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

    def _angle(self, f: Any) -> sympy.Symbol:
        t = f.args[0]
        if not t.is_Symbol:
            raise ValueError(f"{f}: sines and cosines are taken of symbols, their sums and whole multiples")
        names = (sympy.Symbol(f"c_{t.name}"), sympy.Symbol(f"s_{t.name}"))
        return self.angles.setdefault(t, names)[0 if isinstance(f, sympy.cos) else 1]
