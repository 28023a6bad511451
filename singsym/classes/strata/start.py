"""Where the search for strata starts: the four matrices, the feasible set, and the loci of the conditions.

Source: Zlatanov, Fenton, Benhabib (1998), section 3.2, steps 1 and 2.
"""

from __future__ import annotations

from singsym.classes.strata.ranks import RankProblem
from singsym.classes.strata.search import Loci, SingularLoci
from singsym.conditions.conditions import Conditions
from singsym.kinematics.placement import ConfigurationSpace
from singsym.varieties.real.system import RealSystem


def rank_problem(found: Conditions) -> RankProblem:
    """The four matrices of the reduced velocity equation."""
    matrices = {name: found.matrix(name) for name in ("L", "L_I", "L_O", "L_p")}
    return RankProblem(matrices, found.reduction.constant, found.equation.N, found.equation.n)


def feasible_set(space: ConfigurationSpace) -> RealSystem:
    """The exclusions and inequalities of the feasible set Omega, without the loop equations."""
    return RealSystem(space.ring, (), space.exclusions, space.positive, space.nonnegative)


def singular_loci(found: Conditions) -> SingularLoci | None:
    """The alternatives of (4), (5), (iii) and (vi), where they are known.

    >>> from singsym.kinematics.velocity import velocity_equation
    >>> from singsym.mechanism import load
    >>> singular_loci(velocity_equation(load("fourbar")).conditions).passive
    ()
    """
    inputs, outputs, passive, mobility = (_alternatives(found, label) for label in ("4", "5", "iii", "vi"))
    return None if inputs is None or outputs is None else SingularLoci(inputs, outputs, passive, mobility)


def _alternatives(found: Conditions, label: str) -> Loci | None:
    condition = found[label]
    if condition.everywhere:
        return ((),)
    return None if condition.alternatives is None else condition.polynomials
