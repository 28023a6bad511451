"""What is seen of work under way: what was found, how far it is and what may be left; or lines.

Source: rich (https://rich.readthedocs.io); what is left by the mean so far, as GNU parallel's --eta.
"""

from __future__ import annotations

import logging
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from dataclasses import dataclass, replace
from typing import Literal

from singsym.effort.progress import Event

Talk = Literal["usual", "quiet", "progress", "verbose"]
"""usual: a bar on a terminal; quiet: errors only; progress: lines; verbose: a line for whatever happens."""

LINE_SECONDS = 5.0
"""A stage has no more lines than one in so many seconds."""

talk: ContextVar[Talk] = ContextVar("talk", default="usual")


@contextmanager
def talking(how: Talk) -> Iterator[None]:
    """What the work inside says on stderr."""
    log = logging.getLogger("singsym")
    level, handler = log.level, logging.StreamHandler()
    token = talk.set(how)
    if how == "quiet":
        log.setLevel(logging.ERROR)
    elif how == "verbose":
        handler.setFormatter(logging.Formatter("%(asctime)s %(message)s", "%H:%M:%S"))
        log.addHandler(handler)
        log.setLevel(logging.DEBUG)
    try:
        yield
    finally:
        talk.reset(token)
        log.removeHandler(handler)
        log.setLevel(level)


def print_line(text: str) -> None:
    """A line on stderr; where that takes none, as on a full disk, the work goes on without."""
    with suppress(OSError):
        print(text, file=sys.stderr, flush=True)


@contextmanager
def watched(note: Callable[[Event], None]) -> Iterator[Callable[[Event], None]]:
    """What notes an event and shows it in the way that was chosen."""
    how = talk.get()
    if how in ("progress", "verbose"):
        lines = Lines(everything=how == "verbose")

        def show(event: Event) -> None:
            note(event)
            for line in lines.lines(event, time.monotonic()):
                print_line(line)

        yield show
    elif how == "usual" and sys.stderr.isatty():
        with _bar(note) as sink:
            yield sink
    else:
        yield note


@contextmanager
def _bar(note: Callable[[Event], None]) -> Iterator[Callable[[Event], None]]:
    from rich.console import Console, Group
    from rich.live import Live
    from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn
    from rich.table import Table
    from rich.text import Text

    columns = (
        SpinnerColumn(),
        TextColumn("{task.description}"),
        BarColumn(bar_width=24),
        TextColumn("{task.fields[how_far]}"),
        TimeElapsedColumn(),
    )
    pace = Pace()
    bar, console = Progress(*columns), Console(stderr=True)
    task = bar.add_task("starting", total=None, how_far="")
    findings: tuple[tuple[str, str], ...] = ()
    with Live(bar, console=console, transient=True) as live:

        def show(event: Event) -> None:
            nonlocal findings
            note(event)
            now = time.monotonic()
            if event.findings != findings:
                findings = event.findings
                found = Table.grid(padding=(0, 2, 0, 0))
                for about, words in findings[-max(1, console.height - 2) :]:
                    found.add_row(Text(about), Text(words, no_wrap=True, overflow="ellipsis"))
                live.update(Group(found, bar))
            pace.tell(event, now)
            described = f"{event.stage}: {event.detail}" if event.detail else event.stage
            bar.update(
                task,
                description=described[:70],
                total=pace.total,
                completed=pace.done,
                how_far=pace.words(now),
            )

        yield show


@dataclass
class Pace:
    """How far the stage under way is, and since when; `first` of its tasks were done as it began.

    >>> pace = Pace()
    >>> for done, now in ((0, 100.0), (1, 110.0), (2, 140.0)):
    ...     pace.tell(Event("strata", "", done, 5), now)
    >>> pace.words(140.0)
    '2 of 5, about 1 min left of it'
    """

    stage: str = ""
    began: float = 0.0
    first: int = 0
    done: int = 0
    total: int | None = None

    def tell(self, event: Event, now: float) -> None:
        """Take an event in; those that do not count say nothing of how far it is."""
        if event.done is None or not event.total:
            return
        if event.stage != self.stage or event.done < self.done:
            self.stage, self.began, self.first = event.stage, now, event.done
        self.done, self.total = event.done, event.total

    def left(self, now: float) -> float | None:
        """Seconds that the stage may still take, if its tasks go on as they did; None before one is done."""
        if self.total is None or self.done <= self.first:
            return None
        return (now - self.began) / (self.done - self.first) * (self.total - self.done)

    def words(self, now: float) -> str:
        """What is done and what is left, "" where there is nothing to count."""
        if self.total is None:
            return ""
        left = self.left(now)
        about = f", about {span(left)} left of it" if left is not None and left >= 1 else ""
        return f"{self.done} of {self.total}{about}"


class Lines:
    """Events as lines: one as a stage begins, and now and then while it goes on; everything: each event.

    What is found has a line each.
    """

    def __init__(self, everything: bool = False) -> None:
        self.everything = everything
        self.pace = Pace()
        self.started: float | None = None
        self.said: dict[str, float] = {}
        self.last: Event | None = None
        self.findings: dict[str, str] = {}

    def lines(self, event: Event, now: float) -> list[str]:
        """The lines to print: what is new, and how far the work is."""
        since = span(now - (self.started if self.started is not None else now))
        new = [f"{since}: {a}: {words}" for a, words in event.findings if self.findings.get(a) != words]
        self.findings = dict(event.findings)
        line = self.line(replace(event, findings=()), now)
        return [*new, line] if line else new

    def line(self, event: Event, now: float) -> str:
        """The line that says how far the work is, "" for none.

        >>> lines = Lines()
        >>> lines.line(Event("strata", "", 0, 2), 50.0)
        '0 s: strata, 0 of 2'
        >>> lines.line(Event("strata", "", 1, 2), 52.0)
        ''
        >>> lines.line(Event("strata", "", 1, 2), 57.0)
        '7 s: strata, 1 of 2, about 7 s left of it'
        """
        self.started = now if self.started is None else self.started
        self.pace.tell(event, now)
        when = self.said.get(event.stage)
        if event.total is None:
            wanted = self.everything and event != self.last
        else:
            new = when is None or now - when >= LINE_SECONDS
            wanted = new or (self.everything and event != self.last)
        self.last = event
        if not wanted:
            return ""
        if event.total is None:
            return f"{span(now - self.started)}: {event}"
        self.said[event.stage] = now
        words = self.pace.words(now)
        return f"{span(now - self.started)}: {event.stage}{f', {words}' if words else ''}"


def span(seconds: float) -> str:
    """A time in words, to two figures or so.

    >>> span(0.2), span(59), span(90), span(3700)
    ('0 s', '59 s', '2 min', '1 h 2 min')
    """
    if round(seconds) < 60:
        return f"{seconds:.0f} s"
    minutes = round(seconds / 60)
    return f"{minutes} min" if minutes < 60 else f"{minutes // 60} h {minutes % 60} min"
