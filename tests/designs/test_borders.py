"""Borders of families that are written down as equations, against what can be seen of them.

Source: each by hand.
"""

from singsym.classes.running.runner import Runner
from singsym.classes.strata.branches import Branch
from singsym.classes.strata.ranks import RankProblem
from singsym.classes.strata.reflections import reflections
from singsym.classes.strata.search import search
from singsym.classes.strata.start import feasible_set
from singsym.designs.borders import borders
from singsym.designs.families import Family
from singsym.effort.budget import Undecided
from singsym.kinematics.placement import ConfigurationSpace
from singsym.polynomials import Equations, Polynomial, PolynomialMatrix, Ring


def family_of(equations: Equations, locus: Polynomial, *excluded: Polynomial) -> Family:
    """Of the zeros of equations in x and y over a; L_O, with one entry, is singular on a locus."""
    ring, exclusions = locus.ring, tuple((p,) for p in excluded)
    space = ConfigurationSpace(ring, equations, exclusions, parameters=("a",))
    rows = {"L": [ring.one, locus, ring.one], "L_I": [ring.one], "L_O": [locus], "L_p": [ring.one]}
    matrices = {name: PolynomialMatrix.of(ring, [row]) for name, row in rows.items()}
    problem, feasible = RankProblem(matrices, 0, 1, 1), feasible_set(space)
    kept = reflections(feasible, space.equations, matrices.values())
    symmetries = tuple(r for r in kept if "a" not in r)
    root = Branch(problem, feasible, space.equations, symmetries=symmetries)
    return Family(space, search(root, Runner()))


def test_where_a_stratum_meets_its_mirror_image_is_a_border():
    # the points x = a and x = -a of a circle: four for -1 < a < 1, but two for a = 0
    ring = Ring(("x", "y", "a"))
    x, y, a = ring.gens
    found = family_of((x**2 - a**2, x**2 + y**2 - 1), ring.zero)
    assert [part.images for part in found.exploration.found] == [((), ("x",))]
    assert {str(part.polynomial) for part in borders(found).parts} == {"a", "a - 1", "a + 1"}


def test_where_all_configurations_are_excluded_is_a_border():
    # x = a on a circle, without x = 0: two configurations for -1 < a < 1, but none for a = 0
    ring = Ring(("x", "y", "a"))
    x, y, a = ring.gens
    found = borders(family_of((x - a, x**2 + y**2 - 1), ring.one, x))
    assert {str(part.polynomial) for part in found.parts} == {"a", "a - 1", "a + 1"}


def test_walls_that_were_found_before_a_stratum_came_to_no_end_are_borders(monkeypatch):
    # x^2 = a - 1 on a circle: its folds are a = 1 and a = 2, where x = 0 and y = 0; exclusions come last
    ring = Ring(("x", "y", "a"))
    x, y, a = ring.gens

    def withheld(*_: object) -> None:
        raise Undecided("withheld")

    monkeypatch.setattr("singsym.designs.borders._Walls._off", withheld)
    found = borders(family_of((x**2 - a + 1, x**2 + y**2 - 1), ring.one, y - 3))
    assert {str(part.polynomial) for part in found.parts} == {"a - 1", "a - 2"}
    assert "withheld" in {reason for _, reason in found.open}
