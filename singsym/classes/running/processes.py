"""Processes that work on calls, one at a time each: where one dies, it is known over what.

Source: the Executor interface of Python's `concurrent.futures` (PEP 3148), whose own pool of processes breaks
as a whole; parent sentinels of Python's `multiprocessing`; fcntl(2)
F_SETSIG on Linux.
"""

from __future__ import annotations

import multiprocessing
import os
import pickle
import queue
import signal
import sys
import threading
import traceback
from collections.abc import Callable, Collection, Iterator
from concurrent.futures import BrokenExecutor, Executor, Future
from contextlib import contextmanager, suppress
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from types import ModuleType, TracebackType
from typing import Any

from singsym.elimination.engines.process import kill_all

_TRIES = 2
_PARTING_SECONDS = 5.0
"""So long a process has to end when it is not needed any more."""
_lock = threading.Lock()
"""Held while processes are started and waited for, which `multiprocessing` does in one thread only."""


class WorkerDied(BrokenExecutor):
    """The process at work on a call ended before the call did, each time that it was tried."""


class Processes(Executor):
    """An executor of that many processes, each started when there is a call for it.

    A call whose process dies is tried once more in another process; the others are none the wiser.
    Left by an exception, it ends at once, whatever its processes are doing.
    """

    def __init__(self, workers: int) -> None:
        self._calls: queue.SimpleQueue[Call | None] = queue.SimpleQueue()
        self._closed = False
        self._workers = [_Worker(self._calls) for _ in range(workers)]
        for worker in self._workers:
            worker.start()

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """The future of a call; the function must be one of a module, not of a script."""
        if self._closed:
            raise RuntimeError("the processes have been shut down")
        future: Future[Any] = Future()
        self._calls.put((future, fn, args, kwargs))
        return future

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Take no more calls; the processes end when they have done, or not begun, those they have."""
        self._closed = True
        if cancel_futures:
            with suppress(queue.Empty):
                while (call := self._calls.get_nowait()) is not None:
                    call[0].cancel()
        for _ in self._workers:
            self._calls.put(None)
        for worker in self._workers if wait else ():
            worker.join()

    def give_up(self, futures: Collection[Future[Any]]) -> None:
        """End the processes that are at work on these calls, which end with `WorkerDied`."""
        for worker in self._workers:
            worker.give_up(futures)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if kind is not None:
            for worker in self._workers:
                worker.kill()
            self.shutdown(wait=False, cancel_futures=True)
        super().__exit__(kind, error, trace)


Call = tuple["Future[Any]", Callable[..., Any], tuple[Any, ...], dict[str, Any]]


class _Worker(threading.Thread):
    """Hands calls to a process of its own, one after the other."""

    def __init__(self, calls: queue.SimpleQueue[Call | None]) -> None:
        super().__init__(daemon=True)
        self.calls = calls
        self.stopped = False
        self.current: Future[Any] | None = None
        self.given_up: Future[Any] | None = None
        self.process: BaseProcess | None = None
        self.connection: Connection | None = None

    def run(self) -> None:
        while (call := self.calls.get()) is not None:
            future, *rest = call
            if not future.set_running_or_notify_cancel():
                continue
            self.current = future
            try:
                future.set_result(self._result(pickle.dumps(rest)))
            except BaseException as error:
                future.set_exception(error)
        self._end()

    def kill(self) -> None:
        """End the process at once, from another thread."""
        with _lock:
            self.stopped = True
            if self.process is not None:
                self.process.kill()

    def give_up(self, futures: Collection[Future[Any]]) -> None:
        """End the process if it is at work on one of these calls, from another thread."""
        with _lock:
            if self.process is not None and self.current in futures:
                self.given_up = self.current
                self.process.kill()

    def _result(self, message: bytes) -> Any:
        for _ in range(_TRIES):
            try:
                reply = self._reply(message)
            except (EOFError, OSError) as error:
                how = self._end() or f"could not be started ({error})"
                if self.given_up is self.current:
                    raise WorkerDied("it was ended") from None
                continue
            succeeded, value = pickle.loads(reply)
            if succeeded:
                return value
            raise value
        raise WorkerDied(
            f"its worker process {how}, when tried again as well; fewer workers leave more memory to each"
        )

    def _reply(self, message: bytes) -> bytes:
        if self.connection is None:
            self._start()
        assert self.connection is not None
        self.connection.send_bytes(message)
        return self.connection.recv_bytes()

    def _start(self) -> None:
        """Start a process and wait until it has imported what it needs."""
        method = "forkserver" if "forkserver" in multiprocessing.get_all_start_methods() else "spawn"
        context: Any = multiprocessing.get_context(method)
        with _lock:
            if self.stopped:
                raise EOFError
            connection, other = context.Pipe()
            process = context.Process(target=_serve, args=(other,), daemon=True)
            with other, _without_main():
                process.start()
            self.process, self.connection = process, connection
        try:
            self.connection.recv_bytes()
        except EOFError:
            if not self.stopped and (code := self._wait() or 0) > 0:
                raise RuntimeError(f"a worker process ended with exit code {code} before it began") from None
            raise

    def _end(self) -> str:
        """Let the process end, and say how it did; "" where there was none."""
        if self.connection is not None:
            self.connection.close()
            self.connection = None
        code, self.process = self._wait(), None
        if code is None:
            return ""
        return f"was killed by {signal.Signals(-code).name}" if code < 0 else f"ended with exit code {code}"

    def _wait(self) -> int | None:
        """The exit code of the process, whose connection is closed; None where there was none."""
        with _lock:
            if self.process is None:
                return None
            self.process.join(_PARTING_SECONDS)
            self.process.kill()
            self.process.join()
            return self.process.exitcode


@contextmanager
def _without_main() -> Iterator[None]:
    """Processes that are started inside do not run the user's script again, as `multiprocessing` would."""
    main = sys.modules["__main__"]
    sys.modules["__main__"] = ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = main


def _serve(connection: Connection) -> None:
    """What a process does: it answers calls until there is nobody to ask."""
    # an interrupt is the parent's to handle: it ends its workers
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    _end_with_parent()
    with suppress(EOFError, OSError):
        connection.send_bytes(b"ready")
        while True:
            connection.send_bytes(_answer(connection.recv_bytes()))
    kill_all()


def _answer(message: bytes) -> bytes:
    try:
        function, arguments, named = pickle.loads(message)
        return pickle.dumps((True, function(*arguments, **named)))
    except Exception as error:
        error.add_note(traceback.format_exc())
        return pickle.dumps((False, error))


def _end_with_parent() -> None:
    """See to it that this process ends when its parent has, on Linux even in the midst of a long call."""
    parent = multiprocessing.parent_process()
    if parent is None:
        return
    if sys.platform == "linux":
        import fcntl

        # the kernel sends the signal when the parent's end of the pipe is closed
        fcntl.fcntl(parent.sentinel, fcntl.F_SETOWN, os.getpid())
        fcntl.fcntl(parent.sentinel, fcntl.F_SETSIG, signal.SIGKILL)
        flags = fcntl.fcntl(parent.sentinel, fcntl.F_GETFL)
        fcntl.fcntl(parent.sentinel, fcntl.F_SETFL, flags | os.O_ASYNC)
    else:

        def watch() -> None:
            parent.join()
            kill_all()
            os._exit(1)

        threading.Thread(target=watch, daemon=True).start()
