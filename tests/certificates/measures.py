"""What the certificate of one mechanism costs: to find its table, to prove it, to verify the proof.

Source: singsym's own; seconds are of processor time, as `singsym.effort.processor_time` counts it.
"""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path

from singsym.certificates.checker.verification import Verification, verify
from singsym.certificates.prover.writing import certificate
from singsym.classes.classify import Limits, classify
from singsym.effort.processor_time import worked
from singsym.mechanism import load


@dataclass(frozen=True)
class Measured:
    """A certificate's size in bytes, and the seconds to find, to prove and to verify the table."""

    found: Verification
    size: int
    finding: float
    proving: float
    verifying: float

    def line(self, name: str) -> str:
        """A row of the printed table."""
        word = "full" if self.found.complete else "in part"
        proven = sum(row.occurs is not None for row in self.found.proven)
        seconds = f"{self.finding:8.2f} {self.proving:8.2f} {self.verifying:9.2f}"
        return f"{name:26} {word:8} {proven:3}/{len(self.found.proven):<3} {self.size / 1000:8.1f} {seconds}"


def measure(name: str, seconds: float) -> Measured:
    """Classify, prove and verify a mechanism of the library, with as much for each of the first two."""
    begun = worked()
    result = classify(load(name), limits=Limits(seconds=seconds / 6, total=seconds), cache=False)
    classified = worked()
    with tempfile.TemporaryDirectory() as folder:
        path = certificate(result, seconds).write(Path(folder) / name)
        proven = worked()
        found = verify(path)
        return Measured(
            found, path.stat().st_size, classified - begun, proven - classified, worked() - proven
        )
