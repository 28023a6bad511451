"""What the tests of the elimination package share: systems with known answers, a clean memory."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest

from singsym.elimination import engines, memo
from singsym.polynomials import Polynomial, Ring

System = tuple[Ring, tuple[Polynomial, ...]]


def _katsura(n: int) -> System:
    """Katsura's magnetism problem in n + 1 unknowns: 2^n complex solutions."""
    ring = Ring(tuple(f"u{i}" for i in range(n + 1)))
    u = ring.gens

    def at(i: int) -> Polynomial:
        return u[abs(i)] if abs(i) <= n else ring.zero

    rows = [sum((at(i) * at(m - i) for i in range(-n, n + 1)), start=ring.zero) - u[m] for m in range(n)]
    return ring, (*rows, u[0] + 2 * sum(u[1:], start=ring.zero) - 1)


def _cyclic(n: int) -> System:
    """The cyclic n-roots: 70 for n = 5, 156 for n = 6, 924 for n = 7 (Backelin and Fröberg 1991)."""
    ring = Ring(tuple(f"c{i}" for i in range(n)))
    rows = []
    for length in range(1, n):
        products = []
        for i in range(n):
            product = ring.one
            for j in range(length):
                product = product * ring.gens[(i + j) % n]
            products.append(product)
        rows.append(sum(products, start=ring.zero))
    product = ring.one
    for variable in ring.gens:
        product = product * variable
    return ring, (*rows, product - 1)


@pytest.fixture
def katsura() -> Callable[[int], System]:
    return _katsura


@pytest.fixture
def cyclic() -> Callable[[int], System]:
    return _cyclic


@pytest.fixture(autouse=True)
def _clean() -> Iterator[None]:
    """Nothing remembered from the test before, no process left after it."""
    memo.forget()
    yield
    memo.forget()
    engines.close()
