"""Arms from URDF files, with exact rational dimensions near the floats that such files hold.

Source: the URDF specification (https://wiki.ros.org/urdf/XML), read by yourdfpy.
"""

from __future__ import annotations

import io
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from typing import Any

import sympy

from singsym.mechanism.arcs import decimal_arc
from singsym.mechanism.checks import check
from singsym.mechanism.expressions import RESERVED, expression
from singsym.mechanism.model import (
    Joint,
    JointKind,
    Limit,
    Link,
    Mechanism,
    Output,
    PointVelocity,
    Space,
    Twist,
    Vector,
)
from singsym.mechanism.outputs import TWISTS
from singsym.mechanism.problems import MechanismError, Problem

TOLERANCE = 1e-4
"""Rotations this near (in every matrix entry) to quarter turns are quarter turns: 1.5708 means pi/2."""

_KINDS = {"revolute": JointKind.R, "continuous": JointKind.R, "prismatic": JointKind.P}


@dataclass
class _Body:
    """Rigidly joined URDF links: one link of the mechanism, being filled."""

    name: str
    points: dict[str, Vector] = field(default_factory=dict)
    axes: dict[str, Vector] = field(default_factory=dict)


def from_urdf(path: str | Path, tip: str | None = None, components: Sequence[str] | None = None) -> Mechanism:
    """The serial arm from a URDF file's root to its link `tip` (by default the only last link).

    components: of the output twist of `tip`; by default all for six joints, the velocity for three.
    Lengths are in the file's metres and are the rationals that its decimals spell; rotations are quarter
    turns within `TOLERANCE`, else rational rotations within 1e-5, and `description` says so.
    Raises `ImportError` without yourdfpy, `MechanismError` for what the file lacks.
    """
    file = str(path)
    robot = _robot(Path(path), file)
    chain, notes = _chain(robot, tip, file)
    mechanism = _Arm(file, notes).build(robot.name, chain, components)
    if problems := check(mechanism):
        raise MechanismError(problems)
    return mechanism


def _robot(path: Path, file: str) -> Any:
    """The links' names and the joints of a file; visuals, meshes and masses are not looked at."""
    try:
        import yourdfpy
        from lxml import etree
    except ImportError:
        raise ImportError("URDF files are read by yourdfpy: pip install 'singsym[urdf]'") from None
    if not path.is_file():
        raise FileNotFoundError(f"no file is called {file}")
    expected = "URDF: <robot> with links and joints"
    # Prefixes of names that are not declared are usual in such files; other faults of the XML are not.
    parser = etree.XMLParser(recover=True, resolve_entities=False, no_network=True)
    content = path.read_bytes()
    root = etree.fromstring(content, parser) if content.strip() else None
    faults = [f"line {e.line}: {e.message}" for e in parser.error_log if e.domain_name != "NAMESPACE"]
    if faults or root is None or root.tag != "robot":
        found = faults[0] if faults else "no XML" if root is None else f"<{root.tag}>"
        raise MechanismError([Problem("file", found, expected, file=file)])
    bare = etree.Element("robot", name=root.get("name") or path.stem)
    for link in root.findall("link"):
        etree.SubElement(bare, "link", {key: link.get(key) for key in ("name",) if key in link.attrib})
    bare.extend(root.findall("joint"))
    try:
        return yourdfpy.URDF.load(io.BytesIO(etree.tostring(bare)), build_scene_graph=False).robot
    except (ValueError, TypeError, AttributeError, LookupError) as error:
        found = f"{type(error).__name__}: {error}"
        raise MechanismError([Problem("file", found, expected, file=file)]) from None


def _chain(robot: Any, tip: str | None, file: str) -> tuple[list[Any], list[str]]:
    """The joints from the root to the tip, and what was left aside."""
    above = {joint.child: joint for joint in robot.joints}
    parents = {joint.parent for joint in robot.joints}
    ends = [link.name for link in robot.links if link.name not in parents and link.name in above]
    if tip is None and len(ends) != 1:
        found = f"{len(ends)} last links: {', '.join(ends)}"
        raise MechanismError([Problem("robot", found, "one, or the name of a link", "pass tip=NAME", file)])
    end = ends[0] if tip is None else tip
    if end not in above:
        expected = f"a link that a joint moves: {', '.join(above)}"
        raise MechanismError([Problem("tip", repr(end), expected, file=file)])
    chain: list[Any] = []
    name = end
    while name in above and len(chain) <= len(robot.joints):
        chain.insert(0, above[name])
        name = above[name].parent
    aside = [joint.name for joint in robot.joints if joint not in chain]
    notes = [f"Chain from {name} to {end}."]
    if aside:
        notes.append(f"Left aside: the joints {', '.join(aside)}.")
    return chain, notes


class _Arm:
    """Builds links and joints along a chain; `turn`, `shift`: pose of the URDF link in its body's frame."""

    def __init__(self, file: str, notes: list[str]) -> None:
        self.file, self.notes = file, notes
        self.bodies: list[_Body] = []
        self.joints: list[Joint] = []
        self.limits: list[Limit] = []
        self.turn, self.shift = sympy.eye(3), sympy.zeros(3, 1)
        self.taken: set[str] = set()

    def name(self, text: str) -> str:
        """A name in the file format's alphabet, not yet taken."""
        clean = re.sub(r"[^A-Za-z0-9_]", "_", text) or "_"
        clean = f"_{clean}" if not (clean[0].isalpha() or clean[0] == "_") or clean in RESERVED else clean
        while clean in self.taken:
            clean += "_"
        self.taken.add(clean)
        return clean

    def build(self, name: str, chain: list[Any], components: Sequence[str] | None) -> Mechanism:
        self.bodies.append(_Body(self.name(chain[0].parent)))
        for joint in chain:
            self.add(joint)
        last = self.bodies[-1]
        last.points["tool"] = _tuple(self.shift)
        moves = len(self.joints)
        chosen: dict[int, tuple[str, ...]] = {6: TWISTS[Space.SPATIAL]}
        output: Output
        if components is None and moves == 3:
            output = PointVelocity(last.name, "tool", ("x", "y", "z"))
        elif components is None and moves not in chosen:
            expected = f"{moves} names among {', '.join(TWISTS[Space.SPATIAL])}"
            found = f"{moves} moving joints and no output components"
            raise MechanismError([Problem("components", found, expected, "pass components=[...]", self.file)])
        else:
            output = Twist(last.name, "tool", tuple(components or chosen[moves]))
        return Mechanism(
            name=name,
            space=Space.SPATIAL,
            ground=self.bodies[0].name,
            links=tuple(Link(b.name, b.points, b.axes) for b in self.bodies),
            joints=tuple(self.joints),
            inputs=tuple(joint.name for joint in self.joints),
            outputs=(output,),
            limits=tuple(self.limits),
            description=" ".join(self.notes),
            source=f"URDF file {Path(self.file).name}",
            origin=self.file,
        )

    def add(self, joint: Any) -> None:
        """Append one URDF joint: a fixed one moves the pose on, another starts a new body."""
        shift, turn = self.pose(joint)
        self.shift = self.shift + self.turn * shift
        self.turn = self.turn * turn
        if joint.type == "fixed":
            return
        if joint.type not in _KINDS or joint.mimic is not None:
            found = f"a mimic joint {joint.name!r}" if joint.type in _KINDS else f"a joint {joint.type!r}"
            expected = "revolute, continuous, prismatic or fixed joints, each on its own"
            raise MechanismError([Problem(f"joint {joint.name}", found, expected, file=self.file)])
        kind, name, old = _KINDS[joint.type], self.name(joint.name), self.bodies[-1]
        axis = self.axis(joint)
        new = _Body(self.name(joint.child))
        turning = kind is JointKind.R
        # The model keeps a slide's two frames parallel; a turning body gets the URDF frame of its child.
        frame = sympy.eye(3) if turning else self.turn
        at = (f"o_{name}", f"o_{name}" if turning else f"s_{name}")
        old.points[at[0]], new.points[at[1]] = _tuple(self.shift), _tuple(sympy.zeros(3, 1))
        old.axes[f"z_{name}"], new.axes[f"z_{name}"] = _tuple(self.turn * axis), _tuple(frame * axis)
        reference = None
        if turning and self.turn != sympy.eye(3):
            across = _across(axis)
            old.axes[f"x_{name}"], new.axes[f"x_{name}"] = _tuple(self.turn * across), _tuple(across)
            reference = (f"x_{name}", f"x_{name}")
        pair = (f"z_{name}", f"z_{name}")
        self.joints.append(Joint(name, kind, old.name, new.name, at, pair, reference=reference))
        self.bodies.append(new)
        self.turn, self.shift = frame, sympy.zeros(3, 1)
        if joint.type != "continuous" and joint.limit is not None:
            self.limit(name, turning, joint.limit)

    def pose(self, joint: Any) -> tuple[sympy.Matrix, sympy.Matrix]:
        """The exact translation and rotation for a joint's origin."""
        if joint.origin is None:
            return sympy.zeros(3, 1), sympy.eye(3)
        origin = [[float(x) for x in row] for row in joint.origin]
        if not all(math.isfinite(x) for row in origin for x in row):
            found, expected = "numbers that are not finite", "finite xyz and rpy"
            raise MechanismError([Problem(f"joint {joint.name}", found, expected, file=self.file)])
        shift = sympy.Matrix([expression(row[3]) for row in origin[:3]])
        entries = [row[:3] for row in origin[:3]]
        rounded = [[round(x) for x in row] for row in entries]
        error = max(
            abs(x - r)
            for row, near in zip(entries, rounded, strict=True)
            for x, r in zip(row, near, strict=True)
        )
        if error <= TOLERANCE:
            if error > 1e-12:
                self.notes.append(f"Rotation of {joint.name}: quarter turns, {error:.1g} off the file.")
            return shift, sympy.Matrix(rounded)
        turn = rational_rotation(entries)
        off = max(abs(float(turn[i, j]) - entries[i][j]) for i in range(3) for j in range(3))
        self.notes.append(f"Rotation of {joint.name}: a rational rotation, {off:.1g} off the file.")
        return shift, turn

    def axis(self, joint: Any) -> sympy.Matrix:
        """The exact unit vector of a joint's axis: a coordinate axis within `TOLERANCE`, else as spelled."""
        given = [1.0, 0.0, 0.0] if joint.axis is None else [float(x) for x in joint.axis]
        norm = math.hypot(*given)
        if not math.isfinite(norm) or norm == 0:
            found = f"the axis {given}"
            raise MechanismError([Problem(f"joint {joint.name}", found, "a direction", file=self.file)])
        near = [round(x / norm) for x in given]
        if max(abs(x / norm - r) for x, r in zip(given, near, strict=True)) <= TOLERANCE:
            return sympy.Matrix(near)
        exact = sympy.Matrix([expression(x) for x in given])
        return exact / sympy.sqrt(exact.dot(exact))

    def limit(self, name: str, turning: bool, limit: Any) -> None:
        """A length's range as spelled; an angle's in cosine and sine, with ends rounded outwards."""
        # What is not given is zero, says the specification.
        low, high = float(limit.lower or 0), float(limit.upper or 0)
        if low == high:
            self.notes.append(f"Limits of {name}: left out, as both are {low:g}.")
            return
        if not low < high:
            found, expected = f"the limits {low} and {high}", "the lower limit first"
            raise MechanismError([Problem(f"joint {name}", found, expected, file=self.file)])
        if not turning:
            ends = (expression(end) if math.isfinite(end) else None for end in (low, high))
            bounds = Limit(sympy.Symbol(f"length({name})"), *ends)
            if bounds.low is not None or bounds.high is not None:
                self.limits.append(bounds)
        elif math.isfinite(low) and math.isfinite(high):
            arc, words = decimal_arc(name, low, high)
            if arc is not None:
                self.limits.append(arc)
            if words:
                self.notes.append(f"Limits of {name}: {words}.")


def rational_rotation(matrix: Sequence[Sequence[float]]) -> sympy.Matrix:
    """An exact rotation with rational entries near a rotation matrix, by a rational quaternion.

    >>> rational_rotation([[0.8, -0.6, 0], [0.6, 0.8, 0], [0, 0, 1]])
    Matrix([
    [4/5, -3/5, 0],
    [3/5,  4/5, 0],
    [  0,    0, 1]])
    """
    a, b, c = matrix
    # Shepperd: four columns proportional to the quaternion; the longest is the most accurate.
    columns = [
        [1 + a[0] + b[1] + c[2], c[1] - b[2], a[2] - c[0], b[0] - a[1]],
        [c[1] - b[2], 1 + a[0] - b[1] - c[2], a[1] + b[0], a[2] + c[0]],
        [a[2] - c[0], a[1] + b[0], 1 - a[0] + b[1] - c[2], b[2] + c[1]],
        [b[0] - a[1], a[2] + c[0], b[2] + c[1], 1 - a[0] - b[1] + c[2]],
    ]
    index = max(range(4), key=lambda i: columns[i][i])
    ratios = [Fraction(x / columns[index][index]).limit_denominator(1000) for x in columns[index]]
    w, x, y, z = (sympy.Rational(r.numerator, r.denominator) for r in ratios)
    turn = sympy.Matrix(
        [
            [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
        ]
    )
    return turn / (w * w + x * x + y * y + z * z)


def _across(axis: sympy.Matrix) -> sympy.Matrix:
    """A unit vector at right angles to an axis: a coordinate axis where one is."""
    zero = next((i for i in range(3) if axis[i] == 0), None)
    if zero is not None:
        return sympy.Matrix([int(i == zero) for i in range(3)])
    across = sympy.Matrix([axis[1], -axis[0], 0])
    return across / sympy.sqrt(across.dot(across))


def _tuple(vector: Any) -> Vector:
    return tuple(sympy.expand(v) for v in vector)
