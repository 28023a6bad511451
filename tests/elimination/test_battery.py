"""One battery of problems on every engine that is there: all answers agree, and with known ones."""

from __future__ import annotations

from fractions import Fraction

import pytest
import sympy
from flint import fmpz
from hypothesis import given, settings
from hypothesis import strategies as st

from singsym.elimination import engines
from singsym.elimination.engines.text import read, used_variables, write
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Polynomial, Ring

PRESENT = [row.name for row in engines.status() if row.found]
every_engine = pytest.mark.parametrize("engine", PRESENT)

R = Ring(("names", "by", "z"))
x, y, z = R.gens
BIG = int("7" * 100)

# generators, dimension, degree; each from the geometry named
PROBLEMS = {
    "sphere": ((x**2 + y**2 + z**2 - 1,), 2, 2),
    "isolated real point x^2 + y^2 = 0": ((x**2 + y**2,), 2, 2),
    "empty over R, not over C": ((x**2 + y**2 + z**2 + 1, x), 1, 2),
    "double line": (((x - y) ** 2, z), 1, 2),
    "embedded point on a line": ((x**2, x * y, z), 1, 1),
    "unit ideal": ((x * y - 1, x, z), -1, 0),
    "zero ideal": ((), 3, 1),
    "zero ideal with a zero generator": ((R.zero,), 3, 1),
    "unused variables": ((y**2 - 2,), 2, 2),
    "100-digit coefficients": ((BIG * x * y - 1, BIG * y**2 - x, z - BIG), 0, 3),
    "two circles": ((x**2 + y**2 - 1, (x - 1) ** 2 + y**2 - 1, z), 0, 2),
    "twisted cubic": ((y - x**2, z - x**3), 1, 3),
    "three coordinate axes": ((x * y, y * z, x * z), 1, 3),
    "plane and line": ((x * z, y * z), 2, 1),
    "intersection of quadrics": ((x**2 + y * z - 1, y**2 + x * z - 2, z**2 + x * y - 3), 0, 8),
}


@every_engine
@pytest.mark.parametrize("problem", PROBLEMS)
def test_every_engine_gives_the_same_basis(engine: str, problem: str) -> None:
    generators, dimension, degree = PROBLEMS[problem]
    with engines.use("flint"):
        expected = Ideal(R, generators).groebner_basis().value
    with engines.use(engine):
        ideal = Ideal(R, generators)
        assert ideal.groebner_basis().value == expected
        assert (ideal.dimension.value, ideal.degree.value) == (dimension, degree)
        assert ideal.is_unit().value == (dimension < 0)


@every_engine
def test_algebraic_constants_of_a_tower(engine: str) -> None:
    """Q(sqrt 2, sqrt 3): sqrt 2 + sqrt 3 has minimal polynomial t^4 - 10 t^2 + 1."""
    ring = Ring(("r2", "r3", "t"))
    a, b, t = ring.gens
    with engines.use(engine):
        ideal = Ideal(ring, (a**2 - 2, b**2 - 3, t - a - b))
        assert ideal.vector_space_dimension.value == 4
        assert ideal.eliminate(("r2", "r3")).value.generators == (t**4 - 10 * t**2 + 1,)
        assert not ideal.radical_contains(a * b - t).value


@every_engine
def test_known_numbers_of_solutions(engine: str, katsura, cyclic) -> None:
    with engines.use(engine):
        assert Ideal(*katsura(3)).vector_space_dimension.value == 8
        if engine != "sympy":
            assert Ideal(*cyclic(5)).vector_space_dimension.value == 70


def test_large_bases_go_to_another_engine(katsura, cyclic) -> None:
    ideal = Ideal(*katsura(6))
    assert ideal.vector_space_dimension.value == 64
    if "msolve" in PRESENT:
        assert Ideal(*cyclic(6)).vector_space_dimension.value == 156


def test_ten_spellings_have_one_answer() -> None:
    """What msolve misreads silently (brackets, 2x, 0.5, 2*100*x, **, spaces) never reaches it."""
    a, b = sympy.symbols("names by")
    half = sympy.Rational(1, 2)
    spellings = [
        (a - 1) * (b - 2),
        a * b - 2 * a - b + 2,
        a * (b - 2) - (b - 2),
        sympy.Mul(a - 1, b - 2, evaluate=False),
        sympy.Add(a * b, -a, -a, -b, 1, 1, evaluate=False),
        half * (2 * a - 2) * (b - 2),
        (2 * a - 2) * (half * b - 1),
        sympy.expand((a - 1) * (b - 2) * 100) / 100,
        sympy.Poly((a - 1) * (b - 2), a, b).as_expr(),
        -(1 - a) * (b - 2),
    ]
    polynomials = [R.from_sympy(s) for s in spellings]
    for engine in PRESENT:
        with engines.use(engine):
            answers = {Ideal(R, (p, x**2 - 3 * y, z)).groebner_basis().value for p in polynomials}
        assert len(answers) == 1


def test_engines_see_expanded_integer_terms_and_no_names() -> None:
    polynomial = (x - 1) * (Fraction(1, 2) * y - 2) ** 2
    text = write(polynomial, used_variables((polynomial,)))
    assert not set(text) - set("0123456789x*+-^")
    assert read(text, R, (0, 1)) == polynomial.primitive()


def test_numbers_longer_than_python_converts() -> None:
    long = x * fmpz(10) ** 5000 - 1
    assert read(write(long, (0,)), R, (0,)) == long
    with engines.use("flint", "singular"):
        assert Ideal(R, (long, y**2 - x * y - 1, z**2 - y * z)).dimension.value == 0


@pytest.mark.engines
@pytest.mark.skipif("msolve" not in PRESENT, reason="msolve is not installed")
def test_msolve_reads_large_coefficients_modulo_a_prime() -> None:
    """Handed over as they are, coefficients above 2^63 would be cut off."""
    prime = 2**31 - 1
    task = engines.Task("groebner", R, (x * (2**31 - 1) * 5 + BIG * y - 1, z**2 - y, x**2 - z), (), prime)
    with engines.use("msolve"):
        basis = engines.ask(task).ideals[0]
    value = pow(BIG, -1, prime)
    assert (y - value) in basis or (y - value + prime) in basis


@pytest.mark.parametrize("rubbish", ["", "x1*", "x1x2", "2x1", "x1**2", "0.5*x1", "x4", "x1+", "foo", "*x1"])
def test_rubbish_is_not_a_polynomial(rubbish: str) -> None:
    with pytest.raises(ValueError, match=r"polynomial|variables"):
        read(rubbish, R, (0, 1, 2))


@pytest.mark.parametrize("order", ["lex", "deglex", "degrevlex"])
def test_monomial_orders(order: str) -> None:
    ring = Ring(("a", "b"), order)
    a, b = ring.gens
    bases = []
    for engine in PRESENT:
        with engines.use(engine):
            if engine != "msolve" or order == "degrevlex":
                bases.append(Ideal(ring, (a**2 + b**2 - 5, a * b - 2)).groebner_basis().value)
    assert len(set(bases)) == 1
    if order == "lex":
        assert bases[0][0] == b**4 - 5 * b**2 + 4


@every_engine
def test_eliminations_and_saturations_agree(engine: str) -> None:
    ideal = Ideal(R, (x**2 * y - z * x, y**2 * x - x))
    with engines.use("flint"):
        expected = _operations(ideal)
    with engines.use(engine):
        assert _operations(ideal) == expected


def _operations(ideal: Ideal) -> list[tuple[Polynomial, ...]]:
    other = Ideal(R, (x - y, z**2 - 1))
    found = [
        ideal.eliminate({"z"}).value,
        ideal.saturate(x).value,
        ideal.saturate(other).value,
        ideal.intersect(other).value,
        ideal.quotient(x * y).value,
        ideal * other,
    ]
    return [i.groebner_basis().value for i in found]


@pytest.mark.engines
@pytest.mark.skipif("singular" not in PRESENT, reason="Singular is not installed")
def test_singular_decomposes_what_factoring_does() -> None:
    ideal = Ideal(R, (x * y * (x - 1), z * (x**2 - 2)))
    with engines.use("flint", "singular"):
        primes = {p.groebner_basis().value for p in ideal.minimal_primes().value}
        pieces = engines.ask(engines.Task("facstd", R, ideal.generators)).ideals
        eliminated = engines.ask(engines.Task("eliminate", R, (x - z**2, y - z**3), (z,))).ideals[0]
        saturated = engines.ask(engines.Task("saturate", R, ideal.generators, (z,))).ideals[0]
    assert primes == {(z, x), (z, y), (z, x - 1), (y, x**2 - 2)}
    assert len(pieces) >= 4
    assert eliminated == (x**3 - y**2,)
    assert Ideal(R, saturated).equals(Ideal(R, (x**2 - 2, y))).value


small = st.integers(-3, 3)
monomials = [R.one, x, y, z, x * y, y * z, x**2, z**2 * x]
polynomials = st.lists(st.tuples(small, st.sampled_from(monomials)), min_size=1, max_size=4).map(
    lambda terms: sum((c * m for c, m in terms), start=R.zero)
)


@settings(max_examples=15, deadline=None)
@given(st.lists(polynomials, min_size=1, max_size=4))
def test_random_systems_agree(generators: list[Polynomial]) -> None:
    answers = []
    for engine in PRESENT:
        with engines.use(engine):
            ideal = Ideal(R, generators)
            known = ideal.groebner_basis(), ideal.dimension, ideal.radical_contains(x)
            answers.append(tuple(answer.value for answer in known))
    assert len(set(answers)) == 1
