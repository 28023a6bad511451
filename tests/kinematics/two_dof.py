"""The 2-DOF linkage by hand, from (6) of Zlatanov, Fenton, Benhabib (1998), in point coordinates."""

from __future__ import annotations

from singsym.kinematics.placement import ConfigurationSpace
from singsym.kinematics.velocity import Column, Role, VelocityEquation
from singsym.polynomials import Polynomial, PolynomialMatrix, Ring

RING = Ring(("xB", "yB", "xC", "yC", "xF", "yF", "xG", "yG"))
_xB, _yB, _xC, _yC, _xF, _yF, _xG, _yG = RING.gens
Point = tuple[Polynomial, Polynomial]
POINTS: dict[str, Point] = {
    "A": (RING.zero, RING.zero),
    "B": (_xB, _yB),
    "C": (_xC, _yC),
    "D": (RING.one, RING.zero),
    "E": (RING.constant(2), RING.zero),
    "F": (_xF, _yF),
    "G": (_xG, _yG),
}


def collinear(p: str, q: str, r: str) -> Polynomial:
    """Twice the signed area of a triangle of named points."""
    (px, py), (qx, qy), (rx, ry) = POINTS[p], POINTS[q], POINTS[r]
    return (qx - px) * (ry - py) - (qy - py) * (rx - px)


def two_dof() -> VelocityEquation:
    """AB = BC = 1, CD = FG = 2, CG = 3/2, EF = 3; inputs at A and E, output the velocity of G."""
    loops = []
    for p, q, square in [
        ("A", "B", 4),
        ("B", "C", 4),
        ("C", "D", 16),
        ("C", "G", 9),
        ("F", "G", 16),
        ("E", "F", 36),
    ]:
        (px, py), (qx, qy) = POINTS[p], POINTS[q]
        loops.append(((px - qx) ** 2 + (py - qy) ** 2) * 4 - square)
    space = ConfigurationSpace(RING, tuple(loops), points=POINTS)
    first, second = (
        {"A": "A", "B": "B", "C": "C1", "D": "D"},
        {"E": "E", "D": "D", "C": "C2", "G": "G", "F": "F"},
    )
    labels = ["vx", "vy", "A", "E", "B", "C1", "D", "C2", "G", "F"]
    rows: list[list[Polynomial]] = [[RING.zero] * 10 for _ in range(8)]
    rows[0][0] = rows[1][1] = RING.one
    for p in ("E", "F"):
        rows[0][labels.index(p)] = POINTS[p][1] - _yG
        rows[1][labels.index(p)] = _xG - POINTS[p][0]
    for start, loop in ((2, first), (5, second)):
        for p, label in loop.items():
            x, y = POINTS[p]
            for k, entry in enumerate((RING.one, y, -x)):
                rows[start + k][labels.index(label)] = entry
    roles: list[Role] = [*["output"] * 2, *["input"] * 2, *["passive"] * 6]
    columns = tuple(Column(label, role) for label, role in zip(labels, roles, strict=True))
    names = ("G x", "G y", *(f"loop {k} {c}" for k in (1, 2) for c in ("w", "vx", "vy")))
    return VelocityEquation(space, PolynomialMatrix.of(RING, rows), columns, names, 8, 2)
