"""What singularity-free regions end at: conditions (4) and (5), and, apart from these, limits and exclusions.

Source: (4) and (5) of Zlatanov, Fenton, Benhabib (1998), of which one holds at each singularity; limits
as barriers: Haug, Luh, Adkins, Wang, Numerical algorithms for mapping boundaries of manipulator workspaces,
J. Mech. Des. 118 (1996) 228-234.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from singsym.classes.configuration.at import Analysis
from singsym.classes.configuration.locate import sizes_of_coordinates
from singsym.kinematics.velocity import VelocityEquation
from singsym.mechanism.problems import MechanismError, Problem
from singsym.motion.coordinates import Coordinates, joint_space
from singsym.motion.enclosures import Enclosure, is_surely_regular, sure_sign
from singsym.motion.loci import determinant_factors, determinant_loci
from singsym.polynomials import Polynomial
from singsym.polynomials.compiled_map import CompiledMap, Floats

_LIMIT, _EXCLUSION = "limit", "exclusion"


@dataclass(frozen=True)
class Border:
    """One polynomial that vanishes nowhere inside a region.

    condition: "4" or "5", whose factor it is; "limit" of a joint or expression, positive inside; "exclusion".
    """

    condition: str
    polynomial: Polynomial
    words: str

    @property
    def is_singular(self) -> bool:
        """Whether its zeros are singularities; else they are a barrier."""
        return self.condition not in (_LIMIT, _EXCLUSION)

    def __str__(self) -> str:
        return f"({self.condition}) {self.words}" if self.is_singular else f"{self.condition}: {self.words}"


@dataclass(frozen=True, eq=False)
class Borders:
    """All borders of the regions of a mechanism.

    conditions: the factors of (4) and (5), None where they are not single polynomials.
    singular: their factors; barriers: limits, and exclusions of one polynomial; holes: other exclusions, of
    which not all polynomials may vanish.
    unwritten: those of (4) and (5) of which no factors are known.
    """

    equation: VelocityEquation
    conditions: Mapping[str, Sequence[Polynomial] | None]
    singular: tuple[Border, ...]
    barriers: tuple[Border, ...]
    holes: tuple[tuple[Polynomial, ...], ...]
    unwritten: tuple[str, ...]

    @property
    def all(self) -> tuple[Border, ...]:
        """Those whose polynomials keep their signs inside a region."""
        return (*self.singular, *self.barriers)

    def signs(self, where: Enclosure) -> tuple[int, ...]:
        """The signs of all polynomials on an enclosure; 0 where it does not decide them."""
        return tuple(sure_sign(b.polynomial, where) for b in self.all)

    def are_off(self, where: Enclosure) -> bool:
        """Whether it is proven that no configuration in an enclosure is on a border or beyond a limit."""
        return self.is_within(where) and is_surely_regular(self.equation, self.conditions, where)

    def is_within(self, where: Enclosure) -> bool:
        """Whether limits and exclusions are proven to allow all of an enclosure."""
        signs = ((b.condition, sure_sign(b.polynomial, where)) for b in self.barriers)
        allowed = all(sign > 0 if kind == _LIMIT else sign for kind, sign in signs)
        return allowed and all(any(sure_sign(p, where) for p in hole) for hole in self.holes)

    @cached_property
    def _map(self) -> CompiledMap:
        sizes = sizes_of_coordinates(self.equation).tolist()
        polynomials = [b.polynomial for b in self.all]
        return CompiledMap.balanced(polynomials, self.equation.space.ring, sizes)

    def values(self, points: Floats) -> Floats:
        """The values of all polynomials over the sizes of their terms, (..., borders), numerically."""
        if not self.all:
            return np.zeros((*points.shape[:-1], 0))
        return self._map.values(points)

    def allows(self, values: Floats) -> Floats:
        """Of values as `values` gives them, (..., borders), whether limits allow them."""
        limits = [k for k, b in enumerate(self.all) if b.condition == _LIMIT]
        return np.asarray((values[..., limits] > 0).all(axis=-1))


def borders(equation: VelocityEquation) -> Borders:
    """The borders of a mechanism; raises `MechanismError` where (4) or (5) holds in every configuration."""
    for label in ("4", "5"):
        if equation.conditions[label].everywhere:
            found, expected = f"condition ({label}) holds everywhere", "configurations that are not singular"
            raise MechanismError([Problem("regions", found, expected)])
    loci, unwritten = determinant_loci(equation)
    singular = [Border(locus.label, locus.polynomials[0], locus.words) for locus in loci]
    space = equation.space
    barriers = [_barrier(_LIMIT, p) for p in (*space.positive, *space.nonnegative)]
    barriers += [_barrier(_EXCLUSION, group[0]) for group in space.exclusions if len(group) == 1]
    return Borders(
        equation,
        determinant_factors(equation),
        tuple(singular),
        tuple(barriers),
        tuple(group for group in space.exclusions if len(group) > 1),
        unwritten,
    )


def _barrier(kind: str, polynomial: Polynomial) -> Border:
    return Border(kind, polynomial, f"{polynomial.short_text(4)} = 0")


def input_space(equation: VelocityEquation, length: float = 1.0) -> Coordinates:
    """The values of the inputs; raises `MechanismError` where the formulation does not tell them.

    length: the unit of those that are lengths.
    """
    found = joint_space(equation, length)
    if found is None:
        given, expected = "inputs without known values", "inputs whose values are coordinates"
        raise MechanismError([Problem("regions", given, expected)])
    return found


def point_of(found: Analysis) -> Floats:
    """A configuration that was examined, in the order of the ring's names."""
    return np.array([float(found.values[name]) for name in found.equation.space.ring.names])
