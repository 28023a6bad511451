"""Damaged certificates are rejected, or prove a table that says no more than the true one.

A few hundred in every run of the tests; as many as wanted by

    SINGSYM_RUNS=5000 python -m pytest tests/certificates/test_mutations.py -n 2
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from singsym.certificates.checker.table import Row
from singsym.certificates.checker.verification import verify
from singsym.certificates.prover.writing import Certificate
from tests.certificates.damage import damaged
from tests.laws.draws import draw, runs

pytestmark = pytest.mark.engines
NAMES = ("fourbar", "slider-crank", "2r", "orthogonal-3r", "change-point", "wrist-offset", "parallelogram")
EACH = -(-runs(280) // len(NAMES))


def says_no_more(row: Row, true: Row) -> bool:
    """Whether all that a row knows is what the true one knows."""
    keys = ("occurs", "dimension", "points", "components")
    pairs = [(getattr(row, key), getattr(true, key)) for key in keys]
    return all(known is None or known == right for known, right in pairs)


@pytest.mark.parametrize("name", NAMES)
def test_a_damaged_certificate(name: str, certified: Callable[[str], Certificate], tmp_path: Path) -> None:
    whole = certified(name)
    true = verify(whole.write(tmp_path / "whole"))
    assert true.complete
    random = draw("damage", name)
    rejected = 0
    for number in range(EACH):
        lines = damaged(list(whole.lines), random)
        path = Certificate(tuple(lines)).write(tmp_path / "damaged")
        try:
            found = verify(path)
        except ValueError:
            rejected += 1
            continue
        for row, right in zip(found.proven, true.proven, strict=True):
            assert says_no_more(row, right), (number, row, right)
        if found.complete:
            assert all(says_no_more(claim, by) for claim, by in _by_types(found.claimed, true.proven))
    assert rejected > EACH / 3


def _by_types(claims: tuple[Row, ...], proven: tuple[Row, ...]) -> list[tuple[Row, Row]]:
    rows = {row.types: row for row in proven}
    return [(claim, rows[claim.types]) for claim in claims if claim.occurs]
