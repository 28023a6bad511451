"""Which mechanisms of the library get a full certificate, how large, and how long it takes to check.

python -m tests.certificates                    # all; or names
python -m tests.certificates --damage 5000      # so many damaged certificates instead; see `damage`
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

from singsym.certificates.prover.writing import certificate
from singsym.classes.classify import classify
from singsym.mechanism import library, load
from tests.certificates.measures import HEAD, measure
from tests.certificates.trials import NAMES, Trial, tally, trials
from tests.laws.draws import draw


def damage(names: Sequence[str], count: int) -> int:
    """So many damaged certificates of some mechanisms; what became of them by kind and by field.

    Each that proves something false, or makes the checker fail, has a line; then the exit code is 1.
    """
    done = list[Trial]()
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            whole = certificate(classify(load(name), cache=False))
            own = trials(whole, -(-count // len(names)), draw("damage", name), Path(folder))
            for trial in own:
                if trial.what:
                    print(f"{name}: {trial.what} ({trial.damage.kind}, {trial.damage.field})", flush=True)
            done += own
    print("\n".join((*tally(done, "field"), "", *tally(done, "kind"))))
    return int(any(trial.what for trial in done))


def main(names: Sequence[str], seconds: float) -> None:
    """A table with a row for each mechanism, in a process of its own, and what is not proven of it."""
    full = 0
    print("\n".join(HEAD), flush=True)
    for name in names:
        with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as process:
            measured = process.submit(measure, name, seconds).result()
        full += not measured.missing
        print(measured.line(name), flush=True)
    print(f"\n{full} of {len(names)} in full")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m tests.certificates", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help="of the library")
    parser.add_argument("--seconds", type=float, default=60.0, help="to find, and to prove, each (60)")
    parser.add_argument("--damage", type=int, metavar="COUNT", help="damaged certificates, at least so many")
    chosen = parser.parse_args()
    if chosen.damage:
        sys.exit(damage(chosen.names or NAMES, chosen.damage))
    main(chosen.names or list(library.names()), chosen.seconds)
