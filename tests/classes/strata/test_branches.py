"""Branches of the search for strata, and the same answer on every executor."""

from __future__ import annotations

import functools
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import pytest

from singsym.classes import classify as module
from singsym.classes.classify import classify
from singsym.classes.realisation import alike
from singsym.classes.realisation.certified_configuration import Names
from singsym.classes.realisation.realisation import RealTask
from singsym.classes.result import Classification
from singsym.classes.running.runner import Runner
from singsym.classes.strata import branches as explore_module
from singsym.classes.strata.branches import Branch, Explored, explore, split_product
from singsym.classes.strata.ranks import RankProblem
from singsym.classes.strata.search import search
from singsym.classes.taxonomy.types import feasible_classes
from singsym.effort.verdict import Known, Verdict
from singsym.mechanism import load
from singsym.output.plain_data import classification_data
from singsym.polynomials import PolynomialMatrix, Ring
from singsym.varieties.real.numerical.sampling import numerical_points
from singsym.varieties.real.system import RealSystem


def plain(result: Classification) -> dict[str, object]:
    """All that a classification says, without its time."""
    return {key: value for key, value in classification_data(result).items() if key != "seconds"}


@pytest.fixture(scope="module")
def reference() -> dict[str, object]:
    return plain(classify(load("change-point"), cache=False))


def test_powers_and_products_are_split() -> None:
    x, y, z = Ring(("x", "y", "z")).gens
    assert split_product(((x + y) ** 2 * z,)) in ([(x + y,), (z,)], [(z,), (x + y,)])
    assert split_product((x * y, z)) == [(x * y, z)]


def test_numerical_points_lie_on_the_set() -> None:
    ring = Ring(("x", "y"))
    x, y = ring.gens
    found = numerical_points(RealSystem(ring, (x**2 + y**2 - 4,)))
    assert len(found) == 3
    assert all(abs(a * a + b * b - 4) < 1e-9 for a, b in found)


def test_numerical_points_within_a_narrow_range() -> None:
    """Random starts are hardly ever there: the inequalities are among the equations, with slack."""
    ring = Ring(("x", "y"))
    x, y = ring.gens
    found = numerical_points(RealSystem(ring, (x - y**2,), positive=(10 * x - 200, 201 - 10 * x)))
    assert len(found) == 3
    assert all(20 < a < 20.1 for a, _ in found)


def test_numerical_points_of_an_empty_set() -> None:
    ring = Ring(("x",))
    assert numerical_points(RealSystem(ring, (ring.gens[0] ** 2 + 1,))) == ()


def test_a_point_of_two_patches_is_counted_once() -> None:
    """On x y = 0 with L_I = (x), L_O = (y), L = (x y): the lines meet in the one point where L is zero."""
    ring = Ring(("x", "y"))
    x, y = ring.gens
    row = PolynomialMatrix.of(ring, [[x, y]])
    parts = {name: row.select(columns=c) for name, c in (("L_I", [0]), ("L_O", [1]), ("L_p", []))}
    plane = RealSystem(ring, ())
    root = Branch(RankProblem({"L": row, **parts}, 0, 1, 1), plane, (x * y,))
    found = [part for part in search(root, Runner()).found if part.stratum.defects.delta]
    assert len(found) == 2
    tasks = [RealTask(part, plane, Names()) for part in found]
    pieces = [
        p for task in tasks for part in alike.realise_alike(alike.AlikeTask(task)).parts for p in part.pieces
    ]
    assert sum(piece.points or 0 for piece in pieces) == 1


@pytest.mark.parametrize("symmetries", [((),), ((), ("u", "v"))])
def test_parts_that_are_images_are_searched_once(symmetries: tuple[tuple[str, ...], ...]) -> None:
    """The same on u = v = 1 and on u = v = -1: one point each, of two patches, and nothing else."""
    ring = Ring(("x", "y", "u", "v"))
    x, y, u, v = ring.gens
    row = PolynomialMatrix.of(ring, [[x, y]])
    parts = {name: row.select(columns=c) for name, c in (("L_I", [0]), ("L_O", [1]), ("L_p", []))}
    space = RealSystem(ring, ())
    equations = (u**2 - 1, v**2 - 1, u - v, x * y)
    root = Branch(RankProblem({"L": row, **parts}, 0, 1, 1), space, equations, symmetries=symmetries)
    assert len(explore(root).following) == 3 - len(symmetries)
    found = [part for part in search(root, Runner()).found if part.stratum.defects.delta]
    assert len(found) == 2 * (3 - len(symmetries))
    tasks = [RealTask(part, space, Names()) for part in found]
    pieces = [
        p for task in tasks for part in alike.realise_alike(alike.AlikeTask(task)).parts for p in part.pieces
    ]
    assert sum(piece.points or 0 for piece in pieces) == 2


def test_parts_without_points_are_searched_on_their_own(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of x y = 0 with 2 z^4 = 3 x - 5 and no short proof, x = 0 is empty and y = 0 is not."""
    ring = Ring(("x", "y", "z"))
    x, y, z = ring.gens
    row = PolynomialMatrix.of(ring, [[x, y]])
    parts = {name: row.select(columns=c) for name, c in (("L_I", [0]), ("L_O", [1]), ("L_p", []))}
    problem = RankProblem({"L": row, **parts}, 0, 1, 1)
    monkeypatch.setattr(explore_module, "is_proven_empty", lambda *_, **__: Verdict.undecided("not asked"))
    monkeypatch.setattr(explore_module, "points_on", lambda *_: ())
    monkeypatch.setattr("singsym.classes.strata.occurrence.numerical_points", lambda *_: ())
    monkeypatch.setattr(explore_module, "real_consequences", lambda *_: Known([]))
    branch = Branch(problem, RealSystem(ring, ()), (x * y, 2 * z**4 - 3 * x + 5))
    first = explore(branch)
    assert not first.found
    assert [b.equations[0] for b in first.following] == [x, y]
    assert not explore(first.following[0]).found


def test_same_result_for_one_and_two_workers(reference: dict[str, object]) -> None:
    assert plain(classify(load("change-point"), workers=2, cache=False)) == reference


def test_same_result_on_threads(reference: dict[str, object]) -> None:
    with ThreadPoolExecutor(2) as pool:
        assert plain(classify(load("change-point"), executor=pool, cache=False)) == reference


def test_same_result_on_a_dask_cluster(reference: dict[str, object]) -> None:
    """A real LocalCluster: its client's executor is any other to the program."""
    distributed = pytest.importorskip("distributed")
    with (
        distributed.LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
        client.get_executor() as executor,
    ):
        assert plain(classify(load("change-point"), executor=executor, cache=False)) == reference


def test_second_run_is_read_from_the_cache(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, reference: dict[str, object]
) -> None:
    """The tasks of the first run are found again, one by one; none is computed twice."""
    monkeypatch.setenv("SINGSYM_CACHE", str(tmp_path))
    assert plain(classify(load("change-point"))) == reference
    stored = {path: path.stat().st_mtime_ns for path in tmp_path.iterdir()}
    assert stored

    def forbidden(*_: object) -> object:
        raise AssertionError("computed again")

    monkeypatch.setattr(module, "count", _named(forbidden, module.count))
    monkeypatch.setattr(alike, "realise_alike", _named(forbidden, alike.realise_alike))
    monkeypatch.setattr("singsym.classes.strata.search.explore", _named(forbidden, explore))
    assert plain(classify(load("change-point"))) == reference
    assert {path: path.stat().st_mtime_ns for path in tmp_path.iterdir()} == stored


def _named(function: Callable[..., object], known: Callable[..., object]) -> Callable[..., object]:
    """A function that the cache takes for another one."""

    @functools.wraps(known)
    def stand_in(*arguments: object) -> object:
        return function(*arguments)

    return stand_in


class Interrupting(ThreadPoolExecutor):
    """An executor that is interrupted after some tasks."""

    def __init__(self, after: int) -> None:
        super().__init__(1)
        self.left = after

    def submit(self, *arguments: object, **named: object):  # type: ignore[no-untyped-def,override]
        self.left -= 1
        if self.left < 0:
            raise KeyboardInterrupt
        return super().submit(*arguments, **named)  # type: ignore[arg-type]


def test_an_interrupted_run_is_taken_up(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, reference: dict[str, object]
) -> None:
    monkeypatch.setenv("SINGSYM_CACHE", str(tmp_path))
    with Interrupting(after=2) as pool, pytest.raises(KeyboardInterrupt):
        classify(load("change-point"), executor=pool)
    early = set(tmp_path.glob("*.json.gz"))
    assert plain(classify(load("change-point"))) == reference
    assert early < set(tmp_path.glob("*.json.gz"))


def test_limits_leave_configurations_out() -> None:
    """The slider-crank works on one side only; without that limit there are twice as many dead centres."""
    mechanism = load("slider-crank")
    everything = classify(mechanism, cache=False)
    unlimited = classify(replace(mechanism, limits=()), cache=False)
    counts = {
        name: [c.points for c in result.classes if c.verdict.is_yes]
        for name, result in (("limited", everything), ("unlimited", unlimited))
    }
    assert counts == {"limited": [2], "unlimited": [4]}


class Broken(ThreadPoolExecutor):
    """An executor whose workers die over every task."""

    def submit(self, *arguments: object, **named: object):  # type: ignore[no-untyped-def,override]
        return super().submit(self._die)

    def _die(self) -> None:
        raise BrokenExecutor("all workers died")


def test_workers_that_die_leave_undecided_what_is_not_known_without_them() -> None:
    """(1) occurs in fact; a class is "no" only where the four ranks forbid it."""
    with Broken(1) as pool:
        result = classify(load("slider-crank"), executor=pool, cache=False)
    possible = [c for c in result.classes if "impossible" not in c.verdict.reason]
    assert len(possible) == len(feasible_classes(1))
    for found in possible:
        assert found.verdict.is_undecided
        assert "all workers died" in found.verdict.reason
    for locus in result.loci:
        assert locus.verdict.is_undecided
        assert locus.verdict.reason == "all workers died"


def test_what_more_time_could_say_or_prove_is_provisional() -> None:
    assert not Explored().provisional
    assert Explored(undecided=("no time",)).provisional
    assert Explored(certainty="modular").provisional
