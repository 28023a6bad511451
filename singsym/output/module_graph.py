"""The modules of a mechanism, driven from the inputs and from the outputs: as text, as data, as a drawing.

Source: `singsym.kinematics.modules`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import networkx

from singsym.kinematics.modules import DrivenModules
from singsym.output.figures.layers import Arrow, Box, box_width, draw_layers, row_height
from singsym.output.figures.style import INK, LINK, PLATFORM, Picture, canvas
from singsym.output.page import Grid, Page

_HEADERS = ("", "module", "places", "variables", "after")


def modules_page(found: Mapping[str, DrivenModules]) -> Page:
    """A grid of modules for each end, and what is in none of them.

    >>> from singsym.kinematics.modules import driven_modules
    >>> from singsym.mechanism import load
    >>> from singsym.output.page import plain
    >>> print(plain(modules_page(driven_modules(load("slider-crank")))[:1]))
    Modules, driven from the inputs
       module                      places      variables  after
    -  --------------------------  ----------  ---------  -----
    1  crank AB at A               AB          Bx, By
    2  slider dyad C from B and P  BC, slider  d_P        1
    """
    return tuple(block for end, modules in found.items() for block in _page(end, modules))


def _page(end: str, found: DrivenModules) -> Page:
    rows = tuple(
        (
            str(number),
            module.words,
            ", ".join(module.links),
            ", ".join(module.variables),
            ", ".join(str(parent + 1) for parent in module.parents),
        )
        for number, module in enumerate(found.modules, 1)
    )
    blocks: list[str | Grid] = [Grid(_HEADERS, rows, f"Modules, driven from the {end}")]
    if found.undetermined:
        blocks.append(f"Not determined by the {end}: {', '.join(found.undetermined)}")
    if found.left_over:
        blocks.append(f"Loop equations beyond those of the modules: {len(found.left_over)}")
    return tuple(blocks)


def modules_data(found: Mapping[str, DrivenModules]) -> dict[str, Any]:
    """The modules of each end in order; parents by their places in it, from 0."""
    return {
        f"from_{end}": {
            "modules": [
                {
                    "words": module.words,
                    "links": list(module.links),
                    "variables": list(module.variables),
                    "unknowns": module.unknowns,
                    "equations": [str(e) for e in module.equations],
                    "driven": list(module.driven),
                    "meets": list(module.meets),
                    "parents": list(module.parents),
                }
                for module in modules.modules
            ],
            "undetermined": list(modules.undetermined),
            "left_over": [str(e) for e in modules.left_over],
        }
        for end, modules in found.items()
    }


def module_graph(found: DrivenModules) -> networkx.DiGraph:
    """Modules by their places as nodes, an edge from each parent, transitively reduced."""
    graph = networkx.DiGraph()
    graph.add_nodes_from(range(len(found.modules)))
    graph.add_edges_from((parent, k) for k, module in enumerate(found.modules) for parent in module.parents)
    return networkx.transitive_reduction(graph)


def plot_modules(found: Mapping[str, DrivenModules]) -> Picture:
    """The graph of modules from each end, parents above; what is driven has a colour of its own."""
    drawn = {end: _layers(modules) for end, modules in found.items() if modules.modules}
    if not drawn:
        raise ValueError("there is nothing to solve: no module")
    widths = {
        end: max(2.5, box_width(boxes.values()) * max(len(row) for row in rows))
        for end, (rows, boxes, _) in drawn.items()
    }
    most = max(len(rows) for rows, *_ in drawn.values())
    figure = canvas(sum(widths.values()), 1.4 + 1.5 * most)
    panels = figure.subplots(1, len(drawn), squeeze=False, width_ratios=list(widths.values()))[0]
    for axes, (end, (rows, boxes, arrows)) in zip(panels, drawn.items(), strict=True):
        draw_layers(axes, rows, boxes, arrows)
        axes.set(ylim=(row_height(most - 1) - 0.7, 0.7))
        axes.set_title(f"driven from the {end}", fontsize=10, color=INK)
    title = "Modules, with arrows to those that need them"
    figure.suptitle(title, fontsize=12, color=INK)
    lines = [f"from the {end}: {_sentence(modules)}" for end, modules in found.items()]
    return Picture(figure, title, "; ".join(lines))


def _layers(found: DrivenModules) -> tuple[list[list[int]], dict[int, Box], list[Arrow]]:
    graph = module_graph(found)
    rows = [sorted(row) for row in networkx.topological_generations(graph)]
    boxes = {
        k: Box(_broken(module.words), PLATFORM if module.driven else LINK)
        for k, module in enumerate(found.modules)
    }
    return rows, boxes, [Arrow(*edge) for edge in graph.edges]


def _broken(text: str, width: int = 26) -> str:
    """The text in lines of about this width."""
    lines = [""]
    for word in text.split(" "):
        if lines[-1] and len(lines[-1]) + len(word) >= width:
            lines.append(word)
        else:
            lines[-1] = f"{lines[-1]} {word}".strip()
    return "\n".join(lines)


def _sentence(found: DrivenModules) -> str:
    return ", then ".join(module.words for module in found.modules)
