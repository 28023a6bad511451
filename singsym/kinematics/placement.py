"""What a formulation yields: configuration variables, loop equations, and where every joint is.

Source: Zlatanov, Fenton, Benhabib (1998), section 2.4, the loop equations I(q) = 0 and the feasible set.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property

from singsym.polynomials import Polynomial, Ring

Coordinates = tuple[Polynomial, ...]


@dataclass(frozen=True)
class ConfigurationSpace:
    """Configurations as the real zeros of `equations`, cut down to the feasible set Omega.

    equations: I(q) = 0, with c^2 + s^2 - 1 of every angle and the relations of the ring's constants.
    exclusions: of each tuple, not all polynomials may vanish ("leg not folded").
    positive, nonnegative: p > 0, p >= 0 (ranges of parameters, joint limits).
    parameters: the ring's names that are dimensions and not configuration variables.
    mountings: screws and racks, which tie an angle to a length: both are coordinates as if they were free,
        so that all ways to mount them are looked at together.
    lengths: the configuration variables that are lengths; the others are pure numbers.
    points: coordinates of the named points of space, 2 (planar) or 3.
    directions: components of the named axes, in the fixed frame.
    """

    ring: Ring
    equations: tuple[Polynomial, ...]
    exclusions: tuple[tuple[Polynomial, ...], ...] = ()
    positive: tuple[Polynomial, ...] = ()
    nonnegative: tuple[Polynomial, ...] = ()
    parameters: tuple[str, ...] = ()
    mountings: tuple[str, ...] = ()
    lengths: tuple[str, ...] = ()
    points: Mapping[str, Coordinates] = field(default_factory=dict)
    directions: Mapping[str, Coordinates] = field(default_factory=dict)
    formulation: str = ""

    @property
    def varying(self) -> int:
        """How many dimensions the space has beside those of motions: of parameters and of mountings."""
        return len(self.parameters) + len(self.mountings)

    @property
    def variables(self) -> tuple[str, ...]:
        """The configuration variables: the ring's names without parameters and constants."""
        fixed = {*self.parameters, *(c.name for c in self.ring.constants)}
        return tuple(name for name in self.ring.names if name not in fixed)

    @cached_property
    def places(self) -> dict[str, Coordinates]:
        """The named points, one name for each place."""
        found: dict[Coordinates, str] = {}
        for name, place in self.points.items():
            found.setdefault(tuple(place), name)
        return {name: place for place, name in found.items()}


@dataclass(frozen=True)
class JointValue:
    """A joint's value as polynomials: (numerator of cosine, of sine, common denominator), or a length.

    For an angle `cosine/scale`, `sine/scale` with `scale` positive on the feasible set; for a slide `length`,
    or the `square` of a length that is positive.
    """

    cosine: Polynomial | None = None
    sine: Polynomial | None = None
    scale: Polynomial | None = None
    length: Polynomial | None = None
    square: Polynomial | None = None

    def rate(self, slopes: Callable[[Polynomial], Coordinates]) -> Coordinates:
        """Derivatives of the value along some directions, times what has no zero on the feasible set.

        slopes: the derivatives of a polynomial along these directions.
        """
        if self.cosine is not None and self.sine is not None:
            c, s = self.cosine, self.sine
            return tuple(c * b - s * a for a, b in zip(slopes(c), slopes(s), strict=True))
        side = self.square if self.length is None else self.length
        return () if side is None else tuple(slopes(side))


@dataclass(frozen=True)
class PlacedJoint:
    """A joint between two links with its screws in the fixed frame, and the names of where it is.

    points, axes: names of its points and directions, as far as `space.points` and `space.directions` have
        them, each once.
    screws: one for each of `columns`, of the second link relative to the first.
    idle: where the link between two spherical joints would spin about its own line, the direction in which
        this joint does not.
    """

    name: str
    first: str
    second: str
    points: tuple[str, ...]
    axes: tuple[str, ...]
    columns: tuple[str, ...]
    screws: tuple[Coordinates, ...]
    idle: Coordinates | None = None


@dataclass(frozen=True)
class Architecture:
    """How a mechanism hangs together: its joints between links.

    moved, point: the link and point whose velocity is the output, or "".
    coupled: gears, belts or racks tie rates of joints to each other.
    """

    ground: str
    joints: tuple[PlacedJoint, ...]
    moved: str
    point: str = ""
    coupled: bool = False


@dataclass(frozen=True)
class Placement:
    """Where everything is, as polynomials in the configuration variables.

    screws: column label -> joint screw of `second` relative to `first`, in the fixed frame at
        its origin: planar (w, vx, vy), spherical (wx, wy, wz), spatial (wx, wy, wz, vx, vy, vz).  A pin at
        (x, y) is (1, y, -x).  A screw may be scaled by a factor that is nonzero on the feasible set.
    link_points: (link, point) -> coordinates, for every point that an output or a figure needs.
    idle_spins: pairs (S joint name, direction) along which a link between two spherical joints would spin
        idly; velocity.py adds the row direction . (spin of that joint) = 0 for each.
    values: column label -> the joint's value, where the formulation can tell it.
    headings: link -> the variables that its orientation depends on.
    """

    space: ConfigurationSpace
    screws: Mapping[str, Coordinates]
    link_points: Mapping[tuple[str, str], Coordinates]
    idle_spins: tuple[tuple[str, Coordinates], ...] = ()
    values: Mapping[str, JointValue] = field(default_factory=dict)
    headings: Mapping[str, tuple[str, ...]] = field(default_factory=dict)


def variables_of(polynomials: Iterable[Polynomial]) -> tuple[str, ...]:
    """The ring's names in any of some polynomials, in the order of their appearance."""
    return tuple(dict.fromkeys(name for p in polynomials for name in p.variables))


def dot(a: Coordinates, b: Coordinates) -> Polynomial:
    """The scalar product of two vectors of one size."""
    return sum((p * q for p, q in zip(a[1:], b[1:], strict=True)), start=a[0] * b[0])


def cross(a: Coordinates, b: Coordinates) -> Coordinates:
    """The vector product of two vectors of space."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
