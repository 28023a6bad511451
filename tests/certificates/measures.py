"""What the certificate of one mechanism costs: to find its table, to prove it, to verify the proof.

Source: singsym's own; seconds are of processor time, as `singsym.effort.processor_time` counts it.
"""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path

from singsym.certificates.checker.verification import verify
from singsym.certificates.prover.writing import certificate
from singsym.classes.classify import Limits, classify
from singsym.effort.processor_time import worked
from singsym.mechanism import load

MOST_SAID = 3
"""So many of the things that are not proven are printed."""
HEAD = (
    "| mechanism | table | rows proven | kB | finding | proving | verifying | not proven |",
    "|---|---|---|---|---|---|---|---|",
)


@dataclass(frozen=True)
class Measured:
    """What a certificate proves, its bytes, and the seconds to find, to prove and to verify the table.

    rows: how many there are; proven: of how many it is known whether they occur; missing: what is not proven.
    """

    rows: int
    proven: int
    missing: tuple[str, ...]
    size: int
    finding: float
    proving: float
    verifying: float

    def line(self, name: str) -> str:
        """A row of the printed table."""
        word = "in part" if self.missing else "full"
        seconds = f"{self.finding:.1f} | {self.proving:.1f} | {self.verifying:.2f}"
        missing = "; ".join(self.missing[:MOST_SAID]) + ("; ..." if len(self.missing) > MOST_SAID else "")
        size = f"{self.size / 1000:.1f}"
        return f"| {name} | {word} | {self.proven}/{self.rows} | {size} | {seconds} | {missing} |"


def measure(name: str, seconds: float) -> Measured:
    """Classify, prove and verify a mechanism of the library, with as much for each of the first two."""
    begun = worked()
    result = classify(load(name), limits=Limits(seconds=seconds / 6, total=seconds), cache=False)
    classified = worked()
    with tempfile.TemporaryDirectory() as folder:
        path = certificate(result, seconds).write(Path(folder) / name)
        proven = worked()
        found = verify(path)
        seen = sum(row.occurs is not None for row in found.proven)
        seconds_of = classified - begun, proven - classified, worked() - proven
        return Measured(len(found.proven), seen, found.missing, path.stat().st_size, *seconds_of)
