"""From the SymPy numbers of a mechanism to polynomials: values put in, ranges kept, irrational numbers exact.

Source: singsym's own; the field of the cosines and Gauss sums: Washington, Introduction to Cyclotomic Fields.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Any

import sympy

from singsym.kinematics.numberfield import Atoms, NumberField, number_field
from singsym.mechanism.couplings import angle_relations, slide_relations
from singsym.mechanism.model import JointKind, Mechanism, Parameter
from singsym.mechanism.problems import MechanismError, Problem
from singsym.polynomials import AlgebraicConstant, Polynomial, Ring


@dataclass(frozen=True)
class Auxiliary:
    """A name for a root (name^index = base) or, index -1, an inverse of an expression in parameters."""

    name: str
    base: sympy.Expr
    index: int


@dataclass(frozen=True)
class Dimensions:
    """The numbers of a mechanism, ready to become polynomials.

    Make one with `Dimensions.of`; then `ring(variables)` and `polynomial(ring, expression)`.

    >>> D = Dimensions.of_expressions([sympy.sqrt(3) / 2])
    >>> R = D.ring(("x",))
    >>> R.names
    ('x', 'sqrt3')
    >>> D.polynomial(R, (sympy.Symbol("x") - sympy.sqrt(3) / 2) ** 2)
    x^2 - x*sqrt3 + 3/4
    """

    ranges: tuple[Parameter, ...] = ()
    values: Mapping[sympy.Symbol, sympy.Expr] = field(default_factory=dict)
    numbers: NumberField = field(default_factory=NumberField)
    auxiliaries: tuple[Auxiliary, ...] = ()

    @classmethod
    def of(cls, mechanism: Mechanism, extra: Iterable[Any] = ()) -> Dimensions:
        """The dimensions of a mechanism; `extra`: further expressions that will be turned into polynomials.

        Needed in `extra` is only what brings new irrational numbers, such as the length of an axis.
        """
        expressions: list[Any] = [*extra]
        for link in mechanism.links:
            for vector in (*link.points.values(), *link.axes.values()):
                expressions.extend(vector)
        expressions.extend(joint.pitch for joint in mechanism.joints if joint.pitch is not None)
        for limit in mechanism.limits:
            expressions.extend((limit.expression, limit.low, limit.high))
        expressions.extend(e.expression for e in mechanism.exclusions)
        expressions.extend(r.constant for r in slide_relations(mechanism))
        expressions.extend(c.lift for c in mechanism.couplings)
        for relation in angle_relations(mechanism):
            expressions.extend((sympy.cos(relation.constant), sympy.sin(relation.constant)))
        for axis in (a for link in mechanism.links for a in link.axes.values()):
            expressions.append(norm(axis))
        expressions.extend(_turned_upright(mechanism))
        return cls.of_expressions(expressions, mechanism.parameters)

    @classmethod
    def of_expressions(cls, expressions: Iterable[Any], parameters: Sequence[Parameter] = ()) -> Dimensions:
        """The dimensions that occur in these expressions (None among them is passed over)."""
        ranges = tuple(p for p in parameters if p.value is None)
        values = _resolved({sympy.Symbol(p.name): p.value for p in parameters if p.value is not None})
        atoms = Atoms()
        roots: dict[tuple[sympy.Expr, int], None] = {}
        bounds = [bound for p in ranges for bound in (p.low, p.high)]
        for expression in (*expressions, *bounds):
            if expression is not None:
                _collect(sympy.sympify(expression, strict=True).xreplace(values), atoms, roots)
        used = {p.name for p in ranges}
        auxiliaries = []
        for base, index in roots:
            stem = "inverse" if index < 0 else "root"
            name = next(
                n for n in (f"{stem}{k}" for k in range(1, len(roots) + len(used) + 2)) if n not in used
            )
            used.add(name)
            auxiliaries.append(Auxiliary(name, base, index))
        return cls(ranges, values, number_field(atoms), tuple(auxiliaries))

    # -- names and rings -------------------------------------------------------------------------

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names of the symbolic dimensions, auxiliary ones included, in the order they have in every ring."""
        return (*(p.name for p in self.ranges), *(a.name for a in self.auxiliaries))

    @property
    def constants(self) -> tuple[AlgebraicConstant, ...]:
        """The irrational numbers that every ring of this mechanism has."""
        return self.numbers.constants

    def ring(self, variables: Sequence[str]) -> Ring:
        """The ring in these configuration variables, then the parameters, then the constants."""
        names = (*variables, *self.parameters, *(c.name for c in self.constants))
        doubled = sorted({n for n in names if names.count(n) > 1})
        if doubled:
            raise ValueError(
                f"{doubled} would be used twice as names of a ring: rename a parameter, a point or a joint"
            )
        return Ring(names, constants=self.constants)

    @cached_property
    def base(self) -> Ring:
        """The ring of the dimensions alone."""
        return self.ring(())

    def names(self) -> VariableNames:
        """A dispenser of variable names that differ from those of the dimensions."""
        return VariableNames({*self.parameters, *(c.name for c in self.constants)})

    # -- conversion ------------------------------------------------------------------------------

    def polynomial(
        self, ring: Ring, expression: Any, symbols: Mapping[str, Polynomial] | None = None
    ) -> Polynomial:
        """The expression as a polynomial of `ring`, reduced modulo the relations of the constants.

        symbols: what a symbol's name stands for, if not for the variable of that name.
        Raises `ValueError` for floats, unknown symbols, and numbers not announced to `of`.
        """
        expression = sympy.sympify(expression, strict=True).xreplace(dict(self.values))
        return ring.reduced(self._convert(ring, expression, symbols or {}))

    def vector(self, ring: Ring, expressions: Iterable[Any]) -> tuple[Polynomial, ...]:
        """Several expressions at once."""
        return tuple(self.polynomial(ring, e) for e in expressions)

    def _convert(self, ring: Ring, e: Any, symbols: Mapping[str, Polynomial]) -> Polynomial:
        if e.is_Rational:
            return ring.constant(_fraction(e))
        if e.is_Symbol:
            if e.name in symbols:
                return symbols[e.name]
            if e.name not in ring.names:
                raise ValueError(f"the symbol {e.name} is neither a parameter nor one of {ring.names}")
            return ring.gen(e.name)
        if e.is_Add:
            return sum((self._convert(ring, a, symbols) for a in e.args), start=ring.zero)
        if e.is_Mul:
            product = ring.one
            for a in e.args:
                product = ring.reduced(product * self._convert(ring, a, symbols))
            return product
        if e.is_Pow and e.exp.is_Integer and e.exp > 0:
            power = self._convert(ring, e.base, symbols) ** int(e.exp)
            return ring.reduced(power)
        return self._atom(ring, e, symbols)

    def _atom(self, ring: Ring, e: Any, symbols: Mapping[str, Polynomial]) -> Polynomial:
        if e.is_number:
            if e.is_Pow and e.exp.is_Rational and e.exp < 0:
                return ring.convert(self.numbers.inverse(self._number(e.base ** (-e.exp))))
            if e.is_Pow and e.exp.is_Rational and e.exp > 1:
                whole = int(e.exp)
                rest = self._convert(ring, e.base ** (e.exp - whole), symbols)
                return ring.reduced(self._convert(ring, e.base, symbols) ** whole * rest)
            if isinstance(e, sympy.tan):
                return self._convert(ring, sympy.sin(e.args[0]) / sympy.cos(e.args[0]), symbols)
            return ring.convert(self.numbers.image(e))
        if e.is_Pow and e.exp.is_Rational:
            numerator, index = int(e.exp.p), int(e.exp.q)
            result = self._convert(ring, e.base, symbols)
            if index > 1:
                result = ring.gen(self._auxiliary(e.base, index))
            if numerator < 0:
                result = ring.gen(
                    self._auxiliary(e.base if index == 1 else e.base ** sympy.Rational(1, index), -1)
                )
            return result ** abs(numerator)
        raise ValueError(f"{e} is not a polynomial in the parameters and exact real numbers")

    def _number(self, e: Any) -> Polynomial:
        ring = self.numbers.ring
        return ring.reduced(ring.convert(self.polynomial(self.base, e)))

    def _auxiliary(self, base: Any, index: int) -> str:
        for auxiliary in self.auxiliaries:
            if auxiliary.index == index and auxiliary.base == base:
                return auxiliary.name
        raise ValueError(f"{base} to the power {index if index < 0 else f'1/{index}'} was not announced")

    # -- questions about dimensions --------------------------------------------------------------

    def is_zero(self, expression: Any) -> bool:
        """Whether the expression is zero identically in the parameters (exact)."""
        return self.polynomial(self.base, expression).is_zero

    def is_positive(self, expression: Any) -> bool:
        """Whether it is certainly positive for all admitted parameters; False where that is not seen."""
        known = {
            sympy.Symbol(p.name): sympy.Symbol(p.name, positive=True)
            for p in self.ranges
            if p.low is not None
            and sympy.sympify(p.low, strict=True).xreplace(dict(self.values)).is_nonnegative
        }
        return bool(
            sympy.sympify(expression, strict=True).xreplace(dict(self.values)).xreplace(known).is_positive
        )

    # -- what the dimensions add to a configuration space ----------------------------------------

    def relations(self, ring: Ring) -> tuple[Polynomial, ...]:
        """Equations that the constants and the auxiliary names obey."""
        found = []
        for a in self.auxiliaries:
            base = self.polynomial(ring, a.base)
            name = ring.gen(a.name)
            found.append(name * base - 1 if a.index < 0 else name**a.index - base)
        return (*ring.relations, *found)

    def positive(self, ring: Ring) -> tuple[Polynomial, ...]:
        """Polynomials > 0 that say the open ranges of the parameters."""
        found = []
        for p in self.ranges:
            if p.low is not None:
                found.append(ring.gen(p.name) - self.polynomial(ring, p.low))
            if p.high is not None:
                found.append(self.polynomial(ring, p.high) - ring.gen(p.name))
        return tuple(found)

    def nonnegative(self, ring: Ring) -> tuple[Polynomial, ...]:
        """Polynomials >= 0 that choose the auxiliary roots of even index."""
        return tuple(ring.gen(a.name) for a in self.auxiliaries if a.index > 0 and a.index % 2 == 0)


class VariableNames:
    """Dispenses names of ring variables: letters, digits and underscores, each once.

    >>> n = VariableNames({"a"})
    >>> n.new("a"), n.new("B'x"), n.new("B'x")
    ('a_', 'B_x', 'B_x_')
    """

    def __init__(self, used: set[str]) -> None:
        self.used = set(used)

    def new(self, wish: str) -> str:
        """The wish, made a word and, where it is taken, longer by underscores."""
        name = "".join(c if c.isascii() and c.isalnum() else "_" for c in wish)
        if not name[:1].isalpha():
            name = f"v{name}"
        while name in self.used:
            name += "_"
        self.used.add(name)
        return name


def norm(vector: Iterable[Any]) -> sympy.Expr:
    """The length of a vector of SymPy numbers.

    >>> norm((sympy.Integer(1), sympy.Integer(1)))
    sqrt(2)
    """
    square = sympy.expand(sympy.Add(*(sympy.sympify(x, strict=True) ** 2 for x in vector)))
    if square.is_number and not square.is_Rational:
        # cos^2 + sin^2 must not become a nested root.
        found = Dimensions.of_expressions((square,))
        value = found.polynomial(found.base, square)
        if value.is_constant:
            square = sympy.Rational(int(value.constant.p), int(value.constant.q))
    return sympy.sqrt(square)


def _fraction(e: Any) -> Fraction:
    return Fraction(int(e.p), int(e.q))


def _resolved(values: dict[sympy.Symbol, sympy.Expr]) -> dict[sympy.Symbol, sympy.Expr]:
    """Fixed parameters may be given through one another; raises `ValueError` on a circle."""
    for _ in range(len(values) + 1):
        settled = {s: sympy.sympify(v, strict=True).xreplace(values) for s, v in values.items()}
        if not any(v.free_symbols & values.keys() for v in settled.values()):
            return settled
        values = settled
    raise ValueError(f"parameters {sorted(map(str, values))} are given through one another in a circle")


def _collect(e: Any, atoms: Atoms, roots: dict[tuple[sympy.Expr, int], None]) -> None:
    """Note the irrational numbers and the roots and inverses of symbols that occur in an expression."""
    if e.is_Float:
        raise ValueError(
            f"the float {e} is not exact: give a rational such as {sympy.nsimplify(e, rational=True)}"
        )
    if e.is_Rational or e.is_Symbol:
        return
    if e.is_Add or e.is_Mul:
        for a in e.args:
            _collect(a, atoms, roots)
        return
    if e.is_Pow and e.exp.is_Rational:
        if e.is_number:
            if e.exp.is_Integer:
                _collect(e.base, atoms, roots)
            else:
                atoms.root(e.base, int(e.exp.q))
            return
        _collect(e.base, atoms, roots)
        root = e.base if e.exp.is_Integer else e.base ** sympy.Rational(1, e.exp.q)
        if not e.exp.is_Integer:
            roots[(e.base, int(e.exp.q))] = None
        if e.exp < 0:
            roots[(root, -1)] = None
        return
    if e.is_number and isinstance(e, (sympy.cos, sympy.sin, sympy.tan)):
        atoms.angle(e)
        return
    if isinstance(e, sympy.CRootOf) and e.is_real:
        atoms.others[e] = None
        return
    raise ValueError(
        f"{e} is not built from rational numbers, parameters, roots, and sin, cos of rational angles"
    )


@dataclass(frozen=True)
class Sized:
    """The numbers of a mechanism in the ring of one formulation of it."""

    dimensions: Dimensions
    ring: Ring

    @property
    def parameters(self) -> tuple[str, ...]:
        """The ring's names that are dimensions."""
        return self.dimensions.parameters

    @property
    def positive(self) -> tuple[Polynomial, ...]:
        """The parameters' open ranges."""
        return self.dimensions.positive(self.ring)

    @property
    def relations(self) -> tuple[Polynomial, ...]:
        """What the constants and auxiliary names obey."""
        return self.dimensions.relations(self.ring)

    def number(self, expression: Any) -> Polynomial:
        """A dimension as a reduced polynomial of the ring."""
        return self.dimensions.polynomial(self.ring, expression)


def _turned_upright(mechanism: Mechanism) -> Iterable[sympy.Expr]:
    """The lengths by which a universal joint's axes, at no right angle in the frames, are brought to one."""
    for joint in mechanism.joints:
        if joint.kind is JointKind.U and joint.axes is not None:
            a = sympy.Matrix(mechanism.link(joint.first).axes[joint.axes[0]])
            b = sympy.Matrix(mechanism.link(joint.second).axes[joint.axes[1]])
            apart = norm(a.cross(b))
            yield norm(sympy.Matrix((1, 0, 0)).cross(a)) if apart == 0 else apart


def dimensions(mechanism: Mechanism, variables: Sequence[str]) -> Sized:
    """The mechanism's numbers in the ring of these configuration variables.

    Raises `MechanismError` where a parameter has the name of a variable or of a number.

    >>> from singsym.mechanism import load
    >>> dimensions(load("fourbar"), ("x",)).ring
    Q[x]
    """
    found = Dimensions.of(mechanism)
    used = {*variables, *(a.name for a in found.auxiliaries), *(c.name for c in found.constants)}
    doubled = [p.name for p in found.ranges if p.name in used]
    if doubled:
        said, expected = "the name of a configuration variable or a number, too", "another name"
        advice = "rename the parameter"
        raise MechanismError(
            Problem(f"parameters.{name}", said, expected, advice, mechanism.origin) for name in doubled
        )
    return Sized(found, found.ring(variables))
