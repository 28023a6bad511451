"""Certificates of mechanisms, from file to verified table; expected tables are derived in the docstrings."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import pytest
import sympy

from singsym.certificates.checker.polynomials import Rejected
from singsym.certificates.checker.table import Row
from singsym.certificates.checker.verification import verify
from singsym.certificates.prover.writing import Certificate, certificate
from singsym.classes.classify import Limits, classify, classify_equation
from singsym.cli import main
from singsym.kinematics.own_equation import SymbolicSpace, from_sympy
from singsym.mechanism import loads
from tests.soundness.exact_ranks import defects

pytestmark = pytest.mark.engines
OWN = """
name = "own"
inputs = ["A"]
output = { rate = "D" }
links = { ground = { points = { A = [0, 0], D = [6, 0] } }, AB = 2, BC = 4, CD = 5 }
joints = { A = "R", B = "R", C = "R", D = "R" }
"""


def test_a_four_bar_of_ones_own(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Links 2, 4, 5 on a base of 6.

    det L_O = 0 where crank and coupler are in line, C at 2 + 4 = 6 or 4 - 2 = 2 from A: with the rocker of 5
    and the base of 6 the triangles (6, 5, 6) and (2, 5, 6) close, two mirror images each: 4
    points of (RI, IO). det L_I = 0 where coupler and rocker are in line, B at 9 or 1 from D; it is
    between 4 and 8 from D: none.
    """
    file, proof = tmp_path / "own.toml", tmp_path / "own.cert"
    file.write_text(OWN, encoding="utf-8")
    assert main(["classify", str(file), "--no-cache", "--workers", "1", "--certificate", str(proof)]) == 0
    rows = {row.types: row for row in verify(proof).proven}
    assert rows.pop("RI, IO") == Row("RI, IO", True, 0, 4, 4)
    assert not any(row.occurs for row in rows.values())
    assert None not in {row.occurs for row in rows.values()}
    capsys.readouterr()
    assert main(["verify", str(proof), "--mechanism", str(file)]) == 0
    assert "RI, IO: occurs, dimension 0, 4 points" in capsys.readouterr().out
    assert main(["verify", str(proof), "--mechanism", "fourbar"]) == 2
    assert "is not about fourbar" in capsys.readouterr().err


def test_exit_codes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """3 for a certificate that ends too soon, 2 for one that claims what is not so, or is no certificate."""
    path = tmp_path / "proof"
    made = certificate(classify(loads(OWN), cache=False))
    Certificate(made.lines[:-1]).write(path)
    assert main(["verify", str(path)]) == 3
    assert "left open" in capsys.readouterr().out
    header = made.lines[0]
    claims = [row | ({"points": 5} if row["occurs"] else {}) for row in header["claims"]]
    Certificate(({**header, "claims": claims}, *made.lines[1:])).write(path)
    assert main(["verify", str(path)]) == 2
    assert main(["verify", str(tmp_path / "none")]) == 2
    path.write_text("no certificate")
    assert main(["verify", str(path)]) == 2


x, y, z, w = sympy.symbols("x y z w")


@pytest.mark.parametrize(
    ("entry", "row"),
    [(x**2 + y**2, Row("RI, IO", True, 0, 1, 1)), (x**2 + y**2 + 1, Row("RI, IO", False, -1, 0, 0))],
)
def test_less_over_the_reals(entry: sympy.Expr, row: Row, tmp_path: Path) -> None:
    """T = (x^2 + y^2) A in the plane: the minor has curves of complex zeros, and one real zero, or none."""
    columns = [("T", "output"), ("A", "input")]
    equation = from_sympy(sympy.Matrix([[1, entry]]), columns, SymbolicSpace())
    made = certificate(classify_equation(None, equation, cache=False))
    found = verify(made.write(tmp_path / "proof"))
    assert row in found.proven
    assert found.complete, found.missing


TWO = [("T1", "output"), ("T2", "output"), ("A1", "input"), ("A2", "input")]


def _curve() -> tuple[sympy.Matrix, list[tuple[str, str]], list[sympy.Expr], list[dict[sympy.Symbol, int]]]:
    """A curve on which minors vanish in different points: see `tests.soundness.test_own_equations`."""
    u, v = 100 * ((x - 50) + 2 * (y - 30)), 100 * (3 * (x - 50) - (y - 30))
    a, b = (1 + x + y) / 10, (2 - x) / 10
    rows = [[0, 0, u, v, 0], [1, 3, a * u + x, a * v + y, 0], [0, 0, b * u - y, b * v + x, 0]]
    L = sympy.Matrix([*rows, [0, 0, 0, 0, u * x + v * y]]).applyfunc(sympy.expand)
    columns = [("T", "output"), ("A", "input"), ("P1", "passive"), ("P2", "passive"), ("P3", "passive")]
    return L, columns, [sympy.expand(u * y - v * x)], [{x: 0, y: 0}, {x: 50, y: 30}]


def _plane() -> tuple[sympy.Matrix, list[tuple[str, str]], list[sympy.Expr], list[dict[sympy.Symbol, int]]]:
    """Two equations that share a plane, where the rank of L_O is 1: the same page."""
    X, Y = x - 100, y - 80
    a, b = x + 2 * y - z + 3 * w + 1, 2 * x - y + 3 * z - w - 2
    c, d = -x + y + 2 * z + w + 2, 3 * x + y - z + 2 * w - 1
    e, g = x - y + z - 2 * w + 3, x + 3 * y + 2 * z + w - 2
    L = sympy.Matrix([[1, 0, X, Y], [0, 1, -g, e]])
    loops = [sympy.expand(X * a + Y * b), sympy.expand(X * c + Y * d)]
    return L, TWO, loops, [{x: 100, y: 80, z: 5, w: 7}]


@pytest.mark.parametrize("case", [_curve, _plane])
def test_what_was_wrong_once_has_no_certificate(case: Callable[[], tuple], tmp_path: Path) -> None:
    """Types that a rational point has by exact ranks are proven to be empty by no certificate.

    Neither where the table says so, nor where an honest one has its claims changed.
    """
    L, columns, loops, places = case()
    N, n = L.rows, sum(role == "input" for _, role in columns)
    there = {defects(L, columns, place, N, n).types for place in places}
    names = {", ".join(t.names) for t in there}
    limits = Limits(seconds=20, total=60)
    equation = from_sympy(L, columns, SymbolicSpace(loops))
    made = certificate(classify_equation(None, equation, cache=False, limits=limits))
    found = verify(made.write(tmp_path / "honest"))
    assert all(row.occurs is not False for row in found.proven if row.types in names)
    header = made.lines[0]
    claims = [
        {"types": row["types"], "occurs": False} if row["types"] in names else row for row in header["claims"]
    ]
    path = Certificate(({**header, "claims": claims}, *made.lines[1:])).write(tmp_path / "forged")
    with suppress(Rejected):
        assert not verify(path).complete
