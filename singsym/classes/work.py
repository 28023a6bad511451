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
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor, Future, ProcessPoolExecutor, as_completed
from fractions import Fraction
from pathlib import Path
from types import TracebackType
from typing import Any, TypeVar

from singsym.elimination import engines, progress
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


def _with_engines(allowed: tuple[str, ...], function: Callable[[T], R], task: T) -> R:
    with engines.use(*allowed):
        return function(task)


def _call_off(futures: Iterable[Future[Any]]) -> None:
    for future in futures:
        future.cancel()


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
        results = self._run(function, tasks, stage, Budget())
        return [results[i] for i in range(len(tasks))]

    def map_within(
        self, function: Callable[[T], R], tasks: Sequence[T], stage: str, budget: Budget
    ) -> list[R | None]:
        """The same, with None for tasks that were not finished when the budget was used up."""
        results = self._run(function, tasks, stage, budget)
        return [results.get(i) for i in range(len(tasks))]

    def _run(
        self, function: Callable[[T], R], tasks: Sequence[T], stage: str, budget: Budget
    ) -> dict[int, R]:
        results: dict[int, R] = {}
        paths: dict[int, Path] = {}
        if self.cache is not None:
            for i, task in enumerate(tasks):
                paths[i] = self.cache.path(function, task)
                found = self.cache.get(paths[i])
                if found is not None:
                    results[i] = found
        waiting = [i for i in range(len(tasks)) if i not in results]
        progress.report(stage, done=len(results), total=len(tasks))
        finished = self._scattered if self.executor is not None and waiting else self._in_turn
        for i, result in finished(function, tasks, waiting, budget):
            results[i] = result
            if self.cache is not None and not getattr(result, "provisional", False):
                self.cache.put(paths[i], result)
            progress.report(stage, done=len(results), total=len(tasks))
        return results

    def _in_turn(
        self, function: Callable[[T], R], tasks: Sequence[T], waiting: Sequence[int], budget: Budget
    ) -> Iterator[tuple[int, R]]:
        for i in waiting:
            yield i, function(tasks[i])
            if budget.remaining() == 0.0:
                return

    def _scattered(
        self, function: Callable[[T], R], tasks: Sequence[T], waiting: Sequence[int], budget: Budget
    ) -> Iterator[tuple[int, R]]:
        assert self.executor is not None
        allowed = engines.allowed()
        futures: dict[Future[R], int] = {
            self.executor.submit(_with_engines, allowed, function, tasks[i]): i for i in waiting
        }
        try:
            for future in as_completed(futures):
                yield futures[future], future.result()
                if budget.remaining() == 0.0:
                    break
        except Exception:
            _call_off(futures)
            raise
        # not on an interruption: a pool whose processes die while futures are cancelled never ends
        _call_off(futures)


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
