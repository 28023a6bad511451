"""The modules of a mechanism in an order in which they can be solved, driven from either end."""

from singsym.kinematics.modules.driven_modules import (
    DrivenModule,
    DrivenModules,
    driven_modules,
    modules_from_inputs,
    modules_from_outputs,
)

__all__ = [
    "DrivenModule",
    "DrivenModules",
    "driven_modules",
    "modules_from_inputs",
    "modules_from_outputs",
]
