"""The singularity curves of a report: plots, the mechanism that moves along them, regions over the inputs.

Source: section 3.3 of Zlatanov, Fenton, Benhabib (1998).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from singsym.classes.result import Classification
from singsym.output.html import page as html

if TYPE_CHECKING:
    from singsym.output.figures.curves import Trace


def curves(classification: Classification) -> str:
    """Curves over the inputs and the output, and the mechanism along them; "" where no locus is a curve."""
    from singsym.output.figures.curves import input_plane, output_plane, plot_curves, trace_loci
    from singsym.output.figures.scene import Stage
    from singsym.output.html.scenes import scene_box
    from singsym.output.html.tracks import curve_tracks

    traces = trace_loci(classification)
    if not traces:
        return ""
    plots = {}
    for plane, find in (("inputs", input_plane), ("outputs", output_plane)):
        chosen = find(classification)
        if chosen is not None:
            plots[plane] = plot_curves(classification, plane, traces), chosen
    drawn = [html.figure(picture, f"curves-{plane}", plane=plane) for plane, (picture, _) in plots.items()]
    moved = ""
    if classification.mechanism is not None:
        stage = Stage.of(classification.mechanism, classification.equation)
        tracks = curve_tracks(stage, traces, plots)
        if tracks:
            moved = (
                f"<h3>Along a curve</h3>{scene_box(stage, tracks, 'The mechanism on a singularity curve')}"
            )
    note = '<p class="note">The curves are tracked for drawing; the counts above are proven apart.</p>'
    return f'<div class="figures">{"".join(drawn)}</div>{note}{moved}{_regions(classification, traces)}'


def _regions(classification: Classification, traces: Sequence[Trace]) -> str:
    """The input plane of a mechanism with two inputs, with assemblies and regions free of singularities."""
    from singsym.output.figures.regions import plot_regions, regions_over_inputs

    found = regions_over_inputs(classification)
    if found is None or not found.regions:
        return ""
    picture = plot_regions(found, traces=traces)
    note = (
        "Within a region the mechanism moves without meeting a singularity.  Regions are filled on a grid "
        f"from random configurations: a small one may be missed; {found.at_least} at least are certified, by "
        "the signs of what vanishes at singularities."
    )
    return f"<h3>Over the inputs</h3>{html.figure(picture, 'regions', note, broad=True)}"
