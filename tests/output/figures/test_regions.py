"""Pictures of regions: what they draw of mechanisms of one and two degrees of freedom."""

from __future__ import annotations

import pytest

from singsym.mechanism import load
from singsym.motion.regions.regions import regions
from singsym.output.figures.regions import plot_regions


def test_over_the_inputs_and_in_the_workspace() -> None:
    """An arm of two links: one configuration over each pair of angles; elbow up and down."""
    found = regions(load("2r"), grid=16)
    picture = plot_regions(found)
    assert "2 regions found; up to 1 assembly" in picture.description
    # the plane with all assemblies, and a panel for each region
    assert len([axes for axes in picture.figure.axes if axes.axison]) == 3
    tip = plot_regions(found, ("C.x", "C.y"))
    shown = [axes for axes in tip.figure.axes if axes.axison]
    assert len(shown) == 2
    for axes in shown:
        # links of 2 and 1: the tip is between 1 and 3 from the base, on all sides
        assert -3.5 < axes.dataLim.xmin < -2.5
        assert 2.5 < axes.dataLim.xmax < 3.5


def test_arcs_of_one_degree_of_freedom() -> None:
    picture = plot_regions(regions(load("slider-crank")))
    assert "2 arcs; A across, P up" in picture.description


def test_nothing_to_draw_is_said() -> None:
    """A crank that is too short to reach: a four-bar that cannot be assembled has no region."""
    found = regions(load("fourbar").with_parameters(a="1/10", b="1/10", c="1/10"))
    with pytest.raises(ValueError, match="no regions"):
        plot_regions(found)
