"""The conditions of the 2-DOF linkage against section 3.3 of Zlatanov, Fenton, Benhabib (1998)."""

import pytest

from singsym.conditions.conditions import LABELS, Conditions
from singsym.conditions.conditions import conditions as conditions_of
from singsym.conditions.named_quantities import PointNames
from singsym.kinematics.nonzero import Certifier
from singsym.kinematics.placement import ConfigurationSpace
from singsym.kinematics.reduction import reduce
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import load
from singsym.polynomials import Polynomial, Ring
from tests.kinematics.two_dof import collinear, two_dof


@pytest.fixture(scope="module")
def conditions() -> Conditions:
    equation = two_dof()
    return Conditions(equation, reduce(equation))


@pytest.mark.parametrize(
    ("label", "triples"), [("vii", ["BCD", "CFG"]), ("viii", ["ABC", "CDG", "EFG"]), ("4", ["BCD", "CFG"])]
)
def test_determinants_are_products_of_collinearities(
    conditions: Conditions, label: str, triples: list[str]
) -> None:
    """(vii) iff [BCD][CGF] = 0, (viii) iff [ABC][CDG][EFG] = 0."""
    factors = conditions[label].factors
    assert {f.polynomial for f in factors} == {collinear(*t).primitive() for t in triples}
    assert {f.words for f in factors} == {f"{t[0]}, {t[1]}, {t[2]} collinear" for t in triples}
    assert all(f.multiplicity == 1 for f in factors)


def test_redundant_passive_motion_needs_two_collinear_triples(conditions: Conditions) -> None:
    (both,) = conditions["iii"].alternatives or ()
    assert {f.words for f in both} == {"B, C, D collinear", "C, D, G collinear"}


def test_increased_mobility(conditions: Conditions) -> None:
    """From (6): both loops' remaining rows, [ABC] [BCD] and [CGE] [CDG] [CFG], become dependent."""
    found = {frozenset(f.words[:7] for f in a) for a in conditions["vi"].alternatives or ()}
    assert found == {
        frozenset({"A, B, C", "B, C, D"}),
        frozenset({"C, E, G", "C, D, G", "C, F, G"}),
        frozenset({"A, B, C", "C, E, G", "C, F, G"}),
    }


def test_labels_statements_and_comparisons(conditions: Conditions) -> None:
    assert tuple(c.label for c in conditions) == LABELS
    assert conditions["i"].statement == "rank L_O < rank L_p + 2"
    assert conditions["iv"].statement == "rank L_I < rank L"
    assert conditions["vi"].statement == "rank L < 8"
    assert conditions["iii"].statement == "rank L_p < 6"
    with pytest.raises(KeyError, match="the paper has 4, 5, i"):
        conditions["ix"]


def test_latex(conditions: Conditions) -> None:
    text = conditions["vii"].latex()
    assert r"\det[S_{B}\, S_{C}\, S_{D}] = " in text
    assert "x_{B} y_{C}" in text
    assert text.count("&") == text.count("\\\\") + 1


def test_the_library_file_gives_the_conditions_of_the_matrix_by_hand(conditions: Conditions) -> None:
    """Other loops and columns, the same determinants of points."""
    found = conditions_of(velocity_equation(load("zlatanov-2dof")))
    for label in ("vii", "viii"):
        assert {f.words for f in found[label].factors} == {f.words for f in conditions[label].factors}
    (both,) = found["iii"].alternatives or ()
    assert {f.words for f in both} == {"B, C, D collinear", "C, D, G collinear"}


@pytest.fixture(scope="module")
def hybrid() -> Conditions:
    return conditions_of(velocity_equation(load("zlatanov-hybrid")))


def test_hybrid_chain_reduces_to_the_papers_equation_9(hybrid: Conditions) -> None:
    """18x24 to 9x15 by the nine spins; what stays passive is w1 of B and w1, w2 of C (section 5.2)."""
    assert hybrid.equation.matrix.shape == (18, 24)
    assert hybrid.reduction.constant == 9
    assert hybrid.reduction.equation.matrix.shape == (9, 15)
    passive = [c.label for c in hybrid.reduction.equation.columns if c.role == "passive"]
    assert passive == ["B1", "C1", "C2"]


def test_hybrid_chain_legs(hybrid: Conditions) -> None:
    """(13): each leg has its point on the vertical axis, or is extended (folded is excluded)."""
    ring = hybrid.equation.space.ring
    expected = set()
    for leg in "ABC":
        c, s, d, t = (ring.gen(f"{f}_{leg}{k}") for k in ("2", "23") for f in "cs")
        expected |= {c + d, (s * d - c * t).primitive()}
    assert {f.polynomial for f in hybrid["viii"].factors} == expected


def test_hybrid_chain_passive_motion_and_redundant_output(hybrid: Conditions) -> None:
    """(11): B or C on its first axis; (4): or AB across m1 of B, or C0 in plane ABC (section 5.3, step 4)."""
    ring = hybrid.equation.space.ring
    on_axis = {ring.gen(f"c_{leg}2") + ring.gen(f"c_{leg}23") for leg in "BC"}
    assert {a for (a,) in hybrid["iii"].polynomials} == on_axis
    assert [block.width for block in hybrid.rank_blocks("L_p").blocks] == [1, 2]
    factors = hybrid["vii"].factors
    assert on_axis < {f.polynomial for f in factors}
    assert {f.words for f in factors if f.name} >= {"A, B, C, C0 coplanar"}
    assert len(factors) == 4
    assert hybrid["vi"].alternatives is None
    assert "not written out" in str(hybrid["vi"])


def test_a_polynomial_that_is_no_determinant_of_points_gets_no_name() -> None:
    ring = Ring(("x", "y"))
    x, y = ring.gens
    points = {"A": (ring.zero, ring.zero), "B": (ring.one, ring.zero), "C": (x, y)}
    names = PointNames(Certifier(ConfigurationSpace(ring, (), points=points)))
    assert names.recognise(x**2 + y**2 - 1) is None
    assert names.recognise(x) is None
    found = names.recognise(y)
    assert found is not None
    assert found.quantity.words == "A, B, C collinear"


def test_four_points_in_a_plane_and_a_link_across_an_axis() -> None:
    ring = Ring(("x", "y", "z"))
    x, y, z = ring.gens
    o, one = ring.zero, ring.one
    points = {"A": (o, o, o), "B": (one, o, o), "C": (o, one, o), "D": (x, y, z)}
    axes = {"u": (one, one, o)}
    names = PointNames(Certifier(ConfigurationSpace(ring, (), points=points, directions=axes)))
    for polynomial, words in [(z, "A, B, C, D coplanar"), (x + y, "AD perpendicular to axis u")]:
        found = names.recognise(polynomial)
        assert found is not None
        assert found.quantity.words == words


def test_a_long_factor_is_not_squared_where_no_length_could_be_its_root() -> None:
    """In the plane no name is a length, and the square of a minor with thousands of terms has millions."""
    ring = Ring(("x", "y"))
    x, y = ring.gens
    points = {"O": (ring.zero, ring.zero), "A": (ring.one, ring.zero), "B": (x, y)}
    seen = []

    class Counting(Certifier):
        def normal_form(self, polynomial: Polynomial) -> Polynomial:
            seen.append(polynomial.total_degree)
            return super().normal_form(polynomial)

    names = PointNames(Counting(ConfigurationSpace(ring, (), points=points)))
    assert names.recognise((x + y + 1) ** 9 + x) is None
    assert max(seen) == 9
