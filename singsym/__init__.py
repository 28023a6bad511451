"""singsym finds and classifies every singularity of a mechanism, exactly.

Names are imported when they are first used, so that `import singsym` costs nothing.

>>> import singsym
>>> singsym.load("fourbar")
Mechanism('fourbar', 4 links, 4 joints)
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from singsym.classes.classify import Limits, classify, classify_equation
    from singsym.classes.configuration.at import at, at_equation
    from singsym.classes.result import Classification
    from singsym.classes.solve import solve, solve_equation
    from singsym.classes.taxonomy.types import Defects, SingularityType, class_of, feasible_classes
    from singsym.conditions.conditions import conditions
    from singsym.effort.budget import Budget
    from singsym.effort.verdict import Verdict
    from singsym.elimination import engines
    from singsym.elimination.ideal import Ideal
    from singsym.kinematics.own_equation import SymbolicSpace, from_sympy
    from singsym.kinematics.reduction import reduce
    from singsym.kinematics.velocity import loop_closure, velocity_equation
    from singsym.mechanism import Choice, Mechanism, MechanismError, check, define, dumps, load, loads
    from singsym.polynomials import Polynomial, PolynomialMatrix, Ring
    from singsym.varieties.constructible import ConstructibleSet
    from singsym.varieties.decomposition import decompose

_HOMES = {
    "singsym.mechanism": (
        "Choice",
        "Mechanism",
        "MechanismError",
        "check",
        "define",
        "dumps",
        "load",
        "loads",
    ),
    "singsym.kinematics.velocity": ("loop_closure", "velocity_equation"),
    "singsym.kinematics.own_equation": ("SymbolicSpace", "from_sympy"),
    "singsym.kinematics.reduction": ("reduce",),
    "singsym.elimination": ("engines",),
    "singsym.effort.budget": ("Budget",),
    "singsym.conditions.conditions": ("conditions",),
    "singsym.elimination.ideal": ("Ideal",),
    "singsym.effort.verdict": ("Verdict",),
    "singsym.varieties.constructible": ("ConstructibleSet",),
    "singsym.varieties.decomposition": ("decompose",),
    "singsym.classes.configuration.at": ("at", "at_equation"),
    "singsym.classes.classify": ("Limits", "classify", "classify_equation"),
    "singsym.classes.result": ("Classification",),
    "singsym.classes.solve": ("solve", "solve_equation"),
    "singsym.classes.taxonomy.types": ("Defects", "SingularityType", "class_of", "feasible_classes"),
    "singsym.polynomials": ("Polynomial", "PolynomialMatrix", "Ring"),
}
_HOME = {name: home for home, names in _HOMES.items() for name in names}

__all__ = [
    "Budget",
    "Choice",
    "Classification",
    "ConstructibleSet",
    "Defects",
    "Ideal",
    "Limits",
    "Mechanism",
    "MechanismError",
    "Polynomial",
    "PolynomialMatrix",
    "Ring",
    "SingularityType",
    "SymbolicSpace",
    "Verdict",
    "at",
    "at_equation",
    "check",
    "class_of",
    "classify",
    "classify_equation",
    "conditions",
    "decompose",
    "define",
    "dumps",
    "engines",
    "feasible_classes",
    "from_sympy",
    "load",
    "loads",
    "loop_closure",
    "reduce",
    "solve",
    "solve_equation",
    "velocity_equation",
]


def __getattr__(name: str) -> Any:
    """A public name, imported from its home."""
    if name not in _HOME:
        raise AttributeError(f"module 'singsym' has no attribute {name!r}")
    home = import_module(_HOME[name])
    value = import_module(f"{_HOME[name]}.{name}") if name == "engines" else getattr(home, name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
