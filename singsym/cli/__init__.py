"""The command `singsym`: every artefact on stdout, everything else on stderr.

Source: singsym's own; exit codes: 0 decided, 3 a class, a dimension or a number open, 2 usage or bad
input, 130 interrupted, 143 terminated.
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
from types import FrameType

from singsym.cli.screen import UserError, say

USAGE, INTERRUPTED, BROKEN_PIPE = 2, 130, 141


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command and return its exit code; `SystemExit` for usage errors and `--help`, as argparse does.

    >>> main(["classes", "--n", "1", "--format", "json"])  # doctest: +ELLIPSIS
    {"n": 1, ...
    0
    """
    started = time.monotonic()
    from singsym.cli.parser import parser

    chosen = parser().parse_args(arguments)
    chosen.started = started
    if chosen.run is None:
        parser().print_help()
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
        # the reader of the pipe has gone; the flush at exit would complain again
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return BROKEN_PIPE
    except KeyboardInterrupt as interrupt:
        during = f" during {interrupt}" if str(interrupt) else ""
        say(f"singsym {chosen.command}: interrupted{during}{chosen.on_interrupt}")
        sys.stdout.flush()
        return ended.code
    return code


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
