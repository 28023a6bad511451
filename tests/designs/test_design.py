"""Borders of dimensions against lengths that textbooks and triangles give.

Source: F. Grashof, Theoretische Maschinenlehre (1883): a four-bar linkage can lie flat, and its type can
change, only where a sum or difference of its sides vanishes; slider-cranks by right triangles.
"""

from concurrent.futures import Executor, Future
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise, product
from math import hypot, sqrt
from types import SimpleNamespace

import pytest
import sympy

import singsym
from singsym.classes.gathering import gathered
from singsym.classes.running.runner import Runner
from singsym.classes.taxonomy.types import feasible_classes
from singsym.designs.borders import Borders, borders
from singsym.designs.families import Family, family
from singsym.designs.plane import Plane
from singsym.designs.real_borders import real_borders
from singsym.designs.result import Design
from singsym.designs.sampling import Sampled, at_samples
from singsym.output.design.page import proof_text, sample_text
from singsym.polynomials import Ring

OFFSET = """
name = "offset"
inputs = ["A"]
output = { rate = "P" }
[parameters]
r = { value = 1, above = 0 }
l = { value = 3, above = 0 }
e = { value = "1/2", above = 0 }
[links]
ground = { points = { A = [0, 0], O = [0, "e"] }, axes = { x = [1, 0] } }
AB = "r"
BC = "l"
slider = { points = { C = [0, 0] }, axes = { x = [1, 0] } }
[joints]
A = "R"
B = "R"
C = "R"
P = { type = "P", links = ["ground", "slider"], at = ["O", "C"], axis = "x" }
"""


def factors(mechanism: singsym.Mechanism, *names: str) -> set[str]:
    symbolic = mechanism.with_parameters(**dict.fromkeys(names))
    found = borders(family(symbolic, "auto", Runner()))
    assert not [types for types, _ in found.open if types]
    assert found.certainty == "proven"
    return {str(part.polynomial) for part in found.parts}


@pytest.mark.engines
def test_the_borders_of_a_four_bar_are_grashofs_lines():
    # it lies flat where g +- a +- b +- c = 0, here with g = 4 and c = 3; besides only sides of no length
    R = Ring(("a", "b"))
    a, b = R.gens
    flat = {str((4 + s * a + t * b + u * 3).primitive()) for s, t, u in product((1, -1), repeat=3)}
    assert factors(singsym.load("fourbar"), "a", "b") == flat | {"a", "b"}


def grashof(g: Fraction, a: Fraction, b: Fraction, c: Fraction) -> dict[int, int] | None:
    """Points by class: the input's ends and the output's ends, from triangles alone.

    Where the coupler is in line with the input, |a - b| or a + b makes a triangle with g and c, of two mirror
    images each; where it is with the output, |b - c| or b + c with g and a.  None: it cannot be put together.
    """
    longest = max(g, a, b, c)
    if longest > g + a + b + c - longest:
        return None

    def triangles(side: Fraction, other: Fraction) -> int:
        return 2 * (abs(g - other) < side < g + other)

    found = {
        1: triangles(a + b, c) + triangles(abs(a - b), c),
        2: triangles(b + c, a) + triangles(abs(b - c), a),
    }
    return {number: points for number, points in found.items() if points}


def test_open_classes_are_named_by_their_numbers():
    """Many classes are open for one reason; their types, one after the other, fill pages."""
    late = [(kind.types, "late") for kind in reversed(feasible_classes(3))]
    named = {kind.types for kind in feasible_classes(3) if 4 <= kind.number <= 6}
    some = tuple(pair for pair in late if pair[0] in named)
    found = Design(singsym.load("fourbar"), ("a",), Borders((), some, "proven"), (), ())
    assert gathered(found.open_questions()) == (("whether constant over the cells: class 4 to 6", "late"),)
    assert "constant (proven)" in proof_text(found)
    found = replace(found, borders=Borders((), tuple(late), "proven"))
    assert proof_text(found).startswith("No class is proven to be constant")


@pytest.mark.engines
def test_each_cell_of_a_four_bar_has_the_table_that_triangles_give():
    found = singsym.design(singsym.load("fourbar").with_parameters(g=1), ["a", "b"], cache=False)
    assert not list(found.open_questions())
    tables = set()
    for cell in found.cells:
        a, b = (Fraction(str(cell.sample[name])) for name in ("a", "b"))
        expected = grashof(Fraction(1), a, b, Fraction(3))
        points = {number: count for number, _, _, count, _ in cell.entries}
        assert points == ({0: None} if expected is None else expected)
        tables.add(cell.entries)
    # between two cells it can lie flat in one way, and has the other triangles too.  With d = a - b these are
    # a + b = 2; a + b = 4 with d < -2, between and d > 2; d = +-2 with a + b < 4 and > 4; d = +-4
    assert len(found.values) == 1 + 3 + 2 * 2 + 2
    for cell in found.values:
        a, b = (Fraction(str(cell.sample[name])) for name in ("a", "b"))
        assert {name: count for name, _, _, count, _ in cell.entries} == {
            **(grashof(Fraction(1), a, b, Fraction(3)) or {}),
            8: 1,
        }
        assert " = 0 between cells " in cell.where
    assert {row["constant"] for row in found.rows() if "between" in row["where"]} == {False}
    # double rocker by the coupler, crank-rocker, drag link, the two triple rockers' table, not put together
    assert len(tables) == 5
    assert len({cell.signs for cell in found.cells}) == len(found.cells)
    picture = found.plot()
    assert "cell 1: " in picture.description
    assert "<svg" in picture.svg()


def test_one_length_of_a_four_bar_by_hand():
    found = singsym.design(singsym.load("fourbar"), ["a"], cache=False)
    assert [cell.where for cell in found.values] == [f"a = {x}/2" for x in (5, 7, 9, 21)]
    for cell in found.cells:
        expected = grashof(Fraction(4), Fraction(str(cell.sample["a"])), Fraction(7, 2), Fraction(3))
        points = {number: count for number, _, _, count, _ in cell.entries}
        assert points == ({0: None} if expected is None else expected)
    for cell in found.values:  # it can lie flat there, in one way
        assert (8, "yes", 0, 1, 1) in cell.entries
    rows = found.rows()
    assert {row["constant"] for row in rows} == {True}
    assert found.latex().count(r"\left(") == 4


@pytest.mark.engines
def test_the_borders_of_a_slider_crank_with_offset():
    # it can lie flat, across the slide, where e = +-r +- l with l = 3; besides only a crank of no length
    found = factors(singsym.loads(OFFSET), "r", "e")
    R = Ring(("r", "e"))
    r, e = R.gens
    assert found == {str((3 + s * r + t * e).primitive()) for s, t in product((1, -1), repeat=2)} | {"r"}


def test_what_limits_cut_is_a_border():
    # the slide's length is positive: of the two dead centres of r > l one is on the other side
    found = singsym.design(singsym.load("slider-crank"), ["r"], cache=False)
    assert [(cell.where, cell.entries[0][3]) for cell in found.cells] == [("0 < r < 3", 2), ("3 < r", 2)]


@pytest.mark.engines
def test_the_borders_of_a_five_bar_are_circles_that_touch():
    # C is l2 - l1 to l2 + l1 from A, and 1 to 5 from E, which is 1 from A: the circles about A and E touch
    # where a radius of the former is 1 +- 1 or 5 +- 1; borders of no length have nothing real in the ranges
    found = real_family("five-bar", "l1", "l2")
    R = Ring(("l1", "l2"))
    one, two = R.gens
    differences = {str((one - two + k).primitive()) for k in (0, 2, -2, 4, -4, 6, -6)}
    assert found == differences | {str(one + two - k) for k in (2, 4, 6)}


@pytest.mark.engines
def test_the_borders_of_the_papers_linkage_over_one_length():
    # C is 2 from D, and at most 2 from A; so where the four-bar linkage is flat C = (-1, 0), or A, B, C are
    # in line and C = (1/2, +-sqrt(15)/2), which are 3 and sqrt(6) from E.  The chain C, G, F, E is flat
    # where that is a sum or a difference of 3/2, r and 3.
    found = borders(two_dof())
    assert not found.open
    assert found.certainty == "proven"
    mobile = singsym.SingularityType.named("RI, RO, IO, IIM")
    r = Ring(("FG",)).gens[0]
    flat = {r - Fraction(3, 2), r - Fraction(9, 2), r - Fraction(15, 2)}
    in_line = {(r + s * (3 + t * Fraction(3, 2))) ** 2 - 6 for s, t in product((1, -1), repeat=2)}
    special = {p.polynomial for p in found.parts if (mobile, "only there") in p.reasons}
    assert special == {p.primitive() for p in flat | in_line}


def common_points(r: float) -> dict[int, int]:
    """Points of classes 3 and 4 of the paper's linkage with FG = r, from triangles alone.

    (4): B, C, D in line, so C = (0, +-sqrt(3)), or C, G, F.  (5): D, C, G, or A, B, C, so that
    C = (1/2, +-sqrt(15)/2), or E, F, G.  With B, C, D and D, C, G in line both pairs of ends are at rest (4).
    Where all of C, G, F, E or of D, C, G, F are in line the two B are there if |AC| < 2.
    """

    def two(side: float, one: float, other: float) -> int:
        return 2 * (abs(one - other) < side < one + other)

    four = three = 0
    for s in (1, -1):
        x, y = s * 3 / 4, sqrt(3) * (1 - s * 3 / 4)  # G on the line from C = (0, sqrt(3)) to D = (1, 0)
        four += 2 * two(hypot(x - 2, y), r, 3)
        three += 2 * two(sqrt(7), 3 / 2, abs(3 + s * r)) + 2 * two(sqrt(6), abs(3 / 2 + s * r), 3)
        for t in (1, -1):
            far = 2 + s * 3 / 2 + t * r  # F from D, on the circle of radius 3 about E
            three += 4 * (2 < abs(far) < 4 and (far**2 / 2 - 4) / far < -1 / 4)
            three += 4 * (6 < (3 + s * 3 / 2 + t * r) ** 2 < 9)  # C from E
    return {3: three, 4: four}


@pytest.mark.engines
@pytest.mark.parametrize("length", ["57/64", "73/64", "17/4"])
def test_points_of_the_papers_linkage_by_hand(length):
    found = singsym.classify(singsym.load("zlatanov-2dof").with_parameters(FG=length), cache=False)
    points = {c.singularity_class.number: c.points for c in found.classes if c.verdict.is_yes}
    assert not found.undecided
    assert {number: points.get(number, 0) for number in (3, 4)} == common_points(float(Fraction(length)))


def two_dof() -> Family:
    return family(singsym.load("zlatanov-2dof").with_parameters(FG=None), "auto", Runner())


def real_family(name: str, *parameters: str) -> set[str]:
    """The borders with real configurations over them."""
    own = family(singsym.load(name).with_parameters(**dict.fromkeys(parameters)), "auto", Runner())
    found = real_borders(own, borders(own))
    assert not found.open
    assert found.certainty == "proven"
    return {str(part.polynomial) for part in found.parts}


def test_a_root_of_a_quartic_is_put_in():
    # det = d4 (d3 + d4 c3)(...): the first factor's zeros fall together at d3 = d4 = 3/2
    found = singsym.design(singsym.load("orthogonal-3r"), ["d3"], cache=False)
    assert not found.undecided
    assert "d3 = 3/2" in {cell.where for cell in found.values}
    quartic = next(cell for cell in found.values if cell.where == "d3 = 0.58039...")
    assert quartic.entries == found.cells[0].entries
    assert "a root of 4*d3^4" in sample_text(quartic)


def test_a_hyperbola_leaves_three_cells():
    x, y = Ring(("x", "y")).gens
    assert len(Plane(("x", "y"), (x * y - 1,)).components) == 3
    assert len(Plane(("x", "y"), (x**2 + y**2 - 1, x - y)).components) == 4


def test_parameters_that_cannot_be_varied():
    mechanism = singsym.load("fourbar")
    with pytest.raises(singsym.MechanismError, match="one or two parameters; of more, samples: --values, or"):
        singsym.design(mechanism, ["a", "b", "c"])
    with pytest.raises(
        singsym.MechanismError, match="found AB; expected nothing, as it has no parameters; a dim"
    ):
        singsym.design(singsym.load("pentagon"), ["AB"])
    with pytest.raises(singsym.MechanismError, match="a value, as it is not one of those"):
        singsym.design(mechanism.with_parameters(c=None), ["a"])


class Inline(Executor):
    """Calls are made at once, in this process."""

    def submit(self, fn, /, *args, **kwargs):
        future = Future()
        future.set_result(fn(*args, **kwargs))
        return future


def test_samples_that_are_open_have_what_others_leave_of_the_clock(monkeypatch):
    # a third of 900 s for each at first; the one that needs 400 s is asked again, with all that is left
    decided, asked = SimpleNamespace(undecided=False), []

    def fake(sample):
        (a,) = (p.value for p in sample.mechanism.parameters if p.name == "a")
        asked.append((str(a), round(sample.limits.clock, -1)))
        return Sampled(decided if str(a) != "2" or sample.limits.clock > 400 else None, "no time")

    monkeypatch.setattr("singsym.designs.sampling.sampled", fake)
    values, limits = [{"a": a} for a in (1, 2, 3)], singsym.Limits(clock=900.0)
    found = at_samples(singsym.load("fourbar"), values, "auto", limits, 1, Inline(), False)
    assert [own.classification for own in found] == [decided] * 3
    assert asked == [("1", 300), ("2", 300), ("3", 300), ("2", 900)]


def test_a_sample_without_a_classification_is_no_sample_without_singularities():
    # in the chart too: what is open is hatched, and not white
    found = singsym.design(singsym.load("fourbar"), ["a"], cache=False)
    first, *others = found.cells
    doubt = ((singsym.SingularityType.named("RI, IO"), "too long"),)
    unsure = replace(found.borders, open=doubt)
    partly = replace(
        found, cells=(replace(first, classification=None, reason="no time"), *others), borders=unsure
    )
    said = partly.plot().description
    assert "0 < a < 5/2: open: not classified in time" in said
    assert "no singularity" not in said
    assert said.endswith("not proven for whole cells: 1 kind of singularity.")
    assert "<pattern" in partly.plot().svg()
    assert len(partly.tables()) == len(found.tables()) - 1


def test_a_sweep_has_a_row_for_each_class_and_sample():
    rows = singsym.sweep(singsym.load("fourbar"), {"a": [1, 20], "b": ["7/2"]}, cache=False)
    assert [(row["a"], row["class"], row["verdict"]) for row in rows] == [("1", 1, "yes"), ("20", None, "no")]


def test_a_sweep_stays_within_ranges():
    # a = 0 above 0 is none: the crank would be a point, and every turn of it a configuration
    with pytest.raises(singsym.MechanismError, match=r"the value -1; expected a value above 0\n.* 0;"):
        singsym.sweep(singsym.load("fourbar"), {"a": [-1, 0, 1]}, cache=False)


def test_a_chart_of_many_cells_has_room_for_all_that_is_written():
    """Twenty cells, half of them narrow, each with a table of its own."""
    import matplotlib.pyplot as plt

    found = singsym.design(singsym.load("fourbar"), ["a"], cache=False)
    ends = [float(k) if k < 10 else 10 + (k - 10) / 50 for k in range(1, 20)]
    cells = []
    for k, place in enumerate([0.5, *(end + 0.001 for end in ends)]):
        cell = replace(found.cells[0], sample={"a": sympy.Float(place)}, where=f"cell {k}")
        cell.__dict__["entries"] = ((1, "yes", 0, k + 1, k + 1),)
        cells.append(cell)
    values = [replace(found.values[0], sample={"a": sympy.Float(x)}, about=x) for x in ends]
    figure = replace(found, cells=tuple(cells), values=tuple(values)).plot().figure
    figure.draw_without_rendering()
    (axes,), (legend,) = figure.axes, figure.legends
    assert len(legend.get_texts()) == 20
    assert legend.get_window_extent().y1 < axes.get_window_extent().y0
    for written in (axes.texts, axes.get_xticklabels()):
        spans = sorted((box.x0, box.x1) for box in (text.get_window_extent() for text in written))
        assert len(spans) > 8
        assert all(one[1] < two[0] for one, two in pairwise(spans))
    plt.close(figure)
