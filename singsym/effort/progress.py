"""One progress interface for all long work: events go to the sink of the caller, if there is one.

Source: the event sinks of Python's `logging`, scoped by `contextvars`.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, replace


@dataclass(frozen=True)
class Event:
    """A stage of the work and how far it is: `done` of `total` where they are known.

    findings: what was found so far, each with what it is about, as ("1 (RI, IO)", "occurs").

    >>> str(Event("decompose", "BCD", 2, 5))
    'decompose: BCD (2 of 5)'
    """

    stage: str
    detail: str = ""
    done: int | None = None
    total: int | None = None
    findings: tuple[tuple[str, str], ...] = ()

    def __str__(self) -> str:
        text = f"{self.stage}: {self.detail}" if self.detail else self.stage
        if self.done is None:
            return text
        return f"{text} ({self.done} of {self.total})" if self.total is not None else f"{text} ({self.done})"


Sink = Callable[[Event], None]
"""What is called with events, in the thread that works; what it raises ends the work."""

BEAT = 1.0
"""Seconds without an event, after which the last one is sent again: a sink can show time, or end the work."""


class _Listener:
    """A sink, what it was told last, and all that was found."""

    def __init__(self, sink: Sink) -> None:
        self.sink = sink
        self.last: Event | None = None
        self.told = 0.0
        self.findings: dict[str, str] = {}

    def tell(self, event: Event) -> None:
        self.last, self.told = event, time.monotonic()
        self.sink(replace(event, findings=tuple(self.findings.items())))


_listener: ContextVar[_Listener | None] = ContextVar("progress_listener", default=None)


def report(stage: str, detail: str = "", done: int | None = None, total: int | None = None) -> None:
    """Tell the sink in force, if any, what is going on."""
    listener = _listener.get()
    if listener is not None:
        listener.tell(Event(stage, detail, done, total))


def report_finding(about: str, words: str) -> None:
    """Tell the sink in force, if any, what was found out; a later finding about the same takes its place.

    >>> events = []
    >>> with to(events.append):
    ...     report_finding("1 (RI, IO)", "occurs")
    >>> events[0].findings
    (('1 (RI, IO)', 'occurs'),)
    """
    listener = _listener.get()
    if listener is not None and listener.findings.get(about) != words:
        listener.findings[about] = words
        listener.tell(listener.last or Event("starting"))


def beat() -> None:
    """Tell the sink in force the last event again, if that was a while ago; for loops that may take long."""
    listener = _listener.get()
    if listener is not None and listener.last is not None and time.monotonic() - listener.told >= BEAT:
        listener.tell(listener.last)


@contextmanager
def to(sink: Sink | None) -> Iterator[None]:
    """Send the events of the work inside to `sink`; `None` leaves the sink in force.

    >>> events = []
    >>> with to(events.append):
    ...     report("groebner", "8 equations")
    >>> events[0].stage
    'groebner'
    """
    if sink is None:
        yield
        return
    token = _listener.set(_Listener(sink))
    try:
        yield
    finally:
        _listener.reset(token)
