"""Single configurations on which ranks were wrong, with what is right; the distance along lines; more digits.

Expected values are derived in each test from the geometry of the mechanism, not by the program.
"""

from __future__ import annotations

import cmath
import math
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import mpmath
import pytest

from singsym.classes.configuration.at import Analysis, at
from singsym.classes.taxonomy.types import SingularityType as T
from singsym.kinematics import check_mobility, velocity_equation
from singsym.mechanism import Mechanism, define, load

CASES = Path(__file__).parent
STILL = T.RI | T.IO
"""Class 1."""
UNITS = pytest.mark.parametrize("unit", [1, 1000], ids=["m", "mm"])


def tables(name: str) -> dict[str, Any]:
    return tomllib.loads((CASES / f"{name}.toml").read_text(encoding="utf-8"))


def times(value: Any, unit: int) -> Any:
    if isinstance(value, list):
        return [times(x, unit) for x in value]
    return f"{unit} * ({value})"


def mechanism_in(name: str, unit: int) -> Mechanism:
    """The case with every length times `unit`."""
    data = tables(name)
    for link, given in data.get("links", {}).items():
        if isinstance(given, dict):
            given["points"] = {k: times(v, unit) for k, v in given.get("points", {}).items()}
        else:
            data["links"][link] = times(given, unit)
    for row in data.get("dh", {}).get("rows", []):
        row["a"], row["d"] = times(row["a"], unit), times(row["d"], unit)
    return define(**data)


def analysed(name: str, config: str, unit: int) -> Analysis:
    given = tables(f"{config}.config")
    if "points" in given:
        given["points"] = {k: times(v, unit) for k, v in given["points"].items()}
    return at(mechanism_in(name, unit), given)


def restriction(found: Analysis) -> dict[str, float]:
    (only,) = [m for m in found.motions if m.restriction]
    return dict(only.rates)


def proportional(rates: dict[str, float], expected: dict[str, float]) -> bool:
    scale = max(expected.values(), key=abs) / rates[max(expected, key=lambda k: abs(expected[k]))]
    return rates.keys() == expected.keys() and all(
        math.isclose(rates[k] * scale, v, abs_tol=1e-9) for k, v in expected.items()
    )


# -- the cases ----------------------------------------------------------------------------------------


@UNITS
def test_a_folded_arm_whose_tip_is_on_the_first_axis(unit: int) -> None:
    """T = A: A turns without moving T, and T moves at right angles to BT only, so T.x B.x + T.y B.y = 0."""
    found = analysed("at-2r-folded", "at-2r-folded", unit)
    assert found.types == STILL
    assert found.singularity_class is not None
    assert found.singularity_class.number == 1
    (turn,) = [m for m in found.motions if not m.restriction]
    assert turn.rates == {"A": 1.0}
    x, y = found.points["B"]
    assert proportional(restriction(found), {"T.x": x, "T.y": y})


@UNITS
@pytest.mark.parametrize(("config", "exact"), [("", False), ("-exact", True)])
def test_an_elbow_arm_whose_tool_is_on_the_first_axis(unit: int, config: str, exact: bool) -> None:
    """cos J2 + cos(J2 + J3) = 0: J1 turns alone, and the tool stays in the plane -sin J1 x + cos J1 y = 0.

    J2 = J3 = 60 degrees: 1/2 - 1/2; J2 = 1, J3 = pi - 2 to 15 digits: cos 1 + cos(pi - 1).
    """
    found = analysed("at-elbow-shoulder", f"at-elbow-shoulder{config}", unit)
    assert found.exact == exact
    assert found.types == STILL
    assert not found.undecided
    assert [set(m.rates) for m in found.motions if not m.restriction] == [{"J1"}]
    J1 = math.pi / 6 if exact else 0.3
    assert proportional(restriction(found), {"T.x": -math.sin(J1), "T.y": math.cos(J1)})
    assert found.matrices["L_O"].distance == pytest.approx(0, abs=1e-14)


@UNITS
def test_a_goldberg_linkage_is_mobile(unit: int) -> None:
    """Goldberg's 5R moves, and its joint screws have rank 4 (two Bennett linkages share a link): n = 1."""
    found = check_mobility(velocity_equation(mechanism_in("goldberg-5r", unit)))
    assert found.ranks == {"L": 5, "L_I": 5, "L_O": 5, "L_p": 4}
    assert found.samples > 0
    assert found.messages == ()


@UNITS
def test_a_guided_delta_with_one_arm_still(unit: int) -> None:
    """M = e2 + t2: rod 2 lies at right angles to the velocity that arm 2 gives B2, so arm 2 turns alone.

    M cannot move along rod 2, which is C2 - B2 = -(sqrt(3)/2, 1/2, 0).
    """
    found = analysed("delta-guided", "delta-guided", unit)
    assert found.types == STILL
    assert proportional(restriction(found), {"T.x": math.sqrt(3) / 2, "T.y": 0.5})


@pytest.mark.slow
@UNITS
def test_an_architecture_singular_platform_with_two_legs_of_length_zero(unit: int) -> None:
    """Legs 1 and 4 have length zero: each of the two turns freely about its point, in two ways.

    So L_p has a kernel of dimension 4, rank 36 - 4, and L_O rank 42 - 4. The four other legs lie in the
    plane z = 0, where lines have rank 3; the two directions that are free make it 5: one self-motion of the
    platform with lengths locked, and L_I has rank 42 - 4 - 1. L contains all six twists of the platform.
    """
    found = analysed("architecture-singular-6sps", "architecture-singular-6sps", unit)
    assert found.ranks == {"L": 42, "L_I": 37, "L_O": 38, "L_p": 32}
    assert not found.undecided


@pytest.mark.slow
@UNITS
def test_an_architecture_singular_platform_cannot_be_driven(unit: int) -> None:
    """The six lines always have rank 5 (Griffis and Duffy): rank L_I = 42 - 1 at random configurations."""
    found = check_mobility(velocity_equation(mechanism_in("architecture-singular-6sps", unit)))
    assert found.ranks == {"L": 42, "L_I": 41, "L_O": 42, "L_p": 36}


# -- the distance along lines -------------------------------------------------------------------------

DEAD = math.acos((4**2 + 4.5**2 - 3**2) / (2 * 4 * 4.5))
"""The crank's angle where crank 1 and coupler 7/2 of the four-bar 4, 1, 7/2, 3 are in line: |AC| = 9/2."""


def stretched_leg(e: float) -> dict[str, Any]:
    """The five-bar 2, 3, 3, 2 on a base of 1 with its first leg bent by e, D on the left of EC."""
    B = 2 * cmath.exp(1j)
    C = B + 3 * cmath.exp(1j * (1 + e))
    way = C - 1
    along = (2**2 - 3**2 + abs(way) ** 2) / (2 * abs(way))
    D = 1 + way / abs(way) * complex(along, math.sqrt(2**2 - along**2))
    return {"points": {name: [z.real, z.imag] for name, z in (("B", B), ("C", C), ("D", D))}}


LINES: dict[str, tuple[str, Callable[[float], dict[str, Any]]]] = {
    "tip on the first axis": ("at-2r-folded", lambda e: {"joints": {"A": 0.3, "B": math.pi - e}}),
    "arm stretched": ("at-2r-folded", lambda e: {"joints": {"A": 0.3, "B": e}}),
    "tool on the first axis": (
        "at-elbow-shoulder",
        lambda e: {"joints": {"J1": 0.3, "J2": 1, "J3": math.pi - 2 + e}},
    ),
    "elbow stretched": ("at-elbow-shoulder", lambda e: {"joints": {"J1": 0.3, "J2": 1, "J3": e}}),
    "leg stretched": ("five-bar", stretched_leg),
    "dead point": ("fourbar", lambda e: {"joints": {"A": DEAD + e}}),
}


def on_line(line: str, e: float) -> Analysis:
    name, given = LINES[line]
    mechanism = load(CASES / f"{name}.toml") if (CASES / f"{name}.toml").exists() else load(name)
    return at(mechanism, given(e))


@pytest.mark.parametrize("line", LINES)
def test_the_distance_goes_to_zero_with_the_way_to_a_singular_configuration(line: str) -> None:
    """det L_O has a simple zero on these lines, so the distance falls in proportion to the way."""
    near = {e: on_line(line, e).matrices["L_O"].distance for e in (1e-2, 1e-3, 1e-5)}
    assert 0.01 < near[1e-2] / 1e-2 < 10
    assert near[1e-3] / 1e-3 == pytest.approx(near[1e-2] / 1e-2, rel=0.1)
    assert near[1e-5] / 1e-5 == pytest.approx(near[1e-3] / 1e-3, rel=0.1)
    end = on_line(line, 0.0)
    assert end.matrices["L_O"].distance < 1e-7
    assert end.types == STILL


def test_the_distance_of_an_elbow_arm_near_its_first_axis() -> None:
    """J1's column is r = cos J2 + cos(J2 + J3), the tool's distance from the axis, normal to the others.

    So r over the characteristic length is the smallest singular value: about 6e-6 at J3 = 1.1416.
    """
    found = at(load(CASES / "at-elbow-shoulder.toml"), {"joints": {"J1": "0.3", "J2": 1, "J3": "1.1416"}})
    r = math.cos(1) + math.cos(2.1416)
    points = [(0, 0), (0, 1), (math.cos(1), 1 + math.sin(1)), (r, 1 + math.sin(1) + math.sin(2.1416))]
    centre = [sum(p[k] for p in points) / 4 for k in (0, 1)]
    length = math.sqrt(sum(math.dist(p, centre) ** 2 for p in points) / 4)
    assert found.types == T(0)
    assert found.matrices["L_O"].distance == pytest.approx(abs(r) / length, rel=1e-6)


# -- digits -------------------------------------------------------------------------------------------


def elbow(J3: Any) -> Analysis:
    return at(load(CASES / "at-elbow-shoulder.toml"), {"joints": {"J1": "0.3", "J2": 1, "J3": J3}})


def test_thirty_digits_tell_regular_from_singular() -> None:
    """pi - 2 + 1e-12 is regular, at a distance that falls with the way; pi - 2 itself is not."""
    with mpmath.workdps(40):
        singular = mpmath.pi - 2
        near = elbow(mpmath.nstr(singular + mpmath.mpf("1e-12"), 32))
        nearer = elbow(mpmath.nstr(singular + mpmath.mpf("1e-13"), 32))
        there = elbow(mpmath.nstr(singular, 32))
    assert near.digits == 32
    assert near.types == nearer.types == T(0)
    assert not near.undecided
    distance = near.matrices["L_O"].distance
    # r = cos 1 + cos(pi - 1 + e) is e sin 1 to first order, and the length is that at J3 = 1.1416
    assert distance == pytest.approx(1e-12 * math.sin(1) / near.length, rel=1e-6)
    assert nearer.matrices["L_O"].distance == pytest.approx(distance / 10, rel=1e-6)
    assert there.types == STILL
    assert there.matrices["L_O"].distance < 1e-30


def test_a_closed_loop_is_closed_to_thirty_digits() -> None:
    """The four-bar 1e-10 and 0 from its dead point."""
    with mpmath.workdps(40):
        dead = mpmath.acos(mpmath.mpf("27.25") / 36)
        near, there = (
            at(load("fourbar"), {"joints": {"A": mpmath.nstr(dead + e, 34)}})
            for e in (mpmath.mpf("1e-10"), 0)
        )
        x, y = near.points["B"]
        assert abs(x**2 + y**2 - 1) < mpmath.mpf(10) ** -38
    assert near.located is not None
    assert near.located.after < 1e-50
    assert near.types == T(0)
    assert near.matrices["L_O"].distance == pytest.approx(
        1e-5 * on_line("dead point", 1e-5).matrices["L_O"].distance
    )
    assert there.types == STILL


def test_an_exact_configuration_may_be_as_near_as_one_likes() -> None:
    """B = (1, 0), T = B - (1 - t^2, -2 t)/(1 + t^2): det L_O is T.y, and the distance 2 t over the length.

    The three points A, B and T = A are spread by sqrt(2)/3.
    """
    t = mpmath.mpf(10) ** -20
    T_ = ["1 - (1 - 1/10^40)/(1 + 1/10^40)", "2/10^20/(1 + 1/10^40)"]
    found = at(load(CASES / "at-2r-folded.toml"), {"points": {"B": [1, 0], "T": T_}})
    assert found.exact
    assert found.types == T(0)
    assert found.matrices["L_O"].distance == pytest.approx(float(2 * t) * 3 / math.sqrt(2), rel=1e-6)


def test_what_is_too_near_to_the_threshold_is_undecided() -> None:
    """J3 = 1.1415927 is 4.6e-8 from pi - 2: more than rounding, less than what doubles can tell for sure."""
    found = elbow("1.1415927")
    assert "too near to the threshold" in found.undecided
    assert found.singularity_class is None
    chosen = at(
        load(CASES / "at-elbow-shoulder.toml"),
        {"joints": {"J1": "0.3", "J2": 1, "J3": "1.1415927"}},
        tolerance=1e-9,
    )
    assert not chosen.undecided
    assert chosen.types == T(0)
