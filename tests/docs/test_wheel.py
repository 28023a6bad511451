"""The wheel: it has all that the program reads, and nothing else; it works away from the sources."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

import singsym

ROOT = Path(singsym.__file__).parents[1]
SOURCES = ("singsym", "pyproject.toml", "README.md", "LICENSE")


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Built of a copy of the sources, so that nothing is left beside them."""
    folder = tmp_path_factory.mktemp("wheel")
    for name in SOURCES:
        source = ROOT / name
        if source.is_dir():
            shutil.copytree(source, folder / "sources" / name, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy(source, folder / "sources" / name)
    command = [sys.executable, "-m", "pip", "wheel", "--no-deps", "--quiet", "--wheel-dir", str(folder)]
    subprocess.run([*command, str(folder / "sources")], check=True, timeout=300)
    (found,) = folder.glob("singsym-*.whl")
    return found


@pytest.mark.slow
def test_the_wheel_has_the_files_of_the_package_and_no_others(wheel: Path) -> None:
    files = {str(p.relative_to(ROOT)) for p in (ROOT / "singsym").rglob("*") if p.is_file()}
    expected = {name for name in files if "__pycache__" not in name}
    packed = {name for name in zipfile.ZipFile(wheel).namelist() if ".dist-info/" not in name}
    assert packed == expected


@pytest.mark.slow
def test_its_metadata_is_what_the_project_says(wheel: Path) -> None:
    archive = zipfile.ZipFile(wheel)
    (name,) = (n for n in archive.namelist() if n.endswith(".dist-info/METADATA"))
    said = archive.read(name).decode().splitlines()
    assert "Requires-Python: >=3.11" in said
    assert "License-Expression: MIT" in said
    assert not [line for line in said if line.startswith(("Project-URL", "Home-page"))]
    assert any(n.endswith("licenses/LICENSE") for n in archive.namelist())


@pytest.mark.slow
def test_what_the_readme_does_works_from_the_wheel(wheel: Path, tmp_path: Path) -> None:
    packed = tmp_path / "packed"
    zipfile.ZipFile(wheel).extractall(packed)
    work = tmp_path / "work"
    work.mkdir()
    environment = {**os.environ, "PYTHONPATH": str(packed), "SINGSYM_CACHE": str(tmp_path / "cache")}

    def run(*arguments: str) -> str:
        command = [sys.executable, "-m", "singsym", *arguments]
        done = subprocess.run(command, cwd=work, env=environment, capture_output=True, text=True, timeout=300)
        assert done.returncode == 0, done.stderr
        return done.stdout

    where = "import singsym; print(singsym.__file__)"
    found = subprocess.run(
        [sys.executable, "-c", where], cwd=work, env=environment, capture_output=True, text=True
    )
    assert Path(found.stdout.strip()).is_relative_to(packed)
    assert "zlatanov-2dof" in run("list")
    run("new", "mine")
    run("check", "mine.toml")
    run("conditions", "zlatanov-hybrid")
    run("classify", "slider-crank", "--workers", "2")
    run("plot", "slider-crank", "--class", "1")
    run("report", "slider-crank")
    assert {p.name for p in work.iterdir()} == {"mine.toml", "slider-crank.svg", "slider-crank.html"}
