"""Couplings in files: what is read, what is refused and how, and what other units make of them."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from math import gcd
from typing import Any

import pytest
import sympy

from singsym.mechanism import Coupling, Mechanism, MechanismError, check, define, dumps, loads
from singsym.mechanism.couplings import angle_relations, mountings, slide_relations
from singsym.mechanism.locking import locked
from singsym.mechanism.units import own_unit, scaled

HALF = sympy.Rational(1, 2)


def arm(couplings: object, joints: str = "ABCDF", inputs: object = ("A",), **more: Any) -> Mechanism:
    """Turning joints in a row, in the plane, with sides of length 1."""
    ends = [*joints, "T"]
    links: dict[str, object] = {"ground": {"points": {joints[0]: [0, 0]}}}
    links |= {f"{a}{b}": 1 for a, b in pairwise(ends)}
    output = {"twist": f"{joints[-1]}T", "components": ["w", "vx", "vy"][: len(list(inputs))]}
    data = {"inputs": list(inputs), "output": output, "couplings": couplings}
    return define(**data, links=links, joints=dict.fromkeys(joints, "R"), **more)


def slides(couplings: object, inputs: object = ("P",), **more: Any) -> Mechanism:
    """Two slides and a pin between the ground and a tool: P along x, Q along y, then R."""
    body = {"points": {}, "axes": {"x": [1, 0], "y": [0, 1]}}
    links = {
        "ground": {**body, "points": {"O": [0, 0]}},
        "one": {**body, "points": {"M": [0, 0]}},
        "two": {**body, "points": {"R": [0, 0]}},
        "RT": 1,
    }
    joints = {
        "P": {"type": "P", "links": ["ground", "one"], "at": ["O", "M"], "axis": "x"},
        "Q": {"type": "P", "links": ["one", "two"], "at": ["M", "R"], "axis": "y"},
        "R": "R",
    }
    output = {"velocity": "T", "components": ["x", "y"][: len(list(inputs))]}
    return define(inputs=list(inputs), output=output, links=links, joints=joints, couplings=couplings, **more)


def gears(rates: object, **more: object) -> dict[str, object]:
    return {"gears": {"rates": rates, **more}}


def test_a_file_says_rates_and_a_constant() -> None:
    text = """
inputs = ["A"]
output = { twist = "BT", components = ["w"] }
[links]
ground = { points = { A = [0, 0] } }
AB = 1
BT = 1
[joints]
A = "R"
B = "R"
[couplings]
gears = { rates = { A = 0.5, B = "-3/4" }, constant = "30 deg" }
"""
    mechanism = loads(text)
    assert mechanism.couplings == (
        Coupling("gears", (("A", HALF), ("B", -sympy.Rational(3, 4))), sympy.pi / 6),
    )
    assert mechanism.N == 2
    assert mechanism.n == 1
    assert loads(dumps(mechanism)) == mechanism


def test_parameters_with_values_are_ratios() -> None:
    rates = {"A": "20/z", "B": -1}
    mechanism = arm(gears(rates), "AB", parameters={"z": 30})
    (relation,) = angle_relations(mechanism)
    assert dict(relation.terms) == {"A": 2, "B": -3}
    assert loads(dumps(mechanism)) == mechanism


@pytest.mark.parametrize(
    ("couplings", "inputs", "words"),
    [
        (gears({"A": 1, "BB": 2}), "A", r"gears.rates.BB: found the unknown 'BB'.*among A, B, C, D, F"),
        (gears({"A": 1}), "A", r"gears: found the rates of A; expected two joints or more"),
        ({"gears": {}}, "A", r"found the rates of no joint.*write rates = \{ A = 1, B = 2 \}"),
        (gears({"A": 0, "B": 2}), "A", r"gears.rates.A: found the coefficient 0.*leave A out"),
        (gears({"A": "sqrt(2)", "B": 2}), "A", r"rates.A: found sqrt\(2\); expected a rational number"),
        (gears({"A": 1, "B": "97/101"}), "A", r"gears: found coprime whole coefficients up to 101"),
        (gears({"A": 1, "B": 2}, constant="1 rad"), "A", r"gears.constant"),
        (gears({"A": 1, "B": 2}, constant="sqrt(2)"), "A", r"gears.constant: .*an angle such as 40 deg"),
        (gears({"A": 1, "B": 2}, phase=1), "A", r"found the key 'phase'.*keys among rates, constant"),
        (gears({"A": 1, "B": 2}), "AB", r"found inputs alone: A, B; .*leave one of the inputs out"),
        ({"gears": 3}, "A", r"couplings.gears: found the number 3; expected a table"),
        ({"a b": {"rates": {"A": 1, "B": 1}}}, "A", r"found the name 'a b'"),
        (
            {
                "one": {"rates": {"A": 1, "B": 1}},
                "two": {"rates": {"B": 1, "C": 1}},
                "three": {"rates": {"A": 1, "C": -1}},
            },
            "A",
            r"couplings: found one, two, three, of which one follows from the others",
        ),
        (
            {"one": {"rates": {"A": 1, "B": 1, "C": 1}}, "two": {"rates": {"A": 1, "B": 2, "C": 1}}},
            "AB",
            r"couplings: found one, two, which together bind inputs alone",
        ),
    ],
)
def test_faults_are_named(couplings: object, inputs: str, words: str) -> None:
    with pytest.raises(MechanismError, match=words):
        arm(couplings, inputs=tuple(inputs))


def test_the_same_name_twice_in_python() -> None:
    one = arm(gears({"A": 1, "B": 2}))
    twice = replace(one, couplings=one.couplings * 2)
    assert "couplings.gears: found 2 couplings of this name" in "\n".join(map(str, check(twice)))


def test_of_a_rack_the_rates_alone_are_said() -> None:
    mechanism = slides(gears({"P": 1, "R": "1/2"}))
    assert mechanism.couplings[0].constant is None
    assert (angle_relations(mechanism), slide_relations(mechanism)) == ((), ())
    assert mountings(mechanism) == ("gears",)
    assert loads(dumps(mechanism)) == mechanism
    with pytest.raises(
        MechanismError, match=r"gears.constant: .*the slide P with the angle R; .*leave it out"
    ):
        slides(gears({"P": 1, "R": 2}, constant=0))
    turning = arm(gears({"A": 1, "B": 2}))
    open_end = replace(turning, couplings=(replace(turning.couplings[0], constant=None),))
    assert "gears.constant: found no constant" in "\n".join(map(str, check(open_end)))


def test_a_freedom_without_an_angle_is_refused() -> None:
    links = {
        "ground": {"points": {"A": [0, 0, 0], "B": [4, 0, 0]}, "axes": {"z": [0, 0, 1]}},
        "crank": {"points": {"A": [0, 0, 0], "C": [1, 0, 0]}, "axes": {"z": [0, 0, 1]}},
        "rod": {"points": {"C": [0, 0, 0]}},
    }
    joints = {"A": {"type": "R", "axis": "z"}, "C": {"type": "S"}}
    with pytest.raises(MechanismError, match=r"'C.x', a freedom without an angle; expected .* among A"):
        define(
            space="spatial",
            inputs=["A"],
            output={"twist": "rod", "components": ["wz"]},
            links=links,
            joints=joints,
            couplings=gears({"A": 1, "C.x": 1}),
        )


def test_a_coupled_joint_is_not_held() -> None:
    mechanism = arm(gears({"A": 1, "B": 2}), inputs="AC")
    with pytest.raises(MechanismError, match="a joint of the coupling gears"):
        locked(mechanism, {"A": 0})
    assert locked(mechanism, {"C": 0}).couplings == mechanism.couplings


def test_coefficients_become_coprime_and_the_constant_with_them() -> None:
    """4 A - 6 B = 120 deg is 2 A - 3 B = 60 deg: on one turn of the whole relation there is one phase."""
    (relation,) = angle_relations(arm(gears({"A": 4, "B": -6}, constant="120 deg")))
    assert relation.terms == (("A", 2), ("B", -3))
    assert relation.constant == sympy.pi / 3


def test_two_relations_make_a_third() -> None:
    """A + B = 2 C and A - B = 2 D + 60 deg have half their sum, A = C + D + 30 deg, as a whole relation.

    Modulo full turns the two alone would also allow A = C + D + 210 deg, to which no motion leads.
    """
    both = {
        "one": {"rates": {"A": 1, "B": 1, "C": -2}},
        "two": {"rates": {"A": 1, "B": -1, "D": -2}, "constant": "60 deg"},
    }
    relations = angle_relations(arm(both, inputs="AB"))
    rows = [[int(dict(r.terms).get(name, 0)) for name in "ABCD"] for r in relations]
    minors = [rows[0][i] * rows[1][j] - rows[0][j] * rows[1][i] for i in range(4) for j in range(i + 1, 4)]
    assert gcd(*minors) == 1
    # any solution of the two in real numbers is one of these
    for A, B in ((0, 0), (7, -3), (1, 5)):
        at = {"A": A, "B": B, "C": sympy.Rational(A + B, 2), "D": sympy.Rational(A - B, 2) - sympy.pi / 6}
        for relation in relations:
            total = sum(x * at[name] for name, x in relation.terms)
            assert sympy.expand(total - relation.constant) == 0


def test_lengths_scale_with_the_unit() -> None:
    mechanism = slides(gears({"P": 1, "Q": -2}, constant=3))
    bigger = scaled(mechanism, Fraction(1000))
    assert slide_relations(bigger)[0].constant == 3000
    assert own_unit(bigger) == 1000 * own_unit(mechanism)
    rack = scaled(slides(gears({"P": 1, "R": "1/2"})), Fraction(1000))
    assert rack.couplings[0].terms == (("P", 1), ("R", 500))
    turning = arm(gears({"A": 1, "B": 2}, constant="90 deg"))
    assert scaled(turning, Fraction(1000)).couplings == turning.couplings


def cam(lift: str, follower: str = "P") -> dict[str, object]:
    return {"cam": {"follower": follower, "lift": lift}}


def test_of_a_cam_the_lift_is_said() -> None:
    """The ratio of the rates is the derivative: of 3 + 2 cos R - sin^2 R it is -2 sin R - 2 sin R cos R."""
    mechanism = slides(cam("3 + a*cos(R) - sin(R)^2"), inputs=("Q",), parameters={"a": 2})
    (coupling,) = mechanism.resolved.couplings
    cosine, sine = sympy.symbols("cos(R) sin(R)")
    assert coupling.terms[0] == ("P", 1)
    assert coupling.terms[1][0] == "R"
    assert sympy.expand(coupling.terms[1][1] - 2 * sine - 2 * sine * cosine) == 0
    assert loads(dumps(mechanism)) == mechanism
    assert (angle_relations(mechanism), slide_relations(mechanism), mountings(mechanism)) == ((), (), ())


def test_a_wedge_is_a_cam_that_slides() -> None:
    (coupling,) = slides(cam("3 - length(Q)^2/2")).couplings
    assert coupling.terms == (("P", 1), ("Q", sympy.Symbol("length(Q)")))


@pytest.mark.parametrize(
    ("couplings", "words"),
    [
        (cam("3"), r"cam.lift: found 3; expected something that moves"),
        (cam("cos(R)^2 + sin(R)^2"), r"cam.lift: found the constant .*; expected a lift that varies"),
        (
            cam("angle(R)"),
            r"cam.lift: found angle\(R\); .*write the rates, as of a rack",
        ),
        (cam("cos(R) + length(Q)"), r"cam.lift: .*of one joint A, or in length\(P\) of one slide"),
        (cam("T.x"), r"cam.lift: found T.x; expected a polynomial in cos\(A\)"),
        (cam("1/(3 + cos(R))"), r"cam.lift: .*expected a polynomial in cos\(R\)"),
        (cam("cos(R)", "R"), r"cam: found the rates of R, R; expected two joints or more"),
        (cam("length(Q)", "R"), r"cam.follower: found 'R', which turns; expected a slide, P, Q.*the linkage"),
        (cam("cos(R)", "S"), r"cam.follower: found the unknown 'S'; expected a slide, P, Q"),
        ({"cam": {"follower": "P"}}, r"cam.lift: found no lift; expected the length of the follower"),
        ({"cam": {"follower": "P", "lift": "cos(R)", "rates": {}}}, r"found the key 'rates'"),
        ({**cam("cos(R)"), "rod": {"follower": "Q", "lift": "2*sin(R)"}}, r"together bind inputs alone"),
    ],
)
def test_faults_of_cams_are_named(couplings: object, words: str) -> None:
    with pytest.raises(MechanismError, match=words):
        slides(couplings, inputs=("P", "Q"))


def test_a_lift_scales_with_the_unit() -> None:
    turning, sliding = slides(cam("3 + 2*cos(R)")), slides(cam("3 + 2*length(Q)^2"))
    cosine, length = sympy.symbols("cos(R) length(Q)")
    assert scaled(turning, Fraction(10)).couplings[0].lift == 30 + 20 * cosine
    assert scaled(sliding, Fraction(10)).couplings[0].lift == 30 + length**2 / 5
