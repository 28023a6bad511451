"""The certificates of mechanisms of the library: the checker proves all of the tables that tests here expect.

All mechanisms, with sizes and times: `python -m tests.certificates`.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from singsym.certificates.checker.verification import verify
from singsym.certificates.prover.writing import certificate
from singsym.classes.result import Classification
from singsym.mechanism import Mechanism, load

pytestmark = pytest.mark.engines
QUICK = (
    "2r",
    "3rpr",
    "7r-locked",
    "atkinson-engine",
    "bennett",
    "cardan",
    "change-point",
    "chebyshev-lambda",
    "crank-slotted-lever",
    "double-parallelogram",
    "double-rocker",
    "double-rocker-pin",
    "drag-link-press",
    "five-bar",
    "five-bar-coupled",
    "fourbar",
    "oldham",
    "orthogonal-3r",
    "pair-6",
    "pair-10",
    "pair-16",
    "pair-17",
    "pair-19",
    "pair-20",
    "pair-21",
    "parallelogram",
    "parallelogram-advance",
    "parallelogram-height",
    "pantograph",
    "peaucellier",
    "pentagon",
    "puma560",
    "rssr",
    "sarrus",
    "scara",
    "schoenflies",
    "scotch-yoke-advance",
    "scotch-yoke-parallelogram",
    "shaper",
    "slider-crank",
    "spherical-5r",
    "spherical-fourbar",
    "stanford",
    "stephenson-six-bar",
    "stewart-gough-planar",
    "toggle-press",
    "ur5",
    "watt-one-six-bar",
    "watt-six-bar",
    "whitworth",
    "wrist-offset",
)
"""Those whose certificate takes a few seconds at most."""
SLOW = ("eight-bar", "klann-leg", "linear-delta", "pair-11", "stewart-gough")
"""These take tens of seconds."""


@pytest.mark.parametrize("name", [*QUICK, *(pytest.param(name, marks=pytest.mark.slow) for name in SLOW)])
def test_the_table_is_proven_in_full(
    name: str, classified: Callable[[Mechanism], Classification], tmp_path: Path
) -> None:
    """All rows, as the classification has them: nothing is undecided, no part is left open."""
    result = classified(load(name))
    found = verify(certificate(result).write(tmp_path / name))
    assert found.complete, found.missing
    assert "open" not in found.rules
    claimed = {row.types: row.occurs for row in found.claimed}
    assert claimed == {row.types: row.occurs for row in found.proven}
