"""Small planar mechanisms built in Python, for the tests of this folder."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import sympy

from singsym.mechanism.model import Joint, JointKind, JointRate, Link, Mechanism, Output, Space

Points = Mapping[str, Sequence[Any]]


def link(name: str, points: Points, axes: Points | None = None) -> Link:
    """A link with points and axes of numbers."""

    def exact(named: Points) -> dict[str, tuple[sympy.Expr, ...]]:
        return {k: tuple(sympy.sympify(x) for x in v) for k, v in named.items()}

    return Link(name, exact(points), exact(axes or {}))


def pin(name: str, first: str, second: str, at: str | None = None) -> Joint:
    """A planar revolute joint; its point has the joint's name in both links."""
    return Joint(name, JointKind.R, first, second, (at or name, at or name))


def slide(name: str, first: str, second: str, at: tuple[str, str], axis: str = "u") -> Joint:
    """A prismatic joint along the axis that both links call by one name."""
    return Joint(name, JointKind.P, first, second, at, (axis, axis))


def planar(
    links: Sequence[Link],
    joints: Sequence[Joint],
    inputs: Sequence[str],
    outputs: Sequence[Output] = (),
    **more: Any,
) -> Mechanism:
    """A planar mechanism on the link `ground`; without outputs, the rates of its inputs."""
    chosen = tuple(outputs) or tuple(JointRate(c) for c in inputs)
    return Mechanism(
        "test", Space.PLANAR, "ground", tuple(links), tuple(joints), tuple(inputs), chosen, **more
    )


def trammel() -> Mechanism:
    """The elliptic trammel: two sliders at right angles carry a rod of length 2."""
    return planar(
        [
            link("ground", {"O": (0, 0)}, {"u": (1, 0), "v": (0, 1)}),
            link("shoe", {"P": (0, 0)}, {"u": (1, 0)}),
            link("boot", {"Q": (0, 0)}, {"v": (0, 1)}),
            link("rod", {"P": (0, 0), "Q": (2, 0), "M": (1, 1)}),
        ],
        [
            slide("X", "ground", "shoe", ("O", "P")),
            pin("P", "shoe", "rod"),
            slide("Y", "ground", "boot", ("O", "Q"), "v"),
            pin("Q", "boot", "rod"),
        ],
        ["X"],
    )


def inverted_slider() -> Mechanism:
    """Crank AB, a rod through B that slides in a block pinned at C, the slide line off the pins."""
    return planar(
        [
            link("ground", {"A": (0, 0), "C": (3, 0)}),
            link("crank", {"A": (0, 0), "B": (1, 0)}),
            link("rod", {"B": (0, 0), "K": (0, 1)}, {"u": (1, 0)}),
            link("block", {"C": (0, 0), "K": (0, -1)}, {"u": (1, 0)}),
        ],
        [
            pin("A", "ground", "crank"),
            pin("B", "crank", "rod"),
            slide("S", "rod", "block", ("K", "K")),
            pin("C", "block", "ground"),
        ],
        ["A"],
    )


def cross_slides() -> Mechanism:
    """Oldham's coupling: two hubs on the ground, a cross that slides in both."""
    return planar(
        [
            link("ground", {"A": (0, 0), "B": (1, 0)}),
            link("one", {"A": (0, 0)}, {"u": (1, 0)}),
            link("cross", {"K": (0, 0)}, {"u": (1, 0), "v": (0, 1)}),
            link("two", {"B": (0, 0)}, {"v": (0, 1)}),
        ],
        [
            pin("A", "ground", "one"),
            slide("U", "one", "cross", ("A", "K")),
            slide("V", "cross", "two", ("K", "B"), "v"),
            pin("B", "two", "ground"),
        ],
        ["A"],
    )


def crane() -> Mechanism:
    """An open chain: a trolley on a rail, an arm, a telescope with a hook."""
    return planar(
        [
            link("ground", {"O": (0, 0)}, {"u": ("3/5", "4/5")}),
            link("trolley", {"O": (0, 0), "A": (0, 1)}, {"u": ("3/5", "4/5")}),
            link("arm", {"A": (0, 0), "T": (1, 0)}, {"u": (0, 1)}),
            link("telescope", {"T": (0, 0), "hook": (1, 2)}, {"u": (0, 1)}),
        ],
        [
            slide("X", "ground", "trolley", ("O", "O")),
            pin("A", "trolley", "arm"),
            slide("T", "arm", "telescope", ("T", "T")),
        ],
        ["X", "A", "T"],
    )


def puck() -> Mechanism:
    """A disc that lies free on a table (E) and hangs on the ground by a rod."""
    return planar(
        [
            link("ground", {"O": (0, 0), "A": (2, 1)}),
            link("disc", {"O": (0, 0), "B": (1, 0)}),
            link("rod", {"A": (0, 0), "B": (2, 0)}),
        ],
        [
            Joint("E", JointKind.E, "ground", "disc", ("O", "O")),
            pin("A", "ground", "rod"),
            pin("B", "rod", "disc"),
        ],
        ["A", "B"],
    )


def parallel_slides() -> Mechanism:
    """A loop of three slides between links that never turn, driven from one."""
    return planar(
        [
            link("ground", {"O": (0, 0), "Q": (1, 0)}, {"u": (1, 0), "v": (0, 1)}),
            link("one", {"O": (0, 0)}, {"u": (1, 0), "w": ("3/5", "4/5")}),
            link("two", {"Q": (0, 0)}, {"v": (0, 1), "w": ("3/5", "4/5")}),
        ],
        [
            slide("X", "ground", "one", ("O", "O")),
            slide("Y", "ground", "two", ("Q", "Q"), "v"),
            slide("W", "one", "two", ("O", "Q"), "w"),
        ],
        ["X"],
    )


def skew_yoke() -> Mechanism:
    """A crank moves a yoke on a rail by a block in an inclined slot, which both name in their own frames."""
    return planar(
        [
            link("ground", {"A": (0, 0), "O": (3, 1)}, {"y": (0, 1)}),
            link("crank", {"A": (0, 0), "B": (1, 0)}),
            link("block", {"B": (0, 0)}, {"u": ("3/5", "4/5")}),
            link("yoke", {"Z": (0, 0), "W": (-1, 0)}, {"u": ("4/5", "-3/5"), "y": (0, 1)}),
        ],
        [
            pin("A", "ground", "crank"),
            pin("B", "crank", "block"),
            slide("S", "block", "yoke", ("B", "Z")),
            slide("Y", "ground", "yoke", ("O", "W"), "y"),
        ],
        ["A"],
    )


EVERY = (trammel, inverted_slider, cross_slides, crane, puck, parallel_slides, skew_yoke)
