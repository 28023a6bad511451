"""The steps of section 3.2 of Zlatanov, Fenton, Benhabib (1998)."""

from __future__ import annotations

from functools import reduce
from operator import or_

import pytest

from singsym.classes.taxonomy.steps import excluded_in, found_in
from singsym.classes.taxonomy.types import SingularityType, feasible_classes

T = SingularityType


def kinds(text: str) -> SingularityType:
    return reduce(or_, (T[name] for name in text.split()), T(0))


@pytest.mark.parametrize(
    ("types", "step"),
    [("RI IO", "6"), ("RI RO II IO", "6"), ("RPM II IO", "3.5"), ("RI RO IIM", "3.4"), ("RPM IIM", "3.3")],
)
def test_step_of_a_class(types: str, step: str) -> None:
    """Step 6 divides what is left of (4) and (5); 3.3-3.5 what has IIM and RPM, IIM, RPM."""
    assert found_in(kinds(types)) == step


@pytest.mark.parametrize(
    ("types", "others", "step"),
    [
        ("RPM IIM", "RI IO", "1"),
        ("RPM II IO", "RI IO", "2"),
        ("RPM IIM RI IO", "RI RO IIM", "3.1"),
        ("RPM RI II IO", "RPM II IO", "3.2"),
        ("RO II", "RI IO", "4"),
        ("RI IO", "RO II", "5"),
        ("RI RO II IO", "RI IO,RO II", "6"),
    ],
)
def test_first_step_that_excludes(types: str, others: str, step: str) -> None:
    """1 finds no IIM, 2 no RPM, 3.1 and 3.2 the wrong companions, 4 and 5 an empty condition, 6 the rest."""
    assert excluded_in(kinds(types), [kinds(t) for t in others.split(",")]) == step


def test_nothing_singular_excludes_every_class_before_step_6() -> None:
    assert {excluded_in(c.types, []) for c in feasible_classes()} == {"1", "2", "4", "5"}
