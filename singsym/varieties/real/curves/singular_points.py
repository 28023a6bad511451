"""How a real curve looks near a singular point: how many half-branches leave it, and one gate on each.

Source: Lyapunov-Schmidt reduction and the Morse lemma (M. Golubitsky, D. Schaeffer, Singularities and Groups
in Bifurcation Theory I, Springer 1985, chs. I, II), with interval bounds.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from singsym.varieties.real.curves.arithmetic import Array, Balls, System
from singsym.varieties.real.curves.tracking import newton
from singsym.varieties.real.points.exact_point import RealPoint

#: a point of the curve this near to a gate of a node (relative to the coordinates) is on its branch
GATE = 1e-9


@dataclass(frozen=True, eq=False)
class Star:
    """A singular point with the half-branches of the curve that end there.

    gates: a point on each half-branch (G, n) and the error bounds; `outward` the directions away from the
    point.  `exact` gates are points of the curve within the ball; others are balls in which every point of
    the curve lies on the half-branch.  `chart` bounds a neighbourhood in which there is nothing else.
    """

    point: RealPoint
    kind: str
    gates: Balls
    outward: Array
    exact: bool
    chart: Chart | None = None

    @property
    def degree(self) -> int:
        """How many half-branches there are: 0 at an isolated point, 4 at a node."""
        return len(self.gates.mid)


@dataclass(frozen=True, eq=False)
class Chart:
    """{center + plane a + across w : |inverse a|_1 <= size, |w| <= height}: a star and nothing else."""

    center: Array
    plane: Array
    across: Array
    inverse: Array
    size: float
    height: float
    blur: float

    def coordinates(self, points: Balls) -> tuple[Array, Array, Array]:
        """Plane coordinates (B, 2) in which the star is |b1| = |b2|, the heights, and their error bounds."""
        offset = points.mid - self.center
        slack = points.rad.max(axis=1) * 1.001 + 1e-11 * np.linalg.norm(offset, axis=1) + self.blur
        inverse = np.asarray((offset @ self.plane) @ self.inverse.T)
        height = np.abs(offset @ self.across).max(axis=1, initial=0.0)
        return inverse, height, slack

    def holds(self, points: Balls) -> np.ndarray:
        """Whether a ball lies surely inside."""
        b, height, slack = self.coordinates(points)
        loss = slack * 2 * np.linalg.norm(self.inverse)
        return np.asarray((np.abs(b).sum(axis=1) < self.size - loss) & (height < self.height - slack))

    def in_quadrants(self, points: Balls, signs: Array) -> np.ndarray:
        """Whether each ball lies surely inside, in the open quadrant of these signs."""
        b, _, slack = self.coordinates(points)
        clear = (b * signs).min(axis=1) > slack * np.linalg.norm(self.inverse)
        return np.asarray(self.holds(points) & clear)

    def signs(self, points: Balls) -> Array:
        """The quadrant of each point."""
        return np.asarray(np.sign(self.coordinates(points)[0]))


def node(system: System, point: RealPoint, ball: Balls) -> Star | None:
    """The star of an ordinary double point of a square system (n-1 equations), or `None`.

    `ball` encloses the point, at which the Jacobian is known to have rank below n-1.  Lemma: where it has
    rank n-2 and the Hessian form of the reduced equation stays within 1/10 of diag(1, -1) (of 1) on a box,
    the zeros there are the point and 4 arcs, one in each quadrant, near |b1| = |b2| (the point alone).
    """
    size, count = len(ball.mid[0]), len(system.equations)
    if count != size - 1:
        return None
    left, values, right = np.linalg.svd(system.jacobian(ball.mid)[0])
    scale = max(values[0], 1e-300) if len(values) else 1.0
    if count > 1 and values[-2] < 1e-7 * scale:
        return None
    gram = Balls.exact(right).matmul(Balls.exact(right.T.copy())) - Balls.exact(np.eye(size))
    if gram.magnitude().sum() > 1e-12:
        return None
    plane, across = right[-2:].T, right[:-2].T
    reduced = _Reduced(system, ball, plane, across, left[:, :-1], left[:, -1:])
    form = reduced.hessian(0.0, 0.0)
    if form is None or not np.isfinite(form.mid).all():
        return None
    eigenvalues, basis = np.linalg.eigh(form.mid)
    if np.abs(eigenvalues).min() < 1e-6 * max(1e-300, np.abs(eigenvalues).max()):
        return None
    order = np.argsort(-eigenvalues)
    turned = basis[:, order] / np.sqrt(np.abs(eigenvalues[order]))
    signature = np.sign(eigenvalues[order])
    extent = 0.5 / max(1.0, float(np.abs(turned).max()))
    for _ in range(24):
        chart = reduced.chart(turned, signature, extent)
        if chart is not None:
            if signature[0] == signature[1]:
                nothing = np.zeros((0, size))
                return Star(point, "isolated", Balls(nothing, nothing), nothing, False, chart)
            return _with_gates(system, point, chart, turned)
        extent /= 2
    return None


@dataclass(frozen=True, eq=False)
class _Reduced:
    """The one equation in two unknowns left after solving n-2 equations for the coordinates `across`."""

    system: System
    ball: Balls
    plane: Array
    across: Array
    kept: Array
    last: Array

    def _solved(self, flat: float, height: float) -> tuple[Balls, Balls, Balls, float] | None:
        """Over a box: its points, the multipliers, the tangents T (n, 2), and the steepness of the graph."""
        reach = (
            self.ball.rad[0].max()
            + np.abs(self.plane).sum(axis=1) * flat
            + np.abs(self.across).sum(axis=1) * height
        ) * (1 + 1e-12)
        box = Balls(self.ball.mid, reach[None, :])
        jacobian = self.system.jacobian_balls(box).reshape(*self.system.shape)
        exact = Balls.exact
        kept = exact(self.kept.T).matmul(jacobian)
        last = exact(self.last.T).matmul(jacobian)
        middle = self.kept.T @ self.system.jacobian(self.ball.mid)[0] @ self.across
        precondition = exact(np.linalg.inv(middle))
        size = self.across.shape[1]
        square = precondition.matmul(kept.matmul(exact(self.across)))
        defect = float((square - exact(np.eye(size))).magnitude().sum(axis=1).max(initial=0.0)) * (1 + 1e-12)
        if not defect < 0.5:
            return None
        # the inverse of 1 + D with |D| <= defect differs from 1 by at most defect / (1 - defect)
        inverse = Balls(np.eye(size), np.full((size, size), 1.001 * defect / (1 - defect))).matmul(
            precondition
        )
        steep = -inverse.matmul(kept.matmul(exact(self.plane)))
        tangents = exact(self.plane) + exact(self.across).matmul(steep)
        multipliers = exact(self.last.T) - last.matmul(exact(self.across)).matmul(inverse).matmul(
            exact(self.kept.T)
        )
        return box, multipliers, tangents, float(steep.magnitude().sum(axis=1).max(initial=0.0))

    def hessian(self, flat: float, height: float) -> Balls | None:
        """The Hessian of the reduced equation over the box |a| <= flat, |w| <= height."""
        solved = self._solved(flat, height)
        if solved is None:
            return None
        box, multipliers, tangents, _ = solved
        n = self.system.shape[1]
        second = self.system.hessian_balls(box).reshape(self.system.shape[0], n * n)
        form = multipliers.matmul(second).reshape(n, n)
        return tangents.transpose().matmul(form).matmul(tangents)

    def chart(self, turned: Array, signature: Array, extent: float) -> Chart | None:
        """The chart with |b|_1 <= extent, if the Hessian form is controlled over it."""
        flat = float(np.abs(turned).max(axis=1).max()) * extent * (1 + 1e-9)
        start = self._solved(flat, 0.0)
        if start is None:
            return None
        height = 1.2 * start[3] * flat + 1e-3 * flat
        solved = self._solved(flat, height)
        if solved is None or not solved[3] * flat < height * (1 - 1e-9):
            return None
        form = self.hessian(flat, height)
        if form is None:
            return None
        exact = Balls.exact
        final = exact(turned.T.copy()).matmul(form).matmul(exact(turned)) - exact(np.diag(signature))
        if not final.magnitude().max() < 0.1:
            return None
        blur = 1.01 * float(self.ball.rad[0].max()) + 1e-15
        inverse = np.asarray(np.linalg.inv(turned), dtype=np.float64)
        return Chart(self.ball.mid[0], self.plane, self.across, inverse, extent, height, blur)


def _with_gates(system: System, point: RealPoint, chart: Chart, turned: Array) -> Star | None:
    signs = np.array([(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)])
    outward = (signs @ turned.T) @ chart.plane.T
    start = chart.center + outward * (chart.size / 4)
    outward = outward / np.linalg.norm(outward, axis=1, keepdims=True)
    found, _ = newton(system, start, outward, 8)
    size = 1 + np.abs(found).max()
    gates = Balls(found, np.full_like(found, GATE * size))
    if not chart.in_quadrants(gates, signs).all():
        return None
    return Star(point, "node", gates, outward, False, chart)
