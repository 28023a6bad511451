"""Pictures of mechanisms, of their singular configurations with null motions, of loci and of strata.

Source: Figs 1-12 of Zlatanov, Fenton, Benhabib (1998).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from textwrap import wrap
from typing import TYPE_CHECKING, Any

import numpy as np

from singsym.classes.taxonomy.types import Defects, SingularityType
from singsym.kinematics.velocity import VelocityEquation
from singsym.mechanism.model import JointRate, Mechanism, Space
from singsym.output.figures.families import Family, families
from singsym.output.figures.style import Picture

if TYPE_CHECKING:
    from singsym.classes.configuration.null_motions import Motion
    from singsym.classes.result import Classification, ClassResult, Configuration
    from singsym.output.figures.motions import Moving
    from singsym.output.figures.scene import Scene, Stage
    from singsym.output.figures.style import Floats

_TITLE, _BELOW = 60, 75
"""Letters of a title's line, and of a line below, that fit the width of a figure."""


def plot_mechanism(
    mechanism: Mechanism,
    coordinates: Mapping[str, str | float] | None = None,
    *,
    equation: VelocityEquation | None = None,
    seed: int = 0,
    axes: Any = None,
) -> Picture:
    """A mechanism drawn at a configuration.

    coordinates: the configuration variables by name (as in `Configuration.coordinates`); None: a regular
        configuration with room around its points, found numerically from `seed`.
    axes: of matplotlib, to draw on; None: those of a new figure.
    Raises `ValueError` where coordinates are missing or no configuration was found.

    >>> from singsym.mechanism import load
    >>> plot_mechanism(load("fourbar")).title
    'Four-bar linkage, crank-rocker'
    """
    from singsym.output.figures.poses import portrait
    from singsym.output.figures.scene import Stage

    stage = Stage.of(mechanism, equation)
    point = portrait(stage, seed) if coordinates is None else stage.vector(coordinates)
    title = mechanism.title or mechanism.name
    return _drawn(stage, point, (), (title,), f"{title}, {_words(mechanism)}", axes)


def plot_class(
    classification: Classification,
    result: ClassResult | SingularityType,
    witness: int | None = None,
    *,
    axes: Any = None,
) -> Picture:
    """A class at one of its certified configurations, with its null motions as arrows and as a later pose.

    witness: the number of a configuration; None: of the first family, the one farthest from degenerate.
    axes: of matplotlib, to draw on; None: those of a new figure.
    Raises `ValueError` where the class has no such configuration, or no mechanism was given.
    """
    stage = _stage(classification)
    found = classification[result] if isinstance(result, SingularityType) else result
    of_class = _known_families(classification, found, stage)
    if witness is None:
        return _family_drawn(stage, found, of_class[0].words, of_class[0].shown[0], axes)
    if not 0 <= witness < len(found.witnesses):
        known = f"{len(found.witnesses)} configurations known, no number {witness + 1}"
        raise ValueError(f"class {found.singularity_class}: {known}")
    wanted = found.witnesses[witness]
    words, shown = next((f.words, s) for f in of_class for s in f.shown if s[0] is wanted)
    return _family_drawn(stage, found, words, shown, axes)


def plot_families(
    classification: Classification, result: ClassResult | SingularityType
) -> tuple[Picture, ...]:
    """One picture for each family of a class, as for wrist, elbow and shoulder of an arm.

    Raises `ValueError` where the class has no known configuration, or no mechanism was given.
    """
    stage = _stage(classification)
    found = classification[result] if isinstance(result, SingularityType) else result
    of_class = _known_families(classification, found, stage)
    return tuple(_family_drawn(stage, found, f.words, f.shown[0], None) for f in of_class)


def _known_families(classification: Classification, result: ClassResult, stage: Stage) -> tuple[Family, ...]:
    if not result.witnesses:
        fact = "does not occur" if result.verdict.is_no else "has no known configuration"
        which = f"class {result.singularity_class.number} ({result.types})"
        raise ValueError(f"{which} {fact}: {result.verdict.reason}")
    return families(classification, result, stage)


def _family_drawn(
    stage: Stage, result: ClassResult, words: str, shown: tuple[Configuration, Defects], axes: Any
) -> Picture:
    from singsym.output.figures.motions import drawn_motions, motions_at

    point = stage.vector(shown[0].coordinates)
    motions = drawn_motions(motions_at(stage.equation, point, shown[1]))
    number, name = result.singularity_class.number, result.singularity_class.name
    title = f"Class {number} ({name}): {words}"
    lines = (stage.mechanism.title or stage.mechanism.name, title)
    return _drawn(stage, point, motions, lines, _class_words(stage, title, motions), axes)


def plot_configuration(
    mechanism: Mechanism,
    coordinates: Mapping[str, str | float],
    defects: Defects,
    *,
    equation: VelocityEquation | None = None,
    axes: Any = None,
) -> Picture:
    """A mechanism at a configuration with these rank defects, its null motions as arrows.

    axes: of matplotlib, to draw on; None: those of a new figure.
    """
    from singsym.output.figures.motions import drawn_motions, motions_at
    from singsym.output.figures.scene import Stage

    stage = Stage.of(mechanism, equation)
    point = stage.vector(coordinates)
    motions = drawn_motions(motions_at(stage.equation, point, defects))
    title = str(defects.types)
    return _drawn(stage, point, motions, (title,), _class_words(stage, title, motions), axes)


def _stage(classification: Classification) -> Stage:
    from singsym.output.figures.scene import Stage

    if classification.mechanism is None:
        raise ValueError("equations were given without a mechanism: there is nothing to draw")
    return Stage.of(classification.mechanism, classification.equation)


def _drawn(
    stage: Stage, point: Floats, motions: Sequence[Motion], lines: Sequence[str], description: str, axes: Any
) -> Picture:
    """A configuration drawn; lines: of the title, of which the last is the picture's own."""
    from singsym.output.figures.motions import Moving
    from singsym.output.figures.planar import draw_planar
    from singsym.output.figures.spatial import draw_spatial
    from singsym.output.figures.style import entitle, paper
    from singsym.output.figures.view import motion_seen, seen, viewpoint

    scene = stage.scene(point)
    moving = [Moving.of(stage, point, m) for m in motions]
    flat = scene.space is Space.PLANAR
    view = np.eye(2) if flat else viewpoint(scene)
    if not flat:
        scene, moving = seen(scene, view), [motion_seen(m, view) for m in moving]
    alone = axes is None
    title = "\n".join(_wrapped(line) for line in lines)
    axes = paper(axes, 5.4, _height(scene) + 0.2 * title.count("\n"))
    axes.set_aspect("equal")
    axes.axis("off")
    if flat:
        draw_planar(axes, scene, moving)
    else:
        draw_spatial(axes, scene, view, moving)
    entitle(axes, title, alone=alone)
    _write_below(axes, stage.mechanism, moving, alone=alone)
    return Picture(axes.figure, lines[-1], description)


def _write_below(axes: Any, mechanism: Mechanism, motions: Sequence[Moving], *, alone: bool) -> None:
    """What arrows and faint poses are, and the inputs and the output in the colours they are drawn in."""
    from singsym.output.figures.motions import WORDS
    from singsym.output.figures.style import INPUT, MOTION, OUTPUT

    said = []
    for moving in motions:
        kind = moving.motion.type
        faint = "" if moving.later is None else " (faint: a little later)"
        lines = wrap(f"→ {WORDS[kind]}{faint}", _BELOW, subsequent_indent="    ")
        said += [(line, MOTION[str(kind)]) for line in lines]
    rows = len(said) + 1
    figure = axes.figure
    line = 0.22 / figure.get_figheight() if alone else 0.0
    if alone:
        figure.get_layout_engine().set(rect=(0, line * rows, 1, 1 - line * rows))

    def write(words: str, row: int, colour: str, side: str = "left") -> None:
        """One line, rows counted from the lowest: at the foot of the figure, or of the axes."""
        if alone:
            x = 0.02 if side == "left" else 0.98
            figure.text(x, line * (row + 0.3), words, fontsize=9, color=colour, ha=side)
        else:
            corner, below = (float(side == "right"), 0), (0, -12 * (rows - row))
            look = {"fontsize": 8, "color": colour, "ha": side, "annotation_clip": False}
            axes.annotate(words, corner, below, "axes fraction", "offset points", **look)

    for row, (words, colour) in enumerate(reversed(said), 1):
        write(words, row, colour)
    write(_inputs(mechanism), 0, INPUT)
    write(_outputs(mechanism), 0, OUTPUT, "right")


def _inputs(mechanism: Mechanism) -> str:
    one = len(mechanism.inputs) == 1
    return f"input{'' if one else 's'} {', '.join(mechanism.inputs)}"


def _outputs(mechanism: Mechanism) -> str:
    named = [o.column if isinstance(o, JointRate) else o.point for o in mechanism.outputs]
    return f"output{'' if len(named) == 1 else 's'} {', '.join(named)}"


def _height(scene: Scene) -> float:
    """A height in inches that suits a scene on 5.4 inches of width, room for title and words kept."""
    if scene.space is Space.SPHERICAL:
        return 5.4
    width, height = (float(x) for x in np.ptp(scene.all_points[:, :2], axis=0))
    margin = 0.4 * scene.size
    return min(5.4, 1.0 + 5.0 * (height + margin) / (width + margin))


def _wrapped(title: str) -> str:
    """A title in lines that fit the width of a figure."""
    return "\n".join(wrap(title, _TITLE))


def _words(mechanism: Mechanism) -> str:
    parts = f"{len(mechanism.links)} links and {len(mechanism.joints)} joints"
    return f"{parts}, {_inputs(mechanism)}, {_outputs(mechanism)}"


def _class_words(stage: Stage, title: str, motions: Sequence[Motion]) -> str:
    from singsym.output.figures.motions import WORDS, rates_text

    moving = "; ".join(f"{WORDS[m.type]} ({rates_text(m)})" for m in motions)
    return f"{title} of {stage.mechanism.title or stage.mechanism.name}. Arrows: {moving}"
