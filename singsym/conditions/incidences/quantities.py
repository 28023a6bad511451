"""Brackets, products and incidences of named points, lines and axes: how they are printed.

Source: the notation of Ben-Horin and Shoham (2006) for brackets, of Zlatanov, Fenton, Benhabib (1998),
section 3.3, for determinants of planar screws.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Quantity:
    """A determinant or product of named points and axes, and what its vanishing says.

    S_A in a planar determinant is the screw (1, y, -x) of a turn about the point A = (x, y); det[A B C D] in
    space has a row (1, x, y, z) for each point.  AB among three in the plane, or among six in space, is the
    line through A and B by its Plücker vector: B - A, and its moment A x B about the origin; A:u is the line
    through A along the axis u, :u the couple about it.  Among three in space AB is the vector B - A, uxv is
    the vector product of two axes, v_J the velocity of the moved point where the joint J turns alone at the
    rate 1.  ABC among four is the plane with the normal AB x AC, and minus its product with A.  u_P is the
    direction of the slide P as its column in L has it; A:n_P among three in the plane is the line through A
    along its normal.
    """

    latex: str
    text: str
    words: str


def symbol(name: str) -> str:
    r"""A name as LaTeX: one letter with an index, or text.

    >>> print(symbol("B1"), symbol("tool"))
    B_{1} \mathrm{tool}
    """
    head, index = name[:1], name[1:].lstrip("_")
    if head.isalpha() and (not index or index.isalnum()) and len(index) <= 2:
        return rf"{head}_{{{index}}}" if index else head
    return rf"\mathrm{{{name.replace('_', ' ')}}}"


def arrow(start: str, end: str) -> str:
    """The vector from one point to another in LaTeX."""
    return rf"\overrightarrow{{{symbol(start)}{symbol(end)}}}"


def bracket(latex: Sequence[str], text: Sequence[str], words: str) -> Quantity:
    """The determinant of some vectors, each in LaTeX and as text."""
    inside = r",\, ".join(latex)
    return Quantity(rf"\det[{inside}]", f"det[{' '.join(text)}]", words)
