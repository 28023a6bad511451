"""The 2-DOF linkage of Zlatanov, Fenton, Benhabib (1998), §3.3, in the coordinates of its moving points."""

from dataclasses import dataclass
from fractions import Fraction

import pytest

from singsym.polynomials import Polynomial, Ring


@dataclass(frozen=True)
class Linkage:
    """Its ring, the six loop equations, and the points by name."""

    ring: Ring
    loops: tuple[Polynomial, ...]
    points: dict[str, tuple[Polynomial, Polynomial]]

    def determinant(self, triple: str) -> Polynomial:
        """Twice the area of a triangle of points."""
        (px, py), (qx, qy), (rx, ry) = (self.points[n] for n in triple)
        return (qx - px) * (ry - py) - (qy - py) * (rx - px)


@pytest.fixture(scope="session")
def linkage() -> Linkage:
    ring = Ring(("Bx", "By", "Cx", "Cy", "Fx", "Fy", "Gx", "Gy"))
    points = {n: (ring.gen(f"{n}x"), ring.gen(f"{n}y")) for n in "BCFG"}
    points |= {n: (ring.constant(k), ring.zero) for k, n in enumerate("ADE")}
    lengths = {"AB": 1, "BC": 1, "CD": 2, "CG": Fraction(3, 2), "FG": 2, "EF": 3}
    loops = []
    for (p, q), length in lengths.items():
        (px, py), (qx, qy) = points[p], points[q]
        loops.append((px - qx) ** 2 + (py - qy) ** 2 - Fraction(length) ** 2)
    return Linkage(ring, tuple(loops), points)
