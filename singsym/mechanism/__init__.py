"""Mechanisms as data: model, file format, checks, library.

Source: singsym's own; see `singsym new` for the format.
"""

from singsym.mechanism.checks import check
from singsym.mechanism.choices import Choice
from singsym.mechanism.fileformat import define, load, loads
from singsym.mechanism.model import (
    Coupling,
    Exclusion,
    Joint,
    JointKind,
    JointRate,
    Limit,
    Link,
    Mechanism,
    Parameter,
    PointVelocity,
    Space,
    Twist,
)
from singsym.mechanism.problems import MechanismError, Problem
from singsym.mechanism.writer import dumps

__all__ = [
    "Choice",
    "Coupling",
    "Exclusion",
    "Joint",
    "JointKind",
    "JointRate",
    "Limit",
    "Link",
    "Mechanism",
    "MechanismError",
    "Parameter",
    "PointVelocity",
    "Problem",
    "Space",
    "Twist",
    "check",
    "define",
    "dumps",
    "load",
    "loads",
]
