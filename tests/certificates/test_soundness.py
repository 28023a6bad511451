"""Inputs on which singsym was wrong once: no certificate proves the wrong answer, however it is forged.

Source: the counterexamples are singsym's own; what is right is derived by hand in the docstring of each case.
"""

from __future__ import annotations

import copy
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import pytest
import sympy

from singsym.certificates.checker.polynomials import Rejected
from singsym.certificates.checker.sets import statement
from singsym.certificates.checker.table import Row
from singsym.certificates.checker.verification import FORMAT, all_types, verify
from singsym.certificates.prover.proof import Hints, prove
from singsym.certificates.prover.writing import Certificate

pytestmark = pytest.mark.engines
Lines = list[dict[str, Any]]
ONE, TWO = ("output", "input"), ("output", "output", "input", "input")
NEW = 900
"""A number that no set of these proofs has."""
x, y, z, w, u = sympy.symbols("x y z w u")


@dataclass(frozen=True)
class Case:
    """The statement; wrong: rows as singsym said once; right: what may be proven of the same types."""

    data: dict[str, Any]
    wrong: tuple[Row, ...]
    right: tuple[Row, ...]


def _data(equations: list[Any], L: list[list[Any]], roles: tuple[str, ...], *names: Any) -> dict[str, Any]:
    def text(value: Any) -> str:
        return str(sympy.expand(value)).replace("**", "^")

    n = roles.count("input")
    return {
        "variables": [str(name) for name in names],
        "constants": [],
        "equations": [text(e) for e in equations],
        "exclusions": [],
        "positive": [],
        "nonnegative": [],
        "L": [[text(e) for e in row] for row in L],
        "roles": list(roles),
        "n": n,
        "N": len(roles) - n,
    }


def minors_of_a_curve() -> Case:
    """u y = v x, u = v = 0 at (50, 30): (delta, p, k_I, k_O) is (2, 2, 2, 2) at (0, 0), (2, 1, 2, 2) there.

    See `tests.soundness.test_own_equations`; elsewhere all ranks are full. Both were said to be empty.
    """
    a, b = (1 + x + y) / 10, (2 - x) / 10
    s, t = 100 * ((x - 50) + 2 * (y - 30)), 100 * (3 * (x - 50) - (y - 30))
    L = [[0, 0, s, t, 0], [1, 3, a * s + x, a * t + y, 0], [0, 0, b * s - y, b * t + x, 0]]
    L += [[0, 0, 0, 0, s * x + t * y]]
    roles = ("output", "input", "passive", "passive", "passive")
    types = ("RPM, IIM", "RI, RO, RPM, IIM")
    return Case(
        _data([s * y - t * x], L, roles, x, y),
        tuple(Row(name, False) for name in types),
        tuple(Row(name, True, 0, 1, 1) for name in types),
    )


def a_shared_plane() -> Case:
    """X a + Y b = X c + Y d = 0: on X = Y = 0, of dimension 2, the determinant of L_O vanishes.

    It was said to be of dimension 1, that of the curve on the other component.
    """
    X, Y = x - 100, y - 80
    loops = [X * (x + 2 * y - z + 3 * w + 1) + Y * (2 * x - y + 3 * z - w - 2)]
    loops += [X * (-x + y + 2 * z + w + 2) + Y * (3 * x + y - z + 2 * w - 1)]
    L = [[1, 0, X, Y], [0, 1, -(x + 3 * y + 2 * z + w - 2), x - y + z - 2 * w + 3]]
    return Case(
        _data(loops, L, TWO, x, y, z, w), (Row("RI, IO", True, 1),), (Row("RI, IO", True, 2, None, None),)
    )


def a_point_beside_an_empty_surface() -> Case:
    """f p_k + g q_k = 0 for three k: p_k, q_k vanish at (1, 2, 3), f = 1 + x^2 + y^2 + z^2 nowhere.

    So that point is there, and T = 0 A has RI and IO everywhere. The curve f = g = 0 has no real points; all
    was said to be empty.
    """
    f, g, X, Y, Z = x**2 + y**2 + z**2 + 1, x * y - z + x, x - 1, y - 2, z - 3
    loops = [f * (X + Y) + g * (Z - X), f * (Y - 2 * Z) + g * (X + Z), f * (Z + 3 * X) + g * (Y - Z)]
    return Case(
        _data(loops, [[1, 0]], ONE, x, y, z),
        (Row("RI, IO", False), Row("RI, IO", True, 1)),
        (Row("RI, IO", True, 0),),
    )


def a_line_beside_an_empty_surface() -> Case:
    """As before, in (x, y, z, w), with p_k and q_k linear in x, y, z: q_3 is the determinant of L_O.

    Where f p + g q = 0 with f > 0 the vectors p and q are dependent: on some lines (x, y, z) = s v. There
    p = s p(v) and q = s q(v), so that s = 0, or f and g have one ratio: a conic in s and w. So the dimension
    is 1. It was said to be 2, that of f = g = 0.
    """
    f, g = x**2 + y**2 + z**2 + w**2 + 1, x * y - z + w
    p, q = (x + 2 * y - z, y - 3 * z, x + z - 2 * y), (x - y + 3 * z, 2 * x + z, y + z - x)
    one, two, three = (f * a + g * b for a, b in zip(p, q, strict=True))
    return Case(
        _data([one, two], [[1, 0, 1, 0], [0, 1, 0, three]], TWO, x, y, z, w),
        (Row("RI, IO", False), Row("RI, IO", True, 2)),
        (Row("RI, IO", True, 1),),
    )


def a_number_that_a_prime_divides() -> Case:
    """Katsura's equations, with the point (1, 0, 0, 0), and P u = 1, P = 2^31 - 1: no zero modulo P.

    They were said to have no solution, by that prime.
    """
    X = sympy.symbols("x0:4")

    def at(k: int) -> Any:
        return X[abs(k)] if abs(k) < len(X) else 0

    loops = [sum(at(k) * at(m - k) for k in range(-3, 4)) - X[m] for m in range(3)]
    loops += [X[0] + 2 * sum(X[1:]) - 1, (2**31 - 1) * u - 1]
    return Case(_data(loops, [[1, 0]], ONE, *X, u), (Row("RI, IO", False),), (Row("RI, IO", True, 0),))


def circles_in_two_planes() -> Case:
    """f = 0 is a circle in z = 0 and in z = 1, g = f + 5 (1 - z) is f in the second plane alone.

    So (RI, RO, II, IO) is one circle, (RI, IO) the other; the two together were counted for one of these.
    """
    f = x**2 + y**2 - 1
    L = [[1, 0, 1, 0], [0, f + 5 * (1 - z), 1, f]]
    types = ("RI, IO", "RI, RO, II, IO")
    return Case(
        _data([z * (z - 1)], L, TWO, x, y, z),
        tuple(Row(name, True, 1, None, 2) for name in types),
        tuple(Row(name, True, 1, None, 1) for name in types),
    )


CASES = (
    minors_of_a_curve,
    a_shared_plane,
    a_point_beside_an_empty_surface,
    a_line_beside_an_empty_surface,
    a_number_that_a_prime_divides,
    circles_in_two_planes,
)


def _certificate(case: Case, lines: Lines) -> Certificate:
    """The wrong rows are claimed, and all other types to be empty."""
    named = {row.types for row in case.wrong}
    claims: Lines = [{"types": t, "occurs": False} for t in all_types(statement(case.data)) if t not in named]
    for row in {row.types: row for row in case.wrong}.values():
        numbers = {"dimension": row.dimension, "points": row.points, "components": row.components}
        claims.append({"types": row.types, "occurs": row.occurs, **numbers})
    return Certificate(({"format": FORMAT, "name": "forged", "claims": claims}, case.data, *lines))


def _lies(case: Case, at: int) -> Iterator[Lines]:
    """Lines that end a set with what is not so: it is empty, a one is in its ideal, its ranks are full."""
    rows, roles = range(len(case.data["L"])), case.data["roles"]
    for place in range(len(case.data["equations"])):
        yield [{"at": at, "rule": "empty", "equation": place}]
    for units in ([], [0], [1], [0, 1]):
        cancelled = {"at": at, "rule": "cancel", "polynomial": "1", "units": units, "into": [NEW]}
        places = range(len(case.data["equations"]) + 3)
        yield from ([cancelled, {"at": NEW, "rule": "empty", "equation": k}] for k in places)
    for units in ([], [0]):
        evidence = {}
        for name, without in (("L_I", "input"), ("L_O", "output")):
            columns = [j for j, role in enumerate(role for role in roles if role != without)]
            item = {"rows": [*rows], "columns": columns[: len(rows)], "units": units, "exact": True}
            evidence[name] = [item]
        yield [{"at": at, "rule": "ranks", "ranks": evidence}]
    below = {name: [{"below": 1}] for name in ("L", "L_p", "L_I", "L_O")}
    yield [{"at": at, "rule": "ranks", "ranks": below}]


def _larger(line: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """A leaf whose point has one variable more that is free, and one equation less."""
    point: dict[str, Any] = line.get("point", {})
    for name in point.get("centre", ()):
        fixed = point["fixed"] | {name: point["centre"][name]}
        centre = {other: value for other, value in point["centre"].items() if other != name}
        for place in point["square"]:
            square = [k for k in point["square"] if k != place]
            yield line | {"point": point | {"fixed": fixed, "centre": centre, "square": square}}


def _forged(case: Case, honest: Lines) -> Iterator[Lines]:
    """Each set of an honest proof ended by a lie, without what the proof has of its parts."""
    yield honest
    for number, leaf in enumerate(honest):
        yield from ([*honest[:number], lie, *honest[number + 1 :]] for lie in _larger(leaf))
        at = honest[number]["at"]
        inside = {at}
        for line in honest:
            if line["at"] in inside:
                inside |= {*line.get("into", ())}
        rest = [line for line in honest if line["at"] not in inside]
        yield from ([*rest, *copy.deepcopy(lie)] for lie in _lies(case, at))


def _is_wrong(row: Row, right: Row) -> bool:
    pairs = [
        (getattr(row, key), getattr(right, key)) for key in ("occurs", "dimension", "points", "components")
    ]
    return any(a is not None and b is not None and a != b for a, b in pairs)


@pytest.mark.parametrize("case", CASES)
def test_no_certificate_of_the_wrong_answer(case: Callable[[], Case], tmp_path: Path) -> None:
    made = case()
    honest = prove(statement(made.data), Hints()).lines
    for lines in _forged(made, honest):
        try:
            found = verify(_certificate(made, lines).write(tmp_path / "forged"))
        except Rejected:
            continue
        rows = {row.types: row for row in found.proven}
        assert not any(_is_wrong(rows[right.types], right) for right in made.right), lines
        assert not found.complete
    unclaimed = replace(made, wrong=tuple(Row(row.types, None) for row in made.wrong))
    rows = {row.types: row for row in verify(_certificate(unclaimed, honest).write(tmp_path / "own")).proven}
    assert not any(_is_wrong(rows[right.types], right) for right in made.right)


def test_a_curve_is_not_counted_with_one_beside_it(tmp_path: Path) -> None:
    """The loops of f = 0, one in each plane, are not those of its part where g is not zero.

    That part is the circle in z = 0: both loops, and each by itself, are refused, as in z = 1 no point is
    off g = 0, and a loop alone misses the critical points of the other.
    """
    f = x**2 + y**2 - 1
    both = _data([z * (z - 1), f], [[1, 0]], ONE, x, y, z)
    (derived, leaf) = prove(statement(both), Hints(curves=True)).lines
    curve = leaf["curve"]
    assert len(curve["loops"]) == 2
    case = circles_in_two_planes()
    data = {**case.data, "equations": both["equations"]}
    assert (derived["rule"], leaf["rule"]) == ("derive", "ranks")
    evidence = {
        "L_I": [{"rows": [0, 1], "columns": [0, 1], "units": [0], "scale": "1"}],
        "L_O": [{"below": 2}],
    }
    for loops, why in (
        (curve["loops"], "no point of it"),
        (curve["loops"][:1], "critical point|no point of it"),
        (curve["loops"][1:], "critical point|no point of it"),
    ):
        split = {"at": derived["into"][0], "rule": "split", "by": data["L"][1][1], "into": [NEW, NEW + 1]}
        ranks = {"at": NEW + 1, "rule": "ranks", "ranks": evidence}
        lines = [derived, split, ranks | {"curve": {**curve, "loops": loops}}]
        with pytest.raises(Rejected, match=why):
            verify(_certificate(Case(data, case.wrong, case.right), lines).write(tmp_path / "forged"))
    verify(_certificate(Case(data, (), ()), [derived, split, ranks]).write(tmp_path / "without"))
