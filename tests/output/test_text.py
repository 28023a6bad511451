"""Pages of text."""

from singsym.classes.classify import classify
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import load
from singsym.mechanism.fileformat import loads
from singsym.output.page import Grid, plain
from singsym.output.pieces import grouped, moving
from singsym.output.text import classification_page, mechanism_page
from singsym.polynomials import Ring


def test_columns_are_aligned_and_nothing_trails():
    text = plain((Grid(("a", "b"), (("long cell", "1"), ("", "22")), "T"),))
    assert text.splitlines() == ["T", "a          b", "---------  --", "long cell  1", "           22"]


def test_long_polynomials_are_cut_with_a_count():
    x, y = Ring(("x", "y")).gens
    assert ((x + y + 1) ** 3).short_text(4).endswith("... (6 more terms)")
    assert ((x + y + 1) ** 3).short_text(10).count(" + ") == 9


def test_a_long_matrix_is_announced_not_printed():
    mechanism = load("ur5")
    page = mechanism_page(mechanism, velocity_equation(mechanism))
    assert any(isinstance(block, str) and "too long to print" in block for block in page)


def test_pieces_of_a_class_are_gathered_and_fixed_points_left_out():
    result = classify(load("slider-crank"), cache=False)
    (dead,) = [c for c in result.classes if c.verdict.is_yes]
    groups = grouped(dead.pieces, result.loci)
    assert sum(g.points for g in groups) == 2
    names = {name.partition(".")[0] for name in moving(dead.witnesses[0].points, result.equation)}
    assert names == {"B", "C"}
    assert "Engines: flint" in plain(classification_page(result))


def test_a_page_says_from_where_an_angle_is_counted():
    """The smallest turn from z to u = (-sqrt(3)/2, -1/2, 0) takes x to (1/4, -sqrt(3)/4, sqrt(3)/2).

    Along z that is sqrt(3)/2, and u x that is 1/2: where B is 30 degrees the rod points along z,
    and the angle inside begins there.
    """
    arm = loads(
        """
        name = "arm"
        space = "spatial"
        inputs = ["P", "B"]
        output = { twist = "rod", at = "C", components = ["vx", "vz"] }
        [links]
        ground = { points = { A = [0, 0, 0] }, axes = { z = [0, 0, 1] } }
        slide = { points = { B = [0, 0, 0] }, axes = { z = [0, 0, 1], t = ["-sqrt(3)/2", "-1/2", 0] } }
        rod = { points = { B = [0, 0, 0], C = [1, 0, 0] }, axes = { t = [0, 0, 1] } }
        [joints]
        P = { type = "P", links = ["ground", "slide"], at = ["A", "B"], axis = "z" }
        B = { axis = "t" }
        """
    )
    page = plain(mechanism_page(arm, velocity_equation(arm)))
    assert "cos B = 1/2*c_Bo*sqrt3 - 1/2*s_Bo, sin B = 1/2*s_Bo*sqrt3 + 1/2*c_Bo" in page
