"""Chance: the same seed draws the same, in other processes too; primes avoid what they are told to."""

from __future__ import annotations

import os
import subprocess
import sys
from itertools import islice

import pytest
import sympy

from singsym.effort.chance import (
    VARIABLE,
    numbers_in,
    random,
    random_primes,
    seed,
    sparing_prime,
    use_seed,
)
from singsym.polynomials import Ring

PROGRAM = """
from itertools import islice
from singsym.effort.chance import random, random_primes, seed
print(seed(), random("a test", 1).random(), *islice(random_primes("a test"), 3))
"""


def drawn_elsewhere(text: str, hashes: str) -> str:
    environment = {**os.environ, VARIABLE: text, "PYTHONHASHSEED": hashes}
    return subprocess.run(
        [sys.executable, "-c", PROGRAM], env=environment, capture_output=True, text=True, check=True
    ).stdout


def test_a_seed_draws_the_same_in_every_process() -> None:
    with use_seed(12):
        primes = map(str, islice(random_primes("a test"), 3))
        here = f"{seed()} {random('a test', 1).random()} {' '.join(primes)}"
    assert drawn_elsewhere("12", "1").strip() == drawn_elsewhere("12", "2").strip() == here
    assert drawn_elsewhere("13", "1").split()[1:] != here.split()[1:]


def test_without_a_seed_every_process_draws_its_own() -> None:
    assert drawn_elsewhere("", "1") != drawn_elsewhere("", "1")


def test_purposes_and_questions_draw_apart() -> None:
    values = {random("a test").random(), random("another").random(), random("a test", 1).random()}
    assert len(values) == 3


@pytest.mark.parametrize("bits", [31, 62])
def test_random_primes(bits: int) -> None:
    with use_seed(1):
        first = list(islice(random_primes("a test", bits=bits), 20))
        product = first[3] * first[7] * 10
        second = list(islice(random_primes("a test", bits=bits, avoiding=(0, 1, -product)), 18))
    assert all(sympy.isprime(p) and 2 ** (bits - 1) < p < 2**bits for p in first)
    assert len(set(first)) == 20
    assert second == [p for p in first if product % p]


def test_the_sparing_prime_is_one_of_the_seed() -> None:
    with use_seed(1):
        first = sparing_prime()
        assert sparing_prime() == first
    with use_seed(2):
        assert sparing_prime() != first


def test_numbers_in_polynomials() -> None:
    (x,) = Ring(("x",)).gens
    assert numbers_in((7 * x / 3 - 4, x)) == {7, 3, -4, 1}
