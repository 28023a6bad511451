"""Running independent tasks on any executor, with a cache on disk that outlives an interruption.

Source: the Executor interface of Python's `concurrent.futures` (PEP 3148), which Dask and MPI offer too.
"""

from __future__ import annotations

import dataclasses
import enum
import hashlib
import multiprocessing
import os
import pickle
import signal
import sys
import tempfile
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, wait
from fractions import Fraction
from pathlib import Path
from types import TracebackType
from typing import Any, Generic, TypeVar, cast

from singsym.elimination import chance, engines, progress
from singsym.elimination.budget import Budget
from singsym.polynomials import Polynomial, Ring

T = TypeVar("T")
R = TypeVar("R")

CACHE_FORMAT = 1


def cache_folder() -> Path:
    """Where results are kept: `SINGSYM_CACHE`, else the user's cache folder.

    >>> cache_folder().name
    'singsym'
    """
    chosen = os.environ.get("SINGSYM_CACHE")
    if chosen:
        return Path(chosen)
    if sys.platform == "win32":
        base = Path(os.environ.get("LOCALAPPDATA", str(Path.home())))
    else:
        base = Path(os.environ.get("XDG_CACHE_HOME", str(Path.home() / ".cache")))
    return base / "singsym"


def fingerprint(value: Any) -> str:
    """A text that is equal for equal tasks, whatever process made them.

    >>> fingerprint((1, "a")) == fingerprint((1, "a"))
    True
    """
    if isinstance(value, Polynomial):
        return f"<{value}>"
    if isinstance(value, Ring):
        return f"{value.names}{value.order}{value.constants}"
    if isinstance(value, enum.Enum):
        return f"{type(value).__qualname__}({value.value})"
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        parts = (fingerprint(getattr(value, f.name)) for f in dataclasses.fields(value) if f.compare)
        return f"{type(value).__qualname__}({','.join(parts)})"
    if isinstance(value, Mapping):
        return f"{{{','.join(f'{k}:{fingerprint(v)}' for k, v in sorted(value.items()))}}}"
    if isinstance(value, (tuple, list)):
        return f"({','.join(map(fingerprint, value))})"
    if value is None or isinstance(value, (str, int, float, bool, Fraction)):
        return repr(value)
    raise TypeError(f"a task may hold numbers, text, polynomials and frozen dataclasses, not {value!r}")


@dataclasses.dataclass(frozen=True)
class Cache:
    """Results of tasks as files, one each, written whole or not at all.

    Only a folder of one's own should be given: entries are pickles.
    """

    folder: Path

    def path(self, function: Callable[..., Any], task: Any) -> Path:
        """The file of a task's result; its name is a digest of function, task, engines and format."""
        allowed = ",".join(sorted(engines.allowed()))
        text = f"{CACHE_FORMAT}|{function.__module__}.{function.__qualname__}|{allowed}|{fingerprint(task)}"
        return self.folder / f"{hashlib.sha256(text.encode()).hexdigest()}.pickle"

    def get(self, path: Path) -> Any | None:
        """The stored result, or None; a damaged file counts as none."""
        try:
            return pickle.loads(path.read_bytes())
        except (
            OSError,
            pickle.UnpicklingError,
            EOFError,
            AttributeError,
            ImportError,
            IndexError,
            TypeError,
        ):
            return None

    def put(self, path: Path, result: Any) -> None:
        """Store a result under its path, atomically."""
        self.folder.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=self.folder, suffix=".part")
        with os.fdopen(handle, "wb") as stream:
            pickle.dump(result, stream)
        os.replace(name, path)


def _with_settings(allowed: tuple[str, ...], seed: int, function: Callable[[T], R], task: T) -> R:
    with engines.use(*allowed), chance.use_seed(seed):
        return function(task)


@dataclasses.dataclass
class Runner:
    """Maps a function over tasks: in this process, or on an executor, looking into the cache first.

    executor: any `concurrent.futures.Executor`; None runs in this process.
    cache: where results are kept, or None.
    A result that says of itself that it is provisional (attribute `provisional`) is not cached.
    """

    executor: Executor | None = None
    cache: Cache | None = None

    def map(self, function: Callable[[T], R], tasks: Sequence[T], stage: str) -> list[R]:
        """The results in the order of the tasks, whatever order they finish in.

        >>> Runner().map(abs, [-1, 2], "abs")
        [1, 2]
        """
        # without a limit every task is finished
        return cast("list[R]", self.map_within(function, tasks, stage, Budget()))

    def map_within(
        self, function: Callable[[T], R], tasks: Sequence[T], stage: str, budget: Budget
    ) -> list[R | None]:
        """The same, with None for tasks that were not finished when the budget was used up."""
        return [result for _, result in self.grow(function, tasks, _none, stage, budget)]

    def grow(
        self,
        function: Callable[[T], R],
        tasks: Sequence[T],
        following: Callable[[R], Sequence[T]],
        stage: str,
        budget: Budget,
    ) -> list[tuple[T, R | None]]:
        """Tasks and their results, with those of the tasks that follow from results, and so on.

        In the order of generations and, within each, of the tasks they follow from; None for tasks that were
        not finished when the budget was used up.

        >>> Runner().grow(abs, [-2], lambda n: [n - 1] if n else [], "down", Budget())
        [(-2, 2), (1, 1), (0, 0)]
        """
        grown: dict[Place, T] = {}
        results: dict[Place, R] = {}
        work = _Queue(function, self.executor)
        new: list[tuple[Place, T]] = [((i,), task) for i, task in enumerate(tasks)]
        try:
            while True:
                grown.update(new)
                arrived: list[tuple[Place, R]] = []
                for place, task in new:
                    path = None if self.cache is None else self.cache.path(function, task)
                    known = self._known(path)
                    if known is None:
                        work.put(place, path, task)
                    else:
                        arrived.append((place, known))
                progress.report(stage, done=len(results) + len(arrived), total=len(grown))
                if not arrived:
                    if not work or (results and budget.remaining() == 0.0):
                        break
                    for place, path, result in work.finished():
                        self._keep(path, result)
                        arrived.append((place, result))
                results.update(arrived)
                new = [((*p, i), task) for p, r in arrived for i, task in enumerate(following(r))]
        except Exception:
            work.call_off()
            raise
        # not on an interruption: a pool whose processes die while futures are cancelled never ends
        work.call_off()
        order = sorted(grown, key=lambda place: (len(place), place))
        return [(grown[place], results.get(place)) for place in order]

    def _known(self, path: Path | None) -> Any | None:
        return None if self.cache is None or path is None else self.cache.get(path)

    def _keep(self, path: Path | None, result: Any) -> None:
        if self.cache is not None and path is not None and not getattr(result, "provisional", False):
            self.cache.put(path, result)


Place = tuple[int, ...]
"""Which task: its number among the first ones, or among those that follow from the task at `place[:-1]`."""


def _none(result: object) -> tuple[()]:
    return ()


class _Queue(Generic[T, R]):
    """Tasks that wait or are at work, and the results of those that have ended."""

    def __init__(self, function: Callable[[T], R], executor: Executor | None) -> None:
        self.function = function
        self.executor = executor
        self.allowed = engines.allowed()
        self.seed = chance.seed()
        self.waiting: deque[tuple[Place, Path | None, T]] = deque()
        self.running: dict[Future[R], tuple[Place, Path | None]] = {}

    def __bool__(self) -> bool:
        return bool(self.waiting or self.running)

    def put(self, place: Place, path: Path | None, task: T) -> None:
        if self.executor is None:
            self.waiting.append((place, path, task))
        else:
            future = self.executor.submit(_with_settings, self.allowed, self.seed, self.function, task)
            self.running[future] = (place, path)

    def finished(self) -> list[tuple[Place, Path | None, R]]:
        """At least one result, as soon as there is one; without an executor, that of the next task."""
        if self.executor is None:
            place, path, task = self.waiting.popleft()
            return [(place, path, self.function(task))]
        done, _ = wait(self.running, return_when=FIRST_COMPLETED)
        return [(*self.running.pop(future), future.result()) for future in done]

    def call_off(self) -> None:
        for future in self.running:
            future.cancel()


class _Processes(ProcessPoolExecutor):
    """Processes that end at once where the work is interrupted, instead of finishing their tasks."""

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if isinstance(error, KeyboardInterrupt):
            self.shutdown(wait=False, cancel_futures=True)
            for child in multiprocessing.active_children():
                child.terminate()
        super().__exit__(kind, error, trace)


def processes(workers: int) -> Executor | None:
    """An executor of that many processes; None for one worker, which needs no executor."""
    if workers <= 1:
        return None
    method = "forkserver" if "forkserver" in multiprocessing.get_all_start_methods() else "spawn"
    # an interrupt is the parent's to handle: it ends its workers
    return _Processes(
        workers,
        mp_context=multiprocessing.get_context(method),
        initializer=signal.signal,
        initargs=(signal.SIGINT, signal.SIG_IGN),
    )
