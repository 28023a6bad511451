"""What an MJCF file says of bodies, joints and loops, as the package mujoco reads it: numbers in floats.

Source: the MJCF reference (https://mujoco.readthedocs.io); nothing is simulated.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from singsym.mechanism.problems import MechanismError, Problem

FORMAT = "MJCF, the format of MuJoCo"
_KINDS = {1: "ball", 2: "slide", 3: "hinge"}
_HELD_BY_JOINT = (0, 1)
"""Transmissions of actuators that drive a joint."""

Numbers = tuple[float, ...]


@dataclass(frozen=True)
class BodyJoint:
    """A joint of a body to the one before: hinge, slide or ball, its point and axis in the body's frame.

    limits: in radians or lengths, from where the joint is at the start; None for a joint without.
    """

    name: str
    kind: str
    point: Numbers
    axis: Numbers
    limits: tuple[float, float] | None


@dataclass(frozen=True)
class Body:
    """A body: its parent by number, its pose there at the start (quaternion w, x, y, z), its joints."""

    name: str
    parent: int
    position: Numbers
    quaternion: Numbers
    joints: tuple[BodyJoint, ...]


@dataclass(frozen=True)
class Connection:
    """A point of a body and one of another are held together; None: the one that meets it at the start."""

    name: str
    bodies: tuple[int, int]
    points: tuple[Numbers, Numbers | None]


@dataclass(frozen=True)
class Following:
    """A joint is at `offset` + `multiplier` times where the leader is, both from the start."""

    name: str
    leader: str
    multiplier: float
    offset: float


@dataclass(frozen=True)
class Scene:
    """All of a file; body 0 is the world.

    inputs: joints with an actuator; sites: body and point; aside: constraints that are not active, and
    actuators of something else, by name.
    """

    name: str
    bodies: tuple[Body, ...]
    connections: tuple[Connection, ...]
    followings: tuple[Following, ...]
    inputs: tuple[str, ...]
    sites: dict[str, tuple[int, Numbers]]
    aside: tuple[str, ...]
    file: str

    def fault(self, place: str, found: str, expected: str, advice: str = "") -> MechanismError:
        """An error about this file, to be raised."""
        return MechanismError([Problem(place, found, expected, advice, self.file)])


def read_scene(path: str | Path) -> Scene:
    """The bodies and loops of an MJCF file.

    Raises `MechanismError` where the package mujoco is not there or refuses the file, and for floating
    bodies, welds and tendons between bodies, and joints that follow others by curves.
    """
    file = str(path)
    try:
        import mujoco
    except ImportError:
        advice = "pip install 'singsym[mjcf]', or write a TOML file, as `singsym new NAME` does"
        expected = "the Python package mujoco, which reads it"
        raise MechanismError([Problem("file", FORMAT, expected, advice, file)]) from None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of masses
            spec = mujoco.MjSpec.from_file(file)
            # shapes and masses do not matter, and need files and weights that may not be there
            for part in (*spec.geoms, *spec.meshes):
                spec.delete(part)
            spec.compiler.boundmass = spec.compiler.boundinertia = 1
            model = spec.compile()
    except (ValueError, RuntimeError) as error:
        found = f"{FORMAT}, which mujoco refuses: {' '.join(str(error).split())}"
        raise MechanismError([Problem("file", found, "a file that it compiles", file=file)]) from None
    return _Reader(model, mujoco, Path(path)).scene()


class _Reader:
    """Takes what is needed out of a compiled model."""

    def __init__(self, model: Any, mujoco: Any, path: Path) -> None:
        self.model = model
        self.constants = mujoco
        self.path = path
        self.joints = [model.joint(j).name or f"joint{j}" for j in range(model.njnt)]
        self.bodies = [model.body(b).name or f"body{b}" for b in range(model.nbody)]

    def scene(self) -> Scene:
        model = self.model
        driven = [
            int(target)
            for kind, (target, _) in zip(model.actuator_trntype, model.actuator_trnid, strict=True)
            if int(kind) in _HELD_BY_JOINT
        ]
        return Scene(
            self.path.stem,
            tuple(map(self._body, range(model.nbody))),
            tuple(self._connections()),
            tuple(self._followings()),
            tuple(self.joints[j] for j in dict.fromkeys(driven)),
            {
                model.site(s).name or f"site{s}": (int(model.site_bodyid[s]), _numbers(model.site_pos[s]))
                for s in range(model.nsite)
            },
            tuple(self._aside()),
            str(self.path),
        )

    def _aside(self) -> Iterator[str]:
        for e in range(self.model.neq):
            if not self.model.eq_active0[e]:
                yield f"the inactive constraint {self.model.equality(e).name or e}"
        for a, kind in enumerate(self.model.actuator_trntype):
            if int(kind) not in _HELD_BY_JOINT:
                yield f"the actuator {self.model.actuator(a).name or a}, of no joint"
        for j, kind in enumerate(self.model.jnt_type):
            if self.model.jnt_limited[j] and _KINDS.get(int(kind)) == "ball":
                yield f"the limit of the ball joint {self.joints[j]}"

    def _fault(self, place: str, found: str, expected: str, advice: str = "") -> MechanismError:
        return MechanismError([Problem(place, found, expected, advice, str(self.path))])

    def _body(self, b: int) -> Body:
        first, count = int(self.model.body_jntadr[b]), int(self.model.body_jntnum[b])
        joints = tuple(map(self._joint, range(first, first + count)))
        position, quaternion = self.model.body_pos[b], self.model.body_quat[b]
        parent = int(self.model.body_parentid[b])
        return Body(self.bodies[b], parent, _numbers(position), _numbers(quaternion), joints)

    def _joint(self, j: int) -> BodyJoint:
        model, name = self.model, self.joints[j]
        kind = _KINDS.get(int(model.jnt_type[j]))
        if kind is None:
            expected = "bodies that joints hang on others, of types hinge, slide and ball"
            raise self._fault(f"joint {name}", "a floating body", expected, "take its free joint out")
        limits = None
        if model.jnt_limited[j] and kind != "ball":
            start = float(model.qpos0[model.jnt_qposadr[j]])
            limits = (float(model.jnt_range[j][0]) - start, float(model.jnt_range[j][1]) - start)
        return BodyJoint(name, kind, _numbers(model.jnt_pos[j]), _numbers(model.jnt_axis[j]), limits)

    def _active(self, kind: Any) -> Iterator[tuple[int, str]]:
        """The equality constraints of a kind, by number, with a name; raises for kinds that no joint is."""
        kinds = self.constants.mjtEq
        for e in range(self.model.neq):
            own, name = kinds(self.model.eq_type[e]), self.model.equality(e).name or f"connection{e}"
            if not self.model.eq_active0[e]:
                continue
            if own not in (kinds.mjEQ_CONNECT, kinds.mjEQ_JOINT):
                found, expected = f"a constraint of type {own.name[5:].lower()}", "connect or joint"
                advice = "write bodies that are welded as one"
                raise self._fault(f"equality {name}", found, expected, advice)
            if own == kind:
                yield e, name

    def _connections(self) -> Iterator[Connection]:
        model = self.model
        for e, name in self._active(self.constants.mjtEq.mjEQ_CONNECT):
            ends = int(model.eq_obj1id[e]), int(model.eq_obj2id[e])
            if int(model.eq_objtype[e]) == int(self.constants.mjtObj.mjOBJ_SITE):
                one, two = (_numbers(model.site_pos[s]) for s in ends)
                bodies = int(model.site_bodyid[ends[0]]), int(model.site_bodyid[ends[1]])
                yield Connection(name, bodies, (one, two))
            else:
                yield Connection(name, ends, (_numbers(model.eq_data[e][:3]), None))

    def _followings(self) -> Iterator[Following]:
        for e, name in self._active(self.constants.mjtEq.mjEQ_JOINT):
            offset, multiplier, *higher = map(float, self.model.eq_data[e][:5])
            leader = int(self.model.eq_obj2id[e])
            if leader < 0 or multiplier == 0 or any(higher):
                found = (
                    "a joint that is held"
                    if leader < 0 or multiplier == 0
                    else "a joint that follows a curve"
                )
                expected = "one at a multiple of another"
                advice = "leave a held joint out; write a cam in a TOML file, with the lift of its follower"
                raise self._fault(f"equality {name}", found, expected, advice)
            yield Following(
                self.joints[int(self.model.eq_obj1id[e])], self.joints[leader], multiplier, offset
            )


def _numbers(values: Any) -> Numbers:
    return tuple(float(x) for x in values)
