"""Rows 17 and 18 of the published results: linkages that move against Gruebler's count."""

from __future__ import annotations

from collections.abc import Callable
from math import isclose, pi, sin, tan

import numpy as np
import pytest

from singsym.classes.result import Classification
from singsym.classes.taxonomy.types import SingularityType
from singsym.kinematics.sampling import sample_configurations
from singsym.kinematics.velocity import VelocityEquation, velocity_equation
from singsym.mechanism import Mechanism, load
from singsym.polynomials.compiled_map import numerical_matrix
from singsym.varieties.decomposition import decompose

Classified = Callable[[Mechanism], Classification]


def screw_rank(equation: VelocityEquation, point: np.ndarray) -> int:
    """The rank of the joints' screws: L without output columns and output rows."""
    values = np.linalg.svd(numerical_matrix(equation.L_O, point)[equation.n :], compute_uv=False)
    return int((values > 1e-6 * values[0]).sum())


# -- Bennett ----------------------------------------------------------------------------------------------


def test_bennett_screws_have_rank_3() -> None:
    """Row 17: at every configuration; L is 7 x 5 with N = 4."""
    equation = velocity_equation(load("bennett"))
    assert equation.L.shape == (7, 5)
    points = sample_configurations(equation.space, 6, seed=2)
    assert {screw_rank(equation, p) for p in points} == {3}


def test_bennett_tangents() -> None:
    """Row 17: abs(tan(A/2) tan(B/2)) = sin((alpha + beta)/2) / sin((beta - alpha)/2) or its inverse."""
    equation = velocity_equation(load("bennett"))
    alpha, beta = 40 * pi / 180, 75 * pi / 180
    expected = sin((alpha + beta) / 2) / sin((beta - alpha) / 2)
    products = set()
    for point in sample_configurations(equation.space, 6, seed=7):
        angles = []
        for name in ("A", "B"):
            value = equation.values[name]
            assert value.cosine is not None
            assert value.sine is not None
            cosine, sine = (float(p.evaluate(list(point))) for p in (value.cosine, value.sine))
            angles.append(np.arctan2(sine, cosine))
        products.add(round(abs(tan(angles[0] / 2) * tan(angles[1] / 2)), 7))
    (product,) = products
    assert isclose(product, expected, rel_tol=1e-6) or isclose(product, 1 / expected, rel_tol=1e-6)


@pytest.mark.slow
def test_bennett_has_no_singularity(classified: Classified) -> None:
    """Row 17: no configuration-space singularity, and no other, from one hinge to the opposite one."""
    result = classified(load("bennett"))
    assert not result.undecided
    assert [(s.dimension, s.smooth) for s in result.configuration_space] == [(1, "yes")]
    assert all(c.verdict.is_no for c in result.classes)


# -- Sarrus -----------------------------------------------------------------------------------------------


def test_sarrus_configuration_space() -> None:
    """Row 18: both legs rise together, in two ways; folded onto themselves they turn freely."""
    space = velocity_equation(load("sarrus")).space
    parts = decompose(space.equations, ring=space.ring).value
    assert sorted(part.dimension for part in parts) == [1, 1, 2]


def test_sarrus_classes(classified: Classified) -> None:
    """Row 18: where rank 4 or 3 replaces 5 there is IIM, on all of the folded component and where stretched.

    Both legs folded turn at vz = 0, one of them with the input locked: RI, RPM; vz itself is impossible (IO)
    unless both lie flat, where the platform may rise as well.
    """
    result = classified(load("sarrus"))
    assert not result.undecided
    found = {c.types: c.dimension for c in result.classes if c.verdict.is_yes}
    T = SingularityType
    assert found == {T.RI | T.RPM | T.IO | T.IIM: 2, T.RI | T.RO | T.RPM | T.IIM: 0}


def test_sarrus_screw_ranks(classified: Classified) -> None:
    """Row 18: rank 5 at random configurations that rise, 4 stretched, 3 folded flat."""
    result = classified(load("sarrus"))
    equation = result.equation
    names = equation.space.ring.names
    generic = sample_configurations(equation.space, 12, seed=1)
    place = equation.space.points["A3"]
    raised = [p for p in generic if abs(float(place[2].evaluate(list(p)))) > 1e-3]
    assert raised
    assert {screw_rank(equation, p) for p in raised} == {5}
    ranks = set()
    for w in (w for c in result.classes for w in c.witnesses):
        height = abs(float(w.points["A3.z"]))
        ranks.add((round(height, 9), screw_rank(equation, np.array([w.floats()[name] for name in names]))))
    assert ranks == {(2.0, 4), (0.0, 4), (0.0, 3)}
