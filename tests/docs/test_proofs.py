"""The pages of the docs: what they name is there; that of proofs has all that the output can claim."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from functools import cache
from importlib import import_module, resources
from pathlib import Path
from pkgutil import iter_modules
from typing import Any, get_args

import pytest

import singsym
from singsym.certificates.checker import verification
from singsym.certificates.checker.rules import RULES
from singsym.certificates.checker.verification import LEAVES
from singsym.classes.classify import classify
from singsym.classes.configuration.at import at
from singsym.classes.solve import solve
from singsym.conditions.conditions import conditions
from singsym.effort.verdict import Answer, Certainty
from singsym.kinematics.mobility import check_mobility
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism import load
from singsym.output.plain_data import (
    analysis_data,
    classification_data,
    conditions_data,
    mobility_data,
    solution_data,
)

PAGE = resources.files(singsym).joinpath("docs", "proofs.md").read_text(encoding="utf-8")
FOLDERS = [module.name for module in iter_modules(singsym.__path__) if module.ispkg]
PATHS = re.compile(rf"`((?:{'|'.join(FOLDERS)})(?:\.\w+)+)`")
NAMES = sorted(set(PATHS.findall(PAGE)))
OTHERS = {
    name
    for page in Path(str(resources.files(singsym).joinpath("docs"))).rglob("*.md")
    for name in PATHS.findall(page.read_text(encoding="utf-8"))
}
GIVEN, WORDS = "given", "words"


def found(name: str) -> Any:
    """What a dotted path under the package is: a module, or a member of one."""
    parts = name.split(".")
    for size in range(len(parts), 0, -1):
        try:
            value: Any = import_module(".".join(("singsym", *parts[:size])))
        except ModuleNotFoundError:
            continue
        for part in parts[size:]:
            value = getattr(value, part)
        return value
    raise LookupError(name)


@pytest.mark.parametrize("name", sorted({*NAMES, *OTHERS}))
def test_the_function_is_there(name: str) -> None:
    assert found(name) is not None


def test_each_dotted_name_is_a_path() -> None:
    assert set(re.findall(r"`(\w+(?:\.\w+)+)`", PAGE)) == set(NAMES)


def test_dead_names_are_seen() -> None:
    with pytest.raises(AttributeError):
        found("classes.strata.no_such_function")


def rows(section: str) -> list[list[str]]:
    """The cells of the tables in a section, without their heads."""
    text = PAGE.split(f"\n## {section}\n", 1)[1].split("\n## ", 1)[0]
    lines = [line for line in text.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]


def sections() -> list[str]:
    return re.findall(r"^## (.*)$", PAGE, re.MULTILINE)


def test_each_row_is_complete() -> None:
    """As many cells as the head, of which only suppositions may be empty; functions come last."""
    for section in sections():
        for row in rows(section):
            assert len(row) == len(rows(section)[0]), row
            assert all((row[0], row[1])), row
            if section != "Fields of the output":
                assert re.search(r"`\w+(\.\w+)+`", row[-1]), row


CERTIFIED = (
    "The equations and the ranks",
    "The classes that there can be",
    "Ranks on a stratum",
    "The search is complete",
    "No",
    "Yes",
    "Dimension",
    "Number of points",
    "Number of connected components",
    "The configuration space",
)


def test_each_claim_of_a_table_names_its_rules_or_has_no_leaf() -> None:
    """The rules are those of the checker, with the fields of its leaf `ranks`; each of them is named."""
    fields = {"point", "curve", "dimension"}
    assert all(f'line, "{field}"' in inspect.getsource(verification) for field in fields)
    named = set[str]()
    for section in CERTIFIED:
        for row in rows(section):
            own = set(re.findall(r"`(\w+)`", row[3]))
            assert bool(own) != (row[3] in ("no leaf yet", "trusted")), row
            named |= own
    assert named == {*RULES, *LEAVES, *fields}


FIELDS = {re.sub(r"[`]|\s*\(.*\)", "", row[0]): row[1] for row in rows("Fields of the output")}


def test_each_field_names_a_section_with_rows() -> None:
    for field, section in FIELDS.items():
        assert section in (GIVEN, WORDS) or rows(section), field


def test_each_answer_and_each_certainty_has_a_row() -> None:
    assert set(get_args(Certainty)) == {row[0] for row in rows("How an answer is known")}
    claimed = {row[0] for row in rows("Fields of the output")}
    assert {f"`verdict` ({answer})" for answer in Answer} <= claimed


NAMED = {"witnesses", "witness_numbers", "variables", "joints", "rates", "constants", "lengths", "L"}
"""Fields that are tables of the mechanism's own names."""


def keys(data: Any) -> Iterator[str]:
    """The names of all fields, but those that are the mechanism's."""
    if isinstance(data, dict):
        for key, value in data.items():
            yield key
            if key not in NAMED and not (key in ("points", "ranks", "matrices") and isinstance(value, dict)):
                yield from keys(value)
            elif key == "matrices":
                yield from keys(list(value.values()))
    elif isinstance(data, (list, tuple)):
        for part in data:
            yield from keys(part)


@cache
def outputs() -> dict[str, Any]:
    """What the commands print of a small mechanism, singular where the crank and the rod are in line."""
    mechanism = load("slider-crank")
    equation = velocity_equation(mechanism)
    dead = {"points": {"B": [1, 0], "C": [4, 0]}}
    return {
        "classify": classification_data(classify(mechanism, cache=False)),
        "rows": classify(mechanism, cache=False).table(),
        "solve": solution_data("", solve(mechanism, "5", "i", cache=False)),
        "conditions": conditions_data("", conditions(equation)),
        "check": mobility_data("", equation, check_mobility(equation)),
        "at": analysis_data("", at(mechanism, dead)),
    }


@pytest.mark.parametrize("command", ["classify", "rows", "solve", "conditions", "check", "at"])
def test_each_field_of_the_output_has_a_row(command: str) -> None:
    assert set(keys(outputs()[command])) <= FIELDS.keys()
