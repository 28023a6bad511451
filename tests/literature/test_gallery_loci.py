"""Loci of gallery mechanisms in closed form, by lines and planes of their legs, and points counted by hand.

The independent route: determinants written down from the geometry of the legs, compared with those of L_I and
L_O at random configurations, and triangle inequalities.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import product

import numpy as np
import pytest
from numpy.typing import NDArray

from singsym.classes.result import Classification
from singsym.classes.taxonomy.types import SingularityType
from singsym.kinematics.sampling import sample_configurations
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import Mechanism, load
from singsym.polynomials.compiled_map import numerical_matrix

Classified = Callable[[Mechanism], Classification]
Vector = NDArray[np.float64]
Points = dict[str, Vector]
T = SingularityType


def det(*rows: Vector) -> float:
    return float(np.linalg.det(np.array(rows)))


def line(p: Vector, q: Vector) -> Vector:
    """A line of the plane by its homogeneous coordinates, of length |pq|."""
    return np.cross([*p, 1.0], [*q, 1.0])


def area(p: Vector, q: Vector, r: Vector) -> float:
    return float(line(p, q) @ [*r, 1.0])


def rails_and_lines(q: Points) -> tuple[float, float]:
    """3-PRR: the rods' lines have a point in common; a rod is perpendicular to the rail, the x axis."""
    rods = [(q[f"B{i}"], q[f"C{i}"]) for i in (1, 2, 3)]
    return det(*(line(b, c) for b, c in rods)), float(np.prod([(c - b)[0] for b, c in rods]))


def cranks_and_lines(q: Points) -> tuple[float, float]:
    """3-RRR: the rods' lines have a point in common; a crank and its rod are in line (Gosselin, Angeles)."""
    legs = [[q[f"{pin}{i}"] for pin in "ABC"] for i in (1, 2, 3)]
    return det(*(line(b, c) for _, b, c in legs)), float(np.prod([area(*leg) for leg in legs]))


def rods_of_the_delta(q: Points) -> tuple[float, float]:
    """Linear Delta: the rods are parallel to a plane; a rod is horizontal."""
    rods = [q[f"C{i}"] - q[f"B{i}"] for i in (1, 2, 3)]
    return det(*rods), float(np.prod([rod[2] for rod in rods]))


def planes_of_legs(q: Points) -> tuple[float, float]:
    """Spherical 3-RRR: the planes B C have a line in common; axes A, B, C of a leg lie in a plane."""
    base = dict(zip(("A1", "A2", "A3"), np.eye(3), strict=True))
    axes = {**q, **base, "C3": np.cross(q["C1"], q["C2"])}
    legs = [[axes[f"{axis}{i}"] for axis in "ABC"] for i in (1, 2, 3)]
    return det(*(np.cross(b, c) for _, b, c in legs)), float(np.prod([det(*leg) for leg in legs]))


@pytest.mark.parametrize(
    ("name", "closed_form"),
    [
        ("3prr", rails_and_lines),
        ("3rrr", cranks_and_lines),
        ("linear-delta", rods_of_the_delta),
        ("spherical-3rrr", planes_of_legs),
    ],
)
def test_determinants_of_parallel_manipulators(
    name: str, closed_form: Callable[[Points], tuple[float, float]]
) -> None:
    """det L_I and det L_O are constants times the closed forms: rods transmit no power along their lines."""
    equation = velocity_equation(load(name))
    ratios = []
    for point in sample_configurations(equation.space, 8, seed=6):
        places = {**equation.space.points, **equation.space.directions}
        at = {n: np.array([float(p.evaluate(list(point))) for p in place]) for n, place in places.items()}
        forms = closed_form(at)
        found = (np.linalg.det(numerical_matrix(m, point)) for m in (equation.L_I, equation.L_O))
        ratios.append([abs(d / f) for d, f in zip(found, forms, strict=True)])
    assert len(ratios) == 8
    assert np.array(ratios) == pytest.approx(np.array([ratios[0]] * 8), rel=1e-6)
    assert min(ratios[0]) > 1e-9


@pytest.mark.slow
@pytest.mark.parametrize("name", ["3prr", "3rrr", "spherical-3rrr"])
def test_surfaces_that_meet_in_curves(classified: Classified, name: str) -> None:
    """Each locus is one equation on a space of dimension 3; both hold in curves; no RPM and no IIM.

    RPM: with the platform and the cranks at rest a rod would have to turn about both of its ends.
    """
    result = classified(load(name))
    assert not result.undecided
    found = {c.types: c.dimension for c in result.classes if c.verdict.is_yes}
    assert found == {T.RI | T.IO: 2, T.RO | T.II: 2, T.RI | T.RO | T.II | T.IO: 1}


def test_flat_legs_of_the_spherical_3rrr() -> None:
    """IIM needs moments of flat legs in balance, each along the normal of its leg's plane; there are none.

    Two legs in one plane: it holds their A and C, so that the third C is on the third A or against it; but
    no leg closes at an angle of less than 90 - 60 degrees.  Three flat legs: each angle A C is 30 or 150
    degrees, their cosines the diagonal of a rotation; for none of these are the normals A x C in a plane.
    """
    flat = np.cos(np.deg2rad(90 - 60))
    volumes = []
    for signs in product((1, -1), repeat=3):
        diagonal = flat * np.array(signs)
        cosine = (diagonal.sum() - 1) / 2
        squares = (diagonal - cosine) / (1 - cosine)
        if abs(cosine) > 1 or squares.min() < 0:
            continue
        for directions in product((1, -1), repeat=3):
            axis, sine = np.sqrt(squares) * directions, np.sqrt(1 - cosine**2)
            turned = [
                cosine * a + sine * np.cross(axis, a) + (1 - cosine) * (axis @ a) * axis for a in np.eye(3)
            ]
            assert np.diag(turned) == pytest.approx(diagonal)
            volumes.append(abs(det(*(np.cross(a, c) for a, c in zip(np.eye(3), turned, strict=True)))))
    assert len(volumes) == 4 * 8
    assert min(volumes) > 0.01


def test_spherical_fourbar_by_triangles(classified: Classified) -> None:
    """A, B, C in a plane: AC is AB + BC or their difference, and must fit into the triangle with AD, CD.

    Likewise B, C, D with AD, AB for the input's dead centres; each triangle comes with its mirror image.
    """
    ad, ab, bc, cd = 90, 30, 90, 60
    still = [ac for ac in (ab + bc, bc - ab) if abs(ad - cd) < ac < min(ad + cd, 360 - ad - cd)]
    dead = [bd for bd in (bc + cd, bc - cd) if abs(ad - ab) < bd < min(ad + ab, 360 - ad - ab)]
    result = classified(load("spherical-fourbar"))
    assert not result.undecided
    found = {c.types: c.points for c in result.classes if c.verdict.is_yes}
    expected = {T.RI | T.IO: 2 * len(still), T.RO | T.II: 2 * len(dead)}
    assert found == {types: points for types, points in expected.items() if points}


def test_double_parallelogram_is_singular_where_it_is_flat(classified: Classified) -> None:
    """The cranks stay parallel; A, B, C, D in line: B at (1, 0) or (-1, 0), the bar on the frame's line."""
    result = classified(load("double-parallelogram"))
    assert not result.undecided
    (found,) = (c for c in result.classes if c.verdict.is_yes)
    assert found.types == T.RI | T.RO | T.IIM
    assert sorted((float(w.points["B.x"]), float(w.points["B.y"])) for w in found.witnesses) == [
        (-1, 0),
        (1, 0),
    ]


def test_pantograph_is_singular_where_its_arm_is_straight(classified: Classified) -> None:
    """O, B, T in line, and with them the whole parallelogram: the arm's Jacobian has no other zero."""
    result = classified(load("pantograph"))
    assert not result.undecided
    (found,) = (c for c in result.classes if c.verdict.is_yes)
    assert (found.types, found.dimension) == (T.RI | T.RO | T.IO | T.IIM, 1)
    for w in found.witnesses:
        at = {p: np.array([float(w.points[f"{p}.x"]), float(w.points[f"{p}.y"])]) for p in "ABCFT"}
        places = [area(np.zeros(2), at["A"], at[p]) for p in "BCFT"]
        assert places == pytest.approx([0] * 4, abs=1e-9)
