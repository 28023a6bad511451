"""The seed of the laws, new in every run; at its end the gallery's table of times, counts and engines.

The examples of hypothesis are the same in every run.
"""

from __future__ import annotations

import os
from random import SystemRandom
from typing import Any

from hypothesis import settings

settings.register_profile("same examples in every run", derandomize=True)
settings.load_profile("same examples in every run")


def pytest_configure() -> None:
    """A new seed for `tests/laws`, unless one is given; xdist's workers inherit it."""
    os.environ.setdefault("SINGSYM_SEED", str(SystemRandom().randrange(10**6)))


def pytest_terminal_summary(terminalreporter: Any) -> None:
    """Print the seed, and the rows of `tests/literature/test_gallery.py`, also those from xdist's workers."""
    terminalreporter.write_line(f"SINGSYM_SEED={os.environ['SINGSYM_SEED']}")
    reports = (r for kind in ("passed", "failed") for r in terminalreporter.getreports(kind))
    recorded = (dict(report.user_properties) for report in reports if report.when == "call")
    rows = sorted(found["gallery"] for found in recorded if "gallery" in found)
    if not rows:
        return
    headers = ("mechanism", "N", "n", "seconds", "classes", "undecided", "pieces", "engines")
    widths = [max(map(len, column)) for column in zip(headers, *rows, strict=True)]
    terminalreporter.section("gallery")
    for row in (headers, *rows):
        line = "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True))
        terminalreporter.write_line(line.rstrip())
