"""The comparison of answers: what counts as different, and what only as less."""

from __future__ import annotations

from copy import deepcopy
from typing import Any

import pytest

from singsym.classes.classify import classify
from singsym.mechanism import load
from singsym.output.plain_data import classification_data
from tests.laws.answers import contradictions


@pytest.fixture(scope="module")
def crank_rocker() -> dict[str, Any]:
    """Class 1 in 4 points, all else empty, a smooth curve of configurations."""
    return classification_data(classify(load("fourbar"), cache=False))


def changed(answer: dict[str, Any], part: str, field: str, value: object) -> dict[str, Any]:
    other = deepcopy(answer)
    other[part][0][field] = value
    return other


@pytest.mark.parametrize(
    ("part", "field", "value"),
    [
        ("classes", "verdict", "no"),
        ("classes", "dimension", 1),
        ("classes", "points", 3),
        ("classes", "components", 2),
        ("loci", "verdict", "yes"),
        ("loci", "points", 1),
        ("configuration_space", "smooth", "no"),
        ("configuration_space", "dimension", 2),
    ],
)
def test_another_value_is_a_contradiction(
    crank_rocker: dict[str, Any], part: str, field: str, value: object
) -> None:
    other = changed(crank_rocker, part, field, value)
    assert contradictions(crank_rocker, other)
    assert contradictions(other, crank_rocker)


@pytest.mark.parametrize(
    ("part", "field", "value"),
    [("classes", "verdict", "undecided"), ("classes", "points", None), ("loci", "dimension", None)],
)
def test_no_value_is_none(crank_rocker: dict[str, Any], part: str, field: str, value: object) -> None:
    assert not contradictions(crank_rocker, changed(crank_rocker, part, field, value))
