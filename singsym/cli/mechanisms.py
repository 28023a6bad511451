"""The commands about mechanisms as such: list, show, check, new.

Source: singsym's own.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from singsym.cli.screen import UserError, emit_data, emit_latex, emit_page, say
from singsym.mechanism import Choice, Mechanism, MechanismError, check, load
from singsym.mechanism.problems import Problem

if TYPE_CHECKING:
    from singsym.kinematics.velocity import VelocityEquation
    from singsym.mechanism.urdf.chains import Tree


def read(chosen: argparse.Namespace, redundant: bool = False) -> Mechanism:
    """The mechanism that the options name, with its parameters set; `UserError` for what is wrong with it.

    redundant: whether it may be a serial chain with more inputs than output components.
    """
    try:
        mechanism = load(chosen.mechanism, replace(choice_of(chosen), redundant=redundant))
        if chosen.settings:
            mechanism = mechanism.with_parameters(
                **dict(_setting(s, "--set", "a=3/2") for s in chosen.settings)
            )
            problems = check(mechanism, redundant)
            if problems:
                raise MechanismError(problems)
    except MechanismError as error:
        raise UserError(complaint(error.problems)) from None
    except OSError as error:
        raise UserError(str(error)) from None
    return mechanism


def choice_of(chosen: argparse.Namespace) -> Choice:
    """What --base, --tip, --joints, --lock and --components choose; `UserError` for what cannot be read."""
    locks = dict(_setting(text, "--lock", "elbow=0") for text in chosen.lock)
    if missing := [name for name, value in locks.items() if value is None]:
        raise UserError(f"found --lock {missing[0]}=; expected JOINT=VALUE, as --lock elbow=0")
    return Choice(chosen.base, chosen.tip, _listed(chosen.joints), locks, _listed(chosen.components))


def _listed(texts: list[str]) -> tuple[str, ...]:
    """Names given with commas between them, or by the same option several times."""
    return tuple(name.strip() for text in texts for name in text.split(",") if name.strip())


def _setting(text: str, option: str, example: str) -> tuple[str, str | None]:
    name, equals, value = text.partition("=")
    if not equals or not name.strip():
        raise UserError(f"found {option} {text}; expected NAME=VALUE, as {option} {example}")
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
    from singsym.mechanism.library.starter import starter

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
    """`singsym show MECHANISM`; of a URDF file its chains and joints too, whether one is clear or not."""
    robot = _robot_tree(chosen)
    try:
        mechanism = read(chosen, redundant=True)
    except UserError as error:
        asked = choice_of(chosen) != Choice() or chosen.settings or chosen.format not in ("text", "json")
        if robot is None or asked:
            raise
        return _show_robot(robot, str(error), chosen.format)
    if chosen.format == "toml":
        from singsym.mechanism import dumps

        print(dumps(mechanism), end="")
        return 0
    equation = placed(mechanism, chosen.formulation)
    if chosen.format == "json":
        from singsym.kinematics.modules import driven_modules
        from singsym.output.module_graph import modules_data
        from singsym.output.plain_data import mechanism_data

        found = mechanism_data(mechanism, equation)
        found |= {"modules": modules_data(driven_modules(mechanism, chosen.formulation))}
        if robot is not None:
            from singsym.output.robot_page import robot_data

            found |= {"robot": robot_data(robot)}
        emit_data(found)
    elif chosen.format == "latex":
        from singsym.output.latex import mechanism_latex

        body = mechanism_latex(mechanism, equation)
        emit_latex(body, mechanism.title or mechanism.name, chosen.standalone)
    else:
        from singsym.kinematics.modules import driven_modules
        from singsym.output.module_graph import modules_page
        from singsym.output.text import mechanism_page

        modules = modules_page(driven_modules(mechanism, chosen.formulation))
        page = (*mechanism_page(mechanism, equation), *modules)
        if robot is not None:
            from singsym.output.robot_page import robot_page

            page = (*robot_page(robot), *page)
        emit_page(page)
    return 0


def _robot_tree(chosen: argparse.Namespace) -> Tree | None:
    """What a URDF file holds; None for other mechanisms, and where the file cannot be read."""
    from singsym.mechanism.fileformat import is_robot_file
    from singsym.mechanism.library import names
    from singsym.mechanism.urdf.chains import Tree
    from singsym.mechanism.urdf.robot_file import read_robot

    if chosen.mechanism in names() or not Path(chosen.mechanism).is_file():
        return None
    try:
        return Tree(read_robot(chosen.mechanism)) if is_robot_file(chosen.mechanism) else None
    except (MechanismError, OSError):
        return None


def _show_robot(robot: Tree, problem: str, form: str) -> int:
    """A robot of which no mechanism was made, and why."""
    from singsym.output.robot_page import robot_data, robot_page

    if form == "json":
        emit_data({"robot": robot_data(robot), "problem": problem})
    else:
        emit_page((*robot_page(robot), f"Not yet a mechanism to be analysed: {problem}"))
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
