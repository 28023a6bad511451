"""Curves of a row in certificates: those that meet are one piece, those without real points are none.

Source: singsym's own; what is right is derived by hand in the docstring of each test.
"""

from __future__ import annotations

import copy
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from singsym.certificates.checker.curves import components
from singsym.certificates.checker.polynomials import Rejected
from singsym.certificates.checker.sets import RealSet, statement
from singsym.certificates.checker.table import Finding, proven_row
from singsym.certificates.checker.verification import FORMAT, verify
from singsym.certificates.prover.loops import curve_leaf
from singsym.certificates.prover.proof import Hints, based, prove
from singsym.certificates.prover.writing import Certificate

pytestmark = pytest.mark.engines
Lines = list[dict[str, Any]]


def data(variables: list[str], *equations: str) -> dict[str, Any]:
    """T = 0 A: all configurations are of the types RI, IO."""
    empty: dict[str, Any] = {key: [] for key in ("constants", "exclusions", "positive", "nonnegative")}
    own = {"variables": variables, "equations": list(equations), "N": 1, "n": 1}
    return {**empty, **own, "L": [["1", "0"]], "roles": ["output", "input"]}


def numbers(lines: Lines, about: dict[str, Any], path: Path) -> tuple[int | None, int | None]:
    """Components of the row, of each curve by itself and of all together."""
    by_themselves, all_together = (_components(lines, about, path, own) for own in ([], [loops(lines)]))
    return by_themselves, all_together


def loops(lines: Lines) -> list[list[int]]:
    """All loops of a proof, each by its line and place."""
    numbered = ((number, line.get("curve", {"loops": []})) for number, line in enumerate(lines, 3))
    return [[number, k] for number, curve in numbered for k in range(len(curve["loops"]))]


def _components(lines: Lines, about: dict[str, Any], path: Path, together: Any) -> int | None:
    claim = {"types": "RI, IO", "occurs": True, "together": together}
    header = {"format": FORMAT, "name": "own", "claims": [claim]}
    found = verify(Certificate((header, about, *lines)).write(path))
    return next(row.components for row in found.proven if row.types == "RI, IO")


def two_circles(shift: int) -> dict[str, Any]:
    """x^2 + y^2 = 1, and the same circle with its centre at (shift, 0)."""
    s, ss = 2 * shift, shift * shift - 1
    product = f"x^4 + 2*x^2*y^2 + y^4 - {s}*x^3 - {s}*x*y^2 + {ss}*x^2 + {ss}*y^2 - x^2 - y^2 + {s}*x - {ss}"
    return data(["x", "y"], product)


@pytest.mark.parametrize(("shift", "together"), [(1, 1), (3, 2), (2, 1)])
def test_two_circles(shift: int, together: int, tmp_path: Path) -> None:
    """Centres 1 apart: they meet at (1/2, +-sqrt(3)/2); 3 apart: they do not; 2: they touch at (1, 0)."""
    about = two_circles(shift)
    lines = prove(statement(about), Hints(curves=True)).lines
    assert numbers(lines, about, tmp_path / "circles") == (2, together)


def test_curves_that_are_counted_by_themselves_may_meet(tmp_path: Path) -> None:
    """Circles that meet are two by themselves and one together; without their points that is not known."""
    about = two_circles(1)
    lines = copy.deepcopy(prove(statement(about), Hints(curves=True)).lines)
    assert numbers(lines, about, tmp_path / "circles") == (2, 1)
    del _curve_with_meetings(lines)["meets"]
    assert numbers(lines, about, tmp_path / "circles") == (2, None)


def _curve_with_meetings(lines: Lines) -> dict[str, Any]:
    return next(line["curve"] for line in lines if line.get("curve", {}).get("meets"))


def _dropped(curve: dict[str, Any]) -> None:
    del curve["meets"]


def _one_point_less(curve: dict[str, Any]) -> None:
    """Of the points (1/2, y) with y^2 = 3/4 those with y = 1/2 alone, of which there are none."""
    entry = curve["meets"][0]
    entry |= {"minimal": ["-1/2", "1"], "coordinates": {"x": ["1/2"], "y": ["1/2"]}, "form": "y"}


def _of_another_line(curve: dict[str, Any]) -> None:
    curve["meets"][0]["line"] += 1


def _steps_to_nothing(curve: dict[str, Any]) -> None:
    curve["meets"][0] |= {"steps": [], "equations": [0]}


@pytest.mark.parametrize("damage", [_dropped, _one_point_less, _of_another_line, _steps_to_nothing])
def test_circles_that_meet_are_not_counted_apart(
    damage: Callable[[dict[str, Any]], None], tmp_path: Path
) -> None:
    """Without all their points in common nothing is known of the number of pieces, or it is refused."""
    about = two_circles(1)
    lines = copy.deepcopy(prove(statement(about), Hints(curves=True)).lines)
    damage(_curve_with_meetings(lines))
    try:
        assert numbers(lines, about, tmp_path / "circles") == (2, None)
    except Rejected:
        assert damage is not _dropped


def over_a_circle(constant: str) -> RealSet:
    """z^2 = x y - c over the circle x^2 + y^2 = 1, on which x y is at most 1/2."""
    return statement(data(["x", "y", "z"], "x^2 + y^2 - 1", f"z^2 - x*y + {constant}")).whole


def test_a_curve_without_real_points() -> None:
    """c = 3/5 leaves none, c = 2/5 two ovals: the proof of the first is none of the second."""
    empty = over_a_circle("3/5")
    leaf = curve_leaf(empty, {}, based)
    assert leaf is not None
    assert leaf["loops"] == []
    assert components(empty, leaf) == []
    ovals = over_a_circle("2/5")
    assert curve_leaf(ovals, {}, based) is None
    with pytest.raises(Rejected):
        components(ovals, leaf)
    for place in range(len(leaf["critical"]["factors"])):
        wrong = copy.deepcopy(leaf)
        del wrong["critical"]["factors"][place]
        with pytest.raises(Rejected):
            components(empty, wrong)


def ovals_where(*positive: str) -> RealSet:
    """z^2 = x y - 2/5 over the unit circle: an oval with x > 0 and one with x < 0."""
    about = data(["x", "y", "z"], "x^2 + y^2 - 1", "z^2 - x*y + 2/5")
    return statement(about | {"positive": list(positive)}).whole


POINT = {
    "fixed": {"z": "0"},
    "centre": {"x": "4472135955/10000000000", "y": "8944271910/10000000000"},
    "radius": "1/100000000",
    "square": [0, 1],
}
"""x y = 2/5 at (1, 2)/sqrt(5), which is about (0.4472135955, 0.8944271910)."""


@pytest.mark.parametrize(("positive", "left"), [((), 2), (("x",), 1), (("x", "2 - x"), 1), (("x - 2",), 0)])
def test_loops_on_which_an_inequality_fails_are_none_of_the_set(positive: tuple[str, ...], left: int) -> None:
    """On both ovals x y >= 2/5, so that x is not zero; and it is at most 1."""
    at = ovals_where(*positive)
    leaf = curve_leaf(at, POINT, based)
    assert leaf is not None
    assert len(leaf["loops"]) == 2
    assert len(components(at, {**POINT, **leaf})) == left


def test_an_inequality_that_cuts_a_curve() -> None:
    """z is zero on both ovals: what is left of them are arcs, which no one counts."""
    at = ovals_where("z")
    for leaf in (curve_leaf(at, POINT, based), curve_leaf(ovals_where("x"), POINT, based)):
        assert leaf is not None
        with pytest.raises(Rejected):
            components(at, {**POINT, **leaf})


@pytest.mark.parametrize("signs", [None, [], [{"steps": [], "equations": [0, 1, 2]}], ["twice"], ["another"]])
def test_that_inequalities_vanish_nowhere_is_not_believed(signs: Any) -> None:
    at = ovals_where("x")
    leaf = curve_leaf(at, POINT, based)
    assert leaf is not None
    if signs == ["twice"]:
        signs = 2 * leaf["signs"]
    elif signs == ["another"]:
        other = curve_leaf(ovals_where("x - 2"), POINT, based)
        assert other is not None
        signs = other["signs"]
    wrong = {key: value for key, value in {**POINT, **leaf, "signs": signs}.items() if value is not None}
    with pytest.raises(Rejected):
        components(at, wrong)


def test_loops_over_another_root_are_none_of_the_set(tmp_path: Path) -> None:
    """(x - s)^2 + y^2 = 1 with s = sqrt(2), a constant between 1 and 2: one circle; that over -s is none."""
    about = data(["x", "y", "s"], "s^2 - 2", "x^2 - 2*x*s + s^2 + y^2 - 1") | {"constants": [["s", "1", "2"]]}
    lines = prove(statement(about), Hints(curves=True)).lines
    assert len(loops(lines)) == 2
    assert _components(lines, about, tmp_path / "circle", []) == 1
    with pytest.raises(Rejected, match="no curves"):
        _components(lines, about, tmp_path / "circle", [loops(lines)])


def test_a_curve_that_may_be_of_two_types_counts_for_neither() -> None:
    """Its loops may all be of the other types."""
    at = over_a_circle("2/5")
    sure = Finding(at, frozenset({"RI, IO"}), None, 1, 1, [[]], line=3)
    doubtful = Finding(at, frozenset({"RI, IO", "RO, II"}), None, 1, 1, [[]], line=4)
    assert proven_row("RI, IO", [sure]).components == 1
    assert proven_row("RI, IO", [sure, doubtful]).components is None


@pytest.mark.parametrize(("joined", "right"), [(False, 2), (True, 1)])
def test_one_number_is_proven(joined: bool, right: int, tmp_path: Path) -> None:
    """Circles that meet: a claim says whether they are counted together, and no other number is proven."""
    about = two_circles(1)
    lines = prove(statement(about), Hints(curves=True)).lines
    own = [loops(lines)] if joined else []
    for claimed in (1, 2):
        claim = {"types": "RI, IO", "occurs": True, "dimension": 1, "components": claimed, "together": own}
        header = {"format": FORMAT, "name": "own", "claims": [claim]}
        path = Certificate((header, about, *lines)).write(tmp_path / "circles")
        if claimed == right:
            verify(path)
        else:
            with pytest.raises(Rejected, match="proven is"):
                verify(path)


@pytest.mark.parametrize(
    "together", [[[[3, 0]]], [[[1, 1], [1, 1]]], [[["a", 0]]], [[[[]]]], [[3]], [3], "a", [[[]]]]
)
def test_only_loops_of_the_row_are_counted_together(together: Any, tmp_path: Path) -> None:
    """Line 3 is no curve here; nor is one counted twice."""
    about = two_circles(1)
    lines = prove(statement(about), Hints(curves=True)).lines
    assert "curve" not in lines[0]
    with pytest.raises(Rejected, match=r"claims|together"):
        _components(lines, about, tmp_path / "circles", together)


@pytest.mark.parametrize(
    ("variables", "equation", "curve"),
    [
        (
            ["x"],
            "x^2 - 1",
            {"square": [], "bounded": [[0, ["x"]]], "loops": [], "critical": {"variable": "x"}},
        ),
        (["x", "y"], "x^2 + y^2 - 1", {"bounded": [[0, ["x", "y"]]], "loops": [[0]]}),
    ],
)
def test_what_is_no_curve_is_refused(
    variables: list[str], equation: str, curve: dict[str, Any], tmp_path: Path
) -> None:
    """Points on a line, of which a square system has no equations; and a loop of what is no tube."""
    evidence = {"L_I": [{"rows": [0], "columns": [0], "units": []}], "L_O": [{"below": 1}]}
    nothing = {"implied": {"local": "0", "steps": [], "equations": [0]}}
    leaf = {"at": 0, "rule": "ranks", "ranks": evidence, "curve": {**nothing, **curve}}
    with pytest.raises(Rejected, match=r"a curve: expected|expected a tube"):
        numbers([leaf], data(variables, equation), tmp_path / "curve")
