"""Workers of a Dask cluster: results, calls that fail or are lost, and addresses where there is none."""

from __future__ import annotations

import builtins
import logging
import os
import socket
import time
from collections.abc import Iterator
from concurrent.futures import Future
from io import StringIO
from typing import Any

import pytest

from singsym.classes.running import cluster as module
from singsym.classes.running.cluster import ClusterError, LostCall, cluster


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    """That of a scheduler with one worker, a process of its own."""
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(n_workers=1, threads_per_worker=2, dashboard_address=":0") as local:
        yield local.scheduler_address


def test_results_and_exceptions(address: str) -> None:
    with cluster(address) as executor:
        assert [executor.submit(pow, x, 2).result() for x in range(3)] == [0, 1, 4]
        assert executor.submit(os.getpid).result() != os.getpid()
        with pytest.raises(ValueError, match="seven"):
            executor.submit(int, "seven").result()


def test_left_by_an_exception_it_ends_at_once(address: str) -> None:
    futures: list[Future[None]] = []

    def interrupted() -> None:
        with cluster(address) as executor:
            futures.extend(executor.submit(time.sleep, 2) for _ in range(4))
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert all(isinstance(future.exception(0.5), LostCall) for future in futures)


def test_a_call_can_be_called_off(address: str) -> None:
    with cluster(address) as executor:
        future = executor.submit(time.sleep, 2)
        assert future.cancel()
        assert executor.submit(abs, -1).result() == 1


def test_a_call_over_which_a_worker_dies_is_lost() -> None:
    """By default Dask gives it to three others first; other calls are done."""
    distributed = pytest.importorskip("distributed")
    dask = pytest.importorskip("dask")
    with (
        dask.config.set({"distributed.scheduler.allowed-failures": 0}),
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0") as local,
        cluster(local.scheduler_address) as executor,
    ):
        with pytest.raises(LostCall, match="its worker died"):
            executor.submit(os._exit, 1).result(60)
        assert executor.submit(abs, -1).result(60) == 1


def test_calls_are_lost_with_their_scheduler() -> None:
    """Those under way and those that come later."""
    distributed = pytest.importorskip("distributed")
    with (
        distributed.LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=":0") as local,
        cluster(local.scheduler_address) as executor,
    ):
        running = executor.submit(time.sleep, 600)
        local.close()
        with pytest.raises(LostCall, match="has gone"):
            running.result(60)
        with pytest.raises(LostCall):
            executor.submit(abs, -1).result(60)


def test_what_dask_logs_is_not_written(address: str) -> None:
    written = StringIO()
    log, handler = logging.getLogger("distributed"), logging.StreamHandler(written)
    log.addHandler(handler)
    try:
        with cluster(address):
            log.error("a connection is lost")
        assert "a connection is lost" not in written.getvalue()
        log.error("a connection is lost")
        assert "a connection is lost" in written.getvalue()
    finally:
        log.removeHandler(handler)


@pytest.fixture
def another_program(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """This process runs another singsym than the workers do."""
    theirs = module.versions()
    ours = [*theirs[:1], "singsym 99", *theirs[2:]]
    monkeypatch.setattr(module, "versions", lambda: ours)
    module._program.cache_clear()
    yield
    module._program.cache_clear()


@pytest.mark.usefixtures("another_program")
def test_workers_with_another_program_are_named(address: str) -> None:
    with pytest.raises(ClusterError, match=r"worker tcp://.* runs another program: .*, not singsym 99"):
        connected(address)


def test_a_worker_with_another_program_that_comes_later_is_given_nothing(
    address: str, request: pytest.FixtureRequest
) -> None:
    with cluster(address) as executor:
        request.getfixturevalue("another_program")
        with pytest.raises(LostCall, match="another version"):
            executor.submit(abs, -1).result()


def connected(address: str) -> None:
    with cluster(address):
        pass


@pytest.mark.parametrize("bad", ["nonsense", "http://host:80", "host:99999", "tcp://:8786", "host:", ""])
def test_what_is_no_address(bad: str) -> None:
    pytest.importorskip("distributed")
    with pytest.raises(ClusterError, match="expected HOST:PORT"):
        connected(bad)


def test_an_address_where_nobody_listens() -> None:
    """A port that was free a moment ago; the scheme need not be given."""
    pytest.importorskip("distributed")
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        port = listener.getsockname()[1]
    with pytest.raises(ClusterError, match=f"no scheduler answers at tcp://127.0.0.1:{port}: "):
        connected(f"127.0.0.1:{port}")


def test_what_listens_and_is_no_scheduler(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed")
    monkeypatch.setattr(module, "_ANSWER_SECONDS", 0.5)
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        listener.listen()
        with pytest.raises(ClusterError, match="is not a Dask scheduler: it says nothing"):
            connected("{}:{}".format(*listener.getsockname()))


def test_a_scheduler_without_workers(monkeypatch: pytest.MonkeyPatch) -> None:
    distributed = pytest.importorskip("distributed")
    monkeypatch.setattr(module, "_WORKER_SECONDS", 0.5)
    with (
        distributed.LocalCluster(n_workers=0, dashboard_address=":0") as local,
        pytest.raises(ClusterError, match="no worker of the scheduler"),
    ):
        connected(local.scheduler_address)


def test_without_dask(monkeypatch: pytest.MonkeyPatch) -> None:
    """What to install is said."""
    imported = builtins.__import__

    def without(name: str, *rest: Any, **more: Any) -> Any:
        if name.partition(".")[0] == "distributed":
            raise ImportError(name)
        return imported(name, *rest, **more)

    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(ClusterError, match="pip install distributed"):
        connected("127.0.0.1:8786")
