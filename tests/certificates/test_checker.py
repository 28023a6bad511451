"""What the checker refuses, rule by rule, and that it stands alone."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any

import pytest
from flint import ctx, nmod_poly

import singsym
from singsym.certificates.checker import verification
from singsym.certificates.checker.curves import Tubes, components
from singsym.certificates.checker.points import PRIME, pivots, points
from singsym.certificates.checker.polynomials import Rejected, polynomial, ring
from singsym.certificates.checker.ranks import bounds_on, possible_types
from singsym.certificates.checker.rules import cancel, derive, pivot, rows, squares
from singsym.certificates.checker.sets import RealSet, Statement, statement
from singsym.certificates.checker.strata import dimension_above, dimension_below, dimension_within
from singsym.certificates.prover.bases import based
from singsym.certificates.prover.loops import curve_leaf
from singsym.certificates.prover.writing import Certificate
from singsym.classes.taxonomy.types import feasible_classes

FOLDER = Path(verification.__file__).parent
ALLOWED = {"__future__", "collections", "dataclasses", "flint", "functools", "gzip", "itertools", "json"}
ALLOWED |= {"pathlib", "re", "typing"}


def about(equations: list[str], matrix: list[list[str]], roles: list[str], **more: Any) -> Statement:
    """A statement in x and y, with N and n from the roles."""
    data = {
        "variables": ["x", "y"],
        "constants": [],
        "equations": equations,
        "exclusions": [],
        "positive": [],
        "nonnegative": [],
        "L": matrix,
        "roles": roles,
        "n": roles.count("input"),
        "N": len(roles) - roles.count("input"),
    }
    return statement(data | more)


def one_joint(*equations: str, **more: Any) -> Statement:
    """One input, one output: T = x A."""
    return about(list(equations), [["1", "x"]], ["output", "input"], **more)


def whole(*equations: str, **more: Any) -> RealSet:
    return one_joint(*equations, **more).whole


def test_it_imports_arithmetic_and_nothing_else() -> None:
    for file in FOLDER.glob("*.py"):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            names = [node.module or ""] if isinstance(node, ast.ImportFrom) else []
            names += [a.name for a in node.names] if isinstance(node, ast.Import) else []
            for name in names:
                inside = name.startswith("singsym.certificates.checker.")
                assert inside or name.split(".")[0] in ALLOWED, (file.name, name)


def test_it_loads_nothing_else_of_singsym() -> None:
    said = (
        "import sys, singsym.certificates.checker.verification; "
        "print(sorted(m for m in sys.modules if m.startswith('singsym.')))"
    )
    root = Path(singsym.__file__).parents[1]
    done = subprocess.run([sys.executable, "-c", said], capture_output=True, text=True, cwd=root)
    loaded = ast.literal_eval(done.stdout)
    assert loaded
    assert all(name.startswith("singsym.certificates") and "prover" not in name for name in loaded)


def test_it_is_short() -> None:
    assert sum(file.read_text(encoding="utf-8").count("\n") for file in FOLDER.glob("*.py")) < 1500


@pytest.mark.parametrize("text", ["2x", "x^", "x**2", "1/0*x", "z", "", "x +y", "0.5*x", "x^99999"])
def test_text_that_is_no_polynomial(text: str) -> None:
    with pytest.raises(Rejected):
        polynomial(text, ring(["x", "y"]))


def test_a_step_of_derive_is_computed_and_not_believed() -> None:
    """x^2 + y^2 - 1 and x - y: the remainder is 2 y^2 - 1; the circle may go, the line may not."""
    at = whole("x^2 + y^2 - 1", "x - y")
    found = derive(at, {"steps": [[[0], [1]]], "equations": [1, 2]})[0]
    assert [str(e) for e in found.equations] == ["x - y", "2*y^2 - 1"]
    with pytest.raises(Rejected, match="does not follow"):
        derive(at, {"steps": [[[0], [1]]], "equations": [2]})


def test_only_units_cancel() -> None:
    """x y = 0 gives y = 0 where x is not zero, and not elsewhere."""
    line = {"polynomial": "y", "units": [0], "power": 1}
    assert [str(e) for e in cancel(whole("x*y", exclusions=[["x"]]), line)[0].equations] == ["x*y", "y"]
    with pytest.raises(Rejected, match="no unit"):
        cancel(whole("x*y"), line)
    with pytest.raises(Rejected, match="not seen"):
        cancel(whole("x*y", exclusions=[["y"]]), line)


def test_products_of_units_are_reduced_after_each_multiplication() -> None:
    """x^2 is y, and y z = 0; of x^2 z as it stands x z = w would leave x w, as E is no basis."""
    at = whole("x*z - w", "x^2 - y", "y*z", exclusions=[["x^2"]], variables=["x", "y", "z", "w"])
    found = cancel(at, {"polynomial": "z", "units": [0], "power": 1})[0]
    assert str(found.equations[-1]) == "z"


def test_squares_with_positive_weights_vanish_one_by_one() -> None:
    """x^2 - 2 x y + 3 y^2 = (x - y)^2 + 2 y^2."""
    at = whole("x^2 - 2*x*y + 3*y^2")
    found = squares(at, {"terms": [["1", "x - y"], ["2", "y"]]})[0]
    assert [str(e) for e in found.equations[1:]] == ["x - y", "y"]
    for wrong in ([["1", "x - y"], ["1", "y"]], [["1", "x"], ["-1", "x"]], [["1", "x", "y"]]):
        with pytest.raises(Rejected):
            squares(at, {"terms": wrong})


def test_a_pivot_is_passive_and_a_unit() -> None:
    matrix, roles = [["1", "x", "y"], ["0", "1", "x"]], ["output", "input", "passive"]
    at = about([], matrix, roles, exclusions=[["x"]]).whole
    left = pivot(at, {"row": 1, "column": 2, "units": [0]})[0]
    assert [[str(e) for e in row] for row in left.matrix] == [["x", "x^2 - y"]]
    for wrong in ({"row": 0, "column": 2, "units": [0]}, {"row": 0, "column": 0, "units": []}):
        with pytest.raises(Rejected):
            pivot(at, wrong)


def test_rows_are_combined_by_an_invertible_matrix() -> None:
    """(x, y) over the passive column (x, y) is x^2 + y^2, and (-y, x) is 0; the determinant is x^2 + y^2.

    Off the origin that is a unit, on the unit circle it is 1; elsewhere neither.
    """
    matrix, roles = [["1", "0", "x"], ["0", "1", "y"]], ["output", "input", "passive"]
    line = {"rows": [0, 1], "by": [["x", "y"], ["-y", "x"]], "units": [0]}
    off = about([], matrix, roles, exclusions=[["x", "y"]]).whole
    (turned,) = rows(off, line)
    assert [[str(e) for e in row] for row in turned.matrix] == [["x", "y", "x^2 + y^2"], ["-y", "x", "0"]]
    assert turned.eliminated == 0
    circle = about(["x^2 + y^2 - 1"], matrix, roles).whole
    assert rows(circle, line | {"units": []})[0].matrix == turned.matrix
    for wrong in (
        {"units": []},
        {"by": [["x", "y"], ["x", "y"]]},
        {"by": [["x", "y"]]},
        {"by": [["x"], ["y"]]},
        {"rows": [0, 0]},
        {"rows": [0, 2]},
        {"rows": [], "by": []},
    ):
        with pytest.raises(Rejected):
            rows(off, line | wrong)


def test_a_minor_is_a_multiple_of_one_equation_modulo_others() -> None:
    """On x^2 = y, L_O = x^4 + x y^2 = y^2 (x + 1) modulo the first equation; y = 0 is the second.

    Modulo the first it is no multiple of x + 1, and not zero by itself.
    """
    there = about(["x^2 - y", "y"], [["1", "x^4 + x*y^2"]], ["output", "input"])
    one = {"L_I": [{"rows": [0], "columns": [0], "units": []}]}
    item = {"below": 1, "divisors": [0], "of": 1, "by": "x*y + y"}
    found = bounds_on(there.whole, there, one | {"L_O": [item]})
    assert possible_types(found, 1) == {"RI, IO"}
    for wrong in ({"by": "x + 1"}, {"of": 0}, {"of": 2}, {"divisors": []}, {"divisors": [2]}):
        with pytest.raises(Rejected):
            bounds_on(there.whole, there, one | {"L_O": [item | wrong]})
    with pytest.raises(Rejected):
        bounds_on(there.whole, there, one | {"L_O": [{"below": 1, "divisors": [0]}]})


def test_ranks_need_a_unit_and_vanishing_borders() -> None:
    evidence = {
        "L_O": [{"rows": [0], "columns": [0], "units": [0]}],
        "L_I": [{"rows": [0], "columns": [0], "units": []}],
    }
    there = one_joint("y", exclusions=[["x"]])
    assert possible_types(bounds_on(there.whole, there, evidence), 1) == {""}
    on_zero = one_joint("x")
    found = bounds_on(on_zero.whole, on_zero, evidence | {"L_O": [{"below": 1}]})
    assert possible_types(found, 1) == {"RI, IO"}
    for wrong in ({"L_O": [{"below": 1}]}, {"L_O": [{"rows": [0], "columns": [0], "units": []}]}):
        with pytest.raises(Rejected):
            bounds_on(there.whole, there, wrong)


def test_a_curve_misses_two_lines_of_the_projective_plane() -> None:
    """x = y and x = 2 y + 1 meet in (-1, -1): x y = 1 holds there, x y = 2 does not.

    x = 1 and x = 2 meet the hyperbola at infinity, in (0 : 1 : 0); one form does not miss it at all.
    """
    hyperbola = whole("x*y - 1")
    line = {"forms": ["x - y", "x - 2*y - 1"], "steps": [], "equations": [0, 1, 2]}
    with pytest.raises(Rejected, match="power"):
        dimension_within(hyperbola, line)
    assert dimension_within(whole("x*y - 2"), SECANT) == 1
    for wrong in (
        {"forms": ["x - y"], "equations": [0, 1]},
        {"forms": ["x - 1", "x - 2"]},
        {"forms": ["x - y", "1"]},
        {"forms": ["x - y", "x^2 - 1"]},
        {"equations": [0, 1, 2]},
    ):
        with pytest.raises(Rejected):
            dimension_within(whole("x*y - 2"), SECANT | wrong)
    with pytest.raises(Rejected, match="power"):
        dimension_within(hyperbola, SECANT)


SECANT = {
    "forms": ["x - y", "x - 2*y - 1"],
    "steps": [[[2], [1]], [[0], [1, 3]]],
    "equations": [0, 1, 2, 3, 4],
}
"""With the scale z: y + z of the second form by the first, and x y - 2 z^2 by these is -z^2."""


CIRCLE = {"form": "y", "minimal": ["-3/4", "0", "1"], "power": 1}


def test_all_points_are_there_or_it_is_rejected() -> None:
    """x = 1/2 on the unit circle: y^2 = 3/4, two points; one of them where y > 0.

    With m = y^2 - 3/4 the coordinates are those of 1/2 * 2 y = y and y * 2 y = 3/2, over m' = 2 y.
    """
    line = CIRCLE | {"coordinates": {"x": ["0", "1"], "y": ["3/2"]}}
    equations = ("2*x - 1", "x^2 + y^2 - 1", "4*y^2 - 3")
    there = one_joint(*equations)
    ((types, number, vanishes),) = points(there.whole, there, line)
    assert (types, number) == ("", 2)
    assert [vanishes(polynomial(f, there.whole.context)) for f in ("4*x*y^2 - 3*x", "y")] == [True, False]
    above = one_joint(*equations, positive=["y"])
    assert [number for _, number, _ in points(above.whole, above, line)] == [1]
    for wrong in (
        {"minimal": ["-1/2", "1"]},
        {"minimal": ["9/16", "0", "-3/2", "0", "1"]},
        {"coordinates": {"x": ["0", "2/3"], "y": ["3/2"]}},
        {"form": "x"},
    ):
        with pytest.raises(Rejected):
            points(there.whole, there, line | wrong)
    not_all = one_joint("4*y^2 - 3", "2*x^2 - x")
    with pytest.raises(Rejected, match="more points"):
        points(not_all.whole, not_all, line)


def test_ranks_at_a_point_are_those_of_the_field() -> None:
    """L_O = [[x, 1], [2, x]] has the determinant x^2 - 2: zero at both points, though no zero of Q[x].

    L_I = [[1, 1], [0, x]] has x, which is not zero there; L is full with it, and L_p = (1, x) is.
    """
    matrix, roles = [["1", "x", "1"], ["0", "2", "x"]], ["output", "input", "passive"]
    there = about(["x^2 - 2", "y"], matrix, roles)
    line = {"form": "x", "minimal": ["-2", "0", "1"], "coordinates": {"x": ["4"], "y": []}}
    assert [found[:2] for found in points(there.whole, there, line)] == [("RI, IO", 2)]


@pytest.mark.parametrize("seed", range(6))
def test_ranks_by_elimination_without_fractions(seed: int) -> None:
    """Rows that are combinations of r independent ones: [1, 0, *], [0, 1, *], ... have the rank r."""
    random = Random(seed)
    factor, rank = nmod_poly([-2, 0, 0, 1], PRIME), seed % 4

    def number() -> nmod_poly:
        return nmod_poly([random.randint(-3, 3) for _ in range(3)], PRIME)

    def unit(i: int, j: int) -> nmod_poly:
        return nmod_poly([int(i == j)], PRIME)

    basis = [[unit(i, j) if j < rank else number() for j in range(4)] for i in range(rank)]
    weights = [[number() if i >= rank else unit(i, k) for k in range(rank)] for i in range(4)]
    nothing = nmod_poly([], PRIME)
    rows = [
        [sum((w * row[j] for w, row in zip(own, basis, strict=True)), start=nothing) for j in range(4)]
        for own in weights
    ]
    # the same in the field, but not in Q[u]
    rows = [[entry + factor * number() for entry in row] for row in rows]
    random.shuffle(rows)
    own, columns = pivots(rows, factor)
    assert len(own) == len(columns) == rank
    assert len({*own}) == len({*columns}) == rank


def test_a_multiple_of_the_prime_counts_for_nothing() -> None:
    """On x^2 = 2 the entry of L_O is the prime, which is not zero though it is modulo the prime: refused."""
    there = about(["x^2 - 2", "y"], [["1", str(PRIME)]], ["output", "input"])
    line = {"form": "x", "minimal": ["-2", "0", "1"], "coordinates": {"x": ["4"], "y": []}}
    with pytest.raises(Rejected, match="modulo a prime"):
        points(there.whole, there, line)


def test_a_box_without_a_point() -> None:
    at = whole("x^2 + y^2 - 1")
    point = {"fixed": {"x": "3/5"}, "centre": {"y": "4/5"}, "radius": "1/100", "square": [0]}
    assert dimension_below(at, point) == 1 == dimension_above(at)
    for wrong in ({"centre": {"y": "9/10"}}, {"radius": "1"}, {"fixed": {"x": "1"}, "centre": {"y": "0"}}):
        with pytest.raises(Rejected):
            dimension_below(at, point | wrong)


def test_the_one_point_without_variables() -> None:
    at = about([], [["1", "1"]], ["output", "input"], variables=[]).whole
    assert dimension_below(at, {"fixed": {}, "centre": {}, "radius": "1", "square": []}) == 0


def test_a_point_of_a_square_system_that_is_none_of_the_set() -> None:
    """Of x^2 + y^2 = 1 and x = y the first alone has the point (3/5, 4/5)."""
    point = {"fixed": {"x": "3/5"}, "centre": {"y": "4/5"}, "radius": "1/100", "square": [0]}
    steps = {"local": "1", "steps": [], "equations": [0, 1]}
    for implied in ({}, {"implied": steps}):
        with pytest.raises(Rejected):
            dimension_below(whole("x^2 + y^2 - 1", "x - y"), point | implied)


def test_a_square_system_of_all_generators_has_the_ideal_of_the_set() -> None:
    """Of x^2 + y^2 = 1 and x = y follows 2 y^2 = 1; their points are (t, t) with t^2 = 1/2, about 0.70711.

    Both generators tell all of the set, while of one and the third equation it has to be shown.
    """
    (at,) = derive(whole("x^2 + y^2 - 1", "x - y"), {"steps": [[[0, 1], [1]]], "equations": [0, 1, 2]})
    assert [str(e) for e in at.equations] == ["x^2 + y^2 - 1", "x - y", "2*y^2 - 1"]
    about_half = {"x": "70711/100000", "y": "70711/100000"}
    point = {"fixed": {}, "centre": about_half, "radius": "1/1000", "square": [0, 1]}
    assert dimension_below(at, point) == 0
    with pytest.raises(Rejected):
        dimension_below(at, point | {"square": [1, 2]})


def test_a_tube_holds_one_arc() -> None:
    """Over x from -1/10 to 1/10 the circle is within 1/100 of y = 1, not over all of x, nor at y = 1/2."""
    unit = 10**9
    with ctx.workprec(90):
        tubes = Tubes(whole("x^2 + y^2 - 1").equations)
        tube = tubes.tube([0, -unit // 10, unit // 10, [0, unit], [unit, 0], unit // 50])
        assert tube.start[1] < 1
        for wrong in (
            [0, -unit, unit, [0, unit], [unit, 0], unit // 50],
            [0, -unit // 10, unit // 10, [0, unit // 2], [unit, 0], unit // 50],
            [0, -unit // 10, unit // 10, [0, unit], [unit, 0], unit // 10**4],
        ):
            with pytest.raises(Rejected):
                tubes.tube(wrong)


def test_a_curve_of_more_equations_than_it_needs() -> None:
    """The unit circle by its equation and x times that: one component, by the square system of the first.

    With the second in its place, or where the circle is not all of the equations, it is refused.
    """
    at, point = whole("x^2 + y^2 - 1", "x^3 + x*y^2 - x"), _square(0)
    leaf = curve_leaf(at, point, based)
    assert len(components(at, {**point, **leaf})) == 1
    with pytest.raises(Rejected):
        components(at, {**_square(1), **leaf})
    with pytest.raises(Rejected, match="a generator is not seen"):
        components(whole("x^2 + y^2 - 1", "x - y"), {**point, **leaf})


def _square(place: int) -> dict[str, Any]:
    """The part of a point that tells of the square system, one equation here."""
    return {"square": [place], "implied": {"local": "1", "steps": [], "equations": [0, 1]}}


@pytest.mark.parametrize("n", [1, 2, 3])
def test_the_rows_are_the_classes(n: int) -> None:
    """Derived here and there by themselves: 9, 19 and 21 sets of types."""
    roles = ["output"] * n + ["input"] * n
    rows = [["1" if i == j else "0" for j in range(2 * n)] for i in range(n)]
    own = verification.all_types(about([], rows, roles))
    assert {frozenset(t.split(", ")) for t in own} == {frozenset(c.types.names) for c in feasible_classes(n)}


@pytest.mark.engines
def test_a_certificate_that_ends_early(certified: Callable[[str], Certificate], tmp_path: Path) -> None:
    lines = certified("fourbar").lines
    found = verification.verify(Certificate(lines[:-1]).write(tmp_path / "short"))
    assert not found.complete
    assert all(row.occurs is not False for row in found.proven)


def test_a_file_that_is_none(tmp_path: Path) -> None:
    path = tmp_path / "file"
    path.write_text("{}")
    with pytest.raises(ValueError, match="gzip"):
        verification.verify(path)
    with pytest.raises(ValueError, match="format"):
        verification.verify(Certificate(({},)).write(path))
