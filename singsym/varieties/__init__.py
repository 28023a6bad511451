"""Solution sets: decomposition, constructible sets, and real points, dimensions and curves."""

from singsym.varieties.cells import Cell
from singsym.varieties.constructible import ConstructibleSet
from singsym.varieties.decomposition import Component, decompose

__all__ = ["Cell", "Component", "ConstructibleSet", "decompose"]
