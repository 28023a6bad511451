"""What is printed on both sides of "=" for a named factor, at configurations found by Newton's method.

Source: independent of the recognition: the left side is read as it is printed and worked out by numpy from
the places of the named points and axes, the right side by SymPy from the printed text.
"""

import itertools
import re
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
import pytest
import sympy
from sympy.parsing.sympy_parser import parse_expr

from singsym.conditions.conditions import conditions
from singsym.conditions.factor import Factor
from singsym.conditions.named_quantities import PointNames
from singsym.kinematics.nonzero import Certifier
from singsym.kinematics.placement import ConfigurationSpace
from singsym.kinematics.velocity import VelocityEquation, velocity_equation
from singsym.mechanism import load
from singsym.mechanism.library import names
from singsym.polynomials import AlgebraicConstant, PolynomialMatrix, Ring
from singsym.polynomials.latex import symbol_latex
from tests.conditions import test_conditions_numerically as numerically

Places = Mapping[str, np.ndarray]


def bare(space: ConfigurationSpace) -> VelocityEquation:
    """An equation without rows, for names on a configuration space alone."""
    return VelocityEquation(space, PolynomialMatrix.of(space.ring, []), (), (), 0, 0)


@dataclass(frozen=True)
class Pose:
    """Where the named points and axes of a mechanism are at a configuration, worked out by numpy.

    slides: directions of slides in the plane, up to their sign; velocities: of the output's point, for each
    joint that turns alone.
    """

    points: Places
    axes: Places
    slides: Places
    velocities: Places

    @classmethod
    def of(cls, equation: VelocityEquation, point: list[float]) -> "Pose":
        space = equation.space
        points, axes = (
            {name: np.array([float(x.evaluate(point)) for x in place]) for name, place in places.items()}
            for places in (space.points, space.directions)
        )
        return cls(points, axes, _slides(equation, point), _velocities(equation, point))

    def vector(self, text: str) -> np.ndarray:
        """An axis, a slide, or the vector from one point to another, their names side by side."""
        if text in self.axes:
            return self.axes[text]
        if text.startswith("u_"):
            return self.slides[text.removeprefix("u_")]
        p, q = self.named(text, 2)
        return q - p

    def named(self, text: str, count: int) -> list[np.ndarray]:
        """The places of so many points, their names side by side."""
        found = [c for c in itertools.product(self.points, repeat=count) if "".join(c) == text]
        places = {tuple(np.concatenate([self.points[n] for n in names])) for names in found}
        assert len(places) == 1, text
        return [self.points[name] for name in found[0]]

    def line(self, text: str) -> np.ndarray:
        """Plücker coordinates."""
        if ":" in text:
            base, axis = text.split(":")
            if axis.startswith("n_"):
                x, y = self.slides[axis.removeprefix("n_")]
                return np.array([-y, x, self.points[base] @ [x, y]])
            direction = self.axes[axis]
            return np.concatenate([direction, np.cross(self.points[base], direction)])
        p, q = self.named(text, 2)
        return np.concatenate([q - p, np.cross(p, q) if len(p) == 3 else [p[0] * q[1] - p[1] * q[0]]])

    def row(self, text: str, count: int) -> np.ndarray:
        """A row of a determinant of so many."""
        planar = len(next(iter(self.points.values()))) == 2
        if text.startswith("S_"):
            x, y = self.points[text.removeprefix("S_")]
            return np.array([1, y, -x])
        if text.startswith("v_"):
            return self.velocities[text.removeprefix("v_")]
        if count == 6 or (planar and count == 3):
            return self.line(text)
        if count == 4 and text in self.points:
            return np.array([1, *self.points[text]])
        if count == 4:
            p, q, r = self.named(text, 3)
            normal = np.cross(q - p, r - p)
            return np.array([*normal, -normal @ p])
        if found := re.fullmatch(r"(\w+)x(\w+)", text):
            return np.cross(self.axes[found[1]], self.axes[found[2]])
        return self.vector(text)

    def quantity(self, text: str) -> float:
        """A determinant or product from its printed name; a length without its sign."""
        if found := re.fullmatch(r"±\|(\w+) x (\w+)\|", text):
            return float(np.linalg.norm(np.cross(*(self.vector(t) for t in found.groups()))))
        if found := re.fullmatch(r"(\w+)\.(\w+)", text):
            return float(np.dot(*(self.vector(t) for t in found.groups())))
        found = re.fullmatch(r"det\[(.*)\]", text)
        assert found is not None, text
        inside = found[1].split()
        return float(np.linalg.det(np.array([self.row(item, len(inside)) for item in inside])))


def _slides(equation: VelocityEquation, point: list[float]) -> Places:
    """The directions of columns of L that have no rotation, in the plane."""
    rows = [i for i, row in enumerate(equation.rows) if row.startswith("loop")]
    found = {}
    for j, column in enumerate(equation.columns):
        entries = np.array([float(equation.matrix[i, j].evaluate(point)) for i in rows]).reshape(-1, 3)
        place = next((own for own in entries if own.any()), None) if equation.space.points else None
        if place is not None and not place[0]:
            found[column.label] = place[1:]
    return found


def _velocities(equation: VelocityEquation, point: list[float]) -> Places:
    """Of the point `tool`, by a complex step of each joint's angle on its own."""
    space, step, found = equation.space, 1e-30, {}
    for label, value in equation.values.items():
        turned: list[complex] = list(point)
        if "tool" not in space.points or value.cosine is None or value.sine is None:
            continue
        c, s = (space.ring.index(p.variables[0]) for p in (value.cosine, value.sine))
        turned[c], turned[s] = point[c] - 1j * step * point[s], point[s] + 1j * step * point[c]
        found[label] = np.array([complex(x.evaluate(turned)).imag / step for x in space.points["tool"]])
    return found


def from_latex(text: str, ring: Ring) -> str:
    """The LaTeX of a sum of products as Python, the variables by their names."""
    for place, name in sorted(enumerate(ring.names), key=lambda pair: -len(symbol_latex(pair[1]))):
        text = re.sub(rf"(?<![\\\w]){re.escape(symbol_latex(name))}(?!\w)", f"v{place}", text)
    text = re.sub(r"\\left|\\right|\\,", " ", text)
    text = re.sub(r"\^\{(\d+)\}", r"**\1", text)
    text = re.sub(r"\\sqrt\{(\d+)\}", r"root\1", text)
    while r"\frac" in text:
        text = re.sub(r"\\frac\{([^{}]*)\}\{([^{}]*)\}", r"((\1)/(\2))", text)
    text = re.sub(r"(?<=[\w)])\s*(?=\()|(?<=[\w)])\s+(?=\w)|(?<=\))(?=\w)", "*", text)
    text = re.sub(r"root(\d+)", r"sqrt(\1)", text)
    return re.sub(r"v(\d+)", lambda m: f"({ring.names[int(m[1])]})", text)


def both_sides(factor: Factor, point: list[float], equation: VelocityEquation) -> list[float]:
    """The named quantity, the right side of the text, the right side of the LaTeX."""
    assert factor.name is not None
    left, _, right = factor.text().partition(" = ")
    ring = equation.space.ring
    symbols = {name: sympy.Symbol(name) for name in ring.names}
    values = {symbols[name]: value for name, value in zip(ring.names, point, strict=True)}
    latex = factor.latex(10**6).partition(" = ")[2]
    shown = [right.replace("^", "**"), from_latex(latex, ring)]
    return [
        Pose.of(equation, point).quantity(left),
        *(float(parse_expr(text, local_dict=dict(symbols)).xreplace(values)) for text in shown),
    ]


def root(constant: AlgebraicConstant) -> float:
    """The root of a constant's minimal polynomial that is in its interval."""
    roots = np.roots([float(x) for x in reversed(constant.minimal)])
    middle = float(constant.low + constant.high) / 2
    return float(min(roots, key=lambda x: abs(x - middle)).real)


def check(factor: Factor, point: list[float], equation: VelocityEquation) -> None:
    left, *right = both_sides(factor, point, equation)
    if factor.text().startswith("±"):
        right = [abs(value) for value in right]
    if re.search("[un]_", factor.text()):
        left, right = abs(left), [abs(value) for value in right]
    assert right == pytest.approx([left, left], rel=1e-8, abs=1e-9), factor.text()


@pytest.mark.parametrize("name", sorted(set(names()) - numerically.LEFT_OUT - {"zlatanov-hybrid-3-2"}))
def test_equalities_hold_at_random_configurations(name: str) -> None:
    equation = velocity_equation(load(name))
    space = equation.space
    found = {
        factor.polynomial: factor
        for condition in conditions(equation)
        for alternative in condition.alternatives or ()
        for factor in alternative
        if factor.name is not None
    }
    rng = np.random.default_rng(11)
    constants = {space.ring.index(c.name): root(c) for c in space.ring.constants}
    loops = [e for e in space.equations if e not in space.ring.relations]
    tries = (
        numerically.newton(loops, constants, rng) if loops else list(rng.normal(size=len(space.ring.names)))
        for _ in range(40)
    )
    points = list(itertools.islice((point for point in tries if point is not None), 3))
    assert len(points) == 3
    for point in points:
        for factor in found.values():
            check(factor, point, equation)


def test_the_sign_and_the_factor_of_a_small_determinant() -> None:
    """A = (0, 0), B = (2, 0), C = (x, y): det[S_A S_B S_C] has the rows (1, 0, 0), (1, 0, -2), (1, y, -x),
    and is twice the triangle's area 1/2 2 y with its sign: 2 y."""
    ring = Ring(("x", "y"))
    x, y = ring.gens
    points = {"A": (ring.zero, ring.zero), "B": (ring.constant(2), ring.zero), "C": (x, y)}
    found = PointNames(Certifier(ConfigurationSpace(ring, (), points=points)))
    for polynomial, shown in ((y, "2*y"), (-3 * y, "2*y")):
        factor = Factor(polynomial, name=found.recognise(polynomial))
        assert str(factor) == f"det[S_A S_B S_C] = {shown}  (A, B, C collinear)"


def test_a_length_that_is_an_irrational_multiple() -> None:
    """AB = (1, 1, 0) and AC = (c, c, s): AB x AC = (s, -s, 0), of length sqrt(2) |s|."""
    ring = Ring(("c", "s"))
    c, s = ring.gens
    o, one = ring.zero, ring.one
    points = {"A": (o, o, o), "B": (one, one, o), "C": (c, c, s)}
    space = ConfigurationSpace(ring, (2 * c**2 + s**2 - 1,), points=points)
    factor = Factor(s, name=PointNames(Certifier(space)).recognise(s))
    assert factor.text() == "±|AB x AC| = sqrt(2)*s"
    check(factor, [0.48, 0.7341662], bare(space))


def test_a_factor_that_is_not_constant() -> None:
    """A = (0, 0), B = (x, 0), C = (1, y) with x taken out: the determinant x y vanishes with y."""
    ring = Ring(("x", "y"))
    x, y = ring.gens
    points = {"A": (ring.zero, ring.zero), "B": (x, ring.zero), "C": (ring.one, y + 2)}
    space = ConfigurationSpace(ring, (), exclusions=((x,),), points=points)
    factor = Factor(3 * y + 6, name=PointNames(Certifier(space)).recognise(3 * y + 6))
    assert factor.text() == "det[S_A S_B S_C] = 1/3*x*(3*y + 6)"
    check(factor, [0.3, -1.7], bare(space))


def test_roots_are_written_as_what_they_are() -> None:
    """1 + sqrt(5) in a product keeps its parentheses, sqrt(3) needs none; gx is another name than g."""
    roots = (
        AlgebraicConstant("g", (-4, -2, 1), Fraction(3), Fraction(4), text="1 + sqrt(5)"),
        AlgebraicConstant("sqrt3", (-3, 0, 1), Fraction(1), Fraction(2), text="sqrt(3)"),
    )
    x, gx, g, root = Ring(("x", "gx", "g", "sqrt3"), constants=roots).gens
    assert Factor(x * g + gx * root).text() == "x*(1 + sqrt(5)) + gx*sqrt(3)"
