"""Trajectories: times, and values of joints and coordinates of points at them, straight in between.

Source: singsym's own; comma-separated values as in RFC 4180.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from flint import arb

from singsym.mechanism.fileformat import read_text
from singsym.mechanism.problems import MechanismError, Problem
from singsym.motion.arithmetic import Array
from singsym.polynomials.compiled_map import Floats

_TIMES = ("t", "time")


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Values by label at rising times; between two times they change at constant rates.

    times: (rows,); values: by column label of a joint, in radians or lengths, or by coordinate of a named
    point as `C.x`, each (rows,).
    """

    times: Floats
    values: Mapping[str, Floats]

    @classmethod
    def of(
        cls, values: Mapping[str, Sequence[float] | Array], times: Sequence[float] | None = None
    ) -> Trajectory:
        """From arrays; times: by default 0, 1, 2 and so on.  Raises `MechanismError` for what is not fit."""
        arrays = {label: np.asarray(v, dtype=np.float64) for label, v in values.items()}
        count = max((a.size for a in arrays.values()), default=0)
        at = np.arange(count, dtype=np.float64) if times is None else np.asarray(times, dtype=np.float64)
        rows = {label: f"{a.shape}" for label, a in {**arrays, "t": at}.items() if a.shape != (count,)}
        if not arrays or count < 2 or rows:
            found = ", ".join(f"{label} {shape}" for label, shape in rows.items()) or f"{count} rows"
            raise MechanismError([Problem("trajectory", found, "at least two rows, as many for each label")])
        if not all(np.isfinite(a).all() for a in (at, *arrays.values())):
            raise MechanismError([Problem("trajectory", "an infinite number, or none", "finite numbers")])
        if not (np.diff(at) > 0).all():
            raise MechanismError([Problem("trajectory", "times that do not rise", "rising times")])
        return cls(at, arrays)

    @classmethod
    def from_csv(cls, text: str, file: str = "") -> Trajectory:
        """From comma-separated values with a header; raises `MechanismError`.

        A column `t` or `time` holds the times; `A deg` is joint A in degrees.

        >>> Trajectory.from_csv("t,A deg\\n0,0\\n2,180\\n").values
        {'A': array([0.        , 3.14159265])}
        """
        rows = [row for row in csv.reader(io.StringIO(text), skipinitialspace=True) if any(row)]
        header = [name.strip() for name in rows[0]] if rows else []
        problems, columns = [], [[0.0] * 0 for _ in header]
        for number, row in enumerate(rows[1:], 2):
            if len(row) != len(header):
                problems.append(Problem(f"row {number}", f"{len(row)} cells", f"{len(header)}", file=file))
                continue
            for name, cell, column in zip(header, row, columns, strict=True):
                try:
                    column.append(float(cell))
                except ValueError:
                    problems.append(Problem(f"row {number}, {name}", cell, "a number", file=file))
        if len({*header}) < len(header) or "" in header:
            problems.append(Problem("header", ", ".join(header), "different names", file=file))
        if problems:
            raise MechanismError(problems)
        times, values = None, {}
        for name, column in zip(header, columns, strict=True):
            if name in _TIMES:
                times = column
            elif name.endswith(" deg"):
                values[name.removesuffix(" deg").strip()] = np.radians(column)
            else:
                values[name] = np.array(column)
        return cls.of(values, times)

    @classmethod
    def from_file(cls, path: str | Path) -> Trajectory:
        """The same from a file; raises `MechanismError`, and `OSError` where it is not there."""
        return cls.from_csv(read_text(path), str(path))

    @property
    def labels(self) -> tuple[str, ...]:
        """What is driven."""
        return tuple(self.values)

    def at(self, times: Floats) -> dict[str, Floats]:
        """The values at some times, numerically."""
        return {label: np.interp(times, self.times, v) for label, v in self.values.items()}

    def balls(self, start: float, end: float) -> tuple[dict[str, arb], dict[str, arb]]:
        """Values over a span of time within two rows, and their rates, as balls that hold them."""
        k = min(max(int(np.searchsorted(self.times, start, side="right")) - 1, 0), len(self.times) - 2)
        first, last = arb(float(self.times[k])), arb(float(self.times[k + 1]))
        now = arb(start).union(arb(end))
        values, rates = {}, {}
        for label, v in self.values.items():
            low, high = arb(float(v[k])), arb(float(v[k + 1]))
            rates[label] = (high - low) / (last - first)
            values[label] = low + rates[label] * (now - first)
        return values, rates

    def unwrapped(self, labels: Sequence[str]) -> Trajectory:
        """The same with these angles going the shorter way from row to row, as those of atan2 are meant."""
        pairs = self.values.items()
        return Trajectory(self.times, {k: np.unwrap(v) if k in labels else v for k, v in pairs})
