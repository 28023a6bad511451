"""The commands about mechanisms as such: list, show, check, new.

Source: singsym's own.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from singsym.cli.screen import UserError, emit_data, emit_page, say
from singsym.mechanism import Mechanism, MechanismError, check, load
from singsym.mechanism.problems import Problem

if TYPE_CHECKING:
    from singsym.kinematics.velocity import VelocityEquation


def read(chosen: argparse.Namespace) -> Mechanism:
    """The mechanism that the options name, with its parameters set; `UserError` for what is wrong with it."""
    try:
        mechanism = _load(chosen.mechanism)
        if chosen.settings:
            mechanism = mechanism.with_parameters(**dict(map(_setting, chosen.settings)))
            problems = check(mechanism)
            if problems:
                raise MechanismError(problems)
    except MechanismError as error:
        raise UserError(complaint(error.problems)) from None
    except (OSError, ImportError) as error:
        raise UserError(str(error)) from None
    return mechanism


def _load(name: str) -> Mechanism:
    if not name.lower().endswith(".urdf"):
        return load(name)
    from singsym.mechanism.urdf import from_urdf

    if not Path(name).is_file():
        raise FileNotFoundError(f"no file is called {name}")
    return from_urdf(name)


def _setting(text: str) -> tuple[str, str | None]:
    name, equals, value = text.partition("=")
    if not equals or not name.strip():
        raise UserError(f"found --set {text}; expected NAME=VALUE, as --set a=3/2")
    return name.strip(), value.strip() or None


def complaint(problems: tuple[Problem, ...]) -> str:
    """Problems as one paragraph, cut where there are many."""
    shown = [str(p) for p in problems[:12]]
    if len(problems) > 12:
        shown.append(f"and {len(problems) - 12} more")
    return "\n  ".join(shown)


def run_list(chosen: argparse.Namespace) -> int:
    """`singsym list`."""
    from singsym.output.gallery_list import gallery_page, library_data

    if chosen.format == "json":
        emit_data(library_data())
    else:
        emit_page(gallery_page())
    return 0


def run_new(chosen: argparse.Namespace) -> int:
    """`singsym new NAME`: writes NAME.toml and says so."""
    from singsym.mechanism.starter import starter

    name = chosen.name.removesuffix(".toml")
    path = Path(f"{name}.toml")
    try:
        text = starter(name)
        with path.open("w" if chosen.force else "x", encoding="utf-8") as stream:
            stream.write(text)
    except ValueError as error:
        raise UserError(str(error)) from None
    except FileExistsError:
        raise UserError(f"{path} is there already; take another name, or --force to overwrite it") from None
    except OSError as error:
        raise UserError(f"{path} cannot be written: {error.strerror}") from None
    print(path)
    say(f"Edit it, then: singsym check {path}; singsym classify {path}")
    return 0


def run_show(chosen: argparse.Namespace) -> int:
    """`singsym show MECHANISM`."""
    mechanism = read(chosen)
    if chosen.format == "toml":
        from singsym.mechanism import dumps

        print(dumps(mechanism), end="")
        return 0
    equation = placed(mechanism, chosen.formulation)
    if chosen.format == "json":
        from singsym.output.plain_data import mechanism_data

        emit_data(mechanism_data(mechanism, equation))
    elif chosen.format == "latex":
        from singsym.output.latex import document, mechanism_latex

        body = mechanism_latex(mechanism, equation)
        print(document(body, mechanism.title or mechanism.name) if chosen.standalone else body)
    else:
        from singsym.output.text import mechanism_page

        emit_page(mechanism_page(mechanism, equation))
    return 0


def placed(mechanism: Mechanism, formulation: str) -> VelocityEquation:
    """The velocity equation; `UserError` where the mechanism does not allow the formulation."""
    from singsym.kinematics.velocity import velocity_equation

    try:
        return velocity_equation(mechanism, formulation)
    except MechanismError as error:
        raise UserError(complaint(error.problems)) from None
    except ValueError as error:
        raise UserError(str(error)) from None


def run_check(chosen: argparse.Namespace) -> int:
    """`singsym check MECHANISM`: faults by the data alone, then by generic ranks; 2 where there are any."""
    from singsym.kinematics.mobility import check_mobility
    from singsym.output.plain_data import mobility_data
    from singsym.output.text import mobility_page

    mechanism = read(chosen)
    equation = placed(mechanism, chosen.formulation)
    found = check_mobility(equation)
    if chosen.format == "json":
        emit_data(mobility_data(mechanism.name, equation, found))
    else:
        emit_page(mobility_page(mechanism.name, equation, found))
    if found.samples and found.messages:
        return 2
    return 0 if found.samples else 3
