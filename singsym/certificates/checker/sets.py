"""What a certificate is about, and the sets that its rules take apart.

Source: the velocity equation of Zlatanov, Fenton, Benhabib, Mech. Mach. Theory 33 (1998), (1) to (3).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import compress
from typing import Any

from flint import fmpq_mpoly, fmpq_mpoly_ctx

from singsym.certificates.checker.polynomials import Rejected, polynomial, rational, ring

Matrix = tuple[tuple[fmpq_mpoly, ...], ...]
MOST = 64
"""Higher powers are refused."""
ROLES = ("output", "input", "passive")
MATRICES = ("L", "L_p", "L_I", "L_O")
_WITHOUT = {"L": (), "L_p": ("input", "output"), "L_I": ("input",), "L_O": ("output",)}


@dataclass(frozen=True)
class RealSet:
    """Real points where all `equations` vanish, no unit vanishes, and the inequalities hold.

    generators: of the ideal of the equations, as few as are known.
    units: polynomials that vanish nowhere on the set; positive, nonnegative: their signs are as they say.
    matrix, roles: what is left of the velocity equation, `eliminated` rows and columns less than at the
    start.
    """

    context: fmpq_mpoly_ctx
    equations: tuple[fmpq_mpoly, ...]
    generators: tuple[fmpq_mpoly, ...]
    units: tuple[fmpq_mpoly, ...]
    positive: tuple[fmpq_mpoly, ...]
    nonnegative: tuple[fmpq_mpoly, ...]
    matrix: Matrix
    roles: tuple[str, ...]
    eliminated: int

    @property
    def variables(self) -> tuple[str, ...]:
        """The names of the coordinates."""
        return tuple(self.context.names())

    @property
    def inequalities(self) -> tuple[fmpq_mpoly, ...]:
        """What is positive or not negative."""
        return *self.positive, *self.nonnegative

    def within(self, more: Sequence[fmpq_mpoly]) -> RealSet:
        """The part where more polynomials vanish."""
        return replace(self, equations=(*self.equations, *more), generators=(*self.generators, *more))

    def part(self, matrix: Sequence[Sequence[Any]], name: str) -> list[list[Any]]:
        """The columns of L, or of its values, that one of the four matrices has."""
        kept = [role not in _WITHOUT[name] for role in self.roles]
        return [[*compress(row, kept)] for row in matrix]


@dataclass(frozen=True)
class Statement:
    """The velocity equation L m = 0 and the configuration space that a certificate is about."""

    whole: RealSet
    N: int
    n: int

    def full_rank(self, name: str) -> int:
        """The rank below which one of the four matrices is singular."""
        return self.N - self.n if name == "L_p" else self.N


def listed(data: Mapping[str, Any], key: str, kind: type = object, default: Any = None) -> list[Any]:
    """A list of a line; raises `Rejected` where it is something else."""
    value = data.get(key, default)
    if not isinstance(value, list) or not all(type(item) is kind or kind is object for item in value):
        raise Rejected(f"{key}: expected a list of {kind.__name__}, got {str(value)[:80]}")
    return value


def named(data: Mapping[str, Any], key: str, default: Any = None) -> Mapping[str, Any]:
    """An object of a line; raises `Rejected` where it is something else."""
    value = data.get(key, default)
    if not isinstance(value, dict):
        raise Rejected(f"{key}: expected an object, got {str(value)[:80]}")
    return value


def whole_number(data: Mapping[str, Any], key: str, default: Any = None, most: int = 2**31) -> int:
    """A number from 0 to `most`; raises `Rejected` where there is something else."""
    value = data.get(key, default)
    if type(value) is not int or not 0 <= value <= most:
        raise Rejected(f"{key}: expected a whole number up to {most}, got {str(value)[:80]}")
    return value


def chosen(items: Sequence[Any], places: Sequence[Any], what: str) -> list[Any]:
    """Items by their places; raises `Rejected` where there is no such place."""
    for k in places:
        if type(k) is not int or not 0 <= k < len(items):
            raise Rejected(f"there is no {what} {k!r} (there are {len(items)})")
    return [items[k] for k in places]


def statement(data: Mapping[str, Any]) -> Statement:
    """The statement of a certificate, from its second line.

    An exclusion of several polynomials, of which not all vanish, is the sum of their squares that is not
    zero.
    """
    context = ring(listed(data, "variables", str))

    def read(texts: Any) -> tuple[fmpq_mpoly, ...]:
        return tuple(polynomial(text, context) for text in texts)

    nonnegative = list(read(listed(data, "nonnegative", str)))
    for entry in listed(data, "constants", list):
        if len(entry) != 3:
            raise Rejected(f"constants: expected [name, low, high], got {entry}")
        gen = polynomial(entry[0], context)
        nonnegative += [gen - rational(entry[1]), rational(entry[2]) - gen]
    units = []
    for exclusion in listed(data, "exclusions", list):
        parts = read(exclusion)
        units.append(parts[0] if len(parts) == 1 else sum((p * p for p in parts), start=context.constant(0)))
    positive = read(listed(data, "positive", str))
    rows = tuple(read(row) for row in listed(data, "L", list))
    roles = tuple(listed(data, "roles", str))
    if set(roles) - set(ROLES) or any(len(row) != len(roles) for row in rows):
        raise Rejected("L: expected a role, output, input or passive, for each entry of each row")
    equations = read(listed(data, "equations", str))
    nowhere, signs = (*units, *positive), (positive, tuple(nonnegative))
    whole = RealSet(context, equations, equations, nowhere, *signs, rows, roles, 0)
    N, n = whole_number(data, "N"), whole_number(data, "n")
    if [roles.count(role) for role in ROLES] != [n, n, N - n]:
        raise Rejected(f"L: expected {n} output, {n} input and {N - n} passive columns, as N = {N}, n = {n}")
    return Statement(whole, N, n)
