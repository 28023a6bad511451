"""The same random examples in every run; at its end the gallery's table of times, counts and engines."""

from __future__ import annotations

from typing import Any

from hypothesis import settings

settings.register_profile("same examples in every run", derandomize=True)
settings.load_profile("same examples in every run")


def pytest_terminal_summary(terminalreporter: Any) -> None:
    """Print the rows of `tests/literature/test_gallery.py`, also those from xdist's workers."""
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
