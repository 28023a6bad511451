"""Conditions (vi) and (4) as an equilibrium of screws, each reciprocal to the joints of its leg.

Source: Zlatanov, Fenton, Benhabib (1998), step 1 of section 5.3.2, for (vi) and two loops.  The same for any
number: only the output's rows have T, with an identity, so that a row vector y with y L = 0 is zero there and
a screw for each loop.  A joint in several loops asks that the sum of their screws, with the signs by which
they pass it, is reciprocal to its own.  For y L_I = 0, condition (4), only passive joints ask.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from flint import fmpq_mat

if TYPE_CHECKING:
    from singsym.kinematics.velocity import VelocityEquation
    from singsym.polynomials import Polynomial

Signs = tuple[int, ...]

_IDLE = "no idle spin at "


@dataclass(frozen=True)
class Equilibrium:
    """Joints in the same loops make a leg; L, or L_I, drops in rank where screws can be chosen as said.

    joints: the names of those of each leg whose columns the matrix has, or of the columns of a part of one.
    carried: for each leg the signs with which free screws make up the one that is reciprocal to its joints.
    free: places of the legs that bear one free screw each.
    idle: spherical joints whose spin about their strut is left out.
    surplus: rows that the matrix has more than N: so many independent choices there are everywhere.
    """

    joints: tuple[tuple[str, ...], ...]
    carried: tuple[Signs, ...]
    free: tuple[int, ...]
    idle: tuple[str, ...] = ()
    surplus: int = 0

    @property
    def words(self) -> str:
        """The condition in words, as what follows "if".

        >>> from singsym.kinematics.velocity import velocity_equation
        >>> from singsym.mechanism import load
        >>> equilibrium(velocity_equation(load("3rrr"))).words
        'screws reciprocal to A2 B2 C2 and to A3 B3 C3, not both 0, have a sum reciprocal to A1 B1 C1'
        """
        names = [" ".join(joints) for joints in self.joints]
        rest = [k for k in range(len(names)) if k not in self.free]
        own = [names[k] for k in self.free]
        if len(names) == 1:
            said = f"a screw other than 0 is reciprocal to {own[0]}"
        elif len(own) == 2 and len(rest) == 1:
            both = f"screws reciprocal to {own[0]} and to {own[1]}, not both 0,"
            said = f"{both} have a sum reciprocal to {names[rest[0]]}"
        else:
            screws = [(f"w{i}", name) for i, name in enumerate(own, 1)]
            screws += [(_sum(self.carried[k]), names[k]) for k in rest]
            listed = "; ".join(f"{screw} to {name}" for screw, name in screws)
            said = f"screws, not all 0, are reciprocal as follows: {listed}"
        if self.surplus:
            said += f", in more than {self.surplus} independent way{'' if self.surplus == 1 else 's'}"
        return f"{said} (without spins of struts at {', '.join(self.idle)})" if self.idle else said


def equilibrium(equation: VelocityEquation, inputs: bool = True) -> Equilibrium | None:
    """The legs of a mechanism with loops; None without loops, and where couplings tie rates to each other.

    inputs: whether the columns of the inputs count, as in L and not in L_I.
    """
    blocks = equation.loop_rows
    idle = tuple(row.removeprefix(_IDLE) for row in equation.rows if row.startswith(_IDLE))
    others = sum(not row.startswith(("output ", "loop ", _IDLE)) for row in equation.rows)
    if not blocks or others or not _output_is_apart(equation):
        return None
    patterns: dict[Signs, dict[str, list[str]]] = {}
    whole = Counter[str]()
    for j, column in enumerate(equation.columns):
        if column.role == "output":
            continue
        signs = _signs([[equation.matrix.rows[i][j] for i in rows] for rows in blocks])
        if signs is None and (inputs or column.role != "input"):
            return None
        joint = column.label.split(".")[0]
        whole[joint] += signs is None or any(signs)
        if signs is not None and any(signs) and (inputs or column.role != "input"):
            patterns.setdefault(signs, {}).setdefault(joint, []).append(column.label)
    kinds = sorted(patterns, key=lambda s: sum(map(bool, s)))
    free: list[Signs] = []
    for signs in kinds:
        if fmpq_mat([list(s) for s in (*free, signs)]).rank() > len(free):
            free.append(signs)
    carried = _carried(free, list(patterns))
    if carried is None or len(free) < len(blocks):
        return None
    return Equilibrium(
        tuple(
            tuple(
                name
                for joint, labels in joints.items()
                for name in ([joint] if len(labels) == whole[joint] else labels)
            )
            for joints in patterns.values()
        ),
        carried,
        tuple(list(patterns).index(signs) for signs in free),
        idle,
        len(equation.rows) - equation.N,
    )


def _output_is_apart(equation: VelocityEquation) -> bool:
    """Whether the output's velocities have an identity in the output's rows, and nothing else."""
    outputs = [j for j, column in enumerate(equation.columns) if column.role == "output"]
    rows = [i for i, row in enumerate(equation.rows) if row.startswith("output ")]
    matrix = equation.matrix
    return len(rows) == len(outputs) and all(
        row[j] == (1 if (i, j) == (rows[k], outputs[k]) else 0)
        for i, row in enumerate(matrix.rows)
        for k, j in enumerate(outputs)
    )


def _signs(screws: Sequence[Sequence[Polynomial]]) -> Signs | None:
    """How the loops pass a joint, up to a common sign; None where they do not have the same screw of it."""
    own = next((screw for screw in screws if any(screw)), None)
    if own is None:
        return (0,) * len(screws)
    found = []
    for screw in screws:
        if not any(screw):
            found.append(0)
        elif screw in (own, [-e for e in own]):
            found.append(1 if screw == own else -1)
        else:
            return None
    return tuple(found)


def _carried(free: list[Signs], patterns: list[Signs]) -> tuple[Signs, ...] | None:
    """Patterns as sums of the free ones with signs, these turned so that the first sum has plus signs."""
    if not free or fmpq_mat([list(s) for s in free]).rank() < len(free[0]):
        return None
    inverse = fmpq_mat([list(s) for s in free]).inv()
    rows = (fmpq_mat([list(s)]) * inverse for s in patterns)
    found = [tuple(int(row[0, i]) for i in range(len(free))) for row in rows]
    turned = [next((s[i] for s in found if s not in free and s[i]), 1) for i in range(len(free))]
    sums = [tuple(s * t for s, t in zip(row, turned, strict=True)) for row in found]
    return tuple(row if next(filter(None, row)) > 0 else tuple(-s for s in row) for row in sums)


def _sum(signs: Signs) -> str:
    """Free screws with signs, as a sum.

    >>> _sum((1, 0, -1))
    'w1 - w3'
    """
    terms = [f"{'-' if s < 0 else '+'} w{i}" for i, s in enumerate(signs, 1) if s]
    return " ".join(terms).removeprefix("+ ")
