"""The pieces of a class gathered by the equations that lead to them, and what moves in a configuration.

Source: Table 2 of Zlatanov, Fenton, Benhabib (1998) lists a class by its conditions.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from singsym.output.citations import SHORT
from singsym.polynomials import Equations, Polynomial
from singsym.polynomials.unit_circles import unit_circles

if TYPE_CHECKING:
    from singsym.classes.result import Classification, ClassResult, Locus, Piece
    from singsym.classes.solve import SolutionPiece
    from singsym.conditions.named_lengths import NamedLengths
    from singsym.kinematics.velocity import VelocityEquation
    from singsym.varieties.real.dimension.extent import Extent


@dataclass(frozen=True)
class Group:
    """All pieces of a class with the same vanishing factors; `words` has a text or "" for each factor."""

    path: Equations
    words: tuple[str, ...]
    extent: Extent
    points: int | None

    def text(self, names: Mapping[Polynomial, str]) -> str:
        """What vanishes on the pieces; names: of the polynomials that have one."""
        said = [
            w or f"{names.get(p) or p.short_text(6)} = 0" for p, w in zip(self.path, self.words, strict=True)
        ]
        return " and ".join(said) or "everywhere"


def grouped(
    pieces: Iterable[Piece], loci: Iterable[Locus], lengths: NamedLengths | None = None
) -> tuple[Group, ...]:
    """The pieces by their paths in order of appearance, points added up; lengths: those that have names."""
    from singsym.varieties.real.dimension.extent import union

    words = {locus.factor: locus.words for locus in loci}
    by_path: dict[Equations, list[Piece]] = {}
    for piece in pieces:
        by_path.setdefault(piece.path, []).append(piece)
    groups = []
    for path, own in by_path.items():
        counts = [piece.points for piece in own if piece.points is not None]
        points = sum(counts) if len(counts) == len(own) else None
        groups.append(
            Group(
                tuple(map(lengths.shown, path)) if lengths else path,
                tuple(words.get(p, "") for p in path),
                union(p.extent for p in own),
                points,
            )
        )
    return tuple(groups)


def alike(pieces: Iterable[SolutionPiece]) -> tuple[tuple[SolutionPiece, ...], ...]:
    """Pieces of a solution that would be printed in the same words, together."""
    found: dict[object, list[SolutionPiece]] = {}
    for piece in pieces:
        known = piece.verdict.answer, piece.verdict.certainty, piece.is_counted
        found.setdefault((piece.path, piece.extent, piece.points, known), []).append(piece)
    return tuple(map(tuple, found.values()))


def named_polynomials(result: Classification) -> dict[Polynomial, str]:
    """Names of the long polynomials that would be printed more than once, those of the loci first."""
    counts: Counter[Polynomial] = Counter()
    for locus in result.loci:
        counts[result.lengths.shown(locus.factor)] += not locus.words
    for found in result.classes:
        for group in grouped((*found.pieces, *found.unsure), result.loci, result.lengths):
            counts.update(p for p, words in zip(group.path, group.words, strict=True) if not words)
    often = (p for p, count in counts.items() if count > 1 and len(str(p)) > SHORT)
    return {polynomial: f"f{i}" for i, polynomial in enumerate(often, 1)}


def loop_equations(equation: VelocityEquation) -> Equations:
    """The equations of the configuration space, without those that only define its constants."""
    constants = {c.name for c in equation.space.ring.constants}
    return tuple(e for e in equation.space.equations if not constants.issuperset(e.variables))


def angles_counted_elsewhere(equation: VelocityEquation) -> tuple[str, ...]:
    """The cosine and sine of each angle whose variables are counted from elsewhere than its own zero."""
    space = equation.space
    constants = {c.name for c in space.ring.constants}
    lines = []
    for pair in unit_circles(space.equations):
        for name, value in equation.values.items():
            c, s = value.cosine, value.sine
            if c is None or s is None or value.scale != 1 or c == space.ring.gen(pair[0]):
                continue
            if {*c.variables, *s.variables} - constants == {*pair}:
                lines.append(f"cos {name} = {c}, sin {name} = {s}")
    return tuple(lines)


def varying(coordinates: Mapping[str, str], equation: VelocityEquation) -> dict[str, str]:
    """Coordinates by name without the constants of their ring."""
    constants = {c.name for c in equation.space.ring.constants}
    return {name: value for name, value in coordinates.items() if name not in constants}


def filled(headers: Sequence[str], rows: Sequence[Sequence[str]]) -> list[int]:
    """The numbers of the columns that are not empty in all rows.

    >>> filled(("a", "b", "c"), (("1", "", ""), ("2", "", "3")))
    [0, 2]
    """
    return [j for j in range(len(headers)) if not rows or any(row[j] for row in rows)]


def moving(points: Mapping[str, str], equation: VelocityEquation) -> dict[str, str]:
    """The coordinates, named `B.x`, of the points that are not fixed to the ground."""
    fixed = {n for n, place in equation.space.points.items() if all(p.is_constant for p in place)}
    return {name: value for name, value in points.items() if name.rpartition(".")[0] not in fixed}


def extent_of(found: Locus | ClassResult) -> str:
    """The dimension, as far as it is known; "" where the verdict says that there is nothing."""
    return "" if found.verdict.is_no else str(found.extent)


def parts_of(found: Locus | ClassResult) -> str:
    """How many points or connected components, in words; "?" for a number that is open.

    >>> counted(1, "point"), counted(2, "point"), counted("?", "point"), counted("not counted", "point")
    ('1 point', '2 points', '? points', 'not counted')
    """
    from singsym.classes.result import counts

    if found.verdict.is_undecided:
        return "?"
    points, components = counts(found)
    return counted(points, "point") if points else counted(components, "component")


def counted(number: int | str, one: str) -> str:
    """A number of things in words, and what stands for a number as it is."""
    text = str(number)
    return f"{text} {one}{'' if text == '1' else 's'}" if text.isdecimal() or text == "?" else text
