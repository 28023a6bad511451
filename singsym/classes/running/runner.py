"""Running independent tasks on any executor, with a cache on disk that outlives an interruption.

Source: the Executor interface of Python's `concurrent.futures` (PEP 3148), which Dask and MPI offer too.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from typing import Any, Generic, Protocol, TypeVar

from threadpoolctl import threadpool_limits

from singsym.classes.running.disk_cache import Cache, Entry, Result, user_cache
from singsym.classes.running.processes import Processes
from singsym.effort import chance, progress
from singsym.effort.budget import Budget
from singsym.effort.processor_time import charge, worked
from singsym.elimination import engines


class Task(Protocol):
    """What a function is given, one of many."""

    def unfinished(self, reason: str) -> Any:
        """The result where there was no time for it, or its worker died: undecided, for this reason."""
        ...


class Interrupted(KeyboardInterrupt):
    """A `KeyboardInterrupt` while tasks were under way.

    partial: the result of what was finished; the rest is undecided, and says so.
    """

    def __init__(self, partial: object) -> None:
        super().__init__()
        self.partial = partial


T = TypeVar("T", bound=Task)
R = TypeVar("R", bound=Result)

ALONE = 3.0
"""So many seconds of work are done before processes are started, which takes a second each."""

GRACE, SHARE_OVER = 1.0, 0.1
"""So many seconds and so much of the time given may be overrun; then what does not heed it is ended."""

Place = tuple[int, ...]
"""Which task: its number among the first ones, or among those that follow from the task at `place[:-1]`."""


def _with_settings(
    allowed: tuple[str, ...], seed: int, budget: Budget, function: Callable[[T], R], task: T
) -> tuple[R, float]:
    """The result, and the seconds of work that it took."""
    before = worked()
    with engines.use(*allowed), chance.use_seed(seed), budget, threadpool_limits(1):
        return function(task), worked() - before


@dataclass
class Runner:
    """Maps a function over tasks: in this process, or on an executor, looking into the cache first.

    executor: any `concurrent.futures.Executor`; None runs in this process.
    cache: where results are kept, or None.
    alone: so many seconds of work are done in this process before the executor is asked, since starting
    workers takes longer than most mechanisms do.
    interrupted: whether there was a `KeyboardInterrupt`; nothing more is begun then.
    A task whose worker dies, that finds no memory or that is interrupted ends unfinished.
    Tasks use one thread each: on small matrices the threads of BLAS mostly wait for each other.
    """

    executor: Executor | None = None
    cache: Cache | None = None
    alone: float = 0.0
    interrupted: bool = False

    def map(
        self,
        function: Callable[[T], R],
        tasks: Sequence[T],
        stage: str,
        budget: Budget | None = None,
        seen: Callable[[R], None] | None = None,
    ) -> list[R]:
        """The results in the order of the tasks, whatever order they finish in.

        Those not finished when the budget was used up are what such a task says of itself.
        seen: called with each result as it comes.
        """

        def nothing(result: R) -> tuple[()]:
            if seen is not None:
                seen(result)
            return ()

        return [result for _, result in self.grow(function, tasks, nothing, stage, budget or Budget())]

    def grow(
        self,
        function: Callable[[T], R],
        tasks: Sequence[T],
        following: Callable[[R], Sequence[T]],
        stage: str,
        budget: Budget,
    ) -> list[tuple[T, R]]:
        """Tasks and their results, with those of the tasks that follow from results, and so on.

        In the order of generations and, within each, of the tasks they follow from; nothing follows from a
        task that was not finished when the budget was used up.  When it is, those at work have a little time
        to say what they know.
        """
        grown: dict[Place, T] = {}
        results: dict[Place, R] = {}
        work: _Queue[T, R] = _Queue(function, self, budget)
        new: list[tuple[Place, T]] = [((i,), task) for i, task in enumerate(tasks)]
        try:
            while not self.interrupted:
                grown.update(new)
                arrived: list[tuple[Place, R]] = []
                for place, task in new:
                    entry = None if self.cache is None else self.cache.entry(function, task)
                    known = None if self.cache is None or entry is None else self.cache.get(entry)
                    if known is None:
                        work.put(_Job(place, task, entry))
                    else:
                        arrived.append((place, known))
                if grown:
                    progress.report(stage, done=len(results) + len(arrived), total=len(grown))
                if not arrived:
                    if budget.remaining() == 0.0:
                        work.call_off()
                    for job, result in work.finished():
                        if self.cache is not None and job.entry is not None:
                            self.cache.put(job.entry, result)
                        arrived.append((job.place, result))
                    if not arrived:
                        break
                # in this order, so that an interruption leaves none of those that follow out
                new = [((*p, i), task) for p, r in arrived for i, task in enumerate(following(r))]
                results.update(arrived)
        except KeyboardInterrupt:
            self.interrupted = True
        except Exception:
            work.call_off()
            raise
        finally:
            work.end()
        grown.update(new)
        used_up = f"the budget of {budget.seconds or 0:g} s for {stage} is used up"
        reason = "it was interrupted" if self.interrupted else used_up
        order = sorted(grown, key=lambda place: (len(place), place))
        return [(grown[p], results[p] if p in results else grown[p].unfinished(reason)) for p in order]


@contextmanager
def running(workers: int, executor: Executor | None, clock: float | None, cache: bool) -> Iterator[Runner]:
    """A runner on the executor given, or on so many processes of its own, for the work inside.

    clock: the seconds after which all work is over, if any; what does not heed that can only be ended in
        another process.  cache: whether results are kept on disk.
    """
    kept = user_cache() if cache else None
    if executor is not None or (workers == 1 and clock is None):
        yield Runner(executor, kept)
        return
    with Processes(workers) as own:
        yield Runner(own, kept, alone=ALONE if clock is None else 0.0)


def _outcome(future: Future[tuple[R, float]]) -> R:
    """The result of a task, whose work is charged to the thread that waited for it."""
    result, seconds = future.result()
    charge(seconds)
    return result


def _first(futures: Collection[Future[Any]], seconds: float | None = None) -> set[Future[Any]]:
    """Those that are done, as soon as there is one; none where that takes longer.

    Meanwhile progress goes on, so that its sink can end the waiting.
    """
    end = None if seconds is None else time.monotonic() + seconds
    while futures:
        left = progress.BEAT if end is None else min(progress.BEAT, max(0.0, end - time.monotonic()))
        done, _ = wait(futures, left, return_when=FIRST_COMPLETED)
        if done or (end is not None and time.monotonic() >= end):
            return done
        progress.beat()
    return set()


@dataclass(frozen=True)
class _Job(Generic[T, R]):
    """A task to be done, with its place and where its result is kept."""

    place: Place
    task: T
    entry: Entry[R] | None


class _Queue(Generic[T, R]):
    """Tasks that wait or are at work, and the results of those that have ended."""

    def __init__(self, function: Callable[[T], R], runner: Runner, budget: Budget) -> None:
        self.function = function
        self.runner = runner
        self.executor = runner.executor
        self.budget = budget
        self.allowed = engines.allowed()
        self.seed = chance.seed()
        self.waiting: deque[_Job[T, R]] = deque()
        self.running: dict[Future[tuple[R, float]], _Job[T, R]] = {}

    def put(self, job: _Job[T, R]) -> None:
        self.waiting.append(job)

    def _submitted(self, executor: Executor, task: T) -> Future[tuple[R, float]]:
        try:
            left = self.budget.part()
            return executor.submit(_with_settings, self.allowed, self.seed, left, self.function, task)
        except BrokenExecutor as error:
            broken: Future[tuple[R, float]] = Future()
            broken.set_exception(error)
            return broken

    def finished(self) -> Iterable[tuple[_Job[T, R], R]]:
        """At least one result, as soon as there is one; of work in this process, that of the next task.

        No result where no task is left, or where those left do not heed that the time is over.
        """
        if self.executor is None or (self.runner.alone > 0.0 and not self.running):
            return [self._next()] if self.waiting else []
        while self.waiting:
            job = self.waiting.popleft()
            self.running[self._submitted(self.executor, job.task)] = job
        left = self.budget.time_left()
        patience = None if left is None else left + GRACE + SHARE_OVER * (self.budget.seconds or 0.0)
        done = _first(self.running, patience)
        return [
            (job := self.running.pop(future), self._result(job, partial(_outcome, future))) for future in done
        ]

    def _next(self) -> tuple[_Job[T, R], R]:
        """The next task, done in this process."""
        job, before = self.waiting.popleft(), worked()
        with self.budget.part(), threadpool_limits(1):
            result = self._result(job, lambda: self.function(job.task))
        self.runner.alone -= worked() - before
        return job, result

    def _result(self, job: _Job[T, R], outcome: Callable[[], R]) -> R:
        try:
            return outcome()
        except BrokenExecutor as error:
            reason = str(error)
        except MemoryError:
            reason = "the memory was used up"
        unfinished: R = job.task.unfinished(reason)
        return unfinished

    def call_off(self) -> None:
        """Begin no more tasks."""
        self.waiting.clear()
        self.running = {future: job for future, job in self.running.items() if not future.cancel()}

    def end(self) -> None:
        """Begin no more tasks, and end those at work where the executor can."""
        if isinstance(self.executor, Processes):
            self.call_off()
            self.executor.give_up(self.running)
