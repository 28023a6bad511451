"""L in blocks against (6) and (9) of the paper, and against L itself: what names stand for makes it up."""

from __future__ import annotations

import re
from fractions import Fraction

import pytest
from flint import fmpq

from singsym.kinematics.nonzero import Certifier
from singsym.kinematics.reduction import reduce
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import load
from singsym.output.sheet.blocks import Blocks, blocks
from singsym.output.sheet.matrix import matrix_latex
from singsym.polynomials import Polynomial, PolynomialMatrix


def test_the_linkage_as_in_the_papers_6() -> None:
    """(6), with S_P = (1, y_P, -x_P) and m_PG = (y_P - y_G, x_G - x_P); here C is two joints."""
    mechanism = load("zlatanov-2dof")
    found = blocks(velocity_equation(mechanism), mechanism)
    assert found.rows == ("output", "loop 1", "loop 2")
    assert [h.label for h in found.columns] == ["T", "A", "B", "C1", "C2", "D", "E", "F", "G"]
    bare = [[cell.lstrip("-") for cell in row] for row in found.cells]
    assert bare[0] == ["I", *["0"] * 5, "m_{EG}", "m_{FG}", "0"]
    assert bare[1] == ["0", "S_{A}", "S_{B}", "S_{C1}", "0", "S_{D}", "0", "0", "0"]
    assert bare[2] == ["0", "0", "0", "0", "S_{C2}", "S_{D}", "S_{E}", "S_{F}", "S_{G}"]
    screws = {name: [str(row[0]) for row in value.rows] for name, value in found.names.items()}
    for point in "BFG":
        assert screws[f"S_{{{point}}}"] == ["1", f"{point}y", f"-{point}x"]
    assert screws["m_{FG}"] == ["Fy - Gy", "-Fx + Gx"]
    assert screws["m_{EG}"] == ["-Gy", "Gx - 2"]


def test_the_hybrid_chain_as_in_the_papers_9() -> None:
    """(9): zero and I before moments of leg A, then cross products with AB, AC and moments of two legs."""
    mechanism = load("zlatanov-hybrid")
    found = blocks(reduce(velocity_equation(mechanism)).equation, mechanism)
    bare = [[re.sub(r"\d*(m_{\w\d)(,A)?", r"\1", cell.lstrip("-")) for cell in row] for row in found.cells]
    legs = {leg: [f"m_{{{leg}{k}}}" for k in (1, 2, 3)] for leg in "ABC"}
    none = ["0", "0", "0"]
    assert bare[0] == ["0", "I", *legs["A"], *none, *none]
    assert bare[1][:2] == [r"\tilde{b}_{1}", "0"]
    assert bare[2][:2] == [r"\tilde{b}_{2}", "0"]
    assert [cell.partition("^")[0] for cell in bare[1][2:]] == [*legs["A"], *legs["B"], *none]
    assert [cell.partition("^")[0] for cell in bare[2][2:]] == [*legs["A"], *none, *legs["C"]]


def rebuilt(
    found: Blocks, height: int, width: int, heights: list[int], one: Polynomial
) -> list[list[Polynomial]]:
    """The matrix from its formulas, with the names' values put in."""
    zero = one - one
    rows = [[zero] * width for _ in range(height)]
    top = 0
    for cells, size in zip(found.cells, heights, strict=True):
        for heading, cell in zip(found.columns, cells, strict=True):
            value = meaning(cell, found.names, size, len(heading.places), one)
            for i in range(size):
                for j, place in enumerate(heading.places):
                    rows[top + i][place] = value.rows[i][j]
        top += size
    return rows


def meaning(
    cell: str, names: dict[str, PolynomialMatrix], size: int, width: int, one: Polynomial
) -> PolynomialMatrix:
    """What a formula stands for."""
    ring = one.ring
    if cell == "0":
        return PolynomialMatrix.of(ring, [[0] * width for _ in range(size)])
    name = next((n for n in sorted(names, key=len, reverse=True) if cell.endswith(n)), "")
    if not name and cell.endswith("I"):
        name = "I"
    if not name:
        raise AssertionError(f"{cell} is not made of names")
    lead = cell.removesuffix(name)
    fraction = re.fullmatch(r"(-?)\\tfrac\{(\d+)\}\{(\d+)\}", lead)
    number = Fraction(int(fraction[2]), int(fraction[3])) if fraction else Fraction(lead.strip("-") or "1")
    ratio = fmpq(number.numerator, number.denominator) * (-1 if lead.startswith("-") else 1)
    unit = PolynomialMatrix.of(ring, [[int(i == j) for j in range(width)] for i in range(size)])
    return names.get(name, unit).map(lambda e: e * ratio)


@pytest.mark.parametrize("name", ["zlatanov-2dof", "zlatanov-hybrid", "3rrr", "stewart-gough", "puma560"])
def test_the_names_make_up_the_matrix(name: str) -> None:
    mechanism = load(name)
    equation = velocity_equation(mechanism)
    found = blocks(equation, mechanism)
    heights: dict[str, int] = {}
    for row in equation.rows:
        key = "output" if row.startswith("output") else row[:6] if row.startswith("loop") else row
        heights[key] = heights.get(key, 0) + 1
    height, width = equation.matrix.shape
    matrix = rebuilt(found, height, width, list(heights.values()), equation.space.ring.one)
    assert matrix == [list(row) for row in equation.matrix.rows]


def test_short_forms_are_equal_on_the_configuration_space() -> None:
    mechanism = load("zlatanov-hybrid")
    equation = velocity_equation(mechanism)
    certifier = Certifier(equation.space)
    for row in equation.matrix.rows:
        for entry in row:
            assert not certifier.normal_form(certifier.shorten(entry) - entry)


def test_a_wide_matrix_comes_in_parts_and_long_values_are_left_out_unless_asked_for() -> None:
    mechanism = load("stewart-gough")
    equation = velocity_equation(mechanism)
    short, whole = (matrix_latex(equation, mechanism, expand=expand) for expand in (False, True))
    assert sum(part.count(r"\begin{array}") for part in short) > 1
    assert short[-1].startswith("Cut here as they are long: ")
    assert "Cut here" not in whole[-1]
    assert len(whole[-1]) > len(short[-2])
