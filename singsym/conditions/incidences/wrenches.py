"""The wrenches that a leg with locked inputs withstands, as lines through its points.

Source: K. H. Hunt, *Kinematic Geometry of Mechanisms* (1978); D. Zlatanov, R. G. Fenton, B. Benhabib (1998),
section 4.1: a wrench that is reciprocal to all passive joints of a leg.

Lemma (reciprocal rows).  Let P have d columns in h rows, and W h - d rows in as many columns, with W P = 0.
Let each d-minor of P be, up to the sign of Laplace's expansion, k times the minor of W in the other places,
with one k for all.  Then det [E | P] = k det(W E) up to the sign, for any E of h - d columns: both are
expanded by these minors, the right side by Cauchy and Binet.  For several legs, one below the other in E, the
same holds with the product of their k.  That k is the same for all minors is checked in each.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations, product

from singsym.conditions.incidences.grassmann_cayley import Vector, along, felt, join, minus
from singsym.conditions.incidences.legs import Leg
from singsym.kinematics.nonzero import Certifier
from singsym.kinematics.placement import cross, dot
from singsym.minors.determinant import maximal_minors
from singsym.polynomials import Polynomial, PolynomialMatrix


@dataclass(frozen=True)
class Line:
    """A wrench with what it is drawn through.

    kind: "line", a force along the line through two points; "axis", along that through a point parallel to an
        axis; "couple", about an axis; "plane", in spherical motion a moment about the normal of two axes.
    """

    kind: str
    names: tuple[str, str]
    coordinates: Vector


@dataclass(frozen=True)
class Support:
    """All wrenches of a leg, spanned by `lines`; `scale` is the k of the lemma, for its passive joints."""

    leg: Leg
    lines: tuple[Line, ...]
    scale: Polynomial


def support(leg: Leg, inputs: frozenset[str], certifier: Certifier) -> Support | None:
    """What a leg withstands with its inputs locked; None where no lines through its points span it.

    Everything is checked exactly, modulo the circles and spheres of the configuration space.
    """
    space, ring = certifier.space, certifier.space.ring
    planar = any(len(place) == 2 for place in space.points.values())
    columns = leg.columns(inputs)
    idle = sum(joint.idle is not None for joint in leg.joints)
    height = len(leg.joints[0].screws[0]) + idle
    wanted = height - len(columns)
    if wanted <= 0:
        return None
    passive = [(felt(screw, planar), spins) for screw, spins in columns]
    lines: list[Line] = []
    minors: dict[tuple[int, ...], Polynomial] = {}
    for line in _candidates(leg, certifier, planar):
        if len(lines) == wanted:
            break
        if any(certifier.normal_form(dot(line.coordinates, screw)) for screw, _ in passive):
            continue
        rows = [(*known.coordinates, *[ring.zero] * idle) for known in (*lines, line)]
        found = _minors(PolynomialMatrix.of(ring, rows, height))
        if any(map(certifier.normal_form, found.values())):
            lines.append(line)
            minors = found
    if len(lines) < wanted:
        return None
    matrix = PolynomialMatrix.of(ring, [(*screw, *spins) for screw, spins in passive], height)
    scale = _scale(_minors(matrix), minors, height, certifier)
    return None if scale is None else Support(leg, tuple(lines), scale)


def _candidates(leg: Leg, certifier: Certifier, planar: bool) -> Iterator[Line]:
    """Lines through two points of a leg, or through one along an axis; couples; planes of two axes."""
    points = {name: tuple(certifier.space.points[name]) for name in leg.points}
    axes = {name: tuple(certifier.space.directions[name]) for name in leg.axes}
    if len(leg.joints[0].screws[0]) == 3 and not planar:
        for u, v in combinations(axes, 2):
            yield Line("plane", (u, v), cross(axes[u], axes[v]))
        return
    for p, q in combinations(points, 2):
        if any(map(certifier.normal_form, minus(points[q], points[p]))):
            yield Line("line", (p, q), join(points[p], points[q]))
    for p, u in product(points, axes):
        yield Line("axis", (p, u), along(points[p], axes[u]))
    zero = certifier.space.ring.zero
    for u in axes:
        if not planar:
            yield Line("couple", ("", u), (zero, zero, zero, *axes[u]))


def _minors(matrix: PolynomialMatrix) -> dict[tuple[int, ...], Polynomial]:
    """The minors of all rows of a wide matrix by their columns."""
    return {columns: minor for _, columns, minor in maximal_minors(matrix)}


def _scale(
    passive: dict[tuple[int, ...], Polynomial],
    own: dict[tuple[int, ...], Polynomial],
    height: int,
    certifier: Certifier,
) -> Polynomial | None:
    """The k of the lemma, checked in all minors; None where the division does not come out."""
    zero = certifier.space.ring.zero
    pairs = []
    for columns in combinations(range(height), len(next(iter(own)))):
        rest = tuple(i for i in range(height) if i not in columns)
        pairs.append((passive.get(rest, zero) * (-1) ** sum(columns), own.get(columns, zero)))
    whole, part = min(
        (pair for pair in pairs if certifier.normal_form(pair[1])), key=lambda pair: len(pair[1])
    )
    if not part.divides(whole):
        return None
    scale = whole.exact_quotient(part)
    agreed = not any(certifier.normal_form(big - scale * small) for big, small in pairs)
    return scale if agreed else None
