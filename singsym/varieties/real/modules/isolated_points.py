"""Curves of dyads over a circle whose real points are isolated ones: there some dyads are in line.

Source: the coverings of `coverings`; singsym's own.
"""

from __future__ import annotations

from collections.abc import Callable

from singsym.effort import patience
from singsym.effort.attempts import attempt
from singsym.effort.verdict import Known, Premises
from singsym.polynomials import Equations, Polynomial
from singsym.varieties.real.modules.assemblies import dyad
from singsym.varieties.real.modules.curve_point import CurvePoint
from singsym.varieties.real.modules.module_points import curves_over_circle, without_given
from singsym.varieties.splitting import used_ring


def tangencies(equations: Equations) -> Known[Equations] | None:
    """Polynomials that vanish at all real points of equations, though not at all complex ones.

    Lemma: where the covering of a circle by dyads has no arc left, all its real points are among the zeros of
    the dyads' discriminants, and those tangencies that vanish at each of them may be added to the equations.
    None where the equations are not of such a curve, or this is not seen in time; 1 where there is no point.

    >>> from singsym.polynomials import Ring
    >>> c, s, x, y = Ring(("c", "s", "x", "y")).gens
    >>> stretched = (c**2 + s**2 - 4, (x - c) ** 2 + (y - s) ** 2 - 1, (x - 1) ** 2 + y**2 - 16)
    >>> tangencies(stretched).value
    (-4*s*x + 4*c*y + 4*s - 4*y,)
    """
    left, _ = without_given(equations)
    if not left:
        return None
    own, premises = used_ring(left[0].ring, left), Premises()
    with attempt("isolated points of a curve", patience.ASSEMBLIES.work):
        known = curves_over_circle(tuple(map(own.convert, left)))
        if known is None or any(curve.arcs for curve in known.value):
            return None
        curves = premises.take(known)
        points = [point for curve in curves for point in curve.points]
        if not points:
            return premises.conclude((equations[0].ring.one,))
        forms = [form.tangency for module in curves[0].dyads if (form := dyad(module)) is not None]
        touched = [p for p in map(own.convert, forms) if p and not any(map(_sign_of(p), points))]
        for point in points:
            premises.rest_on(point.premises.certainty)
        return premises.conclude(tuple(map(equations[0].ring.convert, touched)))
    return None


def _sign_of(polynomial: Polynomial) -> Callable[[CurvePoint], int]:
    return lambda point: point.sign(point.ring.convert(polynomial))
