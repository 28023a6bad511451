"""The library's mechanisms in disguise, in other processes and with fewer engines: the same answers.

Source: metamorphic testing (T. Y. Chen et al., ACM Computing Surveys 51 (2018) 4); the relations are those of
`disguises`.  In every run of the tests a few; all of them by

    SINGSYM_RUNS=1000 python -m pytest tests/laws/test_metamorphic.py -n 2
"""

from __future__ import annotations

import json
import os
import subprocess
import sys

import pytest

from singsym.classes.classify import classify
from singsym.elimination import engines
from singsym.elimination.memo import forget
from singsym.mechanism import Mechanism, library, load
from singsym.output.plain_data import classification_data
from tests.laws.answers import Answer, contradictions
from tests.laws.disguises import DISGUISES
from tests.laws.draws import SEED, draw, runs

LONG = {"zlatanov-hybrid", "zlatanov-hybrid-3-2", "3upu-tsai", "3rps", "stewart-gough", "spherical-3rrr"}
"""Mechanisms that take more than ten seconds."""
NAMES = [name for name in library.names() if name not in LONG]
GUISES = [(name, guise) for name in NAMES for guise in DISGUISES]
PROCESSES = [(name, way) for name in NAMES for way in ("2 workers", "another hash seed", "FLINT alone")]
random = draw("metamorphic")
DRAWN = [random.sample(pairs, min(len(pairs), runs(few))) for pairs, few in ((GUISES, 10), (PROCESSES, 4))]


def classified(mechanism: Mechanism) -> Answer:
    forget()
    return classification_data(classify(mechanism, cache=False))


@pytest.mark.parametrize(("name", "guise"), DRAWN[0])
def test_a_disguise_changes_nothing(name: str, guise: str) -> None:
    mechanism = load(name)
    disguised = DISGUISES[guise](mechanism)
    if disguised is None:
        pytest.skip("the outputs tell x from y")
    found = contradictions(classified(mechanism), classified(disguised), same_names=False)
    assert not found, f"SINGSYM_SEED={SEED} {name} {guise}: {found}"


@pytest.mark.parametrize(("name", "way"), DRAWN[1])
def test_neither_do_workers_hash_seeds_and_engines(name: str, way: str) -> None:
    """With FLINT alone less may be decided; `contradictions` allows that."""
    whole = classified(load(name))
    if way == "FLINT alone":
        with engines.use("flint"):
            other = classified(load(name))
    else:
        other = by_command(name, "2" if way == "2 workers" else "1")
    found = contradictions(whole, other)
    assert not found, f"SINGSYM_SEED={SEED} {name} {way}: {found}"


def by_command(name: str, workers: str) -> Answer:
    """The answer of a process with another PYTHONHASHSEED."""
    command = [sys.executable, "-m", "singsym", "classify", name, "--no-cache", "--format", "json"]
    environment = {**os.environ, "PYTHONHASHSEED": str(draw("hash seed", name).randrange(2**32))}
    done = subprocess.run([*command, "--workers", workers], env=environment, capture_output=True, text=True)
    answer: Answer = json.loads(done.stdout)
    return answer
