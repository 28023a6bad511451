"""Which mechanisms of the library get a full certificate, how large, and how long it takes to check.

python -m tests.certificates               # all; or names
"""

from __future__ import annotations

import sys
import tempfile
import time
from pathlib import Path

from singsym.certificates.checker.verification import verify
from singsym.certificates.prover.writing import certificate
from singsym.classes.classify import Limits, classify
from singsym.mechanism import library, load

CLASSIFYING = Limits(seconds=10, total=60)


def main(names: list[str]) -> None:
    """A line for each mechanism: seconds are of processor time, engines left out."""
    full = 0
    print(f"{'mechanism':26} {'table':8} {'kB':>8} {'proving':>8} {'verifying':>9}")
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            result = classify(load(name), limits=CLASSIFYING)
            started = time.process_time()
            path = certificate(result).write(Path(folder) / name)
            proven = time.process_time()
            found = verify(path)
            checked = time.process_time()
            full += found.complete
            word, size = "full" if found.complete else "in part", path.stat().st_size / 1000
            seconds = f"{proven - started:8.2f} {checked - proven:9.2f}"
            print(f"{name:26} {word:8} {size:8.1f} {seconds}", flush=True)
            for what in found.missing:
                print(f"    {what}")
    print(f"{full} of {len(names)} in full")


if __name__ == "__main__":
    main(sys.argv[1:] or list(library.names()))
