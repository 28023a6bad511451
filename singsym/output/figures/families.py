"""The families of a class: its pieces by what vanishes there, each with the configuration that shows it best.

Source: Table 2 of Zlatanov, Fenton, Benhabib (1998) lists a class by its conditions.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from singsym.classes.result import Classification, ClassResult, Configuration, Piece
from singsym.classes.taxonomy.types import Defects
from singsym.output.figures.poses import clearest
from singsym.output.figures.scene import Stage
from singsym.output.figures.style import Floats
from singsym.polynomials import Polynomial

_LONGEST = 44
"""Letters of a polynomial in a title."""


@dataclass(frozen=True, eq=False)
class Family:
    """Pieces of a class where the same conditions hold, in words or as equations.

    shown: their certified configurations, each with its rank defects, the one farthest from degenerate first.
    """

    words: str
    shown: tuple[tuple[Configuration, Defects], ...]


def families(classification: Classification, result: ClassResult, stage: Stage) -> tuple[Family, ...]:
    """Those of a class that have a configuration, in the order of the class's pieces."""
    said = {locus.factor: locus.words for locus in reversed(classification.loci)}
    by_words: dict[str, list[tuple[Configuration, Defects]]] = {}
    for piece in result.pieces:
        if piece.witnesses:
            own = by_words.setdefault(_words(classification, said, piece), [])
            own += [(witness, piece.defects) for witness in piece.witnesses]

    def point_of(choice: tuple[Configuration, Defects]) -> tuple[Floats, Defects]:
        return stage.vector(choice[0].coordinates), choice[1]

    found = []
    for words, own in by_words.items():
        best = clearest(stage, own, point_of)
        found.append(Family(words, (best, *(choice for choice in own if choice is not best))))
    return tuple(found)


def _words(classification: Classification, said: Mapping[Polynomial, str], piece: Piece) -> str:
    """What vanishes on a piece, shortly."""
    parts = [said.get(p) or short_equation(classification.lengths.shown(p)) for p in piece.path]
    return " and ".join(parts) or "everywhere"


def short_equation(factor: Polynomial) -> str:
    """A polynomial and that it is zero; how long it is where it is too long for a title."""
    text = str(factor)
    return f"{text} = 0" if len(text) <= _LONGEST else f"a polynomial of {len(factor)} terms is zero"
