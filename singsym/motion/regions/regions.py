"""The singularity-free regions of a mechanism with one or two degrees of freedom.

Source: as in `singsym.motion.regions.arcs` and `singsym.motion.regions.chart`.
"""

from __future__ import annotations

from singsym.kinematics.velocity import VelocityEquation, velocity_equation
from singsym.mechanism.model import Mechanism
from singsym.mechanism.problems import MechanismError, Problem
from singsym.motion.regions.arcs import arcs
from singsym.motion.regions.borders import borders, input_space
from singsym.motion.regions.chart import chart
from singsym.motion.regions.free_motion import FreeMotions
from singsym.motion.regions.result import Regions

GRID = 60
"""Cells along each of two inputs."""


def regions(mechanism: Mechanism, *, formulation: str = "auto", grid: int = GRID, seed: int = 0) -> Regions:
    """The parts of the configuration space between singularities, limits and exclusions.

    For n = 1 they are exact arcs, all of them and proven; for n = 2 they are found on a grid, of cells along
    each input, those with other signs are proven to be apart, and slices prove that they are all.
    Raises `MechanismError` for a larger mobility, where one condition holds everywhere, and where the inputs'
    values are not known.

    >>> from singsym.mechanism import load
    >>> found = regions(load("fourbar"))
    >>> str(found.verdict), [[b.words for b in r.ends] for r in found.regions][0]
    ('yes (certified): all arcs of the configuration curve between its borders', ['A, B, C collinear'])
    """
    return regions_equation(velocity_equation(mechanism, formulation), grid=grid, seed=seed)


def regions_equation(equation: VelocityEquation, *, grid: int = GRID, seed: int = 0) -> Regions:
    """The same for a velocity equation."""
    if equation.n > 2:
        expected = "n = 1 or 2; for more, whether two configurations can be joined, and a free box around one"
        raise MechanismError([Problem("regions", f"a mechanism with n = {equation.n}", expected)])
    if equation.space.parameters:
        found = f"no value of {', '.join(equation.space.parameters)}"
        raise MechanismError([Problem("parameters", found, "values, as mechanism.with_parameters(a=2)")])
    motions = FreeMotions(borders(equation), input_space(equation))
    return arcs(motions) if equation.n == 1 else chart(motions, grid, seed)
