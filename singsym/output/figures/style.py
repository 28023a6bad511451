"""Colours and sizes that all figures share, and a figure with its title and description.

Source: singsym's own.
"""

from __future__ import annotations

import io
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Velocities = Mapping[tuple[str, str], Floats]
"""Velocities of points by link and point."""

INK = "#1f2329"
PALE = "#8b949f"
LINK = "#dbe4ee"
PLATFORM = "#f6e3bd"
INPUT = "#c8500a"
OUTPUT = "#0b7a66"
MOTION = {"RI": "#1a56c4", "RO": "#b3123f", "RPM": "#7a2bb5"}
SERIES = ("#1a56c4", "#b3123f", "#0b7a66", "#a06a00", "#7a2bb5", "#3f6f87", "#8a3d12", "#566b13")
DASHES = ("-", "--", "-.", ":", (0, (8, 2, 1, 2, 1, 2)), (0, (3, 1)), (0, (1, 3)), (0, (10, 3)))
PAPER = "#ffffff"


@dataclass(frozen=True, eq=False)
class Picture:
    """A matplotlib figure, its title, and what it shows in words for those who cannot see it.

    A notebook shows it as vector graphics.
    """

    figure: Any = field(repr=False)
    title: str
    description: str

    def svg(self, *, letters: str = "path") -> str:
        """The figure as an SVG element, the same for the same content.

        letters: "path", drawn and everywhere the same; or "none", text in a font of the reader's.
        """
        import matplotlib

        stream = io.StringIO()
        settings = {"svg.fonttype": letters, "svg.hashsalt": "singsym", "path.simplify_threshold": 0.3}
        with matplotlib.rc_context(settings):
            self.figure.savefig(
                stream, format="svg", transparent=True, metadata={"Date": None, "Creator": None}
            )
        text = stream.getvalue()
        return text[text.index("<svg") :]

    def places(self, x: Floats, y: Floats) -> Floats:
        """Where points of the first axes are in the SVG element, one a row."""
        pixels = self._placing.transform(np.column_stack([x, y]))
        points = pixels * 72 / self.figure.dpi
        height = 72 * self.figure.get_figheight()
        return np.column_stack([points[:, 0], height - points[:, 1]])

    @cached_property
    def _placing(self) -> Any:
        """From points of the first axes to pixels, once all is laid out."""
        self.figure.draw_without_rendering()
        return self.figure.axes[0].transData

    def save(self, path: str | Path) -> Path:
        """Write to a file; its ending says the format (svg, pdf, png and what else matplotlib writes)."""
        target = picture_path(path)
        self.figure.savefig(target, dpi=160)
        return target

    def _repr_svg_(self) -> str:
        return self.svg()


def picture_path(path: str | Path) -> Path:
    """Where a picture can be written; raises `ValueError` for an ending that says no known format."""
    from matplotlib.backend_bases import FigureCanvasBase

    target, known = Path(path), FigureCanvasBase.get_supported_filetypes()
    if target.suffix[1:].lower() not in known:
        raise ValueError(f"{target.name}: expected a file name that ends in {', '.join(sorted(known))}")
    return target


def paper(axes: Any, width: float, height: float) -> Any:
    """The axes to draw on: those given, or of None the only ones of a new figure of this size in inches."""
    return canvas(width, height).add_subplot() if axes is None else axes


def entitle(axes: Any, title: str, *, alone: bool) -> None:
    """A title over axes; alone: whether they are the only ones of a figure of their own."""
    if alone:
        axes.figure.suptitle(title, fontsize=11, color=INK)
    else:
        axes.set_title(title, fontsize=10, color=INK)


def canvas(width: float, height: float) -> Any:
    """An empty figure of this size in inches, apart from pyplot's global state."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure
