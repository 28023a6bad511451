"""A mechanism with parameters kept symbolic, and the strata of all its values together.

Source: Zlatanov, Fenton, Benhabib (1998), section 3.2; parameters are variables as any others.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from singsym.classes.running.runner import Runner
from singsym.classes.strata.branches import Branch
from singsym.classes.strata.reflections import reflections
from singsym.classes.strata.search import Exploration, search
from singsym.classes.strata.start import feasible_set, rank_problem, singular_loci
from singsym.effort.budget import Budget
from singsym.kinematics.placement import ConfigurationSpace
from singsym.kinematics.velocity import velocity_equation
from singsym.mechanism.model import Mechanism
from singsym.polynomials import Polynomial, Ring


@dataclass(frozen=True)
class Family:
    """The configurations of a mechanism for all values of its symbolic parameters, and their strata.

    exploration: strata on which the four ranks are constant, each a set over the space of parameters; of
        those that are images of each other under reflections that keep the parameters, one.
    """

    space: ConfigurationSpace
    exploration: Exploration

    @property
    def parameters(self) -> tuple[str, ...]:
        """The names of the symbolic parameters."""
        return self.space.parameters

    @cached_property
    def others(self) -> tuple[str, ...]:
        """The ring's names that are no parameters: configuration variables and algebraic constants."""
        return tuple(name for name in self.space.ring.names if name not in self.parameters)

    @cached_property
    def base(self) -> Ring:
        """The ring of the parameters."""
        return Ring(self.parameters)

    @cached_property
    def domain(self) -> tuple[Polynomial, ...]:
        """Polynomials that are positive inside the parameters' ranges, and nowhere else."""
        sided = (*self.space.positive, *self.space.nonnegative)
        return tuple(p for p in sided if not self.moves(p))

    def moves(self, polynomial: Polynomial) -> bool:
        """Whether a configuration variable is in it."""
        return not set(self.space.variables).isdisjoint(polynomial.variables)


def family(
    mechanism: Mechanism,
    formulation: str,
    runner: Runner,
    *,
    seconds: float | None = 60.0,
    budget: Budget | None = None,
) -> Family:
    """The family of a mechanism, of which those parameters without a value are symbolic.

    seconds: of work for each branch of the search; budget: of all of it.
    Raises `MechanismError` for a mechanism that cannot be placed.

    >>> from singsym.mechanism import load
    >>> found = family(load("fourbar").with_parameters(a=None), "auto", Runner())
    >>> found.parameters, len(found.exploration.found), found.exploration.unexplored
    (('a',), 8, ())
    """
    equation = velocity_equation(mechanism, formulation)
    found, space = equation.conditions, equation.space
    problem, feasible = rank_problem(found), feasible_set(space)
    # an image under a reflection that keeps the parameters has the same borders; where they meet is one too
    kept = reflections(feasible, space.equations, problem.matrices.values())
    symmetries = tuple(r for r in kept if not set(r) & set(space.parameters))
    root = Branch(problem, feasible, space.equations, symmetries=symmetries, seconds=seconds)
    return Family(space, search(root, runner, singular_loci(found), budget))
