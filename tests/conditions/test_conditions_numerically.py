"""Reduction, blocks and conditions against singular values at configurations found by Newton's method.

Source: independent of the algebra; every library mechanism without open parameters, at generic configurations
and at ones where a factor of a condition vanishes.
"""

from collections.abc import Sequence

import numpy as np
import pytest

from singsym.conditions.conditions import Conditions, conditions
from singsym.kinematics.placement import ConfigurationSpace
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import load
from singsym.mechanism.library import names
from singsym.polynomials import Polynomial, PolynomialMatrix

MATRICES = ("L", "L_I", "L_O", "L_p")
# Too large for a fast test, and the one with an open parameter; their parts are tested with the smaller ones.
LEFT_OUT = {"bennett", "stewart-gough", "stewart-gough-planar", "3rps", "3upu-tsai", "zlatanov-hybrid"}


def newton(
    equations: Sequence[Polynomial], fixed: dict[int, float], rng: np.random.Generator
) -> list[float] | None:
    """A point where the polynomials vanish to 1e-12, by Gauss-Newton steps; None where it fails."""
    ring = equations[0].ring
    slopes = [[e.derivative(name) for name in ring.names] for e in equations]
    x = rng.normal(size=len(ring.names))
    for i, value in fixed.items():
        x[i] = value
    free = [i for i in range(len(x)) if i not in fixed]
    for _ in range(200):
        values = np.array([float(e.evaluate(list(x))) for e in equations])
        if np.abs(values).max() < 1e-13:
            return list(x)
        jacobian = np.array([[float(row[i].evaluate(list(x))) for i in free] for row in slopes])
        step = np.linalg.lstsq(jacobian, -values, rcond=1e-9)[0]
        x[free] += step * min(1.0, 1.0 / (1e-9 + np.abs(step).max()))
    values = np.array([float(e.evaluate(list(x))) for e in equations])
    return list(x) if np.abs(values).max() < 1e-11 else None


def rank(matrix: PolynomialMatrix, point: list[float]) -> int | None:
    """The rank by singular values against an absolute threshold; None where one lies near it."""
    if not all(matrix.shape):
        return 0
    values = np.linalg.svd(np.array(matrix.evaluate(point), dtype=float), compute_uv=False)
    return None if any(1e-8 < v < 1e-4 for v in values) else int((values > 1e-6).sum())


def check_ranks(found: Conditions, point: list[float]) -> dict[str, int]:
    """The four ranks, after asserting that reduction and blocks give the same; {} where one is in doubt."""
    ranks = {}
    for name in MATRICES:
        parts = found.rank_blocks(name)
        full = rank(getattr(found.equation, name), point)
        reduced = rank(found.matrix(name), point)
        blocks = [rank(block, point) for block in parts.blocks]
        if full is None or reduced is None or None in blocks:
            return {}
        assert full == reduced + found.reduction.constant
        assert full == parts.constant + sum(r for r in blocks if r)
        ranks[name] = full
    return ranks


def is_excluded(space: ConfigurationSpace, point: list[float]) -> bool:
    """Whether all polynomials of an exclusion vanish there."""
    return any(max(abs(float(g.evaluate(point))) for g in group) < 1e-6 for group in space.exclusions)


@pytest.mark.parametrize("name", [n for n in names() if n not in LEFT_OUT])
def test_ranks_and_conditions_at_feasible_configurations(name: str) -> None:
    equation = velocity_equation(load(name))
    space = equation.space
    found = conditions(equation)
    fixed = {}
    for constant in space.ring.constants:
        fixed[space.ring.index(constant.name)] = float(constant.expression)
    rng = np.random.default_rng(5)
    N, n = equation.N, equation.n
    required = {"4": ("L_I", N), "5": ("L_O", N), "iii": ("L_p", N - n), "vi": ("L", N)}
    extra: list[tuple[Polynomial, ...]] = [()]
    for label in required:
        extra += found[label].polynomials
    met = 0
    for added in extra:
        if not space.equations and not added:
            continue
        starts = (newton([*space.equations, *added], fixed, rng) for _ in range(1 if added else 20))
        point = next((p for p in starts if p is not None and not is_excluded(space, p)), None)
        if point is None:
            continue
        ranks = check_ranks(found, point)
        if not ranks:
            continue
        met += 1
        for label, (matrix, full) in required.items():
            condition = found[label]
            if condition.alternatives is None and not condition.everywhere:
                continue
            sizes = [max(abs(float(p.evaluate(point))) for p in a) for a in condition.polynomials]
            if any(1e-9 < size < 1e-4 for size in sizes):
                continue
            holds = condition.everywhere or any(size < 1e-9 for size in sizes)
            assert holds == (ranks[matrix] < full), (name, label, added)
    assert met
