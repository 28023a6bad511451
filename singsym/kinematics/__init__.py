"""From a mechanism to its loop equations and its velocity equation."""

from singsym.kinematics.formulations import FORMULATIONS, place
from singsym.kinematics.mobility import Mobility, check_mobility
from singsym.kinematics.own_equation import SymbolicSpace, from_sympy
from singsym.kinematics.placement import ConfigurationSpace, JointValue, Placement
from singsym.kinematics.sampling import sample_configurations
from singsym.kinematics.velocity import Column, VelocityEquation, loop_closure, velocity_equation

__all__ = [
    "FORMULATIONS",
    "Column",
    "ConfigurationSpace",
    "JointValue",
    "Mobility",
    "Placement",
    "SymbolicSpace",
    "VelocityEquation",
    "check_mobility",
    "from_sympy",
    "loop_closure",
    "place",
    "sample_configurations",
    "velocity_equation",
]
