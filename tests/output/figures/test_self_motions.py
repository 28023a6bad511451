"""Pictures of self-motions: their curves in a plane, and what is said where there is none."""

from __future__ import annotations

import numpy as np
import pytest

from singsym.classes.configuration.self_motions import self_motions
from singsym.mechanism import load
from singsym.output.figures.self_motions import plot_self_motions

PLACE = ["1/2", "sqrt(15)/2"]
FOLDED = {"points": {"B": PLACE, "D": PLACE, "C": ["7/2", "sqrt(15)/2"]}}


def test_a_curve_is_drawn_in_the_joints_and_in_the_plane() -> None:
    """Cranks of 2 whose ends coincide, on a base of 1: the rods of 3 turn about B = (1/2, sqrt(15)/2)."""
    found = self_motions(load("five-bar"), FOLDED)
    picture = plot_self_motions(found)
    assert "with the inputs at rest a curve, closed, B across, D up" in picture.description
    assert len(picture.figure.axes) == 1
    places = plot_self_motions(found, ("C.x", "C.y"))
    (circle, ring) = places.figure.axes[0].lines
    away = np.hypot(circle.get_xdata() - 0.5, circle.get_ydata() - 15**0.5 / 2)
    assert np.allclose(away, 3, atol=1e-6)
    assert (ring.get_xdata()[0], ring.get_ydata()[0]) == pytest.approx((3.5, 15**0.5 / 2))


def test_where_no_curve_is_that_is_said() -> None:
    """A dead point's slide rests to first order only."""
    found = self_motions(load("slider-crank"), {"points": {"B": [1, 0], "C": [4, 0]}})
    with pytest.raises(ValueError, match=r"no curve of a self-motion was traced.*infinitesimal"):
        plot_self_motions(found)
    with pytest.raises(ValueError, match="coordinate 'Q': expected one of A, "):
        plot_self_motions(self_motions(load("five-bar"), FOLDED), ("Q", "A"))
