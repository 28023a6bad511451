"""A directed acyclic graph drawn in rows of boxes, with arrows between them.

Source: Sugiyama, Tagawa, Toda, IEEE Trans. Syst. Man Cybern. 11 (1981) 109-125: nodes in the order of the
means of their neighbours above.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from singsym.output.figures.style import INK, PALE

_STEP = 1.6
"""From row to row, where the boxes of the widest row are 1 apart."""


@dataclass(frozen=True)
class Box:
    """A node as it is drawn."""

    text: str
    colour: str


@dataclass(frozen=True)
class Arrow:
    """An arrow from box to box, dashed where it is not `whole`."""

    start: Any
    end: Any
    whole: bool = True


def box_width(boxes: Iterable[Box]) -> float:
    """Inches that the widest of the texts needs."""
    return 0.6 + 0.075 * max(len(line) for box in boxes for line in box.text.split("\n"))


def draw_layers(
    axes: Any, rows: Sequence[Sequence[Any]], boxes: Mapping[Any, Box], arrows: Sequence[Arrow]
) -> None:
    """Draw the boxes of nodes in rows from above, each row in the order of its neighbours' places above."""
    above: dict[Any, list[Any]] = {node: [] for node in boxes}
    level = {node: k for k, row in enumerate(rows) for node in row}
    for arrow in arrows:
        upper, lower = sorted((arrow.start, arrow.end), key=lambda node: level[node])
        above[lower].append(upper)
    widest = max(len(row) for row in rows)
    place: dict[Any, tuple[float, float]] = {}
    for k, row in enumerate(rows):
        middles = {node: _mean(place[n][0] for n in above[node] if n in place) for node in row}
        for i, node in enumerate(sorted(row, key=lambda node: (middles[node], node))):
            place[node] = ((i + 0.5) * widest / len(row), -_STEP * k)
    axes.axis("off")
    patches = {}
    for node, box in boxes.items():
        style = {"boxstyle": "round,pad=0.4", "fc": box.colour, "ec": INK}
        how = {"ha": "center", "va": "center", "fontsize": 8.5, "color": INK, "zorder": 3}
        patches[node] = axes.text(*place[node], box.text, bbox=style, **how).get_bbox_patch()
    for arrow in arrows:
        line = {"arrowstyle": "-|>", "color": PALE, "lw": 1.3, "ls": "-" if arrow.whole else "--"}
        ends = {"patchA": patches[arrow.start], "patchB": patches[arrow.end], "shrinkA": 1, "shrinkB": 1}
        axes.annotate("", place[arrow.end], place[arrow.start], arrowprops={**line, **ends}, zorder=1)
    axes.set(xlim=(-0.1, widest + 0.1), ylim=(row_height(len(rows) - 1) - 0.7, 0.7))


def row_height(row: int) -> float:
    """Where a row is drawn."""
    return -_STEP * row


def _mean(values: Iterable[float]) -> float:
    found = list(values)
    return sum(found) / len(found) if found else 0.0
