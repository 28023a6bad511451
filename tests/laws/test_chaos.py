"""Answers withheld at random, of engines, proofs and searches: the classification says less, nothing else.

Source: fault injection; see `singsym.elimination.chaos`. In every run of the tests some forty runs; all of the
mechanisms, and as many runs as wanted, by

    SINGSYM_RUNS=2000 python -m pytest tests/laws/test_chaos.py -n 2
"""

from __future__ import annotations

from pathlib import Path

import pytest

from singsym.classes.classify import Limits, classify
from singsym.elimination.chaos import chaos
from singsym.elimination.memo import forget
from singsym.mechanism import Mechanism, library, load
from singsym.mechanism.urdf import from_urdf
from tests.laws.answers import Answer, contradictions
from tests.laws.draws import SEED, draw, runs

CASES = {
    path.stem: path
    for path in sorted((Path(__file__).parents[1] / "cases").iterdir())
    if path.suffix in (".toml", ".urdf") and not path.name.endswith(".config.toml")
}
LONG = {
    "3prr",
}
"""Mechanisms that take five seconds and more."""
NAMES = [*(name for name in library.names() if name not in LONG), *CASES]
EACH = 4
RUNS = runs(40)
CHOSEN = draw("chaos").sample(NAMES, min(len(NAMES), max(1, RUNS // EACH)))


def mechanism(name: str) -> Mechanism:
    if name not in CASES:
        return load(name)
    path = CASES[name]
    return from_urdf(path) if path.suffix == ".urdf" else load(path)


def answer(name: str, limits: Limits | None = None) -> Answer:
    return classify(mechanism(name), cache=False, limits=limits).as_json()


@pytest.mark.parametrize("name", CHOSEN)
def test_with_answers_withheld_less_is_decided_and_nothing_differently(name: str) -> None:
    """And what a hurry has left in memory does not change what comes out with time."""
    forget()
    whole = answer(name)
    assert not contradictions(whole, whole)
    random = draw("chaos", name)
    hurried = Limits(seconds=3, total=10)
    for number in range(-(-RUNS // len(CHOSEN))):
        seed, probability = random.randrange(10**6), round(2 ** random.uniform(-7, -0.3), 3)
        forget()
        with chaos(seed, probability):
            less = answer(name, hurried)
        found = contradictions(whole, less)
        assert not found, f"SINGSYM_SEED={SEED}, run {number}: chaos({seed}, {probability}) of {name}: {found}"
    afterwards = contradictions(whole, answer(name))
    assert not afterwards, f"SINGSYM_SEED={SEED}: {name} after the runs: {afterwards}"
