"""Mechanism files: TOML to `Mechanism` and back, and the same keys as Python arguments.

Source: singsym's own format, in TOML (https://toml.io); the starter file explains it.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from difflib import get_close_matches
from pathlib import Path
from typing import Any

from singsym.mechanism.checks import MAX_JOINTS, check
from singsym.mechanism.choices import Choice
from singsym.mechanism.couplings import read_couplings
from singsym.mechanism.expressions import LONG_NUMBER, DecimalText, Quantities
from singsym.mechanism.joints import read_inputs, read_joints
from singsym.mechanism.library import names as library_names
from singsym.mechanism.library import text as library_text
from singsym.mechanism.links import read_links
from singsym.mechanism.model import Mechanism, Output, Parameter, Space, Twist
from singsym.mechanism.outputs import TWISTS, quantities, read_exclusions, read_limits, read_outputs
from singsym.mechanism.problems import MechanismError, Problem, shorten
from singsym.mechanism.reader import Reader, kind_of
from singsym.mechanism.serial import read_dh

MAX_SIZE = 1_000_000
KEYS = (
    "name", "title", "source", "description", "space", "ground", "formulation", "mobility",
    "inputs", "output", "parameters", "links", "joints", "dh", "limits", "exclusions",
    "couplings", "translating",
)  # fmt: skip
FORMULATIONS = ("auto", "planar", "spherical", "joint", "natural", "quaternion")
# Without backtracking, and from the beginnings of words alone, so that long names take no time.
_PART = r"""(?:[\w-]++|"[^"\n]*+"|'[^'\n]*+')[ \t]*+\.[ \t]*+"""
_DEEP_KEY = re.compile(rf"(?<![\w-])(?:{_PART}){{50}}")
_LINE = re.compile(r"at line (\d+)")
_BARE = re.compile(r"[=\[,]\s*((?:[\d.]+\s*[-+*/^]|sqrt\s*\(|sin\s*\(|cos\s*\(|pi\b)[^\"'#,}\]\n]*)")
"""What starts as an expression does after an equals sign, a bracket or a comma."""


def load(name: str | Path, choice: Choice | None = None) -> Mechanism:
    """The checked mechanism of a file, TOML, URDF or MJCF, or of a name in the library.

    choice: the chain of a URDF file, the tip of an MJCF file; joints that are held, components of the output.
    Raises `MechanismError` with every problem, `FileNotFoundError` where there is no such file or name.

    >>> hybrid = load("zlatanov-hybrid").with_parameters(a="3/2")
    >>> hybrid.resolved.link("ground").points["B0"]
    (3/2, 0, 0)
    """
    if str(name) in library_names():
        return _chosen(library_text(str(name)), f"{name}.toml", choice)
    path = Path(name)
    if not path.is_file():
        close = get_close_matches(str(name), library_names(), 3)
        advice = f"did you mean {' or '.join(close)}?" if close else "singsym list shows the library"
        raise FileNotFoundError(f"no file and no mechanism of the library is called {name}; {advice}")
    if is_robot_file(path):
        from singsym.mechanism.mjcf import from_mjcf, is_mjcf
        from singsym.mechanism.urdf import from_urdf

        if is_mjcf(path):
            return from_mjcf(path, choice)
        return from_urdf(path, choice)
    return _chosen(read_text(path), str(name), choice)


def is_robot_file(path: str | Path) -> bool:
    """Whether a file is XML, or named as files of robots are, and not a mechanism file in TOML."""
    if Path(path).suffix.lower() in (".urdf", ".xacro", ".sdf", ".world", ".mjcf", ".xml"):
        return True
    with Path(path).open("rb") as stream:
        return stream.read(100).lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"<")


def _chosen(text: str, origin: str, choice: Choice | None) -> Mechanism:
    """The mechanism of a file with what is chosen of it; before that its output need not fit its inputs."""
    if choice is None or choice == Choice():
        return loads(text, origin)
    mechanism, problems = read(tables(text, origin), origin)
    problems = problems or tuple(p for p in check(mechanism) if p.place != "output")
    if problems:
        raise MechanismError(problems)
    mechanism = choice.applied(mechanism)
    if problems := check(mechanism, choice.redundant):
        raise MechanismError(problems)
    return mechanism


def read_text(path: str | Path) -> str:
    """The text of a file in UTF-8; raises `MechanismError` where it is none, or longer than `MAX_SIZE` bytes.

    No more than that is read, so that a device without an end is refused at once.
    """
    with Path(path).open("rb") as stream:
        data = stream.read(MAX_SIZE + 1)
    if len(data) > MAX_SIZE:
        found, expected = f"more than {MAX_SIZE} bytes", f"a file of at most {MAX_SIZE}"
        raise MechanismError([Problem("file", found, expected, file=str(path))])
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        found = f"byte {error.object[error.start]:#x} at position {error.start}"
        raise MechanismError([Problem("file", found, "text in UTF-8", file=str(path))]) from None


def loads(text: str, origin: str = "") -> Mechanism:
    """The checked mechanism that TOML text describes; `origin` names the file in messages.

    >>> loads('''
    ... inputs = ["A"]
    ... output = { rate = "D" }
    ... [links]
    ... ground = { points = { A = [0, 0], D = [4, 0] } }
    ... AB = 1
    ... BC = "7/2"
    ... CD = 3
    ... [joints]
    ... A = "R"
    ... B = "R"
    ... C = "R"
    ... D = "R"
    ... ''', origin="fourbar.toml")
    Mechanism('fourbar', 4 links, 4 joints)
    """
    return _checked(tables(text, origin), origin)


def tables(text: str, origin: str = "") -> dict[str, Any]:
    """The tables of TOML text, numbers with a point as `DecimalText`; raises `MechanismError`."""
    if len(text) > MAX_SIZE:
        found, expected = f"{len(text)} characters", f"a file of at most {MAX_SIZE}"
        raise MechanismError([Problem("file", found, expected, file=origin)])
    if deep := _DEEP_KEY.search(text):
        # the time that the TOML reader takes grows with the square of a key's parts
        found, line = f"the key {shorten(deep[0])!r}", text.count("\n", 0, deep.start()) + 1
        raise MechanismError([Problem(f"line {line}", found, "keys of fewer than 50 parts", file=origin)])
    try:
        return tomllib.loads(text, parse_float=DecimalText)
    except tomllib.TOMLDecodeError as error:
        twice = "Cannot overwrite a value" in str(error) or "Cannot declare" in str(error)
        found = f"a name for the second time: {error}" if twice else f"no TOML: {error}"
        expected = "each name once in a table" if twice else "TOML"
        advice = "see `singsym new` for an example"
        if text.lstrip().startswith("{"):
            found, advice = (
                "JSON",
                "`singsym new NAME` writes a file to put its points, links and joints into",
            )
        if bare := _bare_expression(text, str(error)):
            advice = f"put expressions in quotes, as {bare}"
        raise MechanismError([Problem("file", found, expected, advice, origin)]) from None
    except (RecursionError, ValueError) as error:
        # int() refuses more than 4300 digits, and the parser recurses on nested lists.
        nested = isinstance(error, RecursionError)
        found, expected = ("lists nested too deep", "TOML") if nested else LONG_NUMBER
        raise MechanismError([Problem("file", found, expected, file=origin)]) from None


def _bare_expression(text: str, error: str) -> str:
    """An expression without quotes in the line of a TOML error, with quotes; empty where there is none."""
    lines, place = text.split("\n"), _LINE.search(error)
    line = lines[int(place[1]) - 1] if place is not None else lines[-1]
    found = _BARE.search(line)
    return "" if found is None else f'"{shorten(found[1].strip())}"'


def define(**keys: Any) -> Mechanism:
    """The checked mechanism given by the keys of a file as arguments: numbers, Fractions, text, SymPy.

    >>> define(name="arm", inputs=["A", "B"], output={"velocity": "C"},
    ...        links={"ground": {"points": {"A": [0, 0]}}, "AB": 1, "BC": "1/2"}, joints={"A": "R", "B": "R"})
    Mechanism('arm', 3 links, 2 joints)
    """
    return _checked(keys, "")


def _checked(data: Mapping[str, Any], origin: str) -> Mechanism:
    mechanism, problems = read(data, origin)
    if not problems:
        problems = check(mechanism)
    if problems:
        raise MechanismError(problems)
    return mechanism


def read(data: Mapping[str, Any], origin: str = "") -> tuple[Mechanism, tuple[Problem, ...]]:
    """A mechanism from a file's tables, with the problems met in reading; see `check` for the others."""
    reader = Reader(origin)
    top = reader.table(data, "", KEYS)
    words = {key: reader.text(top.get(key, ""), key) for key in ("name", "title", "source", "description")}
    usual = "spatial" if "dh" in top else "planar"
    reader.space = _choice(top, "space", [s.value for s in Space], usual, reader, Space)
    formulation = _choice(top, "formulation", FORMULATIONS, "auto", reader, str)
    parameters = _read_parameters(top.get("parameters", {}), reader)
    if "dh" in top:
        clash = [key for key in ("links", "joints") if key in top]
        if clash or reader.space is not Space.SPATIAL:
            found = f"dh with {' and '.join(clash)}" if clash else f"dh in a {reader.space} mechanism"
            reader.report("dh", found, 'dh alone, with space = "spatial"')
            reader.space = Space.SPATIAL
        links, joints = read_dh(top["dh"], reader)
    else:
        links = read_links(top.get("links", {}), reader)
        joints = read_joints(top.get("joints", {}), links, reader)
    outputs: tuple[Output, ...] = ()
    if "output" in top:
        outputs = read_outputs(top["output"], links, reader)
    elif "dh" in top and links:
        outputs = (Twist(links[-1].name, "tool", TWISTS[reader.space]),)
    inputs = read_inputs(top.get("inputs", []), joints, reader)
    if "inputs" not in top and "dh" in top:
        inputs = tuple(column for joint in joints for column in joint.columns)
    mobility = top.get("mobility")
    if mobility is not None and (
        isinstance(mobility, bool) or not isinstance(mobility, int) or not 0 < mobility <= 3 * MAX_JOINTS
    ):
        reader.report("mobility", kind_of(mobility), f"a whole number from 1 to {3 * MAX_JOINTS}")
        mobility = None
    known: Quantities = quantities(reader.space, links, joints)
    mechanism = Mechanism(
        name=words["name"] or Path(origin).stem or "mechanism",
        space=reader.space,
        ground=reader.text(top.get("ground", "ground"), "ground"),
        links=links,
        joints=joints,
        inputs=inputs,
        outputs=outputs,
        parameters=parameters,
        limits=read_limits(top.get("limits", {}), known, reader),
        exclusions=read_exclusions(top.get("exclusions", {}), known, reader),
        couplings=read_couplings(top.get("couplings", {}), known, reader),
        mobility=mobility,
        translating=tuple(reader.names(top.get("translating", []), "translating")),
        formulation=formulation,
        title=words["title"],
        description=words["description"],
        source=words["source"],
        origin=origin,
    )
    return mechanism, tuple(reader.problems)


def _choice(top: dict[str, Any], key: str, allowed: Any, default: str, reader: Reader, kind: Any) -> Any:
    value = top.get(key, default)
    if value not in allowed:
        reader.report(key, kind_of(value), f"one of {', '.join(allowed)}")
        value = default
    return kind(value)


def _read_parameters(value: Any, reader: Reader) -> tuple[Parameter, ...]:
    """name = value, or { between = [low, high] } for a dimension that stays symbolic, or both."""
    table = reader.table(value, "parameters")
    reader.parameters = frozenset(reader.name(name, f"parameters.{name}") for name in table)
    parameters = []
    for name, entry in table.items():
        place = f"parameters.{name}"
        if not isinstance(entry, Mapping):
            parameters.append(Parameter(name, reader.expression(entry, place)))
            continue
        read = reader.table(entry, place, ("value", "between", "above", "below"))
        if not read or ("between" in read and ("above" in read or "below" in read)):
            expected = "value = ..., between = [low, high], above = low or below = high"
            reader.report(place, "no value and no range" if not read else shorten(entry), expected)
        low, high, end_place = read.get("above"), read.get("below"), place
        if "between" in read:
            end_place = f"{place}.between"
            ends = reader.items(read["between"], f"{place}.between")
            if len(ends) != 2:
                reader.report(f"{place}.between", kind_of(read["between"]), "[low, high]")
                ends = [None, None]
            low, high = ends
        bounds = [None if end is None else reader.expression(end, end_place) for end in (low, high)]
        number = reader.expression(read["value"], f"{place}.value") if "value" in read else None
        parameters.append(Parameter(name, number, *bounds))
    reader.ranges = tuple(parameters)
    return reader.ranges
