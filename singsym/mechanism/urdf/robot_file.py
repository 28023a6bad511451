"""What a URDF file says of links and joints, as it is spelled; visuals, meshes and masses are not looked at.

Source: the URDF specification (https://wiki.ros.org/urdf/XML); XML is read by Python's expat.
"""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path
from xml.etree.ElementTree import Element, TreeBuilder
from xml.parsers import expat

from singsym.mechanism.problems import MechanismError, Problem, shorten

LARGEST = 50_000_000
"""Bytes of a file that is read."""
MOVING = ("revolute", "continuous", "prismatic")
KINDS = (*MOVING, "fixed", "floating", "planar")

_START = "`singsym new NAME` writes a TOML file to start from"
_OTHERS = {
    "sdf": (
        "SDF, the format of Gazebo",
        f"for a serial arm run rod, a Python package: rod --file {{name}} -o robot.urdf; for loops {_START}",
    ),
    "mujoco": ("MJCF, the format of MuJoCo", "singsym.mechanism.load('{name}') reads it"),
    "world": ("a world of several models", "give the URDF file of one robot"),
    "COLLADA": ("a COLLADA scene", "give the URDF file that names it"),
}
"""By the root element what a file is, and what to do with it."""
_LATE_DECLARATION = re.compile(rb"(?<=[\s>])<\?xml[^>]*\?>")
_MACROS = {"include", "macro", "if", "unless", "arg"}


@dataclass(frozen=True)
class Mimic:
    """A joint's value as `multiplier` times that of another joint plus `offset`, in radians or metres."""

    joint: str
    multiplier: float
    offset: float


@dataclass(frozen=True)
class RobotJoint:
    """A <joint>: numbers as floats, whose shortest spelling is the decimal that the file meant.

    kind: one of `KINDS`; xyz in metres, rpy in radians, axis as given (not of unit length).
    lower, upper: None where there is no <limit>; what a <limit> leaves out is zero.
    """

    name: str
    kind: str
    parent: str
    child: str
    xyz: tuple[float, ...] = (0.0, 0.0, 0.0)
    rpy: tuple[float, ...] = (0.0, 0.0, 0.0)
    axis: tuple[float, ...] = (1.0, 0.0, 0.0)
    lower: float | None = None
    upper: float | None = None
    mimic: Mimic | None = None

    @property
    def moves(self) -> bool:
        """Whether it has one freedom."""
        return self.kind in MOVING

    @property
    def resting(self) -> str:
        """A value at which it may be held: zero, or a short number within limits that leave zero out.

        >>> RobotJoint("j", "revolute", "a", "b", lower=-3.05, upper=-0.07).resting
        '-2'
        """
        low, high = self.lower, self.upper
        if low is None or high is None or low <= 0 <= high or not math.isfinite(low + high):
            return "0"
        middle = (low + high) / 2
        return next(text for d in range(1, 18) if low <= float(text := f"{middle:.{d}g}") <= high or d == 17)


@dataclass(frozen=True)
class Robot:
    """A <robot>: a forest of links, each the child of at most one joint."""

    name: str
    links: tuple[str, ...]
    joints: tuple[RobotJoint, ...]
    file: str

    def fault(self, place: str, found: str, expected: str, advice: str = "") -> MechanismError:
        """An error about this file, to be raised."""
        return MechanismError([Problem(place, found, expected, advice, self.file)])

    def above(self, link: str) -> RobotJoint | None:
        """The joint of which a link is the child; None at a root."""
        return next((joint for joint in self.joints if joint.child == link), None)


def read_robot(path: str | Path) -> Robot:
    """The robot of a URDF file.

    Raises `MechanismError` for what is no URDF (naming what it is, and what to do) and for what is wrong
    with it, `OSError` where it cannot be read.
    """
    file = str(path)
    root = _xml(Path(path), file)
    joints: list[RobotJoint] = []
    problems: list[Problem] = []
    for number, entry in enumerate(root.findall("joint"), 1):
        try:
            joints.append(_joint(entry, entry.get("name") or f"number {number}", file))
        except MechanismError as error:
            problems += error.problems
    links = tuple(link.get("name") or "" for link in root.findall("link"))
    robot = Robot(root.get("name") or Path(path).stem, links, tuple(joints), file)
    problems += [] if problems else list(_faults(robot))
    if problems:
        raise MechanismError(problems)
    return robot


# -- what the file is -----------------------------------------------------------------------------------


def _xml(path: Path, file: str) -> Element:
    """The root element <robot>; prefixes of names need not be declared, as is usual in such files."""
    with path.open("rb") as stream:
        content = stream.read(LARGEST + 1)
    expected = "URDF: <robot> with links and joints"
    if len(content) > LARGEST:
        raise MechanismError([Problem("file", f"more than {LARGEST} bytes", expected, file=file)])
    if not content.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"<"):
        world = path.suffix.lower() == ".world"
        found = "a world of CUIK, or other text that is no XML" if world else "text that is no XML"
        found = found if content.strip() else "an empty file"
        raise MechanismError([Problem("file", found, expected, _START, file)])
    builder = TreeBuilder()
    parser = expat.ParserCreate()
    parser.StartElementHandler = builder.start
    parser.EndElementHandler = builder.end
    parser.EntityDeclHandler = _refuse_entities
    try:
        parser.Parse(_LATE_DECLARATION.sub(b"", content, count=1), True)
        root = builder.close()
    except (expat.ExpatError, ValueError, LookupError) as error:
        found = f"no XML: {error}"
        raise MechanismError([Problem("file", found, expected, file=file)]) from None
    if root.tag == "robot":
        if path.suffix.lower() == ".xacro" or _has_macros(root):
            advice = f"run xacro first, which is part of ROS: xacro {shorten(path.name)} > robot.urdf"
            raise MechanismError([Problem("file", "xacro, macros that write URDF", expected, advice, file)])
        return root
    what, advice = _OTHERS.get(root.tag, (f"XML that starts with <{shorten(root.tag)}>", ""))
    if root.tag == "sdf" and root.find("world") is not None:
        what = "a world in SDF, the format of Gazebo"
    advice = advice.format(name=shorten(path.name))
    raise MechanismError([Problem("file", what, expected, advice, file)])


def _has_macros(root: Element) -> bool:
    """Whether macros are still to be run; what is left of them inside other elements does not matter."""
    calls = {child.tag.removeprefix("xacro:") for child in root if child.tag.startswith("xacro:")}
    texts = (text for joint in root.iter("joint") for part in joint.iter() for text in part.attrib.values())
    written = root.find("joint") is not None
    return (
        bool(calls & _MACROS)
        or (bool(calls) and not written)
        or any("${" in text or "$(" in text for text in texts)
    )


def _refuse_entities(*declared: object) -> None:
    raise ValueError(f"the entity {declared[0]!r}, as no robot needs")


# -- what it says ---------------------------------------------------------------------------------------


def _joint(entry: Element, name: str, file: str) -> RobotJoint:
    place = f"joint {name}"

    def fault(found: str, expected: str, advice: str = "") -> MechanismError:
        return MechanismError([Problem(place, found, expected, advice, file)])

    if not entry.get("name"):
        raise fault("no name", 'name="..."')
    kind = entry.get("type") or ""
    if kind not in KINDS:
        raise fault(f"the type {shorten(kind)!r}" if kind else "no type", f"one of {', '.join(KINDS)}")
    ends = []
    for end in ("parent", "child"):
        found = entry.find(end)
        if found is None or not found.get("link"):
            raise fault(f"no <{end}>", f'<{end} link="..."/>')
        ends.append(found.get("link") or "")

    def numbers(tag: str, key: str, usual: tuple[float, ...]) -> tuple[float, ...]:
        part = entry.find(tag)
        text = None if part is None else part.get(key)
        if text is None:
            return usual
        read = [_number(word) for word in text.replace(",", " ").split()]
        if len(read) != 3 or any(x is None or abs(x) > 1e6 for x in read):
            raise fault(f'<{tag} {key}="{shorten(text)}">', "three numbers")
        return tuple(x for x in read if x is not None)

    def number(part: Element, key: str, usual: float) -> float:
        text = part.get(key)
        read = usual if text is None else _number(text, infinite=True)
        if read is None:
            raise fault(f'<{part.tag} {key}="{shorten(text)}">', "a number")
        return read

    axis = numbers("axis", "xyz", (1.0, 0.0, 0.0))
    if kind in MOVING and not any(axis):
        raise fault("the axis 0 0 0", "a direction")
    bounds, mimic = entry.find("limit"), entry.find("mimic")
    limited = kind in ("revolute", "prismatic") and bounds is not None
    followed = None
    if mimic is not None:
        leader = mimic.get("joint")
        if not leader:
            raise fault("<mimic> without a joint", '<mimic joint="..."/>')
        followed = Mimic(leader, number(mimic, "multiplier", 1.0), number(mimic, "offset", 0.0))
    return RobotJoint(
        name,
        kind,
        ends[0],
        ends[1],
        numbers("origin", "xyz", (0.0, 0.0, 0.0)),
        numbers("origin", "rpy", (0.0, 0.0, 0.0)),
        axis,
        number(bounds, "lower", 0.0) if limited and bounds is not None else None,
        number(bounds, "upper", 0.0) if limited and bounds is not None else None,
        followed,
    )


def _number(text: str, infinite: bool = False) -> float | None:
    """The number that a word spells; None where it is none, or not finite and not `infinite`."""
    try:
        value = float(text)
    except ValueError:
        return None
    if value != value or (not infinite and value - value != 0):
        return None
    return value


def _faults(robot: Robot) -> Iterator[Problem]:
    """What keeps links and joints from being a forest."""
    expected = "URDF: each link the child of at most one joint"
    for what, names in (("link", robot.links), ("joint", [j.name for j in robot.joints])):
        for name, count in Counter(names).items():
            if not name or count > 1:
                found = f"{count} {what}s of this name" if name else f"a {what} without a name"
                yield Problem(f"{what} {name}".strip(), found, "each name once", file=robot.file)
    for joint in robot.joints:
        for end, link in (("parent", joint.parent), ("child", joint.child)):
            if link not in robot.links:
                close = get_close_matches(link, robot.links, 1)
                advice = f"did you mean {close[0]!r}?" if close else f'add <link name="{shorten(link)}"/>'
                found = f"the {end} {shorten(link)!r}, which is no link"
                yield Problem(f"joint {joint.name}", found, "a link of the file", advice, robot.file)
    parents = {joint.child: joint.parent for joint in robot.joints}
    for link, count in Counter(joint.child for joint in robot.joints).items():
        if count > 1:
            advice = f"for a closed loop {_START}"
            yield Problem(f"link {link}", f"the child of {count} joints", expected, advice, robot.file)
    for link in parents:
        seen = [link]
        while seen[-1] in parents and parents[seen[-1]] not in seen:
            seen.append(parents[seen[-1]])
        if parents.get(seen[-1]) == link:
            found = f"a circle of parents: {', '.join(seen[:8])}"
            yield Problem(f"link {link}", found, expected, file=robot.file)
            return
