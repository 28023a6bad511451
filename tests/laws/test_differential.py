"""Random and degenerate mechanisms: the exact classification against an independent numerical reference.

Source: the definitions of section 2.2 of Zlatanov, Fenton, Benhabib (1998); see `reference`.  In every run of
the tests a few mechanisms that nobody has seen; more, with more starts each, by

    SINGSYM_RUNS=200 python -m pytest tests/laws/test_differential.py -n 2
"""

from __future__ import annotations

import pytest

from singsym.classes.classify import Limits, classify
from singsym.mechanism import dumps
from tests.laws.draws import SEED, draw, runs
from tests.laws.mechanisms import KINDS
from tests.laws.reference.compare import disagreements

USUALLY = 8
RUNS = runs(USUALLY)
STARTS = 24 if RUNS <= USUALLY else 80
LIMITS = Limits(seconds=5, total=20)


@pytest.mark.parametrize("number", range(RUNS))
def test_nothing_contradicts_the_reference(number: int) -> None:
    """Empty classes are not found, no class is larger than said, points and witnesses are right."""
    random = draw("differential", number)
    kind = list(KINDS)[number % len(KINDS)]
    mechanism = KINDS[kind](random)
    result = classify(mechanism, cache=False, limits=LIMITS)
    found = disagreements(result, random.randrange(10**6), STARTS)
    assert not found, f"SINGSYM_SEED={SEED}\n{dumps(mechanism)}{found}"
