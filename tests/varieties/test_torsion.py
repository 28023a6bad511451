"""Off which zeros the ring of an ideal is a free module over that of its independent variables."""

from random import Random

from flint import fmpq

from singsym.elimination.ideal import Ideal
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.irreducibility import Splitting, analyse
from singsym.varieties.torsion import NormalForms, Presentation, off_free, presentation, torsion_support

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


# -- the parts of the proof ------------------------------------------------------------------------------

PLANE = Ring(("x", "u"))
SPACE = Ring(("x", "y", "u"))


def test_normal_forms_are_exact() -> None:
    """Modulo 2 x - 1: 4 x u + u = 3 u, with its factor 3, which a primitive remainder does not have."""
    a, b = PLANE.gens
    forms = NormalForms(PLANE, (2 * a - 1,))
    assert forms.reduce(4 * a * b + b) == 3 * b
    assert forms.reduce(a * a) == PLANE.constant(1) / 4
    assert forms.reduce(b) == b


def test_an_embedded_point_is_torsion() -> None:
    """In Q[x, u]/(x^2, x u) the element x is not zero and u x is: torsion over 0; so over 1."""
    a, b = PLANE.gens
    module = presentation(PLANE, (a**2, a * b), [(0,), (1,)])
    assert module == Presentation(((fmpq(0),),), ({},))
    assert torsion_support(module, Random(1)) == [[0, 1]]
    module = presentation(PLANE, (a**2, a * b - a), [(0,), (1,)])
    assert module == Presentation(((fmpq(1),),), ({},))
    assert torsion_support(module, Random(1)) == [[-1, 1]]


def test_a_curve_that_only_looks_as_if_it_had_torsion() -> None:
    """x^2 = 1, y = x u: u x = y is no relation of x alone, the module has the free basis 1, x.

    In the order x > y > u the leading monomials of the basis are x^2, x y, y^2 and x u, so x is the only
    standard monomial on a finite strip, and u x = y is on the strip of y.
    """
    a, b, c = SPACE.gens
    module = presentation(SPACE, (a**2 - 1, a * b - c, b**2 - c**2, a * c - b), [(0, 0), (1, 0), (0, 1)])
    assert module == Presentation(((fmpq(0),),), ({((0, 1), 0): fmpq(1)},))
    assert torsion_support(module, Random(1)) == []


def test_off_which_zeros_a_ring_is_free() -> None:
    """Q[x, u]/(x^2 - u) has the basis 1, x over Q[u], and Q[x, u]/(x^2, x u) is not free, but is off u = 0.

    The curve of the test before this is free, but u x = y gives x by y only off u = 0: that is what is said.
    """
    a, b = PLANE.gens
    assert off_free(PLANE, (a**2 - b,), [(0,), (1,)]) == 1
    assert off_free(PLANE, (a**2, a * b), [(0,), (1,)]) == b
    a, b, c = SPACE.gens
    twisted = (a**2 - 1, a * b - c, b**2 - c**2, a * c - b)
    assert off_free(SPACE, twisted, [(0, 0), (1, 0), (0, 1)]) == c
