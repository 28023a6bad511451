"""The commands that write files to look at: plot, report.

Source: figures and report are those of `singsym.output`.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from singsym.cli.certificates import write_certificate
from singsym.cli.mechanisms import placed, read
from singsym.cli.screen import UserError, drawable, writable
from singsym.cli.singularities import UNDECIDED, classified

if TYPE_CHECKING:
    from singsym.output.figures.style import Picture


def run_report(chosen: argparse.Namespace) -> int:
    """`singsym report MECHANISM -o FILE [--certificate FILE]`: prints the file's name."""
    path = Path(chosen.output or f"{Path(chosen.mechanism).stem}.html")
    writable(path)
    if chosen.certificate:
        writable(Path(chosen.certificate))
    result = classified(chosen)
    if chosen.certificate:
        write_certificate(result, chosen.certificate)
    try:
        result.report(path, chosen.certificate)
    except OSError as error:
        raise UserError(f"{path} cannot be written: {error.strerror}") from None
    print(path)
    return UNDECIDED if result.undecided else 0


def run_plot(chosen: argparse.Namespace) -> int:
    """`singsym plot MECHANISM`: the mechanism, its modules or what was found; prints the files' names.

    Of a class each family has a figure; where there are several the files are numbered.
    """
    path = Path(chosen.output or f"{Path(chosen.mechanism).stem}.svg")
    drawable(path)
    try:
        pictures, code = _pictures(chosen)
        numbered = [path.with_stem(f"{path.stem}-{k}") for k in range(1, len(pictures) + 1)]
        for picture, target in zip(pictures, numbered if len(pictures) > 1 else [path], strict=True):
            picture.save(target)
            print(target)
    except (ValueError, KeyError) as error:
        raise UserError(str(error.args[0])) from None
    except OSError as error:
        raise UserError(f"{path} cannot be written: {error.strerror}") from None
    return code


def _pictures(chosen: argparse.Namespace) -> tuple[tuple[Picture, ...], int]:
    """What is to be drawn, and the exit code."""
    if chosen.shown is None:
        from singsym.output.figures.figure import plot_mechanism

        mechanism = read(chosen)
        return (plot_mechanism(mechanism, equation=placed(mechanism, chosen.formulation)),), 0
    if chosen.shown == "modules":
        from singsym.kinematics.modules import driven_modules
        from singsym.output.module_graph import plot_modules

        return (plot_modules(driven_modules(read(chosen), chosen.formulation)),), 0
    result = classified(chosen)
    code = UNDECIDED if result.undecided else 0
    if not chosen.shown.isdecimal():
        return (result.plot(chosen.shown),), code
    from singsym.output.figures.figure import plot_families

    return plot_families(result, result[int(chosen.shown)]), code
