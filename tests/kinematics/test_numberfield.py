"""Number fields of irrational lengths and angles: degrees from Galois theory, values from floats."""

from __future__ import annotations

from math import prod

import pytest
import sympy

from singsym.kinematics.numberfield import Atoms, NumberField, number_field


def degree(found: NumberField) -> int:
    return prod(len(c.minimal) - 1 for c in found.constants)


def value(found: NumberField, number: sympy.Expr) -> float:
    at = [float((c.low + c.high) / 2) for c in found.constants]
    return float(found.image(number).evaluate(at))


@pytest.mark.parametrize(
    ("roots", "expected"), [((2,), 2), ((2, 3), 4), ((2, 3, 6), 4), ((8, 2), 2), ((4,), 1)]
)
def test_square_roots(roots: tuple[int, ...], expected: int) -> None:
    """sqrt 6 = sqrt 2 sqrt 3 and sqrt 8 = 2 sqrt 2 bring nothing new."""
    atoms = Atoms()
    for n in roots:
        atoms.root(sympy.Integer(n), 2)
    found = number_field(atoms)
    assert degree(found) == expected
    for n in roots:
        if sympy.sqrt(n).is_Pow:
            assert value(found, sympy.sqrt(n)) == pytest.approx(n**0.5, rel=1e-5)


@pytest.mark.parametrize(
    ("angle", "expected"), [("pi/3", 1), ("pi/4", 2), ("pi/5", 2), ("pi/7", 3), ("pi/12", 4)]
)
def test_cosines_of_parts_of_a_turn(angle: str, expected: int) -> None:
    """Q(cos 2 pi/m) has degree phi(m)/2 (Washington, chapter 2), for pi/12 m = 24."""
    cosine = sympy.cos(sympy.sympify(angle), evaluate=False)
    atoms = Atoms()
    atoms.angle(cosine)
    found = number_field(atoms)
    assert degree(found) == expected
