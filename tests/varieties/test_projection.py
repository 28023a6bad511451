"""Images under projections that are neither closed nor open, by hand."""

from __future__ import annotations

from singsym.polynomials import Ring
from singsym.varieties.constructible import ConstructibleSet
from singsym.varieties.projection import project

R = Ring(("x", "y", "t"))
x, y, t = R.gens
PLANE = Ring(("x", "y"))
X, Y = PLANE.gens
LINE = Ring(("x",))


def zeros(*equations: object) -> ConstructibleSet:
    return ConstructibleSet.zeros(PLANE, *equations)  # type: ignore[arg-type]


def test_a_hyperbola_misses_a_point() -> None:
    """x t = 1 has a solution t exactly where x is not 0."""
    found = project(ConstructibleSet.zeros(R, x * t - 1), ("x", "y"))
    assert found.exact.is_yes
    assert found.image.equals(ConstructibleSet.nonzeros(PLANE, X)).is_yes
    assert found.image.equals(ConstructibleSet.zeros(PLANE)).is_no


def test_a_chart_of_a_blown_up_point() -> None:
    """y = x t: all points with x not 0, and of the line x = 0 the origin alone; not closed, not open."""
    found = project(ConstructibleSet.zeros(R, y - x * t), ("x", "y"))
    assert found.exact.is_yes
    assert found.image.equals(ConstructibleSet.nonzeros(PLANE, X) | zeros(X, Y)).is_yes
    assert (found.image & zeros(X, Y - 1)).is_empty().is_yes
    assert (found.image & zeros(X - 1, Y - 5)).is_empty().is_no


def test_a_circle_covers_the_complex_line() -> None:
    """x^2 + t^2 = 1 has a complex t for every x: the image over the complex numbers is everything."""
    circle = ConstructibleSet.zeros(R, x**2 + t**2 - 1, y)
    found = project(circle, ("x",))
    assert found.exact.is_yes
    assert found.image.equals(ConstructibleSet.zeros(LINE)).is_yes


def test_exclusions_are_projected_too() -> None:
    """t^2 = x without t = 1: x = 1 is still the image of t = -1; t = x without t = 1 misses x = 1."""
    off = ConstructibleSet.nonzeros(R, t - 1)
    doubled = project(ConstructibleSet.zeros(R, t**2 - x, y) & off, ("x",))
    assert doubled.image.equals(ConstructibleSet.zeros(LINE)).is_yes
    single = project(ConstructibleSet.zeros(R, t - x, y) & off, ("x",))
    assert single.image.equals(ConstructibleSet.nonzeros(LINE, LINE.gens[0] - 1)).is_yes


def test_a_projected_inequality_is_not_claimed() -> None:
    """Of t = x > 0 the inequality is lost with t, and the answer says that it is not exact."""
    half = ConstructibleSet.zeros(R, t - x, y) & ConstructibleSet.where(R, positive=[t])
    found = project(half, ("x",))
    assert found.exact.is_no
    assert "inequality" in (found.exact.reason or "")
    kept = project(ConstructibleSet.zeros(R, t - x, y) & ConstructibleSet.where(R, positive=[x]), ("x",))
    assert kept.exact.is_yes
    assert kept.image.cells[0].positive == (LINE.gens[0],)
