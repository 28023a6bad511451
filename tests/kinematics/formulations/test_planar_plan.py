"""Which links of planar mechanisms need a direction, which their pins place, and what slides place."""

from __future__ import annotations

from dataclasses import replace

import pytest
import sympy

from singsym.classes.classify import classify
from singsym.kinematics.formulations.planar_plan import plan
from singsym.mechanism import MechanismError, load
from singsym.mechanism.model import Exclusion, Limit, PointVelocity
from tests.kinematics.linkages import cross_slides, inverted_slider, link, parallel_slides, puck, trammel

PLATFORM = load("3rpr").resolved


def test_bars_between_two_pins_need_no_direction() -> None:
    """A four-bar: the moving pins B and C, and nothing else; the ground's direction is fixed."""
    found = plan(load("fourbar").resolved)
    assert found.variables == ("Bx", "By", "Cx", "Cy")
    assert set(found.pairs) == {"AB", "BC", "CD"}
    assert found.directed == {"ground": None}
    assert found.lengths == found.variables


def test_a_slider_is_placed_by_its_slide() -> None:
    """It keeps the ground's direction and its pin C is where the slide is; the only free pin is B."""
    found = plan(load("slider-crank").resolved)
    assert found.placing_slides == {"P": "d_P"}
    assert found.variables == ("Bx", "By", "d_P")
    assert found.directed["slider"] is None


def test_links_that_slide_on_each_other_have_one_direction() -> None:
    """The inverted slider's rod and block, and all three moving links of Oldham's coupling."""
    rod = plan(inverted_slider()).directed
    assert rod["rod"] == rod["block"] == ("c_rod", "s_rod")
    hubs = plan(cross_slides()).directed
    assert hubs["one"] == hubs["cross"] == hubs["two"] == ("c_one", "s_one")


def test_directions_are_no_lengths() -> None:
    found = plan(inverted_slider())
    assert set(found.variables) - set(found.lengths) == {"c_rod", "s_rod"}


def test_a_link_without_pins_has_coordinates_of_its_own() -> None:
    """The disc lies on the table by an E joint and is pinned to the rod: it is placed from that pin."""
    found = plan(puck())
    assert found.directed["disc"] == ("c_disc", "s_disc")
    assert [(step.link, step.pin) for step in found.steps] == [("disc", "B")]
    assert found.free_links == {}


def test_a_traced_point_that_is_not_rational_in_two_pins_needs_a_direction() -> None:
    """A rod of length sqrt 2 with a third point M: only where M's velocity is an output."""
    rod = link("rod", {"P": (0, 0), "Q": (1, 1), "M": (1, 2)})
    free = replace(trammel(), links=tuple(rod if k.name == "rod" else k for k in trammel().links))
    traced = replace(free, outputs=(PointVelocity("rod", "M", ("x",)),))
    irrational = link("rod", {"P": (0, 0), "Q": (sympy.sqrt(sympy.sqrt(2)), 0), "M": (1, 2)})
    bent = replace(traced, links=tuple(irrational if k.name == "rod" else k for k in traced.links))
    assert "rod" in plan(free).pairs
    assert "rod" in plan(traced).pairs
    assert "rod" not in plan(bent).pairs


def test_legs_whose_ends_stay_apart_need_no_direction() -> None:
    found = plan(PLATFORM)
    assert found.struts == {"P1", "P2", "P3"}
    assert not {"cylinder1", "rod1"} & set(found.directed)


@pytest.mark.parametrize(
    ("exclusions", "limits"),
    [
        ((), ()),
        ((Exclusion("coincide", ("A1", "B2")),), ()),
        ((Exclusion("coincide", ("A1", "A2")),), ()),
        ((), (Limit(sympy.Symbol("length(P1)"), sympy.Integer(0)),)),
        ((), (Limit(sympy.Symbol("length(P1)"), None, sympy.Integer(9)),)),
    ],
    ids=["nothing", "of two legs", "of the ground", "not negative", "from above"],
)
def test_legs_that_may_vanish_keep_their_direction(
    exclusions: tuple[Exclusion, ...], limits: tuple[Limit, ...]
) -> None:
    found = plan(replace(PLATFORM, exclusions=exclusions, limits=limits))
    assert found.struts == frozenset()
    assert found.directed["cylinder1"] == found.directed["rod1"] == ("c_cylinder1", "s_cylinder1")


def test_a_positive_length_is_a_strut() -> None:
    limit = Limit(sympy.Symbol("length(P1)"), sympy.Rational(1, 2))
    assert plan(replace(PLATFORM, exclusions=(), limits=(limit,))).struts == {"P1"}


def test_slides_turn_links_by_their_axes() -> None:
    """The axis is (1, 0) in the ground and (3/5, 4/5) in the shoe: the shoe is turned by the angle back."""
    shoe = link("shoe", {"P": (0, 0)}, {"u": ("3/5", "4/5")})
    turned = replace(trammel(), links=tuple(shoe if k.name == "shoe" else k for k in trammel().links))
    assert plan(turned).turns["shoe"] == (sympy.Rational(3, 5), sympy.Rational(-4, 5))
    assert plan(turned).turns["boot"] == (1, 0)


def test_slides_in_a_loop_that_cannot_agree() -> None:
    """Of three links that never turn, one sees w at another angle than the others."""
    two = link("two", {"Q": (0, 0)}, {"v": (0, 1), "w": ("4/5", "3/5")})
    crooked = replace(
        parallel_slides(), links=tuple(two if k.name == "two" else k for k in parallel_slides().links)
    )
    assert plan(parallel_slides()).turns["two"] == (1, 0)
    with pytest.raises(MechanismError, match="slides in a loop"):
        plan(crooked)


def test_a_slide_on_the_ground_is_no_strut() -> None:
    """A slider that keeps off the crank's pivot: the ground does not turn with the line from pivot to slider.

    With AB = 1, BC = 3 and AC at least 3 there is one curve, and on it one dead point, AC = 4.
    """
    limit = Limit(sympy.Symbol("length(P)"), low=sympy.Integer(3))
    mechanism = replace(load("slider-crank"), limits=(limit,))
    assert not plan(mechanism.resolved).struts
    found = classify(mechanism)
    assert [piece.extent.at_most for piece in found.configuration_space] == [1]
    assert "1 configuration (" in found.summary[0]
