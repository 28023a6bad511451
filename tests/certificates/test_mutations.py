"""Damaged certificates are rejected, or prove a table that says no more than the true one.

A few hundred in every run of the tests; thousands, with what became of each kind, by

    python -m tests.certificates --damage 5000
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from singsym.certificates.checker.rules import RULES
from singsym.certificates.checker.verification import LEAVES
from singsym.certificates.prover.writing import Certificate
from tests.certificates.damage import KINDS, damaged
from tests.certificates.trials import NAMES, trials
from tests.laws.draws import draw, runs

pytestmark = pytest.mark.engines
EACH = -(-runs(280) // len(NAMES))


@pytest.mark.parametrize("name", NAMES)
def test_a_damaged_certificate(name: str, certified: Callable[[str], Certificate], tmp_path: Path) -> None:
    done = trials(certified(name), EACH, draw("damage", name), tmp_path)
    for trial in done:
        assert trial.outcome != "FALSE", (trial.what, trial.damage.kind, trial.damage.field)
    assert sum(trial.outcome == "rejected" for trial in done) > EACH / 3


def test_each_rule_is_damaged(certified: Callable[[str], Certificate]) -> None:
    used = {line["rule"] for name in NAMES for line in certified(name).lines[2:]}
    assert used == {*RULES, *LEAVES} - {"open"}


def test_each_kind_of_damage_happens(certified: Callable[[str], Certificate]) -> None:
    random = draw("kinds of damage")
    lines = [list(certified(name).lines) for name in ("2r", "pantograph")]
    assert {damaged(own, random).kind for own in lines for _ in range(200)} == {*KINDS}
