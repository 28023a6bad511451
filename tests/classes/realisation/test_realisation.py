"""Configurations as decimals: angles of pi are pi, and the error bound is small."""

from __future__ import annotations

from dataclasses import replace
from math import isclose, pi

import pytest

from singsym.classes.classify import classify
from singsym.classes.realisation import realisation
from singsym.classes.realisation.alike import AlikeTask, realise_alike
from singsym.classes.realisation.certified_configuration import Names
from singsym.classes.realisation.curve_components import CurveTask, count, counted_in_one_way
from singsym.classes.realisation.realisation import Realised, RealTask
from singsym.classes.result import Piece
from singsym.classes.strata.branches import Found
from singsym.classes.strata.ranks import Stratum
from singsym.classes.taxonomy.types import Defects
from singsym.classes.taxonomy.types import SingularityType as T
from singsym.effort.budget import Undecided
from singsym.effort.verdict import Known, Verdict
from singsym.elimination.ideal import Ideal
from singsym.mechanism import load
from singsym.polynomials import Equations, Polynomial, Ring
from singsym.varieties.real.dimension.extent import Extent
from singsym.varieties.real.system import RealSystem


def realise(task: RealTask) -> Realised:
    """What a stratum comes to by itself."""
    (alone,) = realise_alike(AlikeTask(task)).parts
    return alone


def test_an_extended_joint_has_its_angle_and_a_small_error() -> None:
    """Where A, B, C are in line with B between, B is straight; with B outside it is folded by pi."""
    dead = classify(load("slider-crank"), cache=False)[T.RI | T.IO]
    assert len(dead.witnesses) == 2
    for witness in dead.witnesses:
        assert float(witness.radius) < 1e-12
    bends = sorted(abs(float(w.joints["B"])) for w in dead.witnesses)
    assert bends[0] == 0
    assert isclose(bends[1], pi, rel_tol=1e-12)


def test_a_stratum_below_a_known_dimension_is_left() -> None:
    """The circle x^2 + y^2 = 1 is a curve: what is known to have a surface is not looked at again."""
    ring = Ring(("x", "y"))
    x, y = ring.gens
    circle = Found((), Stratum((x**2 + y**2 - 1,), Defects(0, 0, 0, 0)))
    task = RealTask(circle, RealSystem(ring, ()), Names())
    (seen,) = realise(task).pieces
    (left,) = realise(replace(task, known=2, seen=True)).pieces
    (unseen,) = realise(replace(task, known=2)).pieces
    (looked_at,) = realise(replace(task, known=0)).pieces
    assert (seen.dimension, unseen.dimension, looked_at.dimension) == (1, 1, 1)
    assert (left.dimension, left.extent.at_most, left.verdict.is_undecided) == (None, 2, True)


def test_a_larger_part_of_a_set_is_found_in_a_second_look() -> None:
    """x y = x z = 0 is a line and a plane: known as a line, it is looked at for something larger."""
    ring = Ring(("x", "y", "z"))
    x, y, z = ring.gens
    both = Found((), Stratum((x * y, x * z), Defects(0, 0, 0, 0)))
    (piece,) = realise(RealTask(both, RealSystem(ring, ()), Names(), most=2, known=1, seen=True)).pieces
    assert (piece.dimension, piece.verdict.is_yes) == (2, True)


def test_what_is_known_of_one_part_stays_where_another_is_left_open(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two points and two circles, x = 1 or x = 3; of the circles nothing is found out."""
    ring = Ring(("x", "y", "z"))
    x, y, z = ring.gens
    whole = ((x - 1) * (x - 3), (x - 1) * z, y**2 + z**2 - 1)
    circle = (x - 3, y**2 + z**2 - 1)
    given = realisation.disjoint_parts
    monkeypatch.setattr(
        realisation, "disjoint_parts", lambda e: [(x - 1, z, y**2 - 1), circle] if e == whole else given(e)
    )
    monkeypatch.setattr(realisation, "numerical_codimension", never)
    found = Found((), Stratum(whole, Defects(0, 0, 0, 0)))
    (piece,) = realise(RealTask(found, RealSystem(ring, ()), Names(), most=2)).pieces
    assert piece.verdict.is_yes
    assert (piece.extent.at_least, piece.extent.at_most, piece.dimension) == (0, 2, None)
    assert piece.extent.open == "not in time"


def never(*_: object) -> None:
    """What is never known in time."""
    raise Undecided("not in time")


def test_a_set_within_its_border_alone() -> None:
    """x >= 1 leaves one point of the circle and of the sphere, x^2 >= 1 two, x >= 0 >= x a great circle."""
    x, y = Ring(("x", "y")).gens
    X, Y, Z = Ring(("x", "y", "z")).gens
    circle, sphere = x**2 + y**2 - 1, X**2 + Y**2 + Z**2 - 1
    found = []
    for surface, nonnegative in (
        (circle, (x - 1,)),
        (circle, (x**2 - 1,)),
        (circle, (x, -x)),
        (circle, (x,)),
        (sphere, (X - 1,)),
        (sphere, (X, -X)),
    ):
        stratum = Found((), Stratum((surface,), Defects(0, 0, 0, 0)))
        (piece,) = realise(
            RealTask(stratum, RealSystem(surface.ring, (), nonnegative=nonnegative), Names())
        ).pieces
        found.append((piece.dimension, piece.points))
    assert found == [(0, 1), (0, 2), (0, 2), (1, None), (0, 1), (1, None)]


@pytest.mark.engines
def test_a_dimension_bounded_modulo_a_prime(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where no Groebner basis ends, random hyperplanes bound it: of a curve by 2, but not by 0."""

    class Endless(Ideal):
        @property
        def dimension(self) -> Known[int]:
            raise Undecided("takes too long")

    monkeypatch.setattr("singsym.classes.realisation.dimension_bounds.Ideal", Endless)
    monkeypatch.setattr("singsym.classes.realisation.dimension_bounds.is_dimension_at_most", lambda *_: False)
    monkeypatch.setattr(
        "singsym.classes.realisation.upper_bounds.is_dimension_at_most", lambda *_: Known(False)
    )
    ring = Ring(("x", "y", "z"))
    x, y, z = ring.gens
    circle = Found((), Stratum((x**2 + y**2 - 1, z - x * y), Defects(0, 0, 0, 0)))
    task = RealTask(circle, RealSystem(ring, ()), Names())
    (bounded,) = realise(replace(task, known=2, seen=True)).pieces
    assert (bounded.extent.at_most, bounded.extent.bounded, bounded.dimension) == (2, "modular", None)
    (seen,) = realise(replace(task, known=0)).pieces
    assert (seen.dimension, seen.extent.bounded) == (1, "modular")


def test_a_real_curve_of_complex_surfaces_is_not_counted() -> None:
    """The real zeros of x^2 + y^2 in space are a line, the complex ones two planes."""
    x, y, _ = Ring(("x", "y", "z")).gens
    counted = count(CurveTask(((x**2 + y**2,),), ((),)))
    assert counted.components is None
    assert "dimension 2" in counted.reason


def test_two_circles_of_one_set_have_numbers_where_they_do_not_meet() -> None:
    """Of radius 1 about (0, 0) and about (1, 0), nearer than 2: in one plane, in two, and of two sets."""
    x, y, z = Ring(("x", "y", "z")).gens
    first = Piece((), (x**2 + y**2 - 1, z), (), Defects(1, 0, 0, 0), Verdict.yes("proven"), Extent(1, 1))

    def numbers(*basis: Polynomial, path: Equations = ()) -> list[int | None]:
        one, other = (replace(first, components=1), replace(first, basis=basis, path=path, components=1))
        return [piece.components for piece in counted_in_one_way([one, other])]

    assert numbers((x - 1) ** 2 + y**2 - 1, z) == [None, None]
    assert numbers((x - 1) ** 2 + y**2 - 1, z - 1) == [1, 1]
    assert numbers((x - 1) ** 2 + y**2 - 1, z, path=(x,)) == [1, 1]
