"""The commands that write files to look at: plot, report.

Source: figures and report are those of `singsym.output`.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from singsym.cli.mechanisms import placed, read
from singsym.cli.screen import UserError
from singsym.cli.singularities import UNDECIDED, classified


def run_report(chosen: argparse.Namespace) -> int:
    """`singsym report MECHANISM -o FILE`: prints the file's name."""
    path = Path(chosen.output or f"{Path(chosen.mechanism).stem}.html")
    _writable(path)
    result = classified(chosen)
    try:
        result.report(path)
    except OSError as error:
        raise UserError(f"{path} cannot be written: {error.strerror}") from None
    print(path)
    return UNDECIDED if result.undecided else 0


def run_plot(chosen: argparse.Namespace) -> int:
    """`singsym plot MECHANISM`: the mechanism, its modules or what was found; prints the file's name."""
    path = Path(chosen.output or f"{Path(chosen.mechanism).stem}.svg")
    _writable(path)
    code = 0
    try:
        if chosen.shown is None:
            from singsym.output.figures.figure import plot_mechanism

            mechanism = read(chosen)
            picture = plot_mechanism(mechanism, equation=placed(mechanism, chosen.formulation))
        elif chosen.shown == "modules":
            from singsym.kinematics.modules import driven_modules
            from singsym.output.module_graph import plot_modules

            picture = plot_modules(driven_modules(read(chosen), chosen.formulation))
        else:
            result = classified(chosen)
            code = UNDECIDED if result.undecided else 0
            picture = result.plot(int(chosen.shown) if chosen.shown.isdecimal() else chosen.shown)
        picture.save(path)
    except (ValueError, KeyError) as error:
        raise UserError(str(error.args[0])) from None
    except OSError as error:
        raise UserError(f"{path} cannot be written: {error.strerror}") from None
    print(path)
    return code


def _writable(path: Path) -> None:
    """Say before the work starts that its result could not be written."""
    if not path.absolute().parent.is_dir():
        raise UserError(f"{path} cannot be written: there is no folder {path.parent}")
