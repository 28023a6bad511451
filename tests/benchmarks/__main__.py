"""A table of what mechanisms cost: `python -m tests.benchmarks [NAME ...]`, in the repository's folder.

Counts stand beside their ratio to those kept in `baseline.json`.  Work is in units of a fixed computation of
the same process, and so is what is kept of it: no seconds are compared with those of another run.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from singsym.output.page import Grid, plain
from tests.benchmarks.cases import CASES, QUICK, mechanism
from tests.benchmarks.counting import BOXES, ENGINES, NEWTON
from tests.benchmarks.measures import Measured, measure

BASELINE = Path(__file__).with_name("baseline.json")
Kept = dict[str, Any]


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, and print the table."""
    chosen = _parser().parse_args(arguments)
    kept: Kept = json.loads(BASELINE.read_text()) if BASELINE.exists() else {}
    names = chosen.names or list(CASES if chosen.all else QUICK)
    rows = []
    for name, found in _measured(names):
        rows.append(row(name, found, kept.get(name)))
        kept[name] = {key: value for key, value in asdict(found).items() if key != "compared"}
    headers = ("mechanism", *ENGINES, NEWTON, BOXES, "work", "to msolve", "to Singular", "open")
    print(plain((Grid(headers, tuple(rows)),)))
    print("\nIn brackets: over the baseline. Work: in Groebner bases of Katsura-6 by FLINT.")
    print(
        "To an engine: work for all loci of (4) and (5), over that of the engine; < or > where one gave up."
    )
    if chosen.keep:
        BASELINE.write_text(json.dumps(kept, indent=1, sort_keys=True) + "\n")
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(CASES)}, or of the library")
    parser.add_argument("--all", action="store_true", help="also those that take minutes")
    parser.add_argument("--keep", action="store_true", help="what is found becomes the baseline")
    return parser


def _measured(names: Sequence[str]) -> Iterator[tuple[str, Measured]]:
    """Each in a process of its own, which remembers nothing of the others."""
    for name in names:
        print(name, "...", file=sys.stderr)
        with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as process:
            yield name, process.submit(measure, mechanism(name)).result()


def row(name: str, found: Measured, kept: Kept | None) -> tuple[str, ...]:
    """The cells of a mechanism."""
    before = kept or {"counts": {}, "work": None}
    counts = [
        beside(found.counts.get(what, 0), before["counts"].get(what)) for what in (*ENGINES, NEWTON, BOXES)
    ]
    engines = [found.compared.get(engine, "") for engine in ("msolve", "singular")]
    return (name, *counts, beside(found.work, before["work"]), *engines, "yes" if found.undecided else "")


def beside(value: float, before: float | None) -> str:
    """A value with its ratio to that of the baseline, where there is one."""
    shown = str(value) if isinstance(value, int) else f"{value:.2f}"
    if before is None or value == before == 0:
        return shown
    return f"{shown} ({value / before:.2f})" if before else f"{shown} (0 before)"


if __name__ == "__main__":
    sys.exit(main())
