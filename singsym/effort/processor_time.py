"""Work: the processor time of a thread and of the programs that it waits for, so that load changes nothing.

Source: clock_getcpuclockid(3), whose Linux clocks of other processes are numbered as in `_clock_of`; proc(5).
"""

from __future__ import annotations

import gc
import sys
import threading
import time
from collections.abc import Callable
from contextlib import suppress

_clock: Callable[[], float] = getattr(time, "thread_time", time.monotonic)
_GRAIN = 0.005
"""Seconds in which the clock is read once: it is a call of the system, and asked for all the time."""


_OLDEST = 2
"""The generation of a full garbage collection."""


class _Work(threading.local):
    """What this thread worked when its clock was last read, when that was, and what it waited for."""

    own = 0.0
    read_at = -1.0
    waited_for = 0.0
    collects_since = 0.0


_thread = _Work()


def worked() -> float:
    """Seconds of work in this thread since some moment: only differences mean something.

    Too small by at most a few milliseconds.

    >>> before = worked()
    >>> time.sleep(0.05)
    >>> worked() - before < 0.05
    True
    """
    now = time.monotonic()
    if now - _thread.read_at > _GRAIN:
        _thread.own, _thread.read_at = _clock(), now
    return _thread.own + _thread.waited_for


def charge(seconds: float) -> None:
    """Add work that another process did for this thread."""
    _thread.waited_for += seconds


def _without_collecting(phase: str, info: dict[str, int]) -> None:
    """A full garbage collection, that costs what all else in the process holds, is no work of this thread."""
    if info["generation"] < _OLDEST:
        return
    if phase == "start":
        _thread.collects_since = _clock()
    else:
        charge(_thread.collects_since - _clock())


gc.callbacks.append(_without_collecting)


class Meter:
    """What a process works from now on, charged to the thread that waits for it.

    A process that sleeps is charged the time: it hangs.  So is one whose clock cannot be read (not Linux).
    """

    def __init__(self, process: int) -> None:
        self._process = process
        self._seen = time.monotonic()
        self._worked = _worked_by(process)

    def charge(self) -> None:
        """Charge what was done since the last call."""
        now, done = time.monotonic(), _worked_by(self._process)
        passed, self._seen = now - self._seen, now
        if done is None or self._worked is None:
            charge(passed)
            return
        own, self._worked = done - self._worked, done
        charge(passed if own == 0.0 and _sleeps(self._process) else own)


def _clock_of(process: int) -> int:
    return (~process << 3) | 2


def _worked_by(process: int) -> float | None:
    """The processor time of a process, of all its threads; None where that is not told."""
    if sys.platform == "linux":
        with suppress(OSError, OverflowError):
            return time.clock_gettime(_clock_of(process))
    return None


def _sleeps(process: int) -> bool:
    """Whether a process waits for something instead of a processor or the disk."""
    with suppress(OSError, IndexError), open(f"/proc/{process}/stat") as file:
        return file.read().rpartition(")")[2].split()[0] in "ST"
    return True
