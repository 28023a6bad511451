"""The picture of a classification that a word, a number or types ask for.

Source: Figs 1-12 of Zlatanov, Fenton, Benhabib (1998).
"""

from __future__ import annotations

from typing import Any

from singsym.classes.result import Classification
from singsym.classes.taxonomy.types import SingularityType
from singsym.output.figures.style import Picture


def picture(
    found: Classification,
    what: int | str | SingularityType | None = None,
    *,
    witness: int | None = None,
    axes: Any = None,
) -> Picture:
    """What `Classification.plot` draws.

    Raises `ValueError` where there is nothing to draw, `KeyError` where there is no such class.
    """
    if what is None:
        from singsym.output.figures.figure import plot_mechanism

        if found.mechanism is None:
            raise ValueError("equations were given without a mechanism: there is nothing to draw")
        return plot_mechanism(found.mechanism, equation=found.equation, axes=axes)
    if what in ("inputs", "outputs"):
        from singsym.output.figures.curves import plot_curves

        return plot_curves(found, str(what), axes=axes)
    if what == "regions":
        from singsym.motion.regions.regions import regions_equation
        from singsym.output.figures.curves import trace_loci
        from singsym.output.figures.regions import plot_regions

        if axes is not None:
            raise ValueError("regions are several drawings: they need a figure of their own, without ax")
        traces = trace_loci(found) if found.equation.n == 2 else ()
        return plot_regions(regions_equation(found.equation, seed=found.seed), traces=traces)
    if what == "strata":
        from singsym.output.strata_graph import plot_strata

        return plot_strata(found, axes=axes)
    from singsym.output.figures.figure import plot_class

    return plot_class(found, found[what], witness, axes=axes)
