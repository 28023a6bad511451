"""The public names: each is there, has one home, is documented, and is hidden by no room of the same name."""

from __future__ import annotations

import re
import subprocess
import sys
from importlib import import_module
from pathlib import Path
from types import ModuleType

import pytest

import singsym

ROOT = Path(singsym.__file__).parent
API = (ROOT / "docs" / "api.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", singsym.__all__)
def test_a_public_name_says_what_it_is(name: str) -> None:
    value = getattr(singsym, name)
    assert value.__doc__
    if not isinstance(value, ModuleType):
        assert getattr(import_module(value.__module__), value.__name__) is value


def test_the_reference_has_every_public_name_once() -> None:
    assert sorted(re.findall(r"^::: singsym\.(\w+)$", API, re.MULTILINE)) == sorted(singsym.__all__)


def test_all_names_are_listed_in_order_and_once() -> None:
    assert singsym.__all__ == sorted(set(singsym.__all__))
    assert set(singsym._HOME) == set(singsym.__all__)
    assert sum(len(names.split()) for names in singsym._HOMES.values()) == len(singsym.__all__)


def test_no_room_hides_a_public_name() -> None:
    """An imported room becomes an attribute of the package, whatever else had its name."""
    rooms = {path.stem for path in ROOT.iterdir()}
    assert not rooms & set(singsym.__all__)


def test_importing_it_loads_nothing() -> None:
    said = "import sys, singsym; print([m for m in sys.modules if m.startswith('singsym.')])"
    done = subprocess.run([sys.executable, "-c", said], capture_output=True, text=True, cwd=ROOT.parent)
    assert done.stdout.strip() == "[]"
