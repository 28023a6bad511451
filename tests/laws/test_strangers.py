"""Linkages that nobody has seen, each as it is and in disguise: the answers agree.

Source: random dyads with small integer lengths, so that equal lengths and stretched positions are common;
nothing here knows the right answer.  In every run of the tests a few with a new seed; more by

    SINGSYM_RUNS=300 python -m pytest tests/laws/test_strangers.py -n 2
"""

from __future__ import annotations

from fractions import Fraction

import pytest

from singsym.classes.classify import Limits, classify
from singsym.mechanism import Mechanism, dumps
from singsym.output.plain_data import classification_data
from tests.laws.answers import Answer, contradictions
from tests.laws.disguises import mirrored, reordered, scaled
from tests.laws.draws import SEED, draw, runs
from tests.laws.mechanisms import dyads

LIMITS = Limits(seconds=5, total=30)


def classified(mechanism: Mechanism) -> Answer:
    return classification_data(classify(mechanism, cache=False, limits=LIMITS))


@pytest.mark.parametrize("number", range(runs(4)))
def test_a_stranger_in_disguise(number: int) -> None:
    """In millimetres or inches, mirrored, listed backwards."""
    random = draw("stranger", number)
    stranger = dyads(random)
    plain = classified(stranger)
    disguises = {
        "scaled": scaled(Fraction(random.choice([1000, 40, 25]))),
        "mirrored": mirrored,
        "listed backwards": reordered,
    }
    for name, disguise in disguises.items():
        found = contradictions(plain, classified(disguise(stranger)), same_names=False)
        assert not found, f"SINGSYM_SEED={SEED} {name}:\n{dumps(stranger)}{found}"
