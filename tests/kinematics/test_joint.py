"""The joint formulation against forward kinematics, published determinants and moving mechanisms."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
import pytest
import sympy

from singsym.kinematics.formulations import joint, place
from singsym.kinematics.placement import Placement
from singsym.mechanism.fileformat import load, loads, read
from singsym.mechanism.model import JointKind
from singsym.mechanism.problems import MechanismError
from singsym.minors.determinant import determinant
from singsym.polynomials import Polynomial, PolynomialMatrix

RSSR = """
name = "rssr"
space = "spatial"
inputs = ["A"]
output = { rate = "D" }
[links]
ground = { points = { A = [0, 0, 0], D = [2, 1, 0] }, axes = { a = [0, 0, 1], d = [0, 1, 0] } }
crank = { points = { A = [0, 0, 0], B = [1, 0, "1/4"] }, axes = { a = [0, 0, 1] } }
rod = { points = { B = [0, 0, 0], C = [3, 0, 0] } }
rocker = { points = { D = [0, 0, 0], C = [2, 0, 0] }, axes = { d = [0, 0, 1] } }
[joints]
A = { axis = "a" }
B = "S"
C = "S"
D = { axis = "d" }
"""

RCCC = """
name = "rccc"
space = "spatial"
inputs = ["A"]
output = { rate = "D.slide" }
[links]
ground = { points = { A = [0, 0, 0], D = [3, 0, 0] }, axes = { a = [0, 0, 1], d = [0, "3/5", "4/5"] } }
one = { points = { A = [0, 0, 0], B1 = [1, 0, 0] }, axes = { a = [0, 0, 1], b = [0, "-5/13", "12/13"] } }
two = { points = { B2 = [0, 0, 0], C1 = [2, 0, 0] }, axes = { b = [0, 0, 1], c = [0, "4/5", "3/5"] } }
three = { points = { C2 = [0, 0, 0], D1 = [2, 1, 0] }, axes = { c = [0, 0, 1], d = [0, "8/17", "15/17"] } }
[joints]
A = { axis = "a" }
B = { type = "C", links = ["one", "two"], at = ["B1", "B2"], axis = "b" }
C = { type = "C", links = ["two", "three"], at = ["C1", "C2"], axis = "c" }
D = { type = "C", links = ["three", "ground"], at = ["D1", "D"], axis = "d" }
"""

MIXED = """
name = "mixed"
space = "spatial"
inputs = ["A.angle", "A.slide", "B.angle1", "B.angle2", "E.x", "E.y", "E.angle"]
output = [{ twist = "three", at = "T" }, { rate = "A.angle" }]
[links]
ground = { points = { A = [0, 0, 0] }, axes = { a = [0, "3/5", "4/5"] } }
one = { points = { A1 = [0, 0, 1], B = [1, 0, 2] }, axes = { a = [0, 0, 1], b = [1, 0, 0] } }
two = { points = { B = [0, 1, 0], E = [0, 0, 3] }, axes = { b = ["3/5", "4/5", 0], e = [0, 0, -1] } }
three = { points = { E1 = [1, 0, 0], T = [1, 2, 3] }, axes = { e = [0, 0, 1] } }
[joints]
A = { type = "C", links = ["ground", "one"], at = ["A", "A1"], axis = "a" }
B = { type = "U", axis = "b" }
E = { type = "E", links = ["two", "three"], at = ["E", "E1"], axis = "e" }
"""

PUMA_560 = ((0, 90, 0), (0.4318, 0, 0), (0.0203, -90, 0.15005), (0, 90, 0.4318), (0, -90, 0), (0, 0, 0))
UR5 = (
    (0, 90, 0.089159),
    (-0.425, 0, 0),
    (-0.39225, 0, 0),
    (0, 90, 0.10915),
    (0, -90, 0.09465),
    (0, 0, 0.0823),
)
DH = {"puma560": PUMA_560, "ur5": UR5}


def forward(rows: Sequence[tuple[float, float, float]], angles: np.ndarray) -> np.ndarray:
    """Standard Denavit-Hartenberg product, written out independently of the library."""
    pose = np.eye(4)
    for (a, alpha, d), theta in zip(rows, angles, strict=True):
        c, s, ca, sa = np.cos(theta), np.sin(theta), np.cos(np.radians(alpha)), np.sin(np.radians(alpha))
        step = [[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]]
        pose = pose @ np.array(step)
    return pose


def jacobian(placement: Placement, columns: tuple[str, ...]) -> PolynomialMatrix:
    rows = zip(*(placement.screws[c] for c in columns), strict=True)
    return PolynomialMatrix.of(placement.space.ring, rows)


def real_factors(polynomial: Polynomial) -> set[str]:
    """Factors other than the circles' c^2 + s^2, as text."""
    return {str(f) for f, _ in polynomial.factors() if len(f.variables) != 2 or "^2 + s" not in str(f)}


@pytest.mark.parametrize("name", ["puma560", "ur5"])
@pytest.mark.parametrize("angles", ["relative", "absolute"])
def test_forward_kinematics(name: str, angles: str) -> None:
    mechanism = load(name)
    placement = joint.place(mechanism, angles=angles)
    theta = np.random.default_rng(3).uniform(-3, 3, 6)
    totals = dict(zip("123456", theta, strict=True))
    names = placement.space.ring.names
    values = [(np.cos if v[0] == "c" else np.sin)(sum(totals[digit] for digit in v[1:])) for v in names]
    tool = mechanism.outputs[0].point  # type: ignore[union-attr]
    found = [float(x.evaluate(values)) for x in placement.link_points["link6", tool]]
    assert found == pytest.approx(forward(DH[name], theta)[:3, 3])
    for k, column in enumerate(mechanism.columns):
        axis = [float(x.evaluate(values)) for x in placement.screws[column][:3]]
        assert axis == pytest.approx(forward(DH[name][:k], theta[:k])[:3, 2])


def test_determinant_of_the_puma_560() -> None:
    """Row 8: a2 s5 (a3 s3 + d4 c3) (a2 c2 + a3 c23 - d4 s23)."""
    mechanism = load("puma560")
    own = determinant(jacobian(joint.place(mechanism), mechanism.columns))
    ring = own.ring
    c2, s2, c3, s3, s5 = (ring.gen(v) for v in ("c2", "s2", "c3", "s3", "s5"))
    a2, a3, d4 = 4318, 203, 4318
    shoulder = a2 * c2 + a3 * (c2 * c3 - s2 * s3) - d4 * (s2 * c3 + c2 * s3)
    expected = {str(f.primitive()) for f in (s5, a3 * s3 + d4 * c3, shoulder)}
    assert real_factors(own) == expected
    sums = determinant(jacobian(joint.place(mechanism, angles="absolute"), mechanism.columns))
    assert "4318*c2 + 203*c23 - 4318*s23" in real_factors(sums)


def test_determinant_of_the_ur5() -> None:
    """Row 9: a2 a3 s3 s5 (a2 c2 + a3 c23 + d5 s234)."""
    mechanism = load("ur5")
    own = determinant(jacobian(joint.place(mechanism), mechanism.columns))
    assert {"s3", "s5"} < real_factors(own)
    sums = determinant(jacobian(joint.place(mechanism, angles="absolute"), mechanism.columns))
    assert real_factors(sums) == {"s5", "s2*c23 - c2*s23", "8500*c2 + 7845*c23 - 1893*s234"}


def test_the_hybrid_chain_of_the_paper() -> None:
    """Section 5: 18 circle variables, 9 circles, 3 distances; a leg's determinant is foot times extension."""
    placement = joint.place(load("zlatanov-hybrid"))
    space = placement.space
    own = [e for e in space.equations if e not in space.ring.relations]
    assert len(space.variables) == 18
    assert sorted(len(e) for e in own) == [3] * 9 + [21, 25, 25]
    for leg in "ABC":
        p = space.points[leg]
        moments = []
        for column in (f"{leg}1", f"{leg}2", f"{leg}3"):
            w, v = placement.screws[column][:3], placement.screws[column][3:]
            moments.append(
                [v[i] + w[(i + 1) % 3] * p[(i + 2) % 3] - w[(i + 2) % 3] * p[(i + 1) % 3] for i in range(3)]
            )
        found = determinant(PolynomialMatrix.of(space.ring, moments))
        foot = f"c_{leg}2 + c_{leg}23"
        assert real_factors(found) == {foot, f"s_{leg}2*c_{leg}23 - c_{leg}2*s_{leg}23"}


ARMS = ["2r", "scara", "ur5", "orthogonal-3r"]
LOOPS = ["3rps", "3upu-tsai", "sarrus", "bennett", "fourbar", "spherical-fourbar"]


@pytest.mark.parametrize("name", [*ARMS, *LOOPS, "stewart-gough", "zlatanov-hybrid"])
def test_screws_are_the_motion(name: str, motion_residual: Callable[..., float]) -> None:
    mechanism = load(name)
    assert motion_residual(mechanism, joint.place(mechanism), 1) < 1e-6


@pytest.mark.parametrize("text", [RSSR, RCCC, MIXED], ids=["rssr", "rccc", "mixed"])
def test_other_joints_move_by_their_screws(text: str, motion_residual: Callable[..., float]) -> None:
    mechanism = loads(text)
    assert motion_residual(mechanism, joint.place(mechanism), 1) < 1e-6


@pytest.mark.parametrize("second", ['"1/3", "2/3", "-2/3"', '"3/5", 0, "4/5"'])
def test_a_universal_joint_turns_its_axes_to_a_right_angle(second: str) -> None:
    """Axes that are parallel in the frames, or at another angle, whose sine is a root: 1 - (1/3)^2 is 8/9."""
    arm = loads(
        f"""
        space = "spatial"
        inputs = ["U.angle1", "U.angle2"]
        output = {{ velocity = "T", components = ["x", "y"] }}
        [links]
        ground = {{ points = {{ O = [0, 0, 0] }}, axes = {{ u = ["1/3", "2/3", "-2/3"] }} }}
        arm = {{ points = {{ O = [0, 0, 0], T = [1, 0, 0] }}, axes = {{ v = [{second}] }} }}
        [joints]
        U = {{ type = "U", links = ["ground", "arm"], at = "O", axis = ["u", "v"] }}
        """
    )
    space = joint.place(arm).space
    at = [{"c_": 0.6, "s_": 0.8, "sq": np.sqrt(2)}[name[:2]] for name in space.ring.names]
    u, v = (np.array([float(x.evaluate(at)) for x in space.directions[name]]) for name in "uv")
    assert abs(u @ v) < 1e-12
    assert abs(v @ v - 1) < 1e-12


def test_a_helical_joint_slides_by_its_pitch() -> None:
    """Its screw is that of the cylindrical joint's turn, plus the pitch times its slide."""
    cylinder = loads(MIXED)
    first = replace(cylinder.joints[0], kind=JointKind.H, pitch=sympy.Rational(1, 3))
    screw = joint.place(replace(cylinder, joints=(first, *cylinder.joints[1:]))).screws["A"]
    turn, slide = (joint.place(cylinder).screws[column] for column in ("A.angle", "A.slide"))
    ring = screw[0].ring
    assert screw == tuple(ring.convert(t) + ring.convert(s) / 3 for t, s in zip(turn, slide, strict=True))


def test_a_rod_spins_idly_and_is_held_by_its_length() -> None:
    placement = joint.place(loads(RSSR))
    assert len(placement.space.variables) == 4
    assert len(placement.space.equations) == 3
    assert [name for name, _ in placement.idle_spins] == ["B"]


def test_a_link_that_translates_has_a_position_only() -> None:
    mode = load("3upu-tsai")
    assert mode.translating == ("platform",)
    names = place(mode).space.variables
    assert [v for v in names if "platform" in v] == ["x_platform", "y_platform", "z_platform"]
    assert len(names) == len(place(replace(mode, translating=())).space.variables) - 1


def test_only_the_joint_formulation_knows_translating_links() -> None:
    with pytest.raises(MechanismError, match="natural for a mechanism with translating links"):
        place(load("3upu-tsai"), "natural")


def test_wrong_angles_are_refused() -> None:
    with pytest.raises(ValueError, match="expected one of auto, absolute, relative"):
        joint.place(load("2r"), angles="degrees")


@pytest.mark.parametrize("seed", range(4))
def test_the_screws_of_bennett_have_rank_3(seed: int, configuration: Callable[..., np.ndarray]) -> None:
    """Row 17, at random configurations."""
    mechanism = load("bennett")
    placement = joint.place(mechanism)
    values = jacobian(placement, mechanism.columns).evaluate(list(configuration(placement.space, seed)))
    assert np.linalg.matrix_rank(np.array(values, dtype=float), tol=1e-6) == 3


def test_the_ranks_of_sarrus() -> None:
    """Row 18: 5 in general, 4 stretched, 3 folded flat; legs (1, 1) with angles measured from the arms."""
    mechanism = load("sarrus")
    placement = joint.place(mechanism)
    matrix = jacobian(placement, mechanism.columns)
    ranks = {}
    for angle in (0.0, 0.7, np.pi / 2):
        c, s = np.cos(angle), np.sin(angle)
        # Leg A: the arm leans outwards by the angle, the fore-arm back, and the platform stays parallel.
        up = {"c_A1": c, "s_A1": -s, "c_A12": c, "s_A12": s, "c_A123": 1.0, "s_A123": 0.0}
        up |= {"c_B1": c, "s_B1": s, "c_B12": c, "s_B12": -s}
        point = [up[name] for name in placement.space.ring.names]
        for equation in placement.space.equations:
            assert float(equation.evaluate(point)) == pytest.approx(0, abs=1e-12)
        ranks[angle] = int(np.linalg.matrix_rank(np.array(matrix.evaluate(point), dtype=float), tol=1e-9))
    assert list(ranks.values()) == [3, 5, 4]


CHAIN_ON_BALLS = RSSR.replace(
    "rod = { points = { B = [0, 0, 0], C = [3, 0, 0] } }",
    """
rod = { points = { B = [0, 0, 0], E = [2, 0, 0] }, axes = { e = [0, 0, 1] } }
rod2 = { points = { E = [0, 0, 0], C = [2, 0, 0] }, axes = { e = [0, 0, 1] } }""",
).replace('D = { axis = "d" }', 'D = { axis = "d" }\nE = { axis = "e" }')


def test_what_it_does_not_suit() -> None:
    """Two hinged links between spherical joints are neither platform nor strut: the natural one."""
    mechanism = read(tomllib.loads(CHAIN_ON_BALLS))[0]
    assert joint.suits(load("stewart-gough"))
    assert not joint.suits(mechanism)
    with pytest.raises(ValueError, match="'rod' is reached through spherical joints only"):
        joint.place(mechanism)
    assert place(mechanism).space.formulation == "natural"
