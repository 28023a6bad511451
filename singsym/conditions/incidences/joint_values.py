"""The values of a joint at which a polynomial in its cosine and sine, or in its length, vanishes.

Source: elementary: half angles, c = (1 - t^2) / (1 + t^2), s = 2 t / (1 + t^2) with t = tan(q/2).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import sympy

from singsym.kinematics.modules.words import listed
from singsym.kinematics.placement import JointValue
from singsym.polynomials import Polynomial

DEGREE_DIGITS, LENGTH_DIGITS = 1, 4
"""After the point, of rounded values."""


@dataclass(frozen=True)
class JointRoots:
    """A joint with all its values at which a polynomial vanishes.

    values: in degrees in (-180, 180], or lengths, ascending; rounded: whether they are.
    variables: of its cosine and sine; exact: its tangent, cosine or sine where the values are rounded, or "".
    """

    joint: str
    values: tuple[str, ...]
    unit: str
    rounded: bool
    variables: tuple[str, ...] = ()
    exact: str = ""

    @property
    def words(self) -> str:
        """The joint with its values.

        >>> JointRoots("J5", ("0", "180"), "deg", False).words
        'J5 = 0 or 180 deg'
        """
        unit = f" {self.unit}" if self.unit else ""
        said = f"{self.joint} {'≈' if self.rounded else '='} {listed(self.values, 'or')}{unit}"
        return f"{self.exact}, {said}" if self.exact else said

    def written_as(self, polynomial: Polynomial) -> JointRoots:
        """The same for the polynomial in names of lengths."""
        return replace(self, exact=_solved(polynomial, self.joint, self.variables)) if self.exact else self


def joint_roots(polynomial: Polynomial, values: Mapping[str, JointValue]) -> JointRoots | None:
    """The joint that alone is in a polynomial, with the values where this vanishes; None where there is none.

    Only joints whose cosine and sine, or length, are variables are looked at, and polynomials over Q.

    >>> from singsym.polynomials import Ring
    >>> R = Ring(("c", "s"))
    >>> c, s = R.gens
    >>> values = {"J": JointValue(c, s, R.one)}
    >>> print(joint_roots(3 * s + 4 * c, values).words, joint_roots(2 * c - 1, values).words, sep="; ")
    tan J = -4/3, J ≈ -53.1 or 126.9 deg; J = -60 or 60 deg
    """
    names = {*polynomial.variables}
    if not names or names & {constant.name for constant in polynomial.ring.constants}:
        return None
    for joint, value in values.items():
        own = _variables(value)
        if names <= {*own}:
            return _angles(joint, polynomial, own) if len(own) == 2 else _lengths(joint, polynomial, own)
    return None


def _variables(value: JointValue) -> tuple[str, ...]:
    """The variables that are a joint's cosine and sine, or its length; none where these are none."""
    parts = (value.length,) if value.length is not None else (value.cosine, value.sine)
    plain = [p for p in parts if p is not None and len(p.variables) == 1 and p == p.ring.gen(p.variables[0])]
    unscaled = value.scale is None or value.scale == 1
    return tuple(p.variables[0] for p in plain) if unscaled and len(plain) == len(parts) else ()


def _solved(polynomial: Polynomial, joint: str, variables: tuple[str, ...]) -> str:
    """a cos + b sin + d = 0, two terms of it, solved for the tangent, cosine or sine; "" for others."""
    cosine, sine = variables
    whole = polynomial.ring.gen(cosine), polynomial.ring.gen(sine)
    a, b = (polynomial.coefficient(x, 1) for x in variables)
    rest = polynomial - a * whole[0] - b * whole[1]
    if any(p.degree(x) > 0 for p in (a, b, rest) for x in variables):
        return ""
    for function, over, under, missing in (("tan", a, b, rest), ("sin", rest, b, a), ("cos", rest, a, b)):
        if over and under and not missing:
            return f"{function} {joint} = {sympy.sstr(sympy.cancel(-over.to_sympy() / under.to_sympy()))}"
    return ""


def _angles(joint: str, polynomial: Polynomial, variables: tuple[str, ...]) -> JointRoots | None:
    """By half angles: c = (1 - t^2) / (1 + t^2), s = 2 t / (1 + t^2), t at infinity for 180 degrees."""
    t = sympy.Symbol("t")
    c, s = (sympy.Symbol(name) for name in variables)
    expression = polynomial.to_sympy()
    halved = expression.subs({c: (1 - t**2) / (1 + t**2), s: 2 * t / (1 + t**2)})
    numerator = sympy.numer(sympy.together(halved))
    found = [sympy.pi] if not expression.subs({c: -1, s: 0}) else []
    if numerator.free_symbols:
        found += [2 * sympy.atan(root) for root in sympy.Poly(numerator, t).real_roots()]
    if not found:
        return None
    degrees, rounded = _written([sympy.deg(angle) for angle in found], DEGREE_DIGITS)
    exact = _solved(polynomial, joint, variables) if rounded else ""
    return JointRoots(joint, degrees, "deg", rounded, variables, exact)


def _lengths(joint: str, polynomial: Polynomial, variables: tuple[str, ...]) -> JointRoots | None:
    found = sympy.Poly(polynomial.to_sympy(), sympy.Symbol(variables[0])).real_roots()
    if not found:
        return None
    values, rounded = _written(found, LENGTH_DIGITS)
    return JointRoots(joint, values, "", rounded, variables)


def _written(numbers: list[sympy.Expr], digits: int) -> tuple[tuple[str, ...], bool]:
    """Distinct numbers, ascending: rational ones as they are, others rounded; whether any is rounded."""
    ordered = sorted(dict.fromkeys(numbers), key=lambda x: float(x.evalf(30)))
    texts = [str(x) if x.is_Rational else f"{float(x.evalf(30)):.{digits}f}" for x in ordered]
    return tuple(dict.fromkeys(texts)), not all(x.is_Rational for x in ordered)
