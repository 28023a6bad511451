"""The commands and options of `singsym`.

Source: argparse; each command's function is in the module of its group and is imported when it runs.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from importlib import import_module

STORY = """\
Finds and classifies every singularity of a mechanism, exactly.

A mechanism is a name of the library (singsym list) or a file of one's own, TOML
(singsym new writes a commented one) or URDF for arms.  Its singular configurations
are found from the velocity equation L m = 0, and divided into the 21 classes of
Zlatanov, Fenton and Benhabib by the six types RI RO RPM II IO IIM; each class is
proven empty, or shown by a certified configuration."""

EXAMPLES = """\
examples:
  singsym classify zlatanov-2dof              which classes occur, where, how often
  singsym conditions stewart-gough            the factored singularity conditions
  singsym classify zlatanov-hybrid --set a=3/2 --workers 2
  singsym new mine && singsym check mine.toml && singsym classify mine.toml

Results go to stdout, messages to stderr.  Exit code: 0 decided, 3 something is
undecided, 2 usage or bad input, 130 interrupted.  More on a command: singsym COMMAND --help"""


def _lazily(module: str, function: str) -> Callable[[argparse.Namespace], int]:
    """The command's function, imported when it is called, so that `singsym list` does not load solvers."""

    def run(chosen: argparse.Namespace) -> int:
        code: int = getattr(import_module(f"singsym.cli.{module}"), function)(chosen)
        return code

    return run


def parser() -> argparse.ArgumentParser:
    """The parser; `run` of what it returns is the command's function."""
    top = argparse.ArgumentParser(
        prog="singsym",
        description=STORY,
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        usage="singsym COMMAND ...",
    )
    top.add_argument("--version", action="version", version=f"singsym {_version()}")
    top.set_defaults(run=None, command="", on_interrupt="")
    commands = top.add_subparsers(title="commands", metavar="", dest="command")

    def add(
        name: str, module: str, words: str, *parts: Callable[[argparse.ArgumentParser], None]
    ) -> argparse.ArgumentParser:
        command = commands.add_parser(name, help=words, description=words.capitalize() + ".")
        command.set_defaults(run=_lazily(module, f"run_{name}"), on_interrupt="")
        for part in parts:
            part(command)
        return command

    formats = _formats("text", "json")
    printed = _formats("text", "latex", "json")
    add("list", "mechanisms", "the mechanisms of the library", formats)
    add("new", "mechanisms", "write a commented mechanism file to start from", _name)
    add(
        "show",
        "mechanisms",
        "a mechanism's joints, loop equations and L",
        _mechanism,
        _formats("text", "latex", "json", "toml"),
    )
    add("check", "mechanisms", "what is wrong with a mechanism, if anything", _mechanism, formats)
    add(
        "conditions",
        "singularities",
        "conditions (4), (5), (i)-(viii), factored",
        _mechanism,
        printed,
        _standalone,
    )
    add(
        "classify",
        "singularities",
        "the singularity set and its classes",
        _mechanism,
        _work,
        printed,
        _standalone,
    )
    add(
        "solve",
        "singularities",
        "the solution sets of conditions: 4 5 i ii ... viii",
        _mechanism,
        _labels,
        _work,
        printed,
        _standalone,
    )
    add(
        "at",
        "singularities",
        "ranks, types and null motions of one configuration",
        _mechanism,
        _configuration,
        formats,
    )
    add(
        "classes",
        "singularities",
        "the classes that a mobility allows (Table 1)",
        _mobility,
        printed,
        _standalone,
    )
    add("engines", "tools", "which engines there are, and how to get the others", _install, formats)
    return top


def _version() -> str:
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version("singsym")
    except PackageNotFoundError:
        return "(not installed)"


def _mechanism(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "mechanism", metavar="MECHANISM", help="a name of the library, a TOML or a URDF file"
    )
    command.add_argument(
        "--set",
        dest="settings",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="set a parameter, as a=3/2; NAME= keeps it symbolic (repeatable)",
    )
    command.add_argument(
        "--formulation",
        default="auto",
        choices=("auto", "planar", "joint", "natural", "quaternion"),
        help="the configuration variables (default: by kind of mechanism)",
    )


def _name(command: argparse.ArgumentParser) -> None:
    command.add_argument("name", metavar="NAME", help="of the mechanism; the file is NAME.toml")
    command.add_argument("--force", action="store_true", help="overwrite the file")


def _formats(*names: str) -> Callable[[argparse.ArgumentParser], None]:
    def part(command: argparse.ArgumentParser) -> None:
        command.add_argument("--format", default="text", choices=names, help="of the output (default: text)")

    return part


def _standalone(command: argparse.ArgumentParser) -> None:
    command.add_argument("--standalone", action="store_true", help="with latex: a whole document")


def _positive(text: str) -> float:
    value = float(text)
    if not value > 0:
        raise argparse.ArgumentTypeError(f"found {text}; expected a positive number")
    return value


def _at_least_one(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"found {text!r}; expected a whole number from 1")
    return int(text)


def _work(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--engine",
        dest="engines",
        action="append",
        default=[],
        choices=("flint", "msolve", "singular", "sympy"),
        help="use this engine and no other (repeatable)",
    )
    command.add_argument(
        "--budget",
        type=_positive,
        metavar="SECONDS",
        help="for each part of the work; what takes longer is undecided",
    )
    command.add_argument(
        "--workers", type=_at_least_one, default=_workers(), help="processes (default: %(default)s)"
    )
    command.add_argument(
        "--no-cache", dest="cache", action="store_false", help="neither read nor keep results on disk"
    )


def _workers() -> int:
    import os

    return min(4, os.cpu_count() or 1)


def _labels(command: argparse.ArgumentParser) -> None:
    labels = ("4", "5", "i", "ii", "iii", "iv", "v", "vi", "vii", "viii")
    command.add_argument(
        "labels", nargs="+", metavar="CONDITION", choices=labels, help="of " + ", ".join(labels)
    )


def _configuration(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--config",
        required=True,
        metavar="FILE",
        help="TOML with [joints] A = '30 deg', [points] B = [0.3, 0.95], [variables] Bx = 0.3",
    )
    command.add_argument(
        "--tolerance", type=_positive, help="singular values below this fraction of the largest count as zero"
    )


def _mobility(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--n", type=_at_least_one, default=3, help="the mobility (default: 3, which allows all)"
    )


def _install(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--install", action="store_true", help="bring Singular and msolve into this environment with pip"
    )
