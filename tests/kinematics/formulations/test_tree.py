"""Spanning trees, the angles that they count from the start of a run, and where the links come to be."""

from __future__ import annotations

import pytest
import sympy

from singsym.kinematics.dimensions import Sized, dimensions
from singsym.kinematics.formulations.frames import Algebra, rigid
from singsym.kinematics.formulations.local import Geometry, apply, cross
from singsym.kinematics.formulations.tree import Grown, by_branch, grow, plan, spanning_steps
from singsym.mechanism import load
from singsym.mechanism.model import Joint, JointKind, JointRate, Link, Mechanism, Space

ZERO, ONE = sympy.Integer(0), sympy.Integer(1)
UP, DOWN, ASIDE = (ZERO, ZERO, ONE), (ZERO, ZERO, -ONE), (ONE, ZERO, ZERO)


def arm(*axes: tuple[sympy.Expr, ...]) -> Mechanism:
    """Links of length 1 along x, hinged one on the other by J1, J2, ... with these axes in both links."""
    names = ["ground", *(f"link{k}" for k in range(1, len(axes) + 1))]
    links = []
    for k, name in enumerate(names):
        own = {f"J{i + 1}": axes[i] for i in (k - 1, k) if 0 <= i < len(axes)}
        points = {"from": (ZERO,) * 3, "to": (ONE if k else ZERO, ZERO, ZERO)}
        links.append(Link(name, points, own))
    joints = tuple(
        Joint(f"J{k}", JointKind.R, names[k - 1], names[k], ("to", "from"), (f"J{k}", f"J{k}"))
        for k in range(1, len(axes) + 1)
    )
    return Mechanism("arm", Space.SPATIAL, "ground", tuple(links), joints, ("J1",), (JointRate("J1"),))


@pytest.mark.parametrize(
    ("axes", "absolute", "names"),
    [
        ((UP, UP, UP), True, [("c1", "s1"), ("c12", "s12"), ("c123", "s123")]),
        ((UP, UP, UP), False, [("c1", "s1"), ("c2", "s2"), ("c3", "s3")]),
        ((UP, DOWN), True, [("c1", "s1"), ("c1m2", "s1m2")]),
        ((UP, ASIDE, ASIDE), True, [("c1", "s1"), ("c2", "s2"), ("c23", "s23")]),
        ((UP, ASIDE, UP), True, [("c1", "s1"), ("c2", "s2"), ("c3", "s3")]),
    ],
)
def test_angles_add_up_along_parallel_axes_only(
    axes: tuple[tuple[sympy.Expr, ...], ...], absolute: bool, names: list[tuple[str, str]]
) -> None:
    """Opposite axes subtract; the first and third axis of an elbow are parallel at one angle only."""
    mechanism = arm(*axes)
    steps = plan(mechanism, Geometry(mechanism), spanning_steps(mechanism), absolute)
    assert [step.variables for step in steps] == names


def grown_arm(mechanism: Mechanism) -> tuple[Geometry, Sized, Grown]:
    """The arm with angles added up along parallel axes, grown from the ground."""
    geometry = Geometry(mechanism)
    steps = plan(mechanism, geometry, spanning_steps(mechanism), True)
    sized = dimensions(mechanism, [v for step in steps for v in step.variables])
    algebra = Algebra(sized.ring, sized.number)
    ground = {"ground": rigid(algebra, algebra.origin, algebra.axes)}
    return geometry, sized, grow(geometry, algebra, ground, steps)


def test_where_the_links_of_a_planar_arm_come_to_be() -> None:
    """The tip of two links is at (c1 + c12, s1 + s12, 0), and J2 turns by the difference of the angles."""
    geometry, sized, grown = grown_arm(arm(UP, UP))
    c1, s1, c12, s12 = sized.ring.gens
    tip = grown.bodies["link2"].point(geometry.point("link2", "to"))
    assert tip == (c1 + c12, s1 + s12, sized.ring.zero)
    assert set(grown.circles) == {c1**2 + s1**2 - 1, c12**2 + s12**2 - 1}
    second = grown.values["J2"]
    assert (second.cosine, second.sine) == (c1 * c12 + s1 * s12, c1 * s12 - s1 * c12)


def test_an_opposite_axis_turns_the_other_way() -> None:
    """About z the second link is turned by q1 - q2, cosine c and sine s: sin q2 = s1 c - c1 s."""
    _, sized, grown = grown_arm(arm(UP, DOWN))
    c1, s1, c, s = sized.ring.gens
    second = grown.values["J2"]
    assert (second.cosine, second.sine) == (c1 * c + s1 * s, s1 * c - c1 * s)


def test_a_loop_is_cut_in_its_middle_and_no_tree_crosses_a_spherical_joint() -> None:
    """RSSR: crank and rocker from the ground, not the rod, which hangs between spherical joints."""
    assert {(p, c) for _, p, c in spanning_steps(load("rssr"))} == {("ground", "crank"), ("ground", "rocker")}
    bennett = load("bennett").resolved
    steps = spanning_steps(bennett)
    assert len(steps) == len(bennett.links) - 1
    assert [parent for _, parent, _ in steps].count(bennett.ground) == 2


def test_the_legs_of_a_tree_come_one_after_the_other() -> None:
    """Breadth first the two legs of a Bennett linkage alternate; by branch the longer one is in one piece."""
    mechanism = load("bennett").resolved
    steps = by_branch(plan(mechanism, Geometry(mechanism), spanning_steps(mechanism), True))
    after_ground = [k for k, step in enumerate(steps) if step.parent == mechanism.ground]
    for k, step in enumerate(steps):
        assert k in after_ground or steps[k - 1].child == step.parent


def test_an_angle_counted_elsewhere_turns_by_the_joint_s_own() -> None:
    """A hinge that stands askew on a slide along z: inside, its angle begins where the rod points along z.

    With p across the axis u at the joint's own zero, the rod's end is cos B p + sin B u x p off the slide.
    """
    root = sympy.sqrt(3)
    askew = (-root / 2, -ONE / 2, ZERO)
    links = (
        Link("ground", {"A": (ZERO,) * 3}, {"z": UP}),
        Link("slide", {"B": (ZERO,) * 3}, {"z": UP, "t": askew}),
        Link("rod", {"B": (ZERO,) * 3, "C": ASIDE}, {"t": UP}),
    )
    joints = (
        Joint("P", JointKind.P, "ground", "slide", ("A", "B"), ("z", "z")),
        Joint("B", JointKind.R, "slide", "rod", ("B", "B"), ("t", "t")),
    )
    geometry, sized, grown = grown_arm(
        Mechanism("leg", Space.SPATIAL, "ground", links, joints, ("P",), (JointRate("B"),))
    )
    assert sized.ring.names[:3] == ("d_P", "c_Bo", "s_Bo")
    value, end = grown.values["B"], grown.bodies["rod"].point(ASIDE)
    assert value.cosine is not None
    assert value.sine is not None
    start = apply(geometry.zero(joints[1]), ASIDE)
    above = (sized.ring.zero, sized.ring.zero, sized.ring.gen("d_P"))
    for found, along, across, slide in zip(end, start, cross(askew, start), above, strict=True):
        expected = value.cosine * sized.number(along) + value.sine * sized.number(across) + slide
        assert sized.ring.reduced(found - expected).is_zero
    assert {*end[2].variables} == {"d_P", "c_Bo"}
