"""`--scheduler`: the same answers as with `--workers`, and what is said where there is no scheduler."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import pytest

from singsym.cli import main


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0") as local:
        yield local.scheduler_address


def printed(capsys: pytest.CaptureFixture[str], *command: str) -> dict[str, Any]:
    """The JSON of a command, but how long it took."""
    assert main([*command, "--no-cache", "--format", "json"]) == 0
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    found.pop("seconds", None)
    return found


@pytest.mark.parametrize("command", [["classify", "slider-crank"], ["solve", "slider-crank", "5", "i"]])
def test_same_answers(command: list[str], address: str, capsys: pytest.CaptureFixture[str]) -> None:
    here = printed(capsys, *command, "--workers", "1")
    assert printed(capsys, *command, "--scheduler", address) == here


def test_no_scheduler_is_bad_input(capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("distributed")
    assert main(["classify", "slider-crank", "--scheduler", "nonsense"]) == 2
    assert capsys.readouterr().err == (
        "singsym classify: found the address 'nonsense'; expected HOST:PORT, as tcp://127.0.0.1:8786\n"
    )


@pytest.mark.parametrize("workers", ["1", "2", "4"])
def test_workers_of_one_kind(workers: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Neither of the two is left out without a word, also where a number is the default."""
    with pytest.raises(SystemExit) as ended:
        main(["solve", "slider-crank", "5", "--workers", workers, "--scheduler", "127.0.0.1:8786"])
    assert ended.value.code == 2
    assert "not allowed with" in capsys.readouterr().err
