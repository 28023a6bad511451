"""Answers withheld at random, of engines, proofs and searches: the classification says less, nothing else.

Source: fault injection; see `singsym.effort.chaos`. In every run of the tests some forty runs; all of
the mechanisms, and as many runs as wanted, by

    SINGSYM_RUNS=2000 python -m pytest tests/laws/test_chaos.py -n 2
"""

from __future__ import annotations

from pathlib import Path

import pytest

from singsym.classes.classify import Limits, classify
from singsym.effort.chaos import chaos
from singsym.elimination.memo import forget
from singsym.mechanism import Mechanism, library, load
from singsym.mechanism.urdf import from_urdf
from singsym.output.plain_data import classification_data
from tests.laws.answers import Answer, contradictions
from tests.laws.draws import SEED, draw, runs

CASES = {
    path.stem: path
    for path in sorted((Path(__file__).parents[1] / "cases").iterdir())
    if path.suffix in (".toml", ".urdf")
    and not path.name.endswith(".config.toml")
    and path.stem not in ("huge-integer", "no-robot-name")
}
"""Without those that are refused."""
LONG = {
    "3rps",
    "3rrr",
    "3upu-tsai",
    "bennett",
    "spherical-3rrr",
    "stewart-gough",
    "zlatanov-hybrid",
    "zlatanov-hybrid-3-2",
}
"""Mechanisms of the library that take more than five seconds: never."""
SLOW = {
    "3rrr-congruent",
    "architecture-singular-6sps",
    "delta-guided",
    "delta-guided-rational",
    "scissor",
    "spherical-3rrr-60",
    "stephenson-square-roots",
}
"""Cases that do: only where many runs are asked for, a few of them."""
USUALLY, EACH = 40, 5
RUNS = runs(USUALLY)
NAMES = [name for name in (*library.names(), *CASES) if name not in (LONG if RUNS > USUALLY else LONG | SLOW)]
CHOSEN = draw("chaos").sample(NAMES, min(len(NAMES), max(1, RUNS // EACH)))
_FEW = SLOW.intersection(CHOSEN)
MANY = -(-(RUNS - EACH * len(_FEW)) // (len(CHOSEN) - len(_FEW)))
"""Runs for each mechanism that is not slow."""
WHOLE, HURRIED = Limits(seconds=20, total=120), Limits(seconds=1, total=5)


def mechanism(name: str) -> Mechanism:
    if name not in CASES:
        return load(name)
    path = CASES[name]
    return from_urdf(path) if path.suffix == ".urdf" else load(path)


def answer(name: str, limits: Limits) -> Answer:
    return classification_data(classify(mechanism(name), cache=False, limits=limits))


def withheld(name: str, whole: Answer, seed: int, probability: float) -> list[str]:
    """What is wrong with the answer of one run; an exception is wrong too."""
    forget()
    try:
        with chaos(seed, probability):
            return contradictions(whole, answer(name, HURRIED))
    except Exception as error:
        return [repr(error)]


@pytest.mark.parametrize("name", CHOSEN)
def test_with_answers_withheld_less_is_decided_and_nothing_differently(name: str) -> None:
    """And what a hurry has left in memory does not change what comes out with time."""
    forget()
    whole = answer(name, WHOLE)
    random = draw("chaos", name)
    failed = []
    for _ in range(EACH if name in SLOW else MANY):
        seed, probability = random.randrange(10**6), round(2 ** random.uniform(-7, -0.3), 3)
        found = withheld(name, whole, seed, probability)
        failed += [f"chaos({seed}, {probability}): {found}"] if found else []
    afterwards = contradictions(whole, answer(name, WHOLE))
    failed += [f"after all runs: {afterwards}"] if afterwards else []
    assert not failed, "\n".join([f"SINGSYM_SEED={SEED} {name}", *failed])
