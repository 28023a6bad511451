"""Off which zeros the ring of an ideal is a free module over that of its independent variables."""

from singsym.elimination.ideal import Ideal
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.irreducibility import Splitting, analyse

R = Ring(("x", "y", "u", "v"))
x, y, u, v = R.gens


def products(first: tuple[Polynomial, ...], second: tuple[Polynomial, ...]) -> Ideal:
    return Ideal(R, tuple(p * q for p in first for q in second))


def unsplit(ideal: Ideal) -> Splitting:
    """What is found where no draw of coordinates splits the variety, which would be right as well."""
    return next(found for found in (analyse(ideal, seed=s).value for s in range(20)) if not found.factors)


def test_a_line_beside_a_surface() -> None:
    """The graph x = u^2, y = u v, and the line x = 5, y = 1, u = 2, on which `beside` vanishes."""
    found = unsplit(products((x - u**2, y - u * v), (x - 5, y - 1, u - 2)))
    assert found.prime
    assert found.beside is not None
    assert found.beside.substitute({"x": R.one * 5, "y": R.one, "u": R.one * 2}).is_zero
    assert not found.beside.substitute({"x": u**2, "y": u * v}).is_zero


def test_an_embedded_point_of_a_surface() -> None:
    """The plane x = y = 0 with the origin embedded: x and y times the maximal ideal."""
    found = unsplit(products((x, y), (x, y, u, v)))
    assert found.prime
    assert found.beside is not None
    assert found.beside.substitute(dict.fromkeys(R.names, R.zero)).is_zero
    assert not found.beside.substitute({"x": R.zero, "y": R.zero}).is_zero


def test_planes_that_meet_in_a_point() -> None:
    """They are of one dimension, but not Cohen-Macaulay: not connected in codimension 1 (Hartshorne 1962)."""
    found = analyse(products((x, y), (u, v))).value
    assert not found.macaulay
