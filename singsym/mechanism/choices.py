"""What a user chooses of a mechanism that is at hand: the ends of a chain, joints that move, components.

Source: singsym's own.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from difflib import get_close_matches
from typing import Any

import networkx

from singsym.mechanism.locking import locked
from singsym.mechanism.model import JointRate, Mechanism, PointVelocity, Twist
from singsym.mechanism.outputs import coordinates
from singsym.mechanism.problems import MechanismError, Problem

REDUNDANT = "the chain is redundant, RI in every configuration, and `singsym conditions` says where IO holds"
"""What is said where the 21 classes are asked for, which suppose as many outputs as inputs."""


@dataclass(frozen=True)
class Choice:
    """Parts of a mechanism that are meant; what is empty is left as it is.

    base, tip: links at which a chain of a URDF file starts and ends.
    joints: those that move, all other inputs are held at zero; lock: joints held at values, in radians or
        lengths.
    components: of the output.
    redundant: whether a serial chain with more inputs than output components is let through.
    """

    base: str | None = None
    tip: str | None = None
    joints: tuple[str, ...] = ()
    lock: Mapping[str, Any] = field(default_factory=dict)
    components: tuple[str, ...] = ()
    redundant: bool = False

    def held(self, inputs: Sequence[str], file: str = "") -> dict[str, Any]:
        """The values of the inputs that do not move; raises `MechanismError` for unknown names."""
        for place, names in (("joints", self.joints), ("lock", tuple(self.lock))):
            for name in names:
                if name not in inputs:
                    close = get_close_matches(name, inputs, 1)
                    advice = f"did you mean {close[0]!r}?" if close else ""
                    expected = f"input joints among {', '.join(inputs)}"
                    raise MechanismError([Problem(place, repr(name), expected, advice, file)])
        if both := [name for name in self.lock if name in self.joints]:
            expected = "each joint either moving or held"
            raise MechanismError([Problem("lock", f"{both[0]!r}, which is in --joints", expected, file=file)])
        rest = dict.fromkeys((n for n in inputs if self.joints and n not in self.joints), 0)
        return {**rest, **self.lock}

    def applied(self, mechanism: Mechanism) -> Mechanism:
        """The mechanism with joints held and its output's components as chosen; raises `MechanismError`."""
        for option in ("base", "tip"):
            if getattr(self, option) is not None:
                found, expected = f"--{option} for a mechanism file", "a URDF file"
                advice = "in the file, change ground and output"
                raise MechanismError([Problem(option, found, expected, advice, mechanism.origin)])
        mechanism = locked(mechanism, self.held(mechanism.inputs, mechanism.origin))
        return with_components(mechanism, self.components) if self.components else mechanism


def with_components(mechanism: Mechanism, components: Iterable[str]) -> Mechanism:
    """The mechanism with these components of its one output: of a point's velocity, or of a link's twist."""
    names = tuple(components)
    output = mechanism.outputs[0] if len(mechanism.outputs) == 1 else None
    if output is None or isinstance(output, JointRate):
        found, expected = "outputs without components to choose", "one output, of a point or of a link"
        raise MechanismError([Problem("components", found, expected, file=mechanism.origin)])
    kind = PointVelocity if set(names) <= set(coordinates(mechanism.space)) else Twist
    return replace(mechanism, outputs=(kind(output.link, output.point, names),))


def is_redundant(mechanism: Mechanism) -> bool:
    """Whether a mechanism is a serial chain, all its freedoms inputs, with fewer output components."""
    every = set(mechanism.inputs) == set(mechanism.columns)
    return every and networkx.is_forest(mechanism.graph) and mechanism.output_size < len(mechanism.inputs)


def balance(mechanism: Mechanism) -> str:
    """How outputs become as many as inputs, in options that fit this mechanism."""
    n, count, output = mechanism.n, mechanism.output_size, mechanism.outputs[0]
    if count > n:
        names = () if isinstance(output, JointRate) else output.components
        return (
            f"choose components, as --components {','.join(names[:n])}" if names else "choose fewer outputs"
        )
    if not is_redundant(mechanism):
        return "name more components of the output"
    spare = n - count
    holds = " ".join(f"--lock {name}=0" for name in mechanism.inputs[-spare:])
    which = "an input" if spare == 1 else f"{spare} inputs"
    return f"{REDUNDANT}: hold {which}, as {holds}, or name more components of the output"
