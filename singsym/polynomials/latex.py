"""Polynomials and their variables in LaTeX.

Source: SymPy's printer, with names of variables as kinematics writes them.
"""

from __future__ import annotations

import re
from functools import lru_cache

import sympy

from singsym.polynomials.polynomial import Polynomial

_INDEXED = re.compile(r"(?P<letter>[a-zA-Z])(?:_(?P<index>\w+)|(?P<other>[0-9A-Z]\w*))")
_COORDINATE = re.compile(r"(?P<index>[A-Z]\w*)(?P<other>)(?P<letter>[xyz])")


def symbol_latex(name: str) -> str:
    r"""A variable in LaTeX: a letter with an index, a coordinate with its point; others as SymPy prints them.

    >>> print(symbol_latex("c_A1"), symbol_latex("x_B"), symbol_latex("B1x"), symbol_latex("d3"))
    c_{\mathrm{A1}} x_{B} x_{\mathrm{B1}} d_{3}
    """
    found = _COORDINATE.fullmatch(name) or _INDEXED.fullmatch(name)
    if found is None:
        return str(sympy.latex(sympy.Symbol(name)))
    letter, index = found["letter"], (found["index"] or found["other"]).replace("_", ",")
    plain = len(index) == 1 or index.isdigit()
    return f"{letter}_{{{index}}}" if plain else f"{letter}_{{\\mathrm{{{index}}}}}"


@lru_cache(maxsize=10_000)
def polynomial_latex(polynomial: Polynomial, longest: int = 24) -> str:
    """A polynomial in LaTeX, cut after some terms with the number of those left out."""
    ring = polynomial.ring
    polynomial = ring.reduced(polynomial)
    names = {sympy.Symbol(name): symbol_latex(name) for name in ring.names}
    if len(polynomial) <= longest:
        return str(sympy.latex(polynomial.to_sympy(), symbol_names=names))
    head = ring.from_dict(dict(polynomial.terms()[:longest])).to_sympy()
    rest = len(polynomial) - longest
    return rf"{sympy.latex(head, symbol_names=names)} + \cdots\ (\text{{{rest} more terms}})"
