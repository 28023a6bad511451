"""Workers on other machines: those of a Dask cluster, behind the address of its scheduler.

Source: the documentation of dask.distributed, https://distributed.dask.org, `Client.get_executor` and
`Client.run`; the Executor interface of Python's `concurrent.futures` (PEP 3148).
"""

from __future__ import annotations

import asyncio
import logging
import pickle
import socket
from collections.abc import Callable, Iterator
from concurrent.futures import BrokenExecutor, Executor, Future, ThreadPoolExecutor
from contextlib import contextmanager
from functools import cache
from typing import Any
from urllib.parse import urlsplit

from singsym.classes.running.disk_cache import versions

_ANSWER_SECONDS = 5.0
"""So long a scheduler has to answer."""
_WORKER_SECONDS = 30.0
"""So long a first worker has to come, where none is there or all are busy."""
_DIED = "its worker died over it, as often as it was tried; fewer threads leave more memory to each"
_EXAMPLE = "tcp://127.0.0.1:8786"


class ClusterError(RuntimeError):
    """There is no cluster to work on, and why."""


class LostCall(BrokenExecutor):
    """A call was given to the cluster, and no result came back."""


@contextmanager
def cluster(address: str) -> Iterator[Executor]:
    """An executor whose calls are done by the workers of the Dask scheduler at HOST:PORT.

    They must run the same program, to the last line, with the same engines; a call that one without it is
    given is lost, as those whose worker dies are.  Where all workers have left, calls wait for others.  Left
    by an exception, it ends at once; workers finish what they are at.
    Raises `ClusterError` where dask.distributed is not installed, where nobody answers, where no worker comes
    and where one runs another program.
    """
    try:
        import distributed
    except ImportError:
        raise ClusterError("a scheduler needs dask.distributed: pip install distributed") from None
    address = _reachable(address)
    try:
        # a client would wait for ever for what listens there and is no scheduler
        with ThreadPoolExecutor(1) as thread:  # where a loop may run already, as in a notebook
            thread.submit(asyncio.run, _identity(address)).result()
    except Exception as error:
        why = "it says nothing" if isinstance(error, TimeoutError) else error
        raise ClusterError(f"what listens at {address} is not a Dask scheduler: {why}") from None
    with _quiet(), distributed.Client(address, timeout=_ANSWER_SECONDS, set_as_default=False) as client:
        _check_workers(client, address)
        yield _Cluster(client, address)


@contextmanager
def _quiet() -> Iterator[None]:
    """Dask does not write tracebacks to stderr inside: what is lost is said by results and exceptions."""
    handlers = logging.getLogger("distributed").handlers
    levels = [(handler, handler.level) for handler in handlers]
    for handler in handlers:
        handler.setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        for handler, level in levels:
            handler.setLevel(level)


class _Cluster(Executor):
    """Hands calls to the workers of a client's scheduler."""

    def __init__(self, client: Any, address: str) -> None:
        # not pure: a call is never answered by what became of another one
        self.inner: Executor = client.get_executor(pure=False)
        self.address = address

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """The future of a call; the function must be one of a module."""
        message = pickle.dumps((fn, args, kwargs))
        try:
            call = self.inner.submit(_answer, _program(), message)
        except Exception as error:
            raise LostCall(f"the scheduler at {self.address} takes no more calls: {error}") from None
        future: Future[Any] = Future()
        future.add_done_callback(lambda own: call.cancel() if own.cancelled() else None)
        call.add_done_callback(lambda done: self._hand_over(done, future))
        return future

    def _hand_over(self, call: Future[Any], future: Future[Any]) -> None:
        """Tell the future what became of a call."""
        if not future.set_running_or_notify_cancel():
            return
        if call.cancelled():
            future.set_exception(LostCall(f"the scheduler at {self.address} has gone, and the call with it"))
        elif (error := call.exception()) is not None:
            future.set_exception(LostCall(_DIED) if _is_loss(error) else error)
        else:
            future.set_result(call.result())


def _is_loss(error: BaseException) -> bool:
    """Whether the workers that were given a call died over it."""
    from distributed.scheduler import KilledWorker

    return isinstance(error, KilledWorker)


def _reachable(address: str) -> str:
    """The address with its scheme, where somebody listens."""
    whole = address if "://" in address else f"tcp://{address}"
    try:
        parts = urlsplit(whole)
        host, port = parts.hostname, parts.port
    except ValueError:
        host, port = None, None
    if not whole.startswith(("tcp://", "tls://")) or not host or not port:
        raise ClusterError(f"found the address {address!r}; expected HOST:PORT, as {_EXAMPLE}")
    try:
        socket.create_connection((host, port), timeout=_ANSWER_SECONDS).close()
    except OSError as error:
        raise ClusterError(f"no scheduler answers at {whole}: {error.strerror or error}") from None
    return whole


async def _identity(address: str) -> None:
    """Ask a scheduler who it is."""
    import distributed

    scheduler = distributed.rpc(address, connection_args=distributed.Security().get_connection_args("client"))
    try:
        await asyncio.wait_for(scheduler.identity(), _ANSWER_SECONDS)
    finally:
        await scheduler.close_rpc()


def _check_workers(client: Any, address: str) -> None:
    """See that a worker takes calls, and that all that are there run this program."""
    try:
        first = client.submit(_program, pure=False)
        first.result(timeout=_WORKER_SECONDS)
        found = client.run(_program)
    except TimeoutError:
        seconds = f"{_WORKER_SECONDS:g} s"
        raise ClusterError(
            f"no worker of the scheduler at {address} took a call within {seconds}; "
            f"one is started by: dask worker {address}"
        ) from None
    except Exception as error:
        raise ClusterError(
            f"the cluster at {address} cannot run singsym, which has to be installed for its scheduler "
            f"and all its workers: {error}"
        ) from None
    for worker, program in found.items():
        if program != _program():
            raise ClusterError(f"the worker {worker} {_difference(program)}")


@cache
def _program() -> tuple[str, ...]:
    """What this process runs."""
    return tuple(versions())


def _difference(program: tuple[str, ...]) -> str:
    """How a worker's program differs from the one here."""
    (code, *theirs), (own_code, *ours) = program, _program()
    different = [f"{b or 'nothing'}, not {a}" for a, b in zip(ours, theirs, strict=False) if a != b]
    if not different and code != own_code:
        different = ["other source code of singsym"]
    return f"runs another program: {'; '.join(different)}"


def _answer(program: tuple[str, ...], message: bytes) -> Any:
    """What a worker does with a call; arguments are read only by the program that wrote them."""
    if program != _program():
        raise LostCall("its worker runs another version of singsym or of its engines")
    function, arguments, named = pickle.loads(message)
    return function(*arguments, **named)
