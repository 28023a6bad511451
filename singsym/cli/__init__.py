"""The command `singsym`: every artefact on stdout, everything else on stderr.

Source: singsym's own; exit codes: 0 decided, 3 a class, a dimension or a number open, 2 usage or bad
input, 74 results that cannot be written (EX_IOERR of sysexits.h), 130 interrupted, 143 terminated.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from io import TextIOWrapper
from types import FrameType
from typing import TextIO

from singsym.cli.screen import UserError, say

USAGE, NOT_WRITTEN, INTERRUPTED, BROKEN_PIPE = 2, 74, 130, 141


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command and return its exit code; `SystemExit` for usage errors and `--help`, as argparse does.

    >>> main(["classes", "--n", "1", "--format", "json"])  # doctest: +ELLIPSIS
    {"n": 1, ...
    0
    """
    started = time.monotonic()
    from singsym.cli.parser import parser

    if _opened():
        say("singsym: standard output is closed, there is nowhere to print to")
        return NOT_WRITTEN
    top = parser()
    chosen = top.parse_args(arguments)
    chosen.started = started
    if chosen.run is None:
        top.print_help()
        return USAGE
    ended = _Ended()
    try:
        with ended.in_order():
            code: int = chosen.run(chosen)
        sys.stdout.flush()
    except UserError as error:
        say(f"singsym {chosen.command}: {error}")
        return USAGE
    except BrokenPipeError:
        return BROKEN_PIPE
    except OSError as error:
        place = error.filename or "standard output"
        say(f"singsym {chosen.command}: {place} cannot be used: {error.strerror or error}")
        return NOT_WRITTEN
    except KeyboardInterrupt as interrupt:
        during = f" during {interrupt}" if str(interrupt) else ""
        say(f"singsym {chosen.command}: interrupted{during}{chosen.on_interrupt}")
        return ended.code
    finally:
        for stream in (sys.stdout, sys.stderr):
            try:
                stream.flush()
            except OSError:
                _forget(stream)
    return code


def _opened() -> bool:
    """Open streams that are closed on nothing, so that no file gets their numbers; whether stdout was.

    Signs that their encoding has not, as ± or ≈, are question marks, and escapes in messages.
    """
    closed = sys.stdout is None
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, os.fdopen(os.open(os.devnull, os.O_RDWR), mode, encoding="utf-8"))
        elif mode == "w" and isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="replace" if name == "stdout" else "backslashreplace")
    return closed


def _forget(stream: TextIO) -> None:
    """Nobody reads what is left in it, or it has no place: the flush at exit would complain again."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


@dataclass
class _Ended:
    """What ends a command early, and its exit code."""

    code: int = INTERRUPTED

    @contextmanager
    def in_order(self) -> Iterator[None]:
        """SIGTERM ends the work inside as Ctrl-C does: what is known is printed, nothing is left behind."""
        if threading.current_thread() is not threading.main_thread():
            yield
            return

        def end(number: int, frame: FrameType | None) -> None:
            self.code = 128 + number
            raise KeyboardInterrupt

        before = signal.signal(signal.SIGTERM, end)
        try:
            yield
        finally:
            signal.signal(signal.SIGTERM, before)
