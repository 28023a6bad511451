"""Planar linkages of cranks and dyads by closed-form geometry, and singularity types by their definitions.

An independent route: circles are intersected in floats, L is written from the pins, and the types come
from its kernel, as section 2.2 of Zlatanov, Fenton, Benhabib (1998) defines them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import acos, cos, sin, sqrt

import numpy as np

Point = tuple[float, float]
Points = dict[str, Point]


def circles(p: Point, r: float, q: Point, s: float) -> list[Point]:
    """The points at distance r from p and s from q; one where the circles touch up to rounding."""
    dx, dy = q[0] - p[0], q[1] - p[1]
    square = dx * dx + dy * dy
    if square < 1e-18:
        return []
    along = (square + r * r - s * s) / 2
    height = r * r * square - along * along
    if height < -1e-9 * (1 + r * r * square):
        return []
    if height < 1e-9 * (1 + r * r * square):
        return [(p[0] + along * dx / square, p[1] + along * dy / square)]
    h = sqrt(height)
    return [
        (p[0] + (along * dx - k * h * dy) / square, p[1] + (along * dy + k * h * dx) / square)
        for k in (1, -1)
    ]


def on_circle(centre: Point, radius: float, angle: float) -> Point:
    return (centre[0] + radius * cos(angle), centre[1] + radius * sin(angle))


def triangle_angles(far: float, near: float, opposite: float) -> list[float]:
    """Angles between sides `far` and `near` of a triangle with the third side given: +-, one where flat."""
    cosine = (far**2 + near**2 - opposite**2) / (2 * far * near)
    if abs(cosine) > 1 + 1e-12:
        return []
    if abs(cosine) > 1 - 1e-12:
        return [0.0 if cosine > 0 else acos(-1.0)]
    return [acos(cosine), -acos(cosine)]


class FourBar:
    """Frame A, D of length g, crank AB = a, coupler BC = b, follower CD = c."""

    def __init__(self, g: int, a: int, b: int, c: int, A: Point = (0.0, 0.0)) -> None:
        self.g, self.a, self.b, self.c, self.A = g, a, b, c, A
        self.D = (A[0] + g, A[1])

    def at_crank(self, angle: float) -> list[Points]:
        """All configurations with the crank at an angle."""
        B = on_circle(self.A, self.a, angle)
        return [self._named(B, C) for C in circles(B, self.b, self.D, self.c)]

    def at_follower(self, angle: float) -> list[Points]:
        """All configurations with the follower at an angle."""
        C = on_circle(self.D, self.c, angle)
        return [self._named(B, C) for B in circles(self.A, self.a, C, self.b)]

    def critical(self) -> list[Points]:
        """Configurations with B, C, D in line (from triangle A, B, D) or A, B, C in line (from A, C, D)."""
        found = self.flat()
        for reach in {self.b + self.c, abs(self.b - self.c)} - {0}:
            for angle in triangle_angles(self.g, self.a, reach):
                found += self.at_crank(angle)
        for reach in {self.a + self.b, abs(self.a - self.b)} - {0}:
            for angle in triangle_angles(self.g, self.c, reach):
                found += self.at_follower(acos(-1.0) - angle)
        return distinct(found)

    def flat(self) -> list[Points]:
        """Configurations with all pins on the frame's line, also where pins coincide."""
        ends = [(self.A[0] + j * self.a, self.D[0] + k * self.c) for j in (1, -1) for k in (1, -1)]
        return [self._named((x, 0.0), (y, 0.0)) for x, y in ends if abs(x - y) == self.b]

    def _named(self, B: Point, C: Point) -> Points:
        return {"A": self.A, "B": B, "C": C, "D": self.D}


def distinct(found: Sequence[Points]) -> list[Points]:
    """Without repetitions up to rounding (near a dead centre the square root of it)."""
    kept: list[Points] = []
    for p in found:
        if not any(all(abs(p[k][i] - q[k][i]) < 1e-5 for k in p for i in (0, 1)) for q in kept):
            kept.append(p)
    return kept


def velocity_matrix(
    at: Points, loops: Sequence[str], columns: Sequence[str], inputs: Sequence[str], outputs: Sequence[str]
) -> np.ndarray:
    """L with columns T, inputs, passive; outputs are rates of joints; each loop is a string of pins.

    Every rate is counted along its loops, so that all signs are +; a pin of two loops is one rate in both.
    """
    order = [*inputs, *(c for c in columns if c not in inputs)]
    L = np.zeros((len(outputs) + 3 * len(loops), len(outputs) + len(order)))
    for i, name in enumerate(outputs):
        L[i, i] = 1
        L[i, len(outputs) + order.index(name)] = -1
    for k, loop in enumerate(loops):
        rows = slice(len(outputs) + 3 * k, len(outputs) + 3 * k + 3)
        for pin in loop:
            x, y = at[pin]
            L[rows, len(outputs) + order.index(pin)] = (1, y, -x)
    return L


def end_point_matrix(at: Points) -> np.ndarray:
    """L of a five-bar A, ..., E: the velocity of C, inputs A and E, one loop."""
    L = np.zeros((5, 7))
    order = "AEBCD"
    x, y = at["C"]
    for pin in "AB":
        L[:2, 2 + order.index(pin)] = (y - at[pin][1], at[pin][0] - x)
    L[0, 0] = L[1, 1] = 1
    for pin in order:
        L[2:, 2 + order.index(pin)] = (1, at[pin][1], -at[pin][0])
    return L


def types(L: np.ndarray, n: int, tolerance: float = 1e-5) -> frozenset[str]:
    """The singularity types at a configuration, by their definitions, from the kernel of L.

    RI: an input moves, the output rests.  RO: the reverse.  RPM: both rest, something moves.  II: some input
    velocity, IO: some output velocity is impossible.  IIM: more than n freedoms.
    """

    def kernel(matrix: np.ndarray) -> np.ndarray:
        if not matrix.size:
            return np.eye(matrix.shape[1])
        _, values, rows = np.linalg.svd(matrix)
        rank = int((values > tolerance * max(1.0, values[0])).sum())
        return rows[rank:].T

    def rank(matrix: np.ndarray) -> int:
        return int((np.linalg.svd(matrix, compute_uv=False) > tolerance).sum()) if matrix.size else 0

    K = kernel(L)
    T, a = K[:n], K[n : 2 * n]
    resting, locked = K @ kernel(T), K @ kernel(a)
    tests = {
        "RI": rank(resting[n : 2 * n]) > 0,
        "RO": rank(locked[:n]) > 0,
        "RPM": kernel(K[: 2 * n]).shape[1] > 0,
        "II": rank(a) < n,
        "IO": rank(T) < n,
        "IIM": K.shape[1] > n,
    }
    return frozenset(name for name, holds in tests.items() if holds)


def turns(count: int, start: float = 0.137) -> Iterator[float]:
    """Angles all around, none of them special."""
    return (start + 2 * acos(-1.0) * i / count for i in range(count))
