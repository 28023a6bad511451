"""To how many digits a configuration is given."""

from __future__ import annotations

import math
from typing import Any

import pytest

from singsym.classes.configuration.given_values import Given


@pytest.mark.parametrize(
    ("value", "digits"),
    [
        ("0.3", 16),
        ("1/3", 16),
        ("pi/6", 16),
        (math.pi, 16),
        (1e-90, 16),
        ("3.1415926535897932385", 20),
        ("0.00031415926535897932385", 20),
        ("31.415926535897932385 deg", 20),
        ("0.30000000000000000000000", 16),
    ],
)
def test_digits_beyond_a_double_count(value: Any, digits: int) -> None:
    """Short decimals, fractions, exact angles, doubles may be meant exactly; trailing zeros say nothing."""
    assert Given.of({"joints": {"A": value, "B": "1.5"}}).digits == digits


def test_the_least_precise_of_long_numbers_counts() -> None:
    given = {"points": {"B": ["3.1415926535897932384626434", "2.71828182845904523536"]}}
    assert Given.of(given).digits == 21
