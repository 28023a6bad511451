"""Damaged certificates are rejected, or prove a table that says no more than the true one.

A few hundred in every run of the tests; thousands, with what became of each kind, by

    python -m tests.certificates --damage 5000
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from singsym.certificates.checker.rules import RULES
from singsym.certificates.checker.sets import statement
from singsym.certificates.checker.verification import FORMAT, LEAVES, all_types, verify
from singsym.certificates.prover import proof
from singsym.certificates.prover.proof import Hints, prove
from singsym.certificates.prover.writing import Certificate
from tests.certificates.damage import KINDS, damaged
from tests.certificates.test_curves import data
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


@pytest.mark.parametrize("positive", [["x"], ["x - 2"]])
def test_a_damaged_curve_within_inequalities(positive: list[str], tmp_path: Path) -> None:
    """Of two ovals, where x is in (0, 1] and in [-1, 0), one is left, or none."""
    about = data(["x", "y", "z"], "x^2 + y^2 - 1", "z^2 - x*y + 2/5") | {"positive": positive}
    occurs = positive == ["x"]
    own = {"types": "RI, IO", "occurs": occurs} | ({"dimension": 1, "components": 1} if occurs else {})
    others = [types for types in all_types(statement(about)) if types != "RI, IO"]
    claims = [own, *({"types": types, "occurs": False} for types in others)]
    lines = prove(statement(about), Hints(curves=True)).lines
    whole = Certificate(({"format": FORMAT, "name": "own", "claims": claims}, about, *lines))
    assert verify(whole.write(tmp_path / "whole")).complete
    assert any("signs" in line.get("curve", {}) for line in lines)
    for trial in trials(whole, runs(60), draw("damage", *positive), tmp_path):
        assert trial.outcome != "FALSE", (trial.what, trial.damage.kind, trial.damage.field)


def test_a_damaged_dimension(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """T = x y A on the unit sphere: two circles, and regular off these; without a basis by linear forms."""
    monkeypatch.setattr(proof, "BASIS", 0.0)
    about = data(["x", "y", "z"], "x^2 + y^2 + z^2 - 1") | {"L": [["1", "x*y"]]}
    claims = [
        {"types": types, "occurs": types == "RI, IO"} | ({"dimension": 1} if types == "RI, IO" else {})
        for types in all_types(statement(about))
    ]
    lines = prove(statement(about), Hints()).lines
    whole = Certificate(({"format": FORMAT, "name": "own", "claims": claims}, about, *lines))
    assert verify(whole.write(tmp_path / "whole")).complete
    assert all("dimension" in line for line in lines if "point" in line)
    assert any("of" in item for line in lines for item in line.get("ranks", {}).get("L_O", ()))
    for trial in trials(whole, runs(60), draw("damage", "dimension"), tmp_path):
        assert trial.outcome != "FALSE", (trial.what, trial.damage.kind, trial.damage.field)


def test_each_rule_is_damaged(certified: Callable[[str], Certificate]) -> None:
    used = {line["rule"] for name in NAMES for line in certified(name).lines[2:]}
    assert used == {*RULES, *LEAVES} - {"open"}


def test_each_kind_of_damage_happens(certified: Callable[[str], Certificate]) -> None:
    random = draw("kinds of damage")
    lines = [list(certified(name).lines) for name in ("2r", "pantograph")]
    assert {damaged(own, random).kind for own in lines for _ in range(200)} == {*KINDS}
