"""Whether ideals are prime: by fibres that are fields, seen modulo primes or over Q."""

from __future__ import annotations

from random import Random

import pytest
from flint import fmpq_mat, fmpq_poly

from singsym.effort import chance
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Ring
from singsym.varieties.coordinates import coordinates
from singsym.varieties.irreducibility import _is_irreducible, analyse

R = Ring(("x", "y", "z"))
x, y, z = R.gens


def companion(*coefficients: int) -> fmpq_mat:
    """The matrix with the characteristic polynomial t^n + ... , constant coefficient first."""
    size = len(coefficients)
    rows = [[int(i == j + 1) for j in range(size)] for i in range(size)]
    for i, c in enumerate(coefficients):
        rows[i][size - 1] -= c
    assert fmpq_mat(rows).charpoly() == fmpq_poly([*coefficients, 1])
    return fmpq_mat(rows)


@pytest.mark.parametrize(
    ("coefficients", "irreducible"),
    [
        ((-2, 0, 0), True),  # t^3 - 2 has no root modulo a third of all primes
        ((-1, -1, 0), True),  # t^3 - t - 1, of discriminant -23, likewise
        ((1, 0, 0, 0), None),  # t^4 + 1 is irreducible, and a product modulo every prime
        ((6, 0, -5, 0), None),  # (t^2 - 2) (t^2 - 3)
        ((1, 2), False),  # (t + 1)^2
    ],
)
def test_degrees_of_factors_modulo_primes(coefficients: tuple[int, ...], irreducible: bool | None) -> None:
    """Yes only for what is irreducible over Q; of eight primes none would do with a chance of (2/3)^8."""
    with chance.use_seed(7):
        assert _is_irreducible(companion(*coefficients)) is irreducible


def test_an_ideal_that_no_prime_shows_to_be_prime() -> None:
    """Q(sqrt 2, sqrt 3) is a field, though t^4 - 10 t^2 + 1 is a product modulo every prime."""
    assert analyse(Ideal(R, (x**2 - 2, y**2 - 3, z))).value.prime
    assert not analyse(Ideal(R, (x**2 - 2, y**2 - 8, z))).value.prime


def test_curves_over_lines() -> None:
    """A twisted cubic is prime; two lines, one of them counted twice, or a cone over them, are not."""
    cubic = Ideal(R, (y - x**2, z - x**3))
    assert analyse(cubic, macaulay=True).value.prime
    assert not analyse(Ideal(R, (x**2, y)), macaulay=True).value.prime
    found = analyse(Ideal(R, (x * y, z)), macaulay=True).value
    assert not found.prime


def test_finite_over_forms() -> None:
    """The hyperbola x y = 1 is finite over x + k y for k not zero, but not over x, where it has a pole."""
    own, *changed = (place.value for place in coordinates(Ideal(R, (x * y - 1, z)), Random(3)))
    assert not own.is_finite().value
    assert all(place.is_finite().value for place in changed)
    assert all(
        place.turned().value.back(place.turned().value.ring.gens[-1]) == place.forms[0] for place in changed
    )


@pytest.mark.parametrize("seed", range(4))
def test_square_roots_of_which_a_product_is_rational(seed: int) -> None:
    """A set of three square roots over an ellipse, from a 3-UPU: two pieces, as at each of its points.

    At e = 7 the minimal polynomial of a c d has two factors of degree 4, those of a c, a d and c d have one.
    """
    ring = Ring(("a", "b", "c", "d", "e", "r"))
    a, b, c, d, e, r = ring.gens
    equations = (
        r**2 - 3,
        b**2 + b * e + e**2 - 3,
        3 * a**2 - 3 * e**2 - b * r - 5 * e * r - 3,
        3 * c**2 + 3 * b * e + b * r - e * r + 3,
        3 * d**2 + 3 * b * e + 3 * e**2 + 5 * b * r + e * r - 12,
    )
    found = analyse(Ideal(ring, equations), seed=seed).value
    assert len(found.factors) == 2
    assert Ideal(ring, equations).contains(found.factors[0] * found.factors[1]).value
