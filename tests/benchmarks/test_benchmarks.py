"""The benchmarks' command runs, and counts what it says; nothing is timed."""

from __future__ import annotations

import json
from math import inf

import pytest

from singsym.effort.budget import BudgetExceeded, current
from singsym.elimination import engines
from singsym.elimination.basis import groebner_basis
from singsym.elimination.memo import forget
from singsym.mechanism import load
from singsym.polynomials import Ring
from singsym.varieties.real.points.boxed_point import boxed_point
from tests.benchmarks import measures
from tests.benchmarks.__main__ import BASELINE, beside, main, row
from tests.benchmarks.cases import mechanism
from tests.benchmarks.counting import BOXES, ENGINES, NEWTON, counted
from tests.benchmarks.measures import Measured

RING = Ring(("x", "y"))
x, y = RING.gens


def test_one_mechanism(capsys: pytest.CaptureFixture[str]) -> None:
    """A small one, by the command: it has a row, in which a point was boxed after Newton steps."""
    assert main(["slider-crank"]) == 0
    headers, _, cells, *_ = capsys.readouterr().out.splitlines()
    assert cells.startswith("slider-crank ")
    for what in (NEWTON, BOXES):
        assert int(cells[headers.index(what) :].split()[0]) > 0


def test_engines_are_counted_and_set_free_again() -> None:
    forget()
    with counted() as counts, engines.use("flint"):
        groebner_basis(RING, [x**2 + y**2 - 1, x * y - 1])
        groebner_basis(RING, [x**2 + y**2 - 1, x * y - 1])
    assert counts == {"flint": 1}
    forget()
    with engines.use("flint"):
        groebner_basis(RING, [x**2 + y**2 - 1, x * y - 1])
    assert counts == {"flint": 1}


def test_steps_and_boxes_are_counted() -> None:
    """From the solution itself one step says that it is one, and one test proves it."""
    with counted() as counts:
        boxed_point(RING, [x - 2, y - 3], {}, (2.0, 3.0))
        boxed_point(RING, [x - 2, y - 3], {}, (2.0, 3.0))
    assert counts == {NEWTON: 2, BOXES: 2}


@pytest.mark.parametrize(
    ("value", "before", "shown"),
    [(30, 20, "30 (1.50)"), (2.514, None, "2.51"), (0, 0, "0"), (3, 0, "3 (0 before)"), (0, 4, "0 (0.00)")],
)
def test_ratios_to_the_baseline(value: float, before: float | None, shown: str) -> None:
    assert beside(value, before) == shown


def test_a_row_has_each_count_beside_that_of_the_baseline() -> None:
    found = Measured({"flint": 3, NEWTON: 10}, 2.0, True, {"singular": "< 0.1"})
    kept = {"counts": {"flint": 2, NEWTON: 10, BOXES: 4}, "work": 4.0}
    engines_cells = ("3 (1.50)", *("0" for _ in ENGINES[1:]))
    counts = (*engines_cells, "10 (1.00)", "0 (0.00)")
    assert row("it", found, kept) == ("it", *counts, "2.00 (0.50)", "", "< 0.1", "yes")


@pytest.mark.parametrize(
    ("own", "other", "shown"),
    [(1.0, 4.0, "0.25"), (1.0, inf, "< 0.05"), (inf, 4.0, "> 5"), (inf, inf, "both open")],
)
def test_ratios_to_an_engine(own: float, other: float, shown: str) -> None:
    """Where one side gave up after 20 s the ratio is bounded by what the other needed."""
    assert measures._ratio(own, other) == shown


def test_a_side_that_does_not_end_is_infinite() -> None:
    def endless() -> None:
        raise BudgetExceeded("no time is left")

    assert measures._work(endless) == inf
    assert measures._work(lambda: current().check()) < inf


def test_an_engine_that_is_not_there_is_not_compared() -> None:
    with engines.use("flint"):
        assert measures._compared(load("slider-crank")) == {}


@pytest.mark.engines
def test_loci_of_points_are_compared_with_msolve() -> None:
    assert set(measures._compared(load("slider-crank"))) == {"msolve"}


def test_the_reference_is_the_basis_of_a_zero_dimensional_ideal() -> None:
    """Katsura-2 in three unknowns has four complex points: the leading monomials leave four others."""
    found = measures.katsura(2).autoreduction()
    leading = [p.monoms()[0] for p in found]
    box = [(i, j, k) for i in range(5) for j in range(5) for k in range(5)]
    below = [m for m in box if not any(all(a <= b for a, b in zip(l, m, strict=True)) for l in leading)]
    assert len(below) == 4


def test_the_baseline_has_mechanisms_that_there_are() -> None:
    kept = json.loads(BASELINE.read_text())
    assert kept
    assert all(mechanism(name).joints for name in kept)
