"""What links share in natural coordinates, counted by hand."""

from __future__ import annotations

from singsym.kinematics.formulations.local import Geometry
from singsym.kinematics.formulations.platforms import POSE
from singsym.kinematics.formulations.shared_coordinates import LinkPlan, plan_links
from singsym.mechanism import load


def planned(
    name: str, rods: set[str], quaternion: bool = False
) -> tuple[dict[str, LinkPlan], dict[str, str]]:
    mechanism = load(name).resolved
    plans, closing = plan_links(mechanism, Geometry(mechanism), rods, quaternion)
    return {plan.link: plan for plan in plans}, closing


def test_crank_and_rocker_bring_in_a_point_each() -> None:
    """Each has its axis and a point of it from the ground, and its end, B or C, as a point of its own."""
    plans, closing = planned("rssr", {"rod"})
    assert plans["crank"].names == plans["crank"].lengths == ("x_B", "y_B", "z_B")
    assert plans["rocker"].names == ("x_C", "y_C", "z_C")
    assert "rod" not in plans
    assert closing == {}
    for plan in plans.values():
        assert plan.anchor.joint is not None
        assert [vector.is_point for vector in plan.vectors] == [False, True]


def test_the_last_link_of_a_bennett_linkage_needs_nothing_new() -> None:
    """The two moving axes, B and C, are three coordinates each, and are directions, not lengths.

    The link that is placed last shares both of its axes, which are not parallel, and a point with the others.
    """
    plans, closing = planned("bennett", set())
    assert [len(plan.names) for plan in plans.values()] == [3, 3, 0]
    assert all(plan.lengths == () for plan in plans.values())
    assert closing == {}


def test_the_platform_is_placed_by_its_pose_where_it_is_wanted() -> None:
    """Position and quaternion of the output's link: the position alone is of lengths."""
    rods = {f"{part}{k}" for part in ("lower", "upper") for k in range(1, 7)}
    posed, _ = planned("stewart-gough-planar", rods, quaternion=True)
    assert posed["platform"].pose == posed["platform"].names == POSE
    assert posed["platform"].lengths == POSE[:3]
    shared, _ = planned("stewart-gough-planar", rods)
    assert shared["platform"].pose == ()
    assert len(shared["platform"].names) == 9
    assert len(shared["platform"].lengths) == 9


def test_parallel_links_take_the_frame_over() -> None:
    """A P joint keeps the frames parallel: the far link needs its length alone, and closes nothing."""
    plans, closing = planned("stanford", set())
    (slider,) = (plan for plan in plans.values() if plan.parallel is not None)
    assert (slider.vectors, len(slider.names), slider.names) == ((), 1, slider.lengths)
    assert closing == {}
