"""Formulas as MathML, which browsers show without help.

Source: SymPy's presentation MathML printer; names of determinants are set by the few commands they use.
"""

from __future__ import annotations

import re
from html import escape

import sympy

from singsym.polynomials import Polynomial, PolynomialMatrix
from singsym.polynomials.latex import symbol_latex

LONGEST = 40
"""Polynomials with more terms are cut, with the number of terms left out."""

_INDEXED = re.compile(r"([a-zA-Z])_\{(?:\\mathrm\{)?(\w+)\}+")


def formula(*parts: str, block: bool = False) -> str:
    """MathML elements as one formula."""
    display = ' display="block"' if block else ""
    return f"<math{display}><mrow>{''.join(parts)}</mrow></math>"


def polynomial(p: Polynomial, longest: int = LONGEST) -> str:
    """A polynomial as MathML elements, cut after some terms.

    >>> from singsym.polynomials import Ring
    >>> polynomial(Ring(("Bx",)).gens[0])
    '<msub><mi>x</mi><mi>B</mi></msub>'
    """
    from sympy.printing.mathml import mathml

    ring = p.ring
    cut = len(p) > longest
    shown = ring.from_dict(dict(p.terms()[:longest])) if cut else p
    text = str(mathml(shown.to_sympy().xreplace(_indexed(shown)), printer="presentation"))
    text = text.replace("<mo>-</mo>", "<mo>−</mo>").replace("<mn>-", "<mn>−")
    rest = f"<mo>+</mo><mtext>… ({len(p) - longest} more terms)</mtext>" if cut else ""
    return text + rest


def _indexed(p: Polynomial) -> dict[sympy.Symbol, sympy.Symbol]:
    """Variables as letters with an index, as the LaTeX output writes them: Bx is x_B."""
    found = {}
    for name in p.ring.names:
        if match := _INDEXED.fullmatch(symbol_latex(name)):
            found[sympy.Symbol(name)] = sympy.Symbol(f"{match[1]}_{match[2]}")
    return found


def terms(p: Polynomial, relation: str = "", longest: int = LONGEST) -> str:
    """A polynomial, with its relation to zero if there is one, as one formula a term, for lines to break.

    >>> from singsym.polynomials import Ring
    >>> x, y = Ring(("x", "y")).gens
    >>> terms(x - y).count("<math>"), terms(x - y, "=").count("<math>"), "1 more" in terms(x - y, longest=1)
    (2, 3, True)
    """
    found = []
    for place, (exponents, coefficient) in enumerate(p.terms()[:longest]):
        sign = "" if place == 0 else "−" if coefficient < 0 else "+"
        term = p.ring.from_dict({exponents: abs(coefficient) if sign else coefficient})
        found.append(formula(f'<mo form="infix">{sign}</mo>' if sign else "", polynomial(term)))
    if len(p) > longest:
        found.append(f"+ … ({len(p) - longest} more terms)")
    if relation:
        found.append(formula(f'<mo form="infix">{escape(relation)}</mo><mn>0</mn>'))
    return " ".join(found)


def equation(p: Polynomial, relation: str = "=", longest: int = LONGEST) -> str:
    """A polynomial and its relation to zero, as MathML elements."""
    return f"{polynomial(p, longest)}<mo>{escape(relation)}</mo><mn>0</mn>"


def matrix(m: PolynomialMatrix, columns: list[str]) -> str:
    """A matrix with its column labels as MathML elements; dots for zeros."""
    head = "".join(f"<mtd><mtext>{escape(label)}</mtext></mtd>" for label in columns)
    rows = "".join(
        "<mtr>" + "".join(f"<mtd>{polynomial(e, 12) if e else '<mo>·</mo>'}</mtd>" for e in row) + "</mtr>"
        for row in m.rows
    )
    return f'<mtable><mtr class="labels">{head}</mtr>{rows}</mtable>'


_TOKEN = re.compile(r"\\[a-zA-Z]+|\\,|[{}_]|[0-9]+|[a-zA-Z]+|\S")
_WORDS = {
    "-": "<mo>−</mo>",
    r"\det": "<mi>det</mi>",
    r"\cdot": "<mo>·</mo>",
    r"\times": "<mo>×</mo>",
    r"\pm": "<mo>±</mo>",
    r"\,": '<mspace width="0.2em"/>',
}


def name(latex: str) -> str:
    """The name of a determinant or product, as `elimination.geometry` writes it, as MathML elements.

    Commands: det, cdot, times, pm, overrightarrow, mathrm, indices in braces.

    >>> name(r"S_{B}")
    '<msub><mi>S</mi><mrow><mi>B</mi></mrow></msub>'
    """
    tokens = _TOKEN.findall(latex)
    found, end = _sequence(tokens, 0)
    return found if end == len(tokens) else f"<mtext>{escape(latex)}</mtext>"


def _sequence(tokens: list[str], at: int) -> tuple[str, int]:
    """Elements up to a closing brace or the end."""
    parts: list[str] = []
    while at < len(tokens) and tokens[at] != "}":
        token = tokens[at]
        if token == "_" and parts:
            below, at = _argument(tokens, at + 1)
            parts[-1] = f"<msub>{parts[-1]}{below}</msub>"
            continue
        if token in (r"\overrightarrow", r"\mathrm"):
            inner, at = _argument(tokens, at + 1)
            parts.append(f"<mover>{inner}<mo>→</mo></mover>" if token == r"\overrightarrow" else inner)
            continue
        if token == "{":
            inner, at = _argument(tokens, at)
            parts.append(inner)
            continue
        parts.append(_atom(token))
        at += 1
    return "".join(parts), at


def _argument(tokens: list[str], at: int) -> tuple[str, int]:
    """What stands in braces, or the next token alone."""
    if at < len(tokens) and tokens[at] == "{":
        inner, end = _sequence(tokens, at + 1)
        return f"<mrow>{inner}</mrow>", end + 1
    return (_atom(tokens[at]), at + 1) if at < len(tokens) else ("", at)


def _atom(token: str) -> str:
    if token in _WORDS:
        return _WORDS[token]
    if token.isdigit():
        return f"<mn>{token}</mn>"
    return f"<mi>{escape(token)}</mi>" if token.isalpha() else f"<mo>{escape(token)}</mo>"
