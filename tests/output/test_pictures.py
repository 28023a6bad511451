"""Pictures that a classification gives of itself, in figures of their own and on axes at hand; its report."""

from __future__ import annotations

from pathlib import Path

import pytest
from matplotlib.figure import Figure

from singsym.classes.classify import classify, classify_equation
from singsym.classes.result import Classification
from singsym.classes.taxonomy.types import SingularityType as T
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import load


@pytest.fixture(scope="module")
def linkage() -> Classification:
    return classify(load("zlatanov-2dof"), cache=False)


@pytest.mark.parametrize("what", [None, 4, "RPM, II, IO", T.RI | T.IO, "inputs", "outputs", "strata"])
def test_on_axes_at_hand_as_in_a_figure_of_its_own(
    linkage: Classification, what: int | str | T | None
) -> None:
    """The same lines, patches and texts; nothing on the axes beside, and no title over the whole."""
    figure = Figure(figsize=(9, 4))
    left, right = figure.subplots(1, 2)
    beside = len(right.get_children())
    alone, placed = linkage.plot(what), linkage.plot(what, ax=left)
    assert placed.figure is figure
    assert (placed.title, placed.description) == (alone.title, alone.description)
    own = alone.figure.axes[0]
    assert len(left.lines) == len(own.lines)
    assert len(left.patches) == len(own.patches)
    assert {t.get_text() for t in own.texts} <= {t.get_text() for t in left.texts}
    assert left.get_title() == alone.figure.get_suptitle()
    assert figure.get_suptitle() == ""
    assert not figure.texts
    assert len(right.get_children()) == beside
    written = {t.get_text() for t in alone.figure.texts if t.get_text() != alone.figure.get_suptitle()}
    assert written <= {t.get_text() for t in left.texts}
    assert placed.svg().startswith("<svg")


def test_each_configuration_of_a_class(linkage: Classification) -> None:
    """Class 4 is of 8 points."""
    pictures = {linkage.plot(4, witness=i).svg() for i in range(8)}
    assert len(pictures) == 8
    with pytest.raises(ValueError, match="8 configurations known, no number 9"):
        linkage.plot(4, witness=8)
    with pytest.raises(ValueError, match="no number 0"):
        linkage.plot(4, witness=-1)


def test_what_cannot_be_drawn(linkage: Classification) -> None:
    with pytest.raises(ValueError, match=r"class 5 \(.*\) does not occur"):
        linkage.plot(5)
    with pytest.raises(KeyError, match="number from 1 to 21"):
        linkage.plot(22)
    with pytest.raises(KeyError, match="'input'"):
        linkage.plot("input")
    equations = classify_equation(None, velocity_equation(load("slider-crank")), cache=False)
    with pytest.raises(ValueError, match="nothing to draw"):
        equations.plot()


def test_the_report_is_written_where_it_should_be(tmp_path: Path) -> None:
    found = classify(load("slider-crank"), cache=False)
    path = found.report(tmp_path / "page.html")
    assert path == tmp_path / "page.html"
    assert path.read_text(encoding="utf-8").startswith("<!DOCTYPE html>")
    with pytest.raises(OSError, match="missing"):
        found.report(tmp_path / "missing" / "page.html")
