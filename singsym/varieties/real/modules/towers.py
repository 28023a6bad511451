"""Circles with dyads over them: what a curve of a planar linkage mostly is.

Source: Dulmage-Mendelsohn, see `block_form`; a crank with Assur groups of the second class.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

from singsym.polynomials import Equations, Polynomial, Ring
from singsym.polynomials.block_form import Module, block_form, independent_parts
from singsym.varieties.real.modules.assemblies import is_circle, is_round


@dataclass(frozen=True)
class Tower:
    """A circle and the dyads over it, in the order in which they are solved.

    foundation: modules that do not depend on the circle, among them the relations of fixed numbers; the
    circle's centre and radius may be theirs.  base: the two variables of the circle.
    """

    foundation: tuple[Module, ...]
    circle: Polynomial
    base: tuple[str, str]
    dyads: tuple[Module, ...]

    @property
    def standing(self) -> Equations:
        """The equations of the foundation in their own ring."""
        below = self.circle.ring.subring([name for m in self.foundation for name in m.unknowns])
        return tuple(below.convert(p) for m in self.foundation for p in m.equations)

    @property
    def base_ring(self) -> Ring:
        """The ring of the foundation and of the circle."""
        return self.circle.ring.subring([*self.base, *(name for m in self.foundation for name in m.unknowns)])

    @property
    def needed(self) -> Equations:
        """Its equations without those that have only fixed numbers in common with the others."""
        constants = {c.name for c in self.circle.ring.constants}
        fixed = [p for m in self.foundation if constants.issuperset(m.unknowns) for p in m.equations]
        modules = (*self.foundation, *self.dyads)
        parts = independent_parts((self.circle, *(p for m in modules for p in m.equations)))
        return tuple(dict.fromkeys((*parts[0], *fixed)))


def towers(equations: Sequence[Polynomial]) -> Iterator[Tower]:
    """Each way to see equations of a curve as a circle with dyads over it.

    >>> from singsym.polynomials import Ring
    >>> ring = Ring(("c", "s", "x", "y"))
    >>> c, s, x, y = ring.gens
    >>> found = next(towers((c**2 + s**2 - 1, (x - c) ** 2 + (y - s) ** 2 - 9, (x - 3) ** 2 + y**2 - 4)))
    >>> found.base, found.dyads[0].unknowns
    (('c', 's'), ('x', 'y'))
    """
    for circle in equations:
        ring = circle.ring
        constants = {c.name for c in ring.constants}
        names = [name for name in circle.variables if name not in constants]
        for x, y in combinations(names, 2):
            if not is_circle(circle, (x, y)):
                continue
            form = block_form([p for p in equations if p is not circle], given=(x, y))
            known, foundation, dyads = set[str](), list[Module](), list[Module]()
            for module in form.modules:
                if known.issuperset(module.parents):
                    foundation.append(module)
                    known |= set(module.unknowns)
                else:
                    dyads.append(module)
            complete = 2 + sum(len(m.unknowns) for m in form.modules) == len(ring.names)
            stands = known.issuperset({*circle.variables} - {x, y})
            if complete and stands and not form.left_over and all(map(is_round, dyads)):
                yield Tower(tuple(foundation), circle, (x, y), tuple(dyads))
