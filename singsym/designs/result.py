"""The result of a design: borders, cells with their tables, and what of it is proven to be constant.

Source: singsym's own.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import sympy

from singsym.classes.result import Classification, ClassResult
from singsym.classes.taxonomy.types import SingularityType, feasible_classes
from singsym.designs.borders import BorderPart, Borders
from singsym.designs.plane import Plane
from singsym.mechanism.model import Mechanism

if TYPE_CHECKING:
    from singsym.output.figures.style import Picture

Entry = tuple[int, str, int | None, int | None, int | None]
"""Of a class: its number, the answer, its dimension, points and components, None where there is no such."""


@dataclass(frozen=True)
class Cell:
    """A connected part of the space of parameters, and the classification at an exact sample in it.

    sample: values of the parameters; where: the cell in words; signs: of `Design.dividing` in it, for two
    parameters; places: the cells of `Design.plane` that it is made of; reason: why it has no classification;
    about: of a value of the border, in floats.
    """

    sample: Mapping[str, sympy.Expr]
    where: str
    classification: Classification | None
    reason: str = ""
    signs: tuple[int, ...] = ()
    places: tuple[tuple[int, int], ...] = ()
    about: float | None = None

    def __repr__(self) -> str:
        return f"Cell({self.where!r}, {sum(e[0] > 0 for e in self.entries)} classes)"

    @cached_property
    def entries(self) -> tuple[Entry, ...]:
        """What the table of classes says here, of the classes that are not proven empty.

        One entry of number 0 where there is no configuration at all; none where there is no classification.
        """
        found = self.classification
        if found is None:
            return ()
        there = tuple(map(_entry, _there(found)))
        return there if there or found.configuration_space else ((0, "no", None, None, None),)


@dataclass(frozen=True)
class Design:
    """How the table of classes depends on one or two parameters.

    dividing: the factors of the border that divide the ranges; cells: open, all of the ranges but the border;
    values: of one parameter, the border's roots, each with a table where its degree is not too high; of two,
        a point on each factor of the border between any two cells, where nothing is said of others;
    plane: of two parameters, the stacks of cells; open: what is not decided, with reasons.
    """

    mechanism: Mechanism
    parameters: tuple[str, ...]
    borders: Borders
    dividing: tuple[BorderPart, ...]
    cells: tuple[Cell, ...]
    values: tuple[Cell, ...] = ()
    plane: Plane | None = field(default=None, compare=False)

    def __repr__(self) -> str:
        names = ", ".join(self.parameters)
        return f"Design({self.mechanism.name!r} over {names}, {len(self.cells)} cells)"

    @cached_property
    def doubts(self) -> tuple[tuple[SingularityType, str], ...]:
        """Types of which it is not proven that they are the same all over a cell, with reasons.

        No types stand for whether there are configurations; where a class occurs in each cell that is known.
        """
        seen = all(cell.entries and cell.entries[0][0] for cell in self.cells)
        return tuple((types, reason) for types, reason in self.borders.open if types or not seen)

    def is_constant(self, types: SingularityType) -> bool:
        """Whether occurrence, dimension and numbers of the class with these types are constant over cells."""
        return not any(types == own for own, _ in self.doubts)

    @property
    def undecided(self) -> bool:
        """Whether anything is open."""
        return any(True for _ in self.open_questions())

    def open_questions(self) -> Iterator[tuple[str, str]]:
        """What is not decided, each with the reason."""
        numbers = {c.types: c.number for c in feasible_classes(3)}
        for types, reason in self.doubts:
            what = f"class {numbers[types]}" if types else "that there are configurations"
            yield f"whether constant over the cells: {what}", reason
        for cell in (*self.cells, *self.values):
            if cell.classification is None:
                yield f"the table where {cell.where}", cell.reason
            else:
                for what, reason in cell.classification.open_questions():
                    yield f"{what} where {cell.where}", reason

    def is_sample_only(self, cell: Cell) -> bool:
        """Whether a cell is a part of the border of which the table of one point alone is known."""
        return self.plane is not None and not cell.places

    def tables(self) -> tuple[tuple[Entry, ...], ...]:
        """The different tables of the cells that have one, in their order."""
        return tuple(dict.fromkeys(cell.entries for cell in self.cells if cell.classification is not None))

    def rows(self) -> list[dict[str, Any]]:
        """A row for each class of each cell and border value, for example for `pandas.DataFrame`."""
        from singsym.output.design.page import design_rows

        return design_rows(self)

    def plot(self, *, ax: Any = None) -> Picture:
        """The cells over the parameters, coloured by their tables, see `output.design.chart`."""
        from singsym.output.design.chart import plot_design

        return plot_design(self, axes=ax)

    def latex(self) -> str:
        """The border, factored, in LaTeX."""
        from singsym.output.design.page import border_latex

        return border_latex(self)

    def _repr_html_(self) -> str:
        from singsym.output.design.page import design_html

        return design_html(self)


def _there(found: Classification) -> list[ClassResult]:
    return [c for c in found.classes if not c.verdict.is_no]


def _entry(found: ClassResult) -> Entry:
    number = found.singularity_class.number
    return number, str(found.verdict.answer), found.dimension, found.points, found.components
