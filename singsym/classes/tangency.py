"""Where a null motion is tangent to the singularities on which it is possible: cusps, as polynomials.

Source: Whitney, On singularities of mappings of Euclidean spaces I, Annals of Mathematics 62 (1955) 374-410:
in the plane a map folds along a curve, which has a cusp where the kernel is tangent to the curve.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from singsym.conditions.factor import Factor
from singsym.effort.budget import Undecided
from singsym.elimination.ideal import Ideal
from singsym.kinematics.nonzero import Certifier
from singsym.kinematics.placement import JointValue
from singsym.kinematics.velocity import VelocityEquation
from singsym.minors.blocks import block_triangular
from singsym.minors.determinant import determinant, maximal_minors, minors
from singsym.minors.rank import alternatives, is_small, minor_factors
from singsym.polynomials import Equations, Polynomial, PolynomialMatrix
from singsym.polynomials.unit_circles import Pair, separate_circles

ROLES = {"4": "input", "5": "output"}
"""What is at rest in the null motions of a condition."""


@dataclass(frozen=True)
class Tangency:
    """Where the null motion is tangent to the zeros of a factor of (4) or (5).

    alternatives: the polynomials of at least one vanish, with the loop equations; the factor is the first.
    exclusions: where all polynomials of one of them vanish there are more null motions, the zeros of the
        condition are not smooth, or the null motion is a turn of an angle that is held.
    held: angles at 0 in `alternatives`, by cosine and sine: all their turns lead to such configurations.
    """

    factor: Factor
    alternatives: tuple[Equations, ...]
    exclusions: tuple[Equations, ...]
    held: tuple[Pair, ...]


def tangencies(equation: VelocityEquation, label: str) -> tuple[Tangency, ...]:
    """For each factor of condition "4" or "5" the configurations where its null motion is tangent to it.

    Lemma: let F be the inputs, of (5) the outputs, as functions of the v coordinates, and f the factor.
    Where the slopes of the loop equations and of F have the rank v - 1, their kernel is tangent to f = 0
    where the slope of f does not make the rank v.
    Raises `Undecided` where (4) or (5) is not a product, and where F is not known as polynomials.
    """
    condition = equation.conditions[label]
    if condition.alternatives is None or any(len(a) != 1 for a in condition.alternatives):
        raise Undecided(f"condition ({label}) is not written as a product of polynomials")
    if not condition.factors:
        return ()
    slopes, certifier = _Slopes(equation), equation.conditions.certifier
    rows = [*slopes.loops, *slopes.at_rest(ROLES[label])]
    driven = PolynomialMatrix.of(equation.space.ring, rows, len(slopes.labels))
    left, kept = peeled(driven, certifier)
    if left.shape[0] < left.width or not any(minor for _, _, minor in maximal_minors(left)):
        raise Undecided(f"the {ROLES[label]}s do not determine the formulation's coordinates")
    return tuple(_tangency(slopes, left, kept, f, condition.factors) for f in condition.factors)


def _tangency(
    slopes: _Slopes, left: PolynomialMatrix, kept: Sequence[int], factor: Factor, factors: Sequence[Factor]
) -> Tangency:
    """left: the slopes of the loops and of F in the columns `kept`, peeled; factors: of the condition."""
    f, ring, certifier = factor.polynomial, left.ring, slopes.equation.conditions.certifier
    slope = slopes.of(f)
    wide = PolynomialMatrix.of(ring, [*left.rows, [slope[j] for j in kept]], left.width)
    smooth = PolynomialMatrix.of(ring, [*slopes.loops, slope], len(slope))
    if not is_small(wide) or not is_small(smooth):
        raise Undecided(f"too many terms in the {wide.shape[0]} equations for a tangent null motion")
    tangent = tuple(minor for _, _, minor in maximal_minors(wide))
    several = tuple(minor for _, _, minor in minors(left, left.width - 1))
    columns: dict[Pair | str, Equations] = {
        slopes.labels[j]: tuple(row[k] for row in left.rows) for k, j in enumerate(kept)
    }
    held = slopes.turning(f, tangent, several, columns)
    at_zero = {c: ring.one for c, _ in held} | {s: ring.zero for _, s in held}
    products = minor_factors(wide.map(lambda p: p.substitute(at_zero)), certifier)
    ways = () if products is None else alternatives(tuple(p for p in products if f not in p), certifier)
    if ways is None:
        raise Undecided("too many ways in which the null motion may be tangent")
    others = [(g.polynomial,) for g in factors if g != factor]
    angles = tuple(p for c, s in held for p in (ring.gen(c) - 1, ring.gen(s)))
    paths = tuple(
        (f, *(p for p in way if p != f), *angles) for way in ways if not any(g[0] in way for g in others)
    )
    folded = tuple(minor for _, _, minor in maximal_minors(smooth))
    groups = (several, folded, *(columns[pair] for pair in held))
    groups = tuple(g for g in groups if not any(certifier.reason(p) for p in g))
    return Tangency(factor, paths, (*others, *groups), held)


def peeled(matrix: PolynomialMatrix, certifier: Certifier) -> tuple[PolynomialMatrix, tuple[int, ...]]:
    """The matrix without square blocks that say that some unknowns are zero, and the columns that are left.

    A block has no other entry in its rows and a determinant proven to be nonzero: whatever rows are added,
    the rank is its size and that of the rest.
    """
    rows, columns = tuple(range(matrix.shape[0])), tuple(range(matrix.width))
    while True:
        part = matrix.select(rows, columns)
        found = next(
            (
                (r, c)
                for r, c in block_triangular(part).square
                if all(not part[i, j] for i in r for j in range(part.width) if j not in c)
                and certifier.reason(certifier.shorten(determinant(part.select(r, c))))
            ),
            None,
        )
        if found is None:
            return part, columns
        rows = tuple(i for k, i in enumerate(rows) if k not in found[0])
        columns = tuple(j for k, j in enumerate(columns) if k not in found[1])


class _Slopes:
    """Derivatives along coordinates: turns of angles that are unit circles, and all other variables."""

    def __init__(self, equation: VelocityEquation) -> None:
        self.equation = equation
        self.pairs = separate_circles(equation.space.equations)
        inside = {name for pair in self.pairs for name in pair}
        self.others = tuple(name for name in equation.space.variables if name not in inside)
        self.labels: tuple[Pair | str, ...] = (*self.pairs, *self.others)

    def of(self, p: Polynomial) -> Equations:
        """Along each coordinate."""
        return (*(_turned(p, pair) for pair in self.pairs), *map(p.derivative, self.others))

    @cached_property
    def loops(self) -> tuple[Equations, ...]:
        """Of the loop equations that are not circles."""
        found = (self.of(p) for p in self.equation.space.equations)
        return tuple(row for row in found if any(row))

    def at_rest(self, role: str) -> Iterator[Equations]:
        """Of the values of all inputs or outputs, times what has no zero."""
        columns = [c.label for c in self.equation.columns if c.role == role]
        for k, label in enumerate(columns):
            value = self.equation.values.get(label) if role == "input" else self._output(k)
            row = self._by_joints(k) if value is None and role == "output" else None
            if value is None and row is None:
                raise Undecided(f"the formulation has no coordinate whose rate is the {role} {label}")
            yield value.rate(self.of) if value is not None else row or ()

    def _output(self, place: int) -> JointValue | None:
        return self.equation.outputs[place][1] if self.equation.outputs else None

    def _by_joints(self, place: int) -> Equations | None:
        """Of a component of a twist, by the rates of the joints of an arm, each of which is a coordinate."""
        equation, ring = self.equation, self.equation.space.ring
        if self.loops or equation.architecture is None:
            return None
        screws = {
            c: s for j in equation.architecture.joints for c, s in zip(j.columns, j.screws, strict=True)
        }
        total = [ring.zero] * len(self.labels)
        for column, entry in zip(equation.columns, equation.matrix.rows[place], strict=True):
            if column.role == "output" or not entry:
                continue
            value, screw = equation.values.get(column.label), screws.get(column.label, ())
            turn = screw[:3] if value is not None and value.cosine is not None else screw[-3:]
            unit = sum((x * x for x in turn), ring.zero) - 1
            rate = () if value is None else value.rate(self.of)
            if value is None or not equation.conditions.certifier.shorten(unit).is_zero or value.square:
                return None
            scale = value.scale if value.scale is not None else ring.one
            if not scale.is_constant:
                return None
            total = [t - entry * r / (scale.constant**2) for t, r in zip(total, rate, strict=True)]
        return tuple(total)

    def turning(
        self,
        factor: Polynomial,
        tangent: Equations,
        several: Equations,
        columns: Mapping[Pair | str, Equations],
    ) -> tuple[Pair, ...]:
        """The angles whose turns do not lead out of what is asked for.

        tangent, with the factor, and several: what vanishes where a null motion is tangent, and where there
        are more; columns: the slopes by each angle.
        Lemma: where the derivative by an angle takes an ideal into itself, its flow takes zeros to zeros.
        """
        space = self.equation.space
        sides = (*space.positive, *space.nonnegative, *(p for group in space.exclusions for p in group))

        def is_kept(pair: Pair, polynomials: Equations) -> bool:
            ideal = Ideal(space.ring, (*space.equations, *polynomials))
            moved = (ideal.contains(_turned(p, pair)) for p in polynomials)
            return all(found.value and found.is_proven for found in moved)

        return tuple(
            pair
            for pair in self.pairs
            if pair in columns
            and not any(_turned(p, pair) for p in (*space.equations, *sides, factor))
            and all(is_kept(pair, own) for own in ((factor, *tangent), several, columns[pair]))
        )


def _turned(p: Polynomial, pair: Pair) -> Polynomial:
    """The derivative by an angle."""
    c, s = pair
    return p.derivative(s) * p.ring.gen(c) - p.derivative(c) * p.ring.gen(s)
