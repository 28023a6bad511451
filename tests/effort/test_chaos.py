"""Answers withheld at random: where, how often, and that nothing is withheld without asking for it."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable

import pytest

from singsym.effort.attempts import attempt, hurries
from singsym.effort.budget import BudgetExceeded
from singsym.effort.chaos import VARIABLE, Chaos, chaos, strikes
from singsym.elimination import engines
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.real.numerical.sampling import numerical_points
from singsym.varieties.real.points.certified_point import find_witness
from singsym.varieties.real.system import RealSystem

System = tuple[Ring, tuple[Polynomial, ...]]


def test_every_engine_is_silent_where_all_is_withheld(katsura: Callable[[int], System]) -> None:
    ring, equations = katsura(2)
    task = engines.Task("groebner", ring, equations)
    for name in ("flint", "msolve", "singular", "sympy"):
        with engines.use(name):
            if not engines.has(name):
                continue
            with chaos(1, 1.0), pytest.raises(BudgetExceeded):
                engines.ask(task)
            assert engines.ask(task).ideals


def test_proofs_and_searches_come_to_nothing() -> None:
    ring = Ring(("x",))
    system = RealSystem(ring, (ring.gens[0] ** 2 - 4,))
    with chaos(1, 1.0):
        with hurries() as cut, attempt("a proof", 100) as own:
            own.check()
            pytest.fail("the attempt went on")
        assert cut == ["a proof"]
        assert numerical_points(system) == ()
        assert find_witness(system) is None
    assert numerical_points(system)
    assert find_witness(system) is not None


def test_a_seed_gives_the_same_sequence_and_a_probability_its_share() -> None:
    def drawn(seed: int) -> list[bool]:
        with chaos(seed, 0.25):
            return [strikes() for _ in range(1000)]

    assert drawn(3) == drawn(3) != drawn(4)
    # 1000 draws: 250 on average, standard deviation 13.7
    assert 150 < sum(drawn(3)) < 350


def test_nothing_is_withheld_outside() -> None:
    with chaos(1, 1.0), chaos(1, 0.0):
        assert not strikes()
    assert not any(strikes() for _ in range(1000))


def test_the_environment_is_read_once_by_every_process() -> None:
    program = "from singsym.effort.chaos import strikes; print(strikes())"
    for text, expected in (("5:1", "True"), ("5:0", "False"), ("", "False")):
        done = subprocess.run(
            [sys.executable, "-c", program],
            env={**os.environ, VARIABLE: text},
            capture_output=True,
            text=True,
        )
        assert done.stdout.strip() == expected
    with pytest.raises(ValueError, match="seed:probability"):
        Chaos.read("often")
