"""Generic ranks of L and its submatrices at random configurations, and what they say against the author's n.

Source: Zlatanov, Fenton, Benhabib (1998), section 2.1; generic ranks: theory of the four integers, 2.3.
"""

from __future__ import annotations

from dataclasses import dataclass

from singsym.kinematics.numerical_rank import numerical_rank
from singsym.kinematics.sampling import sample_configurations
from singsym.kinematics.scaling import scaled_matrix
from singsym.kinematics.velocity import VelocityEquation

_TOLERANCE = 1e-7
_NAMES = ("L", "L_I", "L_O", "L_p")


@dataclass(frozen=True)
class Mobility:
    """Largest ranks seen at random configurations, numerically: hints for the user, not proofs.

    ranks: of L, L_I, L_O, L_p; gap: the smallest ratio between a singular value that was counted and the next
    one; samples: how many configurations were found whose ranks are clear, regular: how many of them are
    nonsingular.  Fewer than all point to components of another mobility.  messages: what contradicts N, n,
    inputs or outputs.
    """

    ranks: dict[str, int]
    gap: float
    samples: int
    regular: int
    messages: tuple[str, ...]


def check_mobility(equation: VelocityEquation, seed: int = 0, count: int = 12) -> Mobility:
    """Compare the ranks at `count` random configurations with N and n.

    >>> from singsym.kinematics.velocity import velocity_equation
    >>> from singsym.mechanism import load
    >>> check_mobility(velocity_equation(load("zlatanov-2dof"))).ranks
    {'L': 8, 'L_I': 8, 'L_O': 8, 'L_p': 6}
    """
    points = sample_configurations(equation.space, count, seed)
    if not points:
        nothing = "no configuration was found numerically: the loops may be impossible to close"
        return Mobility(dict.fromkeys(_NAMES, 0), float("inf"), 0, 0, (nothing,))
    seen = []
    for point in points:
        parts = scaled_matrix(equation, point).submatrices()
        here = {name: numerical_rank(part, _TOLERANCE, size=1.0) for name, part in parts.items()}
        if all(found.is_clear for found in here.values()):
            seen.append(here)
    if not seen:
        unclear = f"at all {len(points)} random configurations found, a rank is numerically unclear"
        return Mobility(dict.fromkeys(_NAMES, 0), 1.0, 0, 0, (unclear,))
    ranks = {name: max(here[name].rank for here in seen) for name in _NAMES}
    gap = min(found.gap for here in seen for found in here.values())
    regular = sum(here["L_I"].rank == here["L_O"].rank == equation.N for here in seen)
    return Mobility(ranks, gap, len(seen), regular, tuple(_messages(equation, ranks)))


def _messages(equation: VelocityEquation, ranks: dict[str, int]) -> list[str]:
    N, n = equation.N, equation.n
    roles = [column.role for column in equation.columns]
    found = []
    for role in ("input", "output"):
        number = roles.count(role)
        if number != n:
            found.append(f"{number} {role}s, expected n = {n}: as many as the mobility")
    freedoms = len(roles) - ranks["L"]
    if freedoms > n:
        found.append(
            f"at random configurations {freedoms} independent motions are possible, but n = {n}: "
            f"rank L = {ranks['L']}, expected N = {N}; state the mobility that is meant, or expect a "
            "mechanism that is shaky in every configuration"
        )
    if freedoms < n:
        found.append(
            f"at random configurations only {freedoms} independent motions are possible, but n = {n}: "
            f"rank L = {ranks['L']}, expected N = {N}; lower the mobility or free a joint"
        )
    if ranks["L_I"] < ranks["L"]:
        names = [c.label for c in equation.columns if c.role == "input"]
        found.append(
            f"{', '.join(names)} cannot be the inputs: rank L_I = {ranks['L_I']} < rank L = {ranks['L']} "
            "at random configurations, so their rates depend on each other; choose others"
        )
    if ranks["L_O"] < ranks["L"]:
        names = [c.label for c in equation.columns if c.role == "output"]
        found.append(
            f"{', '.join(names)} cannot be the outputs: rank L_O = {ranks['L_O']} < rank L = {ranks['L']} "
            "at random configurations, so they depend on each other; choose others"
        )
    return found
