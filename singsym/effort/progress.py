"""One progress interface for all long work: events go to the sink of the caller, if there is one.

Source: the event sinks of Python's `logging`, scoped by `contextvars`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass


@dataclass(frozen=True)
class Event:
    """A stage of the work and how far it is: `done` of `total` where they are known.

    >>> str(Event("decompose", "BCD", 2, 5))
    'decompose: BCD (2 of 5)'
    """

    stage: str
    detail: str = ""
    done: int | None = None
    total: int | None = None

    def __str__(self) -> str:
        text = f"{self.stage}: {self.detail}" if self.detail else self.stage
        if self.done is None:
            return text
        return f"{text} ({self.done} of {self.total})" if self.total is not None else f"{text} ({self.done})"


Sink = Callable[[Event], None]
_sink: ContextVar[Sink | None] = ContextVar("progress_sink", default=None)


def report(stage: str, detail: str = "", done: int | None = None, total: int | None = None) -> None:
    """Tell the sink in force, if any, what is going on."""
    sink = _sink.get()
    if sink is not None:
        sink(Event(stage, detail, done, total))


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
    token = _sink.set(sink)
    try:
        yield
    finally:
        _sink.reset(token)
