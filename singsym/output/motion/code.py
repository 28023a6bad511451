"""Stand-alone code of a linkage's L, conditions and closed-form assemblies, in Python or C, for a controller.

Source: common subexpressions and printers of SymPy (https://docs.sympy.org, sympy.simplify.cse_main,
sympy.printing).
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy
from sympy.printing.c import C99CodePrinter
from sympy.printing.pycode import PythonCodePrinter

from singsym.kinematics.velocity import VelocityEquation
from singsym.mechanism.problems import MechanismError
from singsym.motion.arithmetic import Arithmetic, Array
from singsym.motion.forward import Forward
from singsym.motion.numeric import NumericLinkage
from singsym.polynomials import Polynomial

LANGUAGES = ("python", "c")
"""What code can be written in."""


@dataclass(frozen=True)
class _Function:
    """A function from an array to a list of numbers: assignments in order, then the results.

    arguments: name and length of each array that it takes; is_polynomial: whether it has a value everywhere.
    """

    name: str
    words: str
    arguments: tuple[tuple[str, int], ...]
    assignments: tuple[tuple[sympy.Symbol, sympy.Expr], ...]
    results: tuple[sympy.Expr, ...]
    is_polynomial: bool = True

    @property
    def symbols(self) -> set[sympy.Symbol]:
        """All that are read."""
        expressions = (*(e for _, e in self.assignments), *self.results)
        return {s for e in expressions for s in e.free_symbols}


def code(equation: VelocityEquation, language: str, name: str) -> str:
    """A file with the loop equations, L, the factors of (4) and (5), and the assemblies over the inputs.

    language: one of `LANGUAGES`; name: of the mechanism.  Symbolic parameters are arguments.  Conditions that
    are no products of polynomials, and assemblies that have no closed form, as where there are parameters,
    are left out and named.

    >>> from singsym.kinematics.velocity import velocity_equation
    >>> from singsym.mechanism import load
    >>> text = code(velocity_equation(load("fourbar")), "python", "fourbar")
    >>> there = {}
    >>> exec(text, there)
    >>> there["VARIABLES"]
    ('Bx', 'By', 'Cx', 'Cy')
    """
    linkage = NumericLinkage(equation, Arithmetic())
    names = _variables(equation)
    functions = [
        _of_polynomials(equation, "loops", "What is left of the loop equations.", equation.space.equations),
        _of_polynomials(
            equation,
            "L",
            f"L row by row, {equation.matrix.shape[0]} x {equation.matrix.shape[1]}, "
            f"columns {', '.join(c.label for c in equation.columns)}.",
            [e for row in equation.matrix.rows for e in row],
        ),
    ]
    functions = [function for function in functions if function.results]
    remarks = []
    for label, matrix in (("4", "L_I"), ("5", "L_O")):
        try:
            factors = linkage.factors(label)
        except MechanismError as error:
            remarks.append(f"Condition ({label}) is left out: {error.problems[0]}")
            continue
        if not factors:
            remarks.append(f"Condition ({label}) holds nowhere: {matrix} is never singular.")
            continue
        said = "; ".join(f.words or f.polynomial.short_text(3) for f in factors)
        words = f"Factors of det {matrix}, which is singular where one is zero: {said}."
        functions.append(
            _of_polynomials(equation, f"condition_{label}", words, [f.polynomial for f in factors])
        )
    try:
        functions.append(_of_assemblies(linkage, names))
    except MechanismError as error:
        remarks.append(f"The configuration over the inputs is left out: {error.problems[0]}")
    head = [f"{name}: loop equations, L and singularity conditions, written by singsym."]
    head += [f"The variables are {', '.join(names)}; lengths in the mechanism's unit, angles in radians."]
    if equation.space.parameters:
        head += [f"The parameters are {', '.join(equation.space.parameters)}."]
    if language == "c":
        return _c([*head, *remarks], functions, name)
    return _python(
        [*head, *remarks], {"VARIABLES": names, "PARAMETERS": equation.space.parameters}, functions
    )


def _variables(equation: VelocityEquation) -> tuple[str, ...]:
    """The names that are neither constants nor parameters."""
    others = {*(c.name for c in equation.space.ring.constants), *equation.space.parameters}
    return tuple(n for n in equation.space.ring.names if n not in others)


def _of_polynomials(
    equation: VelocityEquation, name: str, words: str, polynomials: Sequence[Polynomial]
) -> _Function:
    groups = {"q": _variables(equation), "parameters": equation.space.parameters}
    symbols = {
        sympy.Symbol(name): sympy.Symbol(f"{argument}[{k}]")
        for argument, names in groups.items()
        for k, name in enumerate(names)
    }
    expressions = [p.to_sympy().xreplace(symbols) for p in polynomials]
    shared, results = sympy.cse(expressions, symbols=sympy.numbered_symbols("t"), order="none")
    arguments = tuple((argument, len(names)) for argument, names in groups.items() if names)
    return _Function(name, words, arguments, tuple(shared), tuple(results))


# -- assemblies --------------------------------------------------------------------------------------


class _Symbolic:
    """Square roots and linear equations in SymPy."""

    def root(self, squares: Array) -> Array:
        """See `singsym.motion.arithmetic.Roots`."""
        return np.asarray(np.frompyfunc(sympy.sqrt, 1, 1)(squares), dtype=object)

    def solved(self, matrices: Array, sides: Array) -> Array:
        """See `singsym.motion.arithmetic.Roots`."""
        return np.array(sympy.Matrix(matrices).LUsolve(sympy.Matrix(sides)), dtype=object).reshape(-1)


def _of_assemblies(linkage: NumericLinkage, names: Sequence[str]) -> _Function:
    """The steps of `singsym.motion.forward`, each in names of its own."""
    solver: Forward = linkage.solver(linkage.inputs)
    ring = solver.system.ring
    known: dict[str, sympy.Expr] = {c.name: c.expression for c in ring.constants}
    for k, drive in enumerate(solver.system.drives):
        given = sympy.Symbol(f"values[{k}]")
        parts = (sympy.cos(given), sympy.sin(given)) if drive.is_angle else (given,)
        known |= dict(zip(drive.names, parts, strict=True))
    assignments: list[tuple[sympy.Symbol, sympy.Expr]] = []
    temporary = sympy.numbered_symbols("t")
    place = 0
    for step in solver.steps:
        at = [known.get(name, sympy.S.Zero) for name in ring.names]
        sign = sympy.Symbol(f"mode[{place}]") if step.has_root else sympy.S.One
        place += step.has_root

        def value(p: Polynomial, at: Sequence[sympy.Expr] = at) -> Array:
            return np.array(sympy.sympify(p.evaluate(at)), dtype=object)

        found = step.solved(value, sign, _Symbolic())
        expressions = [sympy.sympify(np.asarray(x, dtype=object).item()) for x in found]
        shared, results = sympy.cse(expressions, symbols=temporary, order="none")
        assignments += shared
        for name, result in zip(step.unknowns, results, strict=True):
            symbol = next(temporary)
            assignments.append((symbol, result))
            known[name] = symbol
    words = (
        f"The configuration q with these values of the inputs {', '.join(linkage.inputs)}; "
        f"mode: signs 1 or -1 for {'; '.join(solver.roots) or 'nothing'}; not numbers where there is none."
    )
    arguments = (("values", len(solver.system.drives)), ("mode", place))
    results = tuple(known[n] for n in names)
    return _Function("configuration", words, arguments, tuple(assignments), results, is_polynomial=False)


# -- printing ----------------------------------------------------------------------------------------


class _Python(PythonCodePrinter):  # type: ignore[misc]
    """Python that needs the module `math` alone."""


class _C(C99CodePrinter):  # type: ignore[misc]
    """C99 with small powers as products."""

    def _print_Pow(self, expr: Any) -> str:
        if expr.exp.is_Integer and 2 <= expr.exp <= 4:
            return "*".join([self.parenthesize(expr.base, 100)] * int(expr.exp))
        return str(super()._print_Pow(expr))


def _python(head: Sequence[str], names: Mapping[str, Sequence[str]], functions: Sequence[_Function]) -> str:
    printer = _Python({"fully_qualified_modules": True})
    first, *others = map(_quotable, head)
    lines = [f'"""{first}', *others, '"""', "", "import math", ""]
    lines += [f"{title} = {tuple(own)!r}" for title, own in names.items() if own]
    for function in functions:
        arguments = ", ".join(argument for argument, _ in function.arguments)
        lines += ["", "", f"def {function.name}({arguments}):", f'    """{_quotable(function.words)}"""']
        body = [f"{symbol} = {printer.doprint(e)}" for symbol, e in function.assignments]
        body += ["return [", *(f"    {printer.doprint(e)}," for e in function.results), "]"]
        if not function.is_polynomial:
            failed = [
                "except (ValueError, ZeroDivisionError):",
                f"    return [math.nan] * {len(function.results)}",
            ]
            body = ["try:", *(f"    {line}" for line in body), *failed]
        lines += [f"    {line}" for line in body]
    return "\n".join(lines)


def _c(head: Sequence[str], functions: Sequence[_Function], name: str) -> str:
    printer = _C()
    prefix = re.sub(r"\W", "_", name, flags=re.ASCII)
    prefix = f"linkage_{prefix}" if not prefix[:1].isalpha() else prefix
    lines = ["/* " + "\n   ".join(map(_quotable, head)), "*/", "", "#include <math.h>"]
    for function in functions:
        taken = [f"const double {argument}[{size}]" for argument, size in function.arguments if size]
        arguments = ", ".join([*taken, f"double result[{max(1, len(function.results))}]"])
        lines += [
            "",
            f"/* {_quotable(function.words)} */",
            f"void {prefix}_{function.name}({arguments})",
            "{",
        ]
        used = {str(s).partition("[")[0] for s in function.symbols}
        lines += [
            f"    (void){argument};" for argument, size in function.arguments if size and argument not in used
        ]
        lines += [f"    const double {symbol} = {printer.doprint(e)};" for symbol, e in function.assignments]
        lines += [f"    result[{k}] = {printer.doprint(e)};" for k, e in enumerate(function.results)]
        lines += ["}"]
    return "\n".join(lines)


def _quotable(text: str) -> str:
    """Without what would end a string of Python or a comment of C."""
    return text.replace("\\", "/").replace('"', "'").replace("*/", "* /")
