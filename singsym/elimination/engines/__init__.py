"""Engines: FLINT inside, msolve and Singular outside, SymPy for reference.

Source: the registry, which says who does what.
"""

from singsym.effort.patience import patiently, proof_patience
from singsym.elimination.engines.base import (
    Engine,
    EngineAnswer,
    EngineFailure,
    EngineUnavailable,
    Task,
)
from singsym.elimination.engines.registry import (
    EngineStatus,
    allowed,
    ask,
    close,
    has,
    install,
    status,
    use,
)

__all__ = [
    "Engine",
    "EngineAnswer",
    "EngineFailure",
    "EngineStatus",
    "EngineUnavailable",
    "Task",
    "allowed",
    "ask",
    "close",
    "has",
    "install",
    "patiently",
    "proof_patience",
    "status",
    "use",
]
