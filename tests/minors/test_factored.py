"""Factored determinants: the published factorisations of two arms, and values preserved on the circles."""

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from singsym.kinematics.nonzero import Certifier
from singsym.kinematics.placement import ConfigurationSpace
from singsym.minors.determinant import TooManyTerms, determinant
from singsym.minors.factored import condense, determinant_factors, factored
from singsym.minors.trigonometry import trigonometric_factors
from singsym.polynomials import Polynomial, PolynomialMatrix, Ring
from singsym.polynomials.unit_circles import separate_circles

Vector = list[Polynomial]
ARM = Ring(tuple(f"{f}{i}" for i in range(1, 7) for f in "cs"))
C, S = ARM.gens[::2], ARM.gens[1::2]
CIRCLES = tuple(c * c + s * s - 1 for c, s in zip(C, S, strict=True))


def cross(a: Vector, b: Vector) -> Vector:
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def jacobian(rows: list[tuple[int, fmpq, fmpq]]) -> PolynomialMatrix:
    """The geometric Jacobian of standard DH rows (quarter turns of alpha, a, d), at the last origin."""
    one, zero = ARM.one, ARM.zero
    frame = [[one, zero, zero], [zero, one, zero], [zero, zero, one]]
    origin, axes, origins = [zero] * 3, [], []
    for i, (quarter, a, d) in enumerate(rows):
        axes.append([row[2] for row in frame])
        origins.append(origin)
        ca, sa = [(1, 0), (0, 1), (-1, 0), (0, -1)][quarter % 4]
        turn = [[C[i], -S[i] * ca, S[i] * sa], [S[i], C[i] * ca, -C[i] * sa], [zero, one * sa, one * ca]]
        shift = [C[i] * a, S[i] * a, one * d]
        dot = [sum((f * t for f, t in zip(row, shift, strict=True)), start=zero) for row in frame]
        origin = [o + x for o, x in zip(origin, dot, strict=True)]
        frame = [
            [sum((row[k] * turn[k][j] for k in range(3)), start=zero) for j in range(3)] for row in frame
        ]
    columns = [
        [*axis, *cross(axis, [a - b for a, b in zip(origin, start, strict=True)])]
        for axis, start in zip(axes, origins, strict=True)
    ]
    return PolynomialMatrix.of(ARM, columns).T


def test_puma_560() -> None:
    """-a2 s5 (a3 s3 + d4 c3)(a2 c2 + a3 c23 - d4 s23): literature/results row 8."""
    a2, a3, d3, d4 = fmpq(4318, 10000), fmpq(203, 10000), fmpq(15005, 100000), fmpq(4318, 10000)
    o = fmpq(0)
    arm = jacobian([(1, o, o), (0, a2, o), (-1, a3, d3), (1, o, d4), (-1, o, o), (0, o, o)])
    found = determinant_factors(arm, Certifier(ConfigurationSpace(ARM, CIRCLES)))
    (_, c2, c3, *_), (_, s2, s3, _, s5, _) = C, S
    c23, s23 = c2 * c3 - s2 * s3, s2 * c3 + c2 * s3
    expected = {s5, (s3 * a3 + c3 * d4).primitive(), (c2 * a2 + c23 * a3 - s23 * d4).primitive()}
    assert set(found.polynomials) == expected


def test_ur5() -> None:
    """-a2 a3 s3 s5 (a2 c2 + a3 c23 + d5 s234): literature/results row 9."""
    a2, a3 = fmpq(-425, 1000), fmpq(-39225, 100000)
    d1, d4, d5, d6 = fmpq(89159, 10**6), fmpq(10915, 10**5), fmpq(9465, 10**5), fmpq(823, 10**4)
    o = fmpq(0)
    arm = jacobian([(1, o, d1), (0, a2, o), (0, a3, o), (1, o, d4), (-1, o, d5), (0, o, d6)])
    found = determinant_factors(arm, Certifier(ConfigurationSpace(ARM, CIRCLES)))
    (_, c2, c3, c4, *_), (_, s2, s3, s4, s5, _) = C, S
    c23, s23 = c2 * c3 - s2 * s3, s2 * c3 + c2 * s3
    last = (c2 * a2 + c23 * a3 + (s23 * c4 + c23 * s4) * d5).primitive()
    assert set(found.polynomials) == {s3, s5, last}


R = Ring(("c", "s", "d", "t", "x"))
c, s, d, t, x = R.gens
SPACE = ConfigurationSpace(R, (c**2 + s**2 - 1, d**2 + t**2 - 1))
PIECES = st.sampled_from(
    [s, c, 1 + c, 1 - c, c * d - s * t, s * t + c * d - x, 2 * s + t, 3 * c + d * x - 1, c + d]
)


@pytest.mark.parametrize(
    ("polynomial", "factors"),
    [
        (1 - c**2, {s}),
        (s**2 * c, {s, c}),
        (1 + c, {c + 1}),
        ((c * d - s * t + 1) * (c + 3), {c * d - s * t + 1}),
        (s * d + c * t, {s * d + c * t}),
    ],
)
def test_half_angles_keep_zero_and_pi(polynomial: Polynomial, factors: set[Polynomial]) -> None:
    found = set(factored([polynomial], Certifier(SPACE)).polynomials)
    if polynomial == 1 - c**2:
        assert found in (factors, {c + 1, c - 1})
    else:
        assert found == factors


@settings(max_examples=50, deadline=None)
@given(st.lists(PIECES, min_size=1, max_size=3), st.integers(-5, 5), st.integers(-5, 5), st.integers(-3, 3))
def test_factors_have_the_zeros_of_the_product(pieces: list[Polynomial], k: int, m: int, value: int) -> None:
    product = R.one
    for piece in pieces:
        product = product * piece
    reduced = Certifier(SPACE).normal_form(product)
    point = [
        fmpq(1 - k * k, 1 + k * k),
        fmpq(2 * k, 1 + k * k),
        fmpq(1 - m * m, 1 + m * m),
        fmpq(2 * m, 1 + m * m),
        fmpq(value),
    ]
    for factors in (
        trigonometric_factors(reduced, separate_circles(SPACE.equations)),
        factored([reduced], Certifier(SPACE)).factors,
    ):
        values = [f.evaluate(point) for f, _ in factors]
        assert (0 in values) == (product.evaluate(point) == 0)


def test_units_are_said_and_a_vanishing_determinant_is_known() -> None:
    certifier = Certifier(SPACE)
    assert factored([c**2 + s**2 - 1], certifier).vanishes
    found = factored([(c**2 + s**2) ** 2 * (x**2 + 1)], certifier)
    assert not found.factors
    assert any("terms have one sign" in str(unit) for unit in found.units)


FREE = Certifier(ConfigurationSpace(R, ()))


@settings(max_examples=60, deadline=None)
@given(
    st.lists(
        st.lists(st.sampled_from([0, 0, 0, 1, c, s, x, d - t]), min_size=6, max_size=6),
        min_size=6,
        max_size=6,
    )
)
def test_condensation_keeps_the_determinant_up_to_a_constant(rows: list[list[Polynomial]]) -> None:
    matrix = PolynomialMatrix.of(R, rows)
    rest, contents = condense(matrix, FREE)
    product = determinant(rest)
    for factor in contents:
        product = product * factor
    assert product.primitive() == determinant(matrix).primitive()


def test_too_many_terms_are_refused() -> None:
    ring = Ring(tuple(f"x{i}" for i in range(25)))
    dense = PolynomialMatrix.of(ring, [ring.gens[5 * i : 5 * i + 5] for i in range(5)])
    with pytest.raises(TooManyTerms, match="more than 50"):
        determinant_factors(dense, Certifier(ConfigurationSpace(ring, ())), 50)
