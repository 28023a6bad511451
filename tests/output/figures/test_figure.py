"""Figures: velocities of points against rigidity, arrows against Figs 2-4 of the paper, curves, strata."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from matplotlib.colors import to_rgba

from singsym.classes.classify import classify
from singsym.classes.result import Classification
from singsym.classes.taxonomy.types import SingularityType as T
from singsym.kinematics.sampling import sample_configurations
from singsym.mechanism import load
from singsym.mechanism.model import Space
from singsym.output.figures.curves import Coordinate, plot_curves, smooth, trace_loci
from singsym.output.figures.figure import plot_class, plot_families, plot_mechanism
from singsym.output.figures.motions import drawn_motions, motions_at, restriction_text
from singsym.output.figures.poses import clearance, portrait, poses_along
from singsym.output.figures.scene import Stage
from singsym.output.figures.style import INPUT, PAPER
from singsym.output.figures.view import seen, viewpoint
from singsym.output.strata_graph import plot_strata, strata_graph
from singsym.polynomials import Ring
from singsym.polynomials.compiled_map import CompiledMap, numerical_matrix


@pytest.fixture(scope="module")
def linkage() -> Classification:
    return classify(load("zlatanov-2dof"), cache=False)


@pytest.mark.parametrize("name", ["fourbar", "slider-crank", "3rpr", "3rrr", "puma560", "zlatanov-hybrid"])
def test_a_feasible_motion_keeps_links_rigid_and_joints_together(name: str) -> None:
    stage = Stage.of(load(name))
    point = portrait(stage, seed=3)
    matrix = numerical_matrix(stage.equation.matrix, point)
    motion = np.linalg.svd(matrix)[2][-1]
    labels = [c.label for c in stage.equation.columns]
    moving = stage.velocities(point, dict(zip(labels, motion, strict=True)))
    scene = stage.scene(point)
    # sampled points are as near to the loops as their size allows
    small = 1e-7 * max(scene.size, 1)
    for body in scene.bodies:
        for a, p in body.points.items():
            for b, q in body.points.items():
                assert abs((p - q) @ (moving[body.name, a] - moving[body.name, b])) < small * scene.size
    for joint in stage.mechanism.joints:
        if joint.kind in "RSU":
            ends = (joint.first, joint.at[0]), (joint.second, joint.at[1])
            at = [
                body.points[n]
                for e, n in ends
                for body in scene.bodies
                if body.name == e and n in body.points
            ]
            assert len(at) == 2
            # an axis may be held by two different points of it
            if np.abs(at[0] - at[1]).max() < small:
                assert np.abs(moving[ends[0]] - moving[ends[1]]).max() < small


def test_the_passive_motion_of_fig_2_moves_only_the_pin_between_b_d_and_g(linkage: Classification) -> None:
    stage = Stage.of(load("zlatanov-2dof"), linkage.equation)
    found = linkage[T.RPM | T.II | T.IO]
    point = stage.vector(found.witnesses[0].coordinates)
    (motion,) = drawn_motions(motions_at(stage.equation, point, found.pieces[0].defects))
    assert motion.type is T.RPM
    moving = stage.velocities(point, motion.rates)
    fast = {name for (_, name), v in moving.items() if np.abs(v).max() > 1e-8}
    assert fast == {"C"}


def test_fig_4_moves_the_elbow_of_the_input_leg_with_the_output_at_rest(linkage: Classification) -> None:
    stage = Stage.of(load("zlatanov-2dof"), linkage.equation)
    found = linkage[T.RI | T.IO]
    piece = next(p for p in found.pieces if str(p.path[0]) == "By*Cx - Bx*Cy")
    point = stage.vector(piece.witnesses[0].coordinates)
    motions = motions_at(stage.equation, point, piece.defects)
    (motion,) = drawn_motions(motions)
    moving = stage.velocities(point, motion.rates)
    assert motion.type is T.RI
    assert {name for (_, name), v in moving.items() if np.abs(v).max() > 1e-8} == {"B"}
    (restriction,) = (m for m in motions if m.restriction)
    assert restriction.type is T.IO
    assert restriction_text(restriction).endswith("= 0")


def test_every_class_has_a_picture_with_words(linkage: Classification) -> None:
    pictures = [p for c in linkage.classes if c.witnesses for p in plot_families(linkage, c)]
    families = {"Class 1": 3, "Class 2": 2, "Class 3": 3, "Class 4": 1}
    assert Counter(p.title[:7] for p in pictures) == families, "by the loci whose names the paper gives"
    titles = [p.figure.get_suptitle() for p in pictures]
    assert all(title.startswith("Planar linkage with two degrees of freedom") for title in titles)
    assert "Class 4 (RPM, II, IO): B, C, D collinear and C, D, G collinear" in titles[-1].replace("\n", " ")
    assert all(p.svg().startswith("<svg") and p.description for p in pictures)


def test_what_is_written_below_a_picture_stays_on_it(linkage: Classification) -> None:
    """Also the words for redundant passive motion, that are longer than a line."""
    for found in (c for c in linkage.classes if c.witnesses):
        figure = plot_class(linkage, found).figure
        figure.draw_without_rendering()
        for text in figure.texts:
            box = text.get_window_extent()
            assert box.x0 >= 0, text.get_text()
            assert box.x1 <= figure.bbox.width, text.get_text()


def test_curves_have_the_components_that_are_proven_and_lie_on_their_loci(linkage: Classification) -> None:
    traces = trace_loci(linkage)
    assert [len(t.components) for t in traces] == [locus.components for locus in linkage.loci]
    for trace in traces:
        for line in (arc for component in trace.components for arc in component):
            assert max(abs(trace.locus.factor.evaluate(list(p))) for p in line) < 1e-6
    picture = plot_curves(linkage, "inputs", traces)
    assert "B, C, D collinear" in picture.description
    assert plot_curves(linkage, ("C.x", "G.y"), traces).title == "Singularity curves"


def test_a_polygon_in_a_circle_becomes_round() -> None:
    """An arc of angle a is 1 - cos(a / 2) away from its chord; vertices stay in their order."""
    x, y = Ring(("x", "y")).gens
    angles = np.linspace(0, 2 * np.pi, 7)
    polygon = np.array([np.cos(angles), np.sin(angles)]).T
    line = smooth(polygon, CompiledMap.balanced([x**2 + y**2 - 1], x.ring))
    assert np.hypot(*line.T) == pytest.approx(1)
    steps = np.diff(np.unwrap(np.arctan2(line[:, 1], line[:, 0])))
    assert (steps > 0).all()
    assert steps.sum() == pytest.approx(2 * np.pi)
    assert 1 - np.cos(steps / 2).min() < 0.002
    assert len(smooth(line[:3], CompiledMap.balanced([x], x.ring))) == 3, "what lands far away is left out"


def test_a_curve_that_stays_over_a_point_is_marked_there() -> None:
    """Five-bar with equal rods: with B on D the point C turns about them while the cranks stand still.

    The angle at E is that of the link DE, from D to E: B = 2 (cos a, sin a), D = (1, 0) - 2 (cos e, sin e).
    """
    figure = plot_curves(classify(load("five-bar"), cache=False), "inputs").figure
    dots = [line for line in figure.axes[0].lines if line.get_marker() == "."]
    assert dots
    for line in dots:
        a, e = (np.asarray(data)[0] for data in (line.get_xdata(), line.get_ydata()))
        assert 2 * np.cos(a) == pytest.approx(1 - 2 * np.cos(e))
        assert np.sin(a) == pytest.approx(-np.sin(e))


def test_planes_that_are_not_there_are_refused_with_the_reason() -> None:
    with pytest.raises(ValueError, match="mobility 2: this one has n = 1"):
        plot_curves(classify(load("fourbar"), cache=False), "inputs")


def test_coordinates_of_another_name_are_refused_with_those_there_are(linkage: Classification) -> None:
    with pytest.raises(ValueError, match="expected one of A, B"):
        _ = Coordinate("Q", linkage.equation).is_angle


def test_the_graph_of_strata_of_the_linkage(linkage: Classification) -> None:
    graph = strata_graph(linkage)
    labels = dict(graph.nodes(data="label"))
    up = {(labels[a].split("\n")[0], labels[b].split("\n")[-1]) for a, b in graph.edges if b[0]}
    assert ("4 (RPM, II, IO)", "B, C, D collinear") in up
    assert ("4 (RPM, II, IO)", "C, D, G collinear") in up
    assert ("4 (RPM, II, IO)", "A, B, C collinear") not in up
    assert graph.graph["undecided"] == 0
    assert all(graph.nodes[a]["dimension"] < graph.nodes[b]["dimension"] for a, b in graph.edges)
    assert "closure" in plot_strata(linkage, graph).description


@pytest.mark.parametrize("name", ["3rpr", "spherical-fourbar", "stewart-gough", "ur5", "slider-crank"])
def test_mechanisms_of_every_space_can_be_drawn(name: str, tmp_path: object) -> None:
    mechanism = load(name)
    picture = plot_mechanism(mechanism, seed=1)
    assert picture.save(f"{tmp_path}/figure.pdf").stat().st_size > 1000
    written = {text.get_text() for text in [*picture.figure.texts, *picture.figure.axes[0].texts]}
    named = {name for text in written for name in text.split(", ")}
    assert any(text.startswith("input") and text.endswith(mechanism.inputs[-1]) for text in written)
    joints = {joint.name for joint in mechanism.joints}
    by_joints = mechanism.space is Space.SPHERICAL or len(joints) < len(mechanism.links)
    expected = joints if by_joints else set(Stage.of(mechanism).placement.space.points)
    assert {name.partition(".")[2] or name for name in expected} <= named


@pytest.mark.parametrize("name", ["zlatanov-hybrid-3-2", "rssr", "stewart-gough"])
def test_a_view_is_a_rotation(name: str) -> None:
    stage = Stage.of(load(name))
    scene = stage.scene(portrait(stage, seed=2))
    view = viewpoint(scene)
    assert np.allclose(view @ view.T, np.eye(3))
    assert np.linalg.det(view) == pytest.approx(1)
    drawn = seen(scene, view)
    for body, turned in zip(scene.bodies, drawn.bodies, strict=True):
        assert np.allclose(np.ptp(body.places @ view.T, axis=0), np.ptp(turned.places, axis=0))


@pytest.mark.parametrize("name", ["fourbar", "3rpr", "orthogonal-3r", "stewart-gough"])
def test_a_portrait_is_farther_from_singular_than_most(name: str) -> None:
    stage = Stage.of(load(name))
    others = sample_configurations(stage.placement.space, 15, seed=7)
    assert clearance(stage, portrait(stage)) > np.median([clearance(stage, point) for point in others])


def test_a_short_leg_is_no_clearance() -> None:
    """3-RPR with B1 at a hundredth from A1: the clearance is at most that leg over the size of it all."""
    stage = Stage.of(load("3rpr"))
    point = portrait(stage)
    scene = stage.scene(point)
    mark = next(m for m in scene.marks if m.joint.name == "P1")
    direction = (mark.place - mark.base) / np.linalg.norm(mark.place - mark.base)
    names = stage.placement.space.ring.names
    for axis, shift in zip("xy", 0.01 * direction, strict=True):
        point[names.index(f"B1{axis}")] = mark.base["xy".index(axis)] + shift
    assert clearance(stage, point) <= 0.0101 / stage.scene(point).size


@pytest.mark.parametrize("name", ["zlatanov-2dof", "3rpr", "spherical-5r", "linear-delta", "puma560"])
def test_poses_along_a_motion_keep_links_rigid_and_begin_with_its_velocities(name: str) -> None:
    """Of any feasible motion: central differences of the places are the velocities up to the second order."""
    stage = Stage.of(load(name))
    point = portrait(stage)
    motion = np.linalg.svd(numerical_matrix(stage.equation.matrix, point))[2][-1]
    rates = dict(zip([c.label for c in stage.equation.columns], motion, strict=True))
    here = stage.scene(point)
    small = 1e-3
    back, ahead, far = (stage.scene(p) for p in poses_along(stage, point, rates, (-small, small, 1.0)))
    velocities = stage.velocities(point, rates)
    shifts, expected = [], []
    for body, before, after, later in zip(here.bodies, back.bodies, ahead.bodies, far.bodies, strict=True):
        for a, p in body.points.items():
            shifts.append(after.points[a] - before.points[a])
            expected.append(velocities[body.name, a])
            for b, q in body.points.items():
                length = np.linalg.norm(p - q)
                assert np.linalg.norm(later.points[a] - later.points[b]) == pytest.approx(length, abs=1e-7)
    shifts, expected = np.array(shifts), np.array(expected)
    scale = float((shifts * expected).sum() / (expected * expected).sum())
    assert scale > 0
    assert np.abs(shifts - scale * expected).max() < 1e-3 * np.abs(shifts).max()


def test_files_and_configurations_that_are_not_there_are_refused(linkage: Classification) -> None:
    with pytest.raises(ValueError, match="ends in"):
        plot_mechanism(load("fourbar")).save("figure.docx")
    with pytest.raises(ValueError, match="missing"):
        plot_mechanism(load("fourbar"), {"Bx": 1})
    with pytest.raises(ValueError, match=r"class 12 .* does not occur"):
        plot_class(linkage, T.IIM | T.RPM)


def test_an_input_is_seen_where_another_joint_lies_on_it() -> None:
    """Sarrus, both legs folded: the input A1, in orange, is drawn after A3 at the same place."""
    result = classify(load("sarrus"), cache=False)
    found = result[T.RI | T.RO | T.RPM | T.IIM]
    (axes,) = plot_class(result, found).figure.axes
    fills = {p.get_facecolor(): p.get_zorder() for p in sorted(axes.patches, key=lambda p: p.get_zorder())}
    assert fills[to_rgba(INPUT)] > fills[to_rgba(PAPER)]
