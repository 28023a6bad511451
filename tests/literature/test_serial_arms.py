"""Rows 8-10 and 16 of the published results: determinants of serial arms in closed form."""

from __future__ import annotations

from collections.abc import Callable

import pytest
import sympy

from singsym.classes.result import Classification
from singsym.classes.taxonomy.types import SingularityType
from singsym.conditions.conditions import conditions
from singsym.elimination.ideal import Ideal
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import Mechanism, load
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.points.finite_sets import real_points

Classified = Callable[[Mechanism], Classification]


def factors(name: str) -> list[sympy.Expr]:
    """The factors of condition (5) as expressions in the joints' cosines and sines."""
    found = conditions(velocity_equation(load(name)))["5"].factors
    return [f.polynomial.to_sympy() for f in found]


def c(*joints: int) -> sympy.Expr:
    """The cosine of a sum of joint angles, expanded in c1, s1, ..."""
    return _expanded(sympy.cos, joints)


def s(*joints: int) -> sympy.Expr:
    """The sine of a sum of joint angles, expanded in c1, s1, ..."""
    return _expanded(sympy.sin, joints)


def _expanded(function: sympy.Function, joints: tuple[int, ...]) -> sympy.Expr:
    angles = sympy.symbols([f"t{j}" for j in joints])
    found = sympy.expand_trig(function(sum(angles)))
    names = {sympy.cos(t): sympy.Symbol(f"c{j}") for t, j in zip(angles, joints, strict=True)}
    names |= {sympy.sin(t): sympy.Symbol(f"s{j}") for t, j in zip(angles, joints, strict=True)}
    return found.xreplace(names)


def same_up_to_constants(found: list[sympy.Expr], expected: list[sympy.Expr]) -> bool:
    def monic(e: sympy.Expr) -> sympy.Expr:
        return sympy.Poly(e).monic().as_expr()

    return {monic(e) for e in found} == {monic(sympy.expand(e)) for e in expected}


def test_puma() -> None:
    """Row 8: det J = -a2 s5 (a3 s3 + d4 c3) (a2 c2 + a3 c23 - d4 s23), wrist, elbow, shoulder."""
    a2, a3, d4 = (sympy.Rational(x) for x in ("0.4318", "0.0203", "0.4318"))
    shoulder = a2 * c(2) + a3 * c(2, 3) - d4 * s(2, 3)
    assert same_up_to_constants(factors("puma560"), [s(5), a3 * s(3) + d4 * c(3), shoulder])


def test_ur5() -> None:
    """Row 9: det J = -a2 a3 s3 s5 (a2 c2 + a3 c23 + d5 s234)."""
    a2, a3, d5 = (sympy.Rational(x) for x in ("-0.425", "-0.39225", "0.09465"))
    shoulder = a2 * c(2) + a3 * c(2, 3) + d5 * s(2, 3, 4)
    assert same_up_to_constants(factors("ur5"), [s(3), s(5), shoulder])


@pytest.mark.parametrize(("name", "sine"), [("2r", "s_B"), ("scara", "s2")])
def test_planar_arm_and_scara(classified: Classified, name: str, sine: str) -> None:
    """Row 10: det = l1 l2 sin(theta2); so (RI, IO) in the stretched and the folded arm, nothing else."""
    assert factors(name) == [sympy.Symbol(sine)]
    result = classified(load(name))
    assert not result.undecided
    found = {c.types: c.dimension for c in result.classes if c.verdict.is_yes}
    assert found == {SingularityType.RI | SingularityType.IO: result.equation.n - 1}


def test_orthogonal_arm() -> None:
    """Row 16: det = d4 (d3 + d4 c3) (s3 d2 + c2 (s3 d3 - c3 r2)); the first bracket has no zero, d3 > d4."""
    c2, s3, c3 = sympy.symbols("c2 s3 c3")
    assert same_up_to_constants(factors("orthogonal-3r"), [s3 * 1 + c2 * (s3 * 2 - c3 * 1)])


def test_four_cusps_of_the_orthogonal_arm() -> None:
    """Row 16: the image of the singularity curve in (rho, z) has 4 cusps (Baili, Wenger, Chablat).

    A cusp: the map (theta2, theta3) -> (rho^2, z) is singular and so is the curve's image along the kernel.
    The tool's place by hand: x = 1 + c2 X, y = W, z = -s2 X with X = 2 + 3/2 c3, W = 1 + 3/2 s3.
    """
    (factor,) = (f.polynomial for f in conditions(velocity_equation(load("orthogonal-3r")))["5"].factors)
    ring = Ring(("c2", "s2", "c3", "s3"))
    factor = ring.convert(factor)
    c2, s2, c3, s3 = ring.gens

    def turn(p: Polynomial, joint: str) -> Polynomial:
        cosine, sine = ring.gen(f"c{joint}"), ring.gen(f"s{joint}")
        return p.derivative(f"s{joint}") * cosine - p.derivative(f"c{joint}") * sine

    reach, height = 2 + c3 * 3 / 2, 1 + s3 * 3 / 2
    squared, z = (1 + c2 * reach) ** 2 + height**2, -s2 * reach
    rows = [(turn(f, "2"), turn(f, "3")) for f in (squared, z)]
    circles = (c2**2 + s2**2 - 1, c3**2 + s3**2 - 1)
    det = rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0]
    assert Ideal(ring, circles).contains(det - 3 * reach * factor).value
    cusps = [turn(factor, "2") * b - turn(factor, "3") * a for a, b in rows]
    assert len(real_points([*circles, factor, *cusps]).value) == 4
