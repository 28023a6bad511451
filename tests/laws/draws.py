"""What the laws are tried on: as many draws as asked for, each run others, from a seed that is printed.

SINGSYM_SEED repeats a run, SINGSYM_RUNS makes it long: see `tests/conftest.py`.
"""

from __future__ import annotations

import os
from random import Random

SEED = os.environ.get("SINGSYM_SEED", "0")


def runs(usually: int) -> int:
    """How many are to be tried: few in every run of the tests, as many as SINGSYM_RUNS says otherwise."""
    return int(os.environ.get("SINGSYM_RUNS", usually))


def draw(*what: object) -> Random:
    """A random source for one test by itself, so that it does not depend on which others are run."""
    return Random(" ".join(map(str, (SEED, *what))))
