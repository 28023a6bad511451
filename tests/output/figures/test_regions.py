"""Regions over the inputs against what can be said of simple mechanisms by hand."""

from __future__ import annotations

import numpy as np
import pytest

from singsym.classes.classify import classify
from singsym.mechanism import load
from singsym.output.figures.regions import find_regions, plot_regions


def test_an_arm_of_two_links_has_two_regions_elbow_up_and_down() -> None:
    """The determinant is a multiple of sin B, so the regions are the halves B > 0 and B < 0 of the torus."""
    result = classify(load("2r"), cache=False)
    found = find_regions(result, grid=24, seeds=30)
    assert found is not None
    assert (found.assemblies == 1).all()
    one, two = (region > 0 for region in found.regions)
    up = np.broadcast_to(found.inputs[1] > 0, one.shape)
    assert (one == up).all() or (one == ~up).all()
    assert (two == ~one).all()
    picture = plot_regions(result, regions=found)
    assert "2 regions found; up to 1 assembly" in picture.description


def test_the_five_bar_has_two_assemblies_over_all_inputs() -> None:
    """Cranks of 2 on a base of 1 keep B and D nearer than 5; C is 3 from both: two ways unless B is on D."""
    found = find_regions(classify(load("five-bar"), cache=False), grid=40)
    assert found is not None
    assert (found.assemblies == 2).all()
    assert all(region.max() == 1 for region in found.regions), "a region holds one assembly of each input"
    over_all = np.sum(found.regions, axis=0)
    assert over_all.max() == 2, "no configuration is in two regions"


def test_mechanisms_of_another_mobility_have_no_such_plane() -> None:
    with pytest.raises(ValueError, match="two inputs"):
        plot_regions(classify(load("slider-crank"), cache=False))
