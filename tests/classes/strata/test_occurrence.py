"""Whether parts of a configuration space have real points: what is proven empty, and what never is."""

from __future__ import annotations

import pytest

from singsym.classes.strata.occurrence import is_proven_empty, points_on, restricted, samples_of
from singsym.classes.strata.patches import unsplit
from singsym.polynomials import Ring
from singsym.varieties.decomposition import decompose
from singsym.varieties.real.system import RealSystem

R = Ring(("x", "y"))
x, y = R.gens
CIRCLE = x**2 + y**2 - 1


@pytest.mark.parametrize(
    ("system", "empty"),
    [
        (RealSystem(R, (x, x - 1)), True),
        (RealSystem(R, (x**2 + 1,)), True),
        (RealSystem(R, (x**2 + y**2 + 1,)), True),
        (RealSystem(R, (x**2 + y**2,), exclusions=((x, y),)), True),
        (RealSystem(R, (CIRCLE,), positive=(x - 2,)), True),
        (RealSystem(R, (x**2 - 2,)), False),
        (RealSystem(R, (x**2 + y**2,)), False),
        (RealSystem(R, (CIRCLE,), nonnegative=(x - 1,)), False),
        (RealSystem(R, (CIRCLE,), exclusions=((x, y - 1),)), False),
        (RealSystem(R, ()), False),
    ],
    ids=[
        "x = 0 = 1",
        "no real root",
        "negative radius",
        "its one real point is excluded",
        "beyond the circle",
        "two lines",
        "a point",
        "the circle's border",
        "a circle without a point",
        "the plane",
    ],
)
@pytest.mark.parametrize("modular", [True, False])
def test_what_is_proven_empty(system: RealSystem, empty: bool, modular: bool) -> None:
    assert is_proven_empty(system, modular=modular).is_yes == empty


def test_a_set_on_a_patch() -> None:
    """On x = y^2 the condition x > 0 is y^2 > 0; an exclusion loses what is zero or an equation there."""
    patch = unsplit([x - y**2, y**3 - y], R)
    assert patch.rest == (y**3 - y,)
    system = RealSystem(R, patch.generators, ((x - y**2, y - 2), (y - x * y,)), (x,), (x - 1,))
    found = restricted(system, patch)
    assert found.equations == (y**3 - y,)
    assert found.exclusions == ((y - 2,), ())
    assert (found.positive, found.nonnegative) == ((y**2,), (y**2 - 1,))


def test_points_on_a_patch_have_all_coordinates() -> None:
    """x = y + 1 on the circle: (1, 0) and (0, -1)."""
    patch = unsplit([x - y - 1, CIRCLE], R)
    found = points_on(RealSystem(R, ()), patch)
    assert found
    for a, b in found:
        assert a - b == pytest.approx(1)
        assert a * a + b * b == pytest.approx(1)


def test_samples_of_components() -> None:
    """Of x y = 0 the positive half of one axis is feasible; x^2 + 1 has no sample, nor (0, 1)."""
    feasible = RealSystem(R, (), positive=(x - 1,))
    (axis,) = decompose([y], ring=R).value
    found = samples_of(axis, feasible).value
    assert found
    assert all(a > 1 and b == pytest.approx(0) for a, b in found)
    (other,) = decompose([x], ring=R).value
    assert not samples_of(other, feasible).value
    (imaginary,) = decompose([x**2 + 1], ring=R).value
    assert samples_of(imaginary, RealSystem(R, ())).value is None
    (point,) = decompose([x, y - 1], ring=R).value
    assert samples_of(point, feasible).value is None
    assert samples_of(point, RealSystem(R, ())).value == ((0.0, 1.0),)
