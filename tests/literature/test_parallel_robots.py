"""Rows 11-14 of the published results: loci of parallel manipulators in closed form."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from math import prod

import numpy as np
import pytest

from singsym.classes.result import Classification
from singsym.classes.taxonomy.types import SingularityType
from singsym.conditions.conditions import conditions
from singsym.elimination.ideal import Ideal
from singsym.kinematics.sampling import sample_configurations
from singsym.kinematics.velocity import VelocityEquation, velocity_equation
from singsym.mechanism import Mechanism, load
from singsym.minors.determinant import determinant
from singsym.polynomials import Polynomial, Ring
from singsym.polynomials.compiled_map import numerical_matrix
from singsym.varieties.real.points.finite_sets import real_points

Classified = Callable[[Mechanism], Classification]

# a rational rotation about a general axis
TURNED = {"q0": Fraction(1, 2), "q1": Fraction(1, 2), "q2": Fraction(1, 10), "q3": Fraction(7, 10)}
FLAT = {"q0": Fraction(3, 5), "q1": 0, "q2": 0, "q3": Fraction(4, 5)}


# -- row 11: 3-RPR ---------------------------------------------------------------------------------------


def locus_of_3rpr() -> tuple[VelocityEquation, Polynomial]:
    """The factor of condition (4), in x, y of B1 and the platform's angle, sin^2 written as 1 - cos^2."""
    equation = velocity_equation(load("3rpr"))
    (factor,) = (f.polynomial for f in conditions(equation)["4"].factors)
    cosine, sine = (factor.ring.gen(v) for v in ("c_platform", "s_platform"))
    return equation, factor + factor.coefficient("s_platform", 2) * (1 - cosine**2 - sine**2)


def test_3rpr_locus_has_degree_3_and_14_terms() -> None:
    """Row 11, Sefrioui, Gosselin (1995): degree 3 in (x, y, cos, sin), 14 monomials."""
    _, locus = locus_of_3rpr()
    names = locus.ring.names
    places = [names.index(v) for v in ("B1x", "B1y", "c_platform", "s_platform")]
    monomials = {tuple(int(e[i]) for i in places) for e, _ in locus.terms()}
    assert len(monomials) == 14
    assert max(map(sum, monomials)) == 3


def test_3rpr_locus_is_a_conic_at_fixed_orientation() -> None:
    """Row 11, Sefrioui, Gosselin (1995): quadratic in x and y."""
    _, locus = locus_of_3rpr()
    for cosine, sine in ((1, 0), (Fraction(3, 5), Fraction(4, 5)), (0, -1)):
        slice_ = locus.substitute({"c_platform": cosine, "s_platform": sine})
        assert max(slice_.degree("B1x"), slice_.degree("B1y")) == 2
        i, j = (slice_.ring.index(v) for v in ("B1x", "B1y"))
        assert max(int(e[i]) + int(e[j]) for e, _ in slice_.terms()) == 2


def test_3rpr_has_six_assemblies() -> None:
    """Row 11, Innocenti, Parenti-Castelli: direct kinematics of degree 6."""
    equation, _ = locus_of_3rpr()
    squares = [equation.values[f"P{i}"].square for i in (1, 2, 3)]
    lengths = [Fraction(1498, 100), Fraction(1538, 100), 12]
    legs = [p - r * r for p, r in zip(squares, lengths, strict=True) if p is not None]
    assert len(legs) == 3
    ideal = Ideal(equation.space.ring, (*equation.space.equations, *legs))
    # the ring's square root counts twice
    assert ideal.vector_space_dimension.value == 2 * 6


@pytest.mark.slow
def test_six_cusps_of_the_3rpr() -> None:
    """Row 11, Innocenti, Parenti-Castelli's slice at leg length 14.98: 6 cusps.

    A cusp of the map (x, y, angle) -> (leg lengths): its determinant vanishes, and so does the determinant's
    derivative along the kernel, which is the cross product of two gradients.
    """
    equation, locus = locus_of_3rpr()
    ring = equation.space.ring
    cosine, sine = ring.gen("c_platform"), ring.gen("s_platform")

    def gradient(p: Polynomial) -> tuple[Polynomial, ...]:
        turned = p.derivative("s_platform") * cosine - p.derivative("c_platform") * sine
        return p.derivative("B1x"), p.derivative("B1y"), turned

    squares = [p for p in (equation.values[f"P{i}"].square for i in (1, 2, 3)) if p is not None]
    a, b, c = map(gradient, squares)
    slope = gradient(locus)
    along = [
        slope[0] * (u[1] * v[2] - u[2] * v[1])
        + slope[1] * (u[2] * v[0] - u[0] * v[2])
        + slope[2] * (u[0] * v[1] - u[1] * v[0])
        for u, v in ((a, b), (a, c), (b, c))
    ]
    slice_ = squares[0] - Fraction(1498, 100) ** 2
    assert len(real_points([*equation.space.equations, slice_, locus, *along]).value) == 6


def test_3rpr_has_type_2_only(classified: Callable[[Mechanism], Classification]) -> None:
    """Row 11: legs that have a length can always be driven back, so that det L_O has no zero."""
    result = classified(load("3rpr"))
    assert not result.undecided
    found = {c.singularity_class.name: c.dimension for c in result.classes if c.verdict.is_yes}
    assert found == {"RO, II": 2}


# -- row 12: Stewart-Gough -------------------------------------------------------------------------------


def locus_at(name: str, orientation: dict[str, Fraction | int]) -> Polynomial:
    """The factor of condition (4) in the platform's position at a fixed orientation.

    What the reduction divided by, squares of leg lengths, is taken away.
    """
    equation = velocity_equation(load(name), "quaternion")
    position = Ring(("x", "y", "z"))
    matrix = conditions(equation).matrix("L_I")
    fixed = matrix.map(lambda e: position.convert(e.substitute(orientation)), position)
    found = [p**k for p, k in determinant(fixed).factors() if not _is_square_of_length(p)]
    return prod(found, start=position.one)


def _is_square_of_length(p: Polynomial) -> bool:
    """x^2 + y^2 + z^2 + ..., positive off a single point."""
    squares = [(2, 0, 0), (0, 2, 0), (0, 0, 2)]
    return p.total_degree == 2 and len({c for e, c in p.terms() if tuple(map(int, e)) in squares}) == 1


def test_general_stewart_platform_is_a_cubic_with_20_monomials() -> None:
    """Row 12, Mayer St-Onge, Gosselin (2000): all 20 monomials of degree 3 and less in x, y, z."""
    locus = locus_at("stewart-gough", TURNED)
    assert locus.total_degree == 3
    assert len(locus) == 20


def test_planar_stewart_platform_has_16_monomials() -> None:
    """Row 12, Mayer St-Onge, Gosselin (2000): base and platform planar."""
    locus = locus_at("stewart-gough-planar", TURNED)
    assert locus.total_degree == 3
    assert len(locus) == 16


def test_planar_stewart_platform_parallel_to_its_base() -> None:
    """Row 12: const z^3."""
    locus = locus_at("stewart-gough-planar", FLAT)
    ((exponents, _),) = locus.terms()
    assert tuple(map(int, exponents)) == (0, 0, 3)


# -- row 13: 3-UPU ---------------------------------------------------------------------------------------


def test_constraint_singularity_of_the_3upu() -> None:
    """Row 13, Di Gregorio, Parenti-Castelli: in translation z (x^2 + y^2 - 4 delta^2) = 0.

    One factor of (4) and (5) is that, for all radii with delta = rb - rp, when multiplied with the length of
    each leg off the tangent at its foot, d_Pi c_Aib; these numbers vanish in conditions of their own.
    """
    found = conditions(velocity_equation(load("3upu-tsai").with_parameters(rb=None, rp=None)))
    space = found.equation.space
    ring = space.ring
    x, y, z, rb, rp = (ring.gen(n) for n in ("x_platform", "y_platform", "z_platform", "rb", "rp"))
    lengths = [ring.gen(f"d_P{i}") * ring.gen(f"c_A{i}b") for i in (1, 2, 3)]
    expected = z * (x**2 + y**2 - 4 * (rb - rp) ** 2)
    loops = Ideal(ring, space.equations)
    for label in ("4", "5"):
        constraint = [f.polynomial for f in found[label].factors if len(f.polynomial) == 3]
        assert len(constraint) == 1
        product = constraint[0] * prod(lengths, start=ring.one)
        assert (
            loops.contains(4 * product - 3 * expected).value
            or loops.contains(4 * product + 3 * expected).value
        )


@pytest.mark.slow
@pytest.mark.skipif(not os.environ.get("SINGSYM_LONG"), reason="takes long: SINGSYM_LONG=1 runs it")
@pytest.mark.xdist_group("3upu-tsai")
def test_classes_of_the_3upu_in_translation(classified: Classified) -> None:
    """Row 13 by the classes: all IIM of dimension 2 is z = 0, or x^2 + y^2 = 4 delta^2 with delta = 1.

    At z = 0 the legs lie in a plane as well and cannot hold the platform: II; on the cylinder they can.
    """
    result = classified(load("3upu-tsai"))
    surfaces = {c.singularity_class.name: c for c in result.classes if c.dimension == 2}
    assert set(surfaces) == {"RPM, II, IO", "RI, RO, IIM", "RI, RO, II, IIM"}
    increased = [c for c in result.classes if SingularityType.IIM in c.types and c.verdict.is_yes]
    assert increased
    for witness in (w for c in increased for w in c.witnesses):
        x, y, z = (float(witness.points[f"M.{k}"]) for k in "xyz")
        assert z * (x**2 + y**2 - 4) == pytest.approx(0, abs=1e-9)
    for name, flat in (("RI, RO, IIM", False), ("RI, RO, II, IIM", True)):
        assert all((abs(float(w.points["M.z"])) < 1e-9) is flat for w in surfaces[name].witnesses)


# -- row 14: 3-RPS ---------------------------------------------------------------------------------------


def test_two_modes_of_the_3rps() -> None:
    """Row 14: the platform's quaternion obeys q0 q3 = 0 wherever the three legs can stand."""
    space = velocity_equation(load("3rps"), "quaternion").space
    ring = space.ring
    # B_i keeps to the plane of its leg: no y component in the leg's frame, (x_i u_i - B_i) . t_i = 0
    planes = [e for e in space.equations if not any(v.startswith("d_") for v in e.variables)]
    sides = {i: [e for e in space.equations if f"d_P{i}" in e.variables] for i in (1, 2, 3)}
    root = ring.gen("sqrt3")
    tangents = {1: (ring.zero, ring.one), 2: (-root, -ring.one), 3: (root, -ring.one)}
    constraints = [x * e[0] + y * e[1] for (x, y), e in zip(tangents.values(), sides.values(), strict=True)]
    ideal = Ideal(ring, (*constraints, *planes))
    assert ideal.contains(ring.gen("q0") * ring.gen("q3")).value
    assert not ideal.contains(ring.gen("q0")).value
    assert not ideal.contains(ring.gen("q3")).value


@pytest.mark.parametrize("zero", [("q3",), ("q0",), ("q0", "q3")])
def test_constraint_singularity_of_the_3rps(zero: tuple[str, ...]) -> None:
    """Row 14: with w = z + R z the constraints become dependent where w . z = 0, that is where modes meet.

    R z . z = 2 (q0^2 + q3^2) - 1, so that w . z = 2 (q0^2 + q3^2).
    """
    equation = velocity_equation(load("3rps"), "quaternion")
    space = equation.space
    wanted = tuple(space.ring.gen(name) for name in zero)
    points = sample_configurations(replace(space, equations=(*space.equations, *wanted)), 4, seed=5)
    assert points
    for point in points:
        q0, q3 = (point[space.ring.index(name)] for name in ("q0", "q3"))
        values = np.linalg.svd(numerical_matrix(equation.L, point), compute_uv=False)
        assert (values[-1] < 1e-6 * values[0]) == (2 * (q0**2 + q3**2) < 1e-9)
