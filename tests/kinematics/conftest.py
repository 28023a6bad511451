"""A numerical check that screws are the motion: move along the configuration space and compare velocities."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from singsym.kinematics.placement import ConfigurationSpace, Placement
from singsym.mechanism.model import Mechanism, Space

Check = Callable[[Mechanism, Placement, int], float]


def constants(space: ConfigurationSpace) -> dict[str, float]:
    """Values of the ring's constants, and 1.5 for every parameter."""
    known = {c.name: float(c.expression) for c in space.ring.constants}
    return known | dict.fromkeys(space.parameters, 1.5)


def jacobian(space: ConfigurationSpace, point: np.ndarray) -> np.ndarray:
    """Derivatives of the equations by the configuration variables."""
    rows = [[float(e.derivative(v).evaluate(list(point))) for v in space.variables] for e in space.equations]
    return np.array(rows, dtype=float).reshape(len(space.equations), len(space.variables))


def find_configuration(space: ConfigurationSpace, seed: int) -> np.ndarray:
    """A random point of the configuration space, in the order of the ring's names (Gauss-Newton)."""
    random, known = np.random.default_rng(seed), constants(space)
    free = [space.ring.index(v) for v in space.variables]
    for _ in range(200):
        point = np.array([known.get(name, random.normal()) for name in space.ring.names])
        for _ in range(60):
            residual = np.array([float(e.evaluate(list(point))) for e in space.equations])
            if not residual.size or np.abs(residual).max() < 1e-12:
                return point
            step = np.linalg.lstsq(jacobian(space, point), residual, rcond=1e-9)[0]
            point[free] -= step * min(1.0, 1.0 / (1e-9 + np.linalg.norm(step)))
    raise AssertionError("no configuration found")


def tangents(space: ConfigurationSpace, point: np.ndarray) -> np.ndarray:
    """A basis of the tangent space, one row a direction in the variables."""
    matrix = jacobian(space, point)
    if not matrix.size:
        return np.eye(len(space.variables))
    _, values, rows = np.linalg.svd(matrix)
    rank = int((values > 1e-7).sum())
    return rows[rank:]


def _rates(mechanism: Mechanism, placement: Placement, point: np.ndarray, tangent: np.ndarray) -> float:
    """The residual of: link points and joint values move as link twists and joint screws say."""
    space = placement.space
    names, columns = space.ring.names, mechanism.columns
    h = 1e-6
    speed = np.zeros(len(names))
    speed[[space.ring.index(v) for v in space.variables]] = tangent
    planar, spherical = mechanism.space is Space.PLANAR, mechanism.space is Space.SPHERICAL
    size = 6 if mechanism.space is Space.SPATIAL else 3
    links = {link.name: i for i, link in enumerate(mechanism.links)}
    width = size * len(links) + len(columns)
    matrix: list[np.ndarray] = []
    right: list[float] = []

    def add(rows: np.ndarray, values: np.ndarray) -> None:
        matrix.extend(rows)
        right.extend(values)

    def numbers(polynomials: tuple[object, ...], at: np.ndarray) -> np.ndarray:
        return np.array([float(p.evaluate(list(at))) for p in polynomials])  # type: ignore[attr-defined]

    def derivative(polynomials: tuple[object, ...]) -> np.ndarray:
        return (numbers(polynomials, point + h * speed) - numbers(polynomials, point - h * speed)) / (2 * h)

    ground = np.zeros((size, width))
    ground[:, size * links[mechanism.ground] : size * (links[mechanism.ground] + 1)] = np.eye(size)
    add(ground, np.zeros(size))
    for joint in mechanism.joints:
        rows = np.zeros((size, width))
        rows[:, size * links[joint.second] :][:, :size] = np.eye(size)
        rows[:, size * links[joint.first] :][:, :size] = -np.eye(size)
        for column in joint.columns:
            rows[:, size * len(links) + columns.index(column)] = -numbers(placement.screws[column], point)
        add(rows, np.zeros(size))
    for (link, _), place in placement.link_points.items():
        p = numbers(place, point)
        start = size * links[link]
        rows = np.zeros((len(p), width))
        if planar:
            rows[:, start : start + 3] = [[-p[1], 1, 0], [p[0], 0, 1]]
        else:
            rows[:, start : start + 3] = [[0, p[2], -p[1]], [-p[2], 0, p[0]], [p[1], -p[0], 0]]
            if not spherical:
                rows[:, start + 3 : start + 6] = np.eye(3)
        add(rows, derivative(place))
    for column, value in placement.values.items():
        rows = np.zeros((1, width))
        rows[0, size * len(links) + columns.index(column)] = 1
        if value.length is not None:
            add(rows, derivative((value.length,)))
        elif value.square is not None:
            # the screw is scaled by the length r, so its rate is r'/r = (r^2)' / (2 r^2)
            add(rows, derivative((value.square,)) / (2 * numbers((value.square,), point)))
        else:
            c, s, scale = numbers((value.cosine, value.sine, value.scale), point)
            dc, ds = derivative((value.cosine, value.sine))
            assert c * c + s * s == pytest.approx(scale * scale)
            add(rows, np.array([(c * ds - s * dc) / scale**2]))
    a, b = np.array(matrix), np.array(right)
    return float(np.abs(a @ np.linalg.lstsq(a, b, rcond=None)[0] - b).max())


@pytest.fixture
def configuration() -> Callable[[ConfigurationSpace, int], np.ndarray]:
    """Random points of configuration spaces, by seed."""
    return find_configuration


@pytest.fixture
def motion_residual() -> Check:
    """How far the screws are from the motion, over all tangents at a random configuration."""

    def check(mechanism: Mechanism, placement: Placement, seed: int = 0) -> float:
        point = find_configuration(placement.space, seed)
        return max(
            (_rates(mechanism, placement, point, t) for t in tangents(placement.space, point)), default=0.0
        )

    return check
