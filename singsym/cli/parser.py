"""The commands and options of `singsym`.

Source: argparse; each command's function is in the module of its group and is imported when it runs.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from difflib import get_close_matches
from importlib import import_module
from textwrap import fill
from typing import Any

STORY = """\
Finds and classifies every singularity of a mechanism, exactly.

A mechanism is a name of the library (singsym list) or a file of one's own, TOML
(singsym new writes a commented one) or a robot's URDF.  Its singular configurations
are found from the velocity equation L m = 0, and divided into the 21 classes of
Zlatanov, Fenton and Benhabib by the six types RI RO RPM II IO IIM; each class is
proven empty, or shown by a certified configuration."""

EXAMPLES = """\
examples:
  singsym classify zlatanov-2dof              which classes occur, where, how often
  singsym conditions stewart-gough            the factored singularity conditions
  singsym classify zlatanov-hybrid --set a=3/2 --workers 2
  singsym show robot.urdf                     its chains, joints and limits
  singsym conditions robot.urdf --tip tool0 --lock elbow=0
  singsym new mine && singsym check mine.toml && singsym classify mine.toml

Results go to stdout, messages to stderr.  Exit code: 0 decided, 3 a class,
a dimension or a number is open, 2 usage or bad input, 130 interrupted.  More on a
command: singsym COMMAND --help"""


def _lazily(module: str, function: str) -> Callable[[argparse.Namespace], int]:
    """The command's function, imported when it is called, so that `singsym list` does not load solvers."""

    def run(chosen: argparse.Namespace) -> int:
        from singsym.cli.watch import talking

        with talking(chosen.talk):
            code: int = getattr(import_module(f"singsym.cli.{module}"), function)(chosen)
        return code

    return run


def parser() -> argparse.ArgumentParser:
    """The parser; `run` of what it returns is the command's function."""
    top = _Top(
        prog="singsym",
        description=STORY,
        epilog=EXAMPLES,
        formatter_class=lambda prog: argparse.RawDescriptionHelpFormatter(prog, max_help_position=16),
        usage="singsym COMMAND ...",
    )
    top.add_argument("--version", action="version", version=f"singsym {_version()}")
    top.set_defaults(run=None, command="", on_interrupt="")
    commands = top.add_subparsers(
        title="commands", metavar="", dest="command", prog="singsym", parser_class=argparse.ArgumentParser
    )

    def add(
        name: str, module: str, words: str, *parts: Callable[[argparse.ArgumentParser], None]
    ) -> argparse.ArgumentParser:
        command = commands.add_parser(name, help=words, description=f"{words[0].upper()}{words[1:]}.")
        command.set_defaults(run=_lazily(module, f"run_{name}"), on_interrupt="")
        for part in parts:
            part(command)
        _talk(command, works=_work in parts)
        return command

    short, printed = _formats("text", "json"), _formats("text", "latex", "json")
    shown = _formats("text", "latex", "json", "toml")
    add("list", "mechanisms", "the mechanisms of the library", short)
    add("new", "mechanisms", "write a commented mechanism file to start from", _name)
    add(
        "show",
        "mechanisms",
        "a mechanism's joints, loop equations, L and modules",
        _mechanism,
        shown,
        _standalone,
    )
    add("check", "mechanisms", "what is wrong with a mechanism, if anything", _mechanism, short)
    whole = (_mechanism, _work, printed, _standalone)
    words = "conditions (4), (5), (i)-(viii), factored"
    add("conditions", "singularities", words, _mechanism, printed, _standalone, _expand)
    add("classify", "singularities", "the singularity set and its classes", *whole)
    add("solve", "singularities", "the solution sets of some conditions", *whole, _labels)
    words = "ranks, types and null motions of one configuration"
    add("at", "singularities", words, _mechanism, _configuration, short)
    words = "L, conditions and assemblies as code for a controller"
    add("export", "motion", words, _mechanism, _language)
    words = "the singularities on a trajectory"
    add("follow", "motion", words, _mechanism, _trajectory, short)
    add(
        "classes",
        "singularities",
        "the classes that a mobility allows (Table 1)",
        _mobility,
        printed,
        _standalone,
    )
    add(
        "plot",
        "pictures",
        "draw the mechanism, its modules, a class or the singularity curves",
        _mechanism,
        _work,
        _shown,
    )
    add("report", "pictures", "one HTML page with everything about a mechanism", _mechanism, _work, _output)
    words = "a web page of each mechanism of the library, and an index"
    usual: dict[str, Any] = {"settings": [], "formulation": "auto", "base": None, "tip": None}
    usual |= {"components": [], "lock": [], "joints": []}
    add("gallery", "gallery", words, _work, _folder).set_defaults(**usual)
    add("engines", "tools", "which engines there are, and how to get the others", _install, short)
    add("cache", "tools", "the results that are kept on disk, and how to clear them", _clear, short)
    add("completion", "tools", "a script that completes commands in a shell", _shell)
    return top


class _Top(argparse.ArgumentParser):
    """The parser of the program itself, which says what commands there are where one is not known."""

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """See `argparse.ArgumentParser.parse_known_args`."""
        words = [a for a in (sys.argv[1:] if args is None else args) if not a.startswith("-")]
        known = [name for a in self._actions if isinstance(a.choices, dict) for name in a.choices]
        if words and words[0] not in known:
            close = get_close_matches(words[0], known, 1)
            advice = f"; did you mean {close[0]}?" if close else ""
            listed = fill(f"commands: {', '.join(known)}", 80)
            self.error(f"there is no command {words[0]!r}{advice}\n{listed}")
        return super().parse_known_args(args, namespace)


def commands() -> list[tuple[str, list[str], bool]]:
    """Each command with its options, and whether it takes a mechanism: for completion."""
    found = []
    for action in parser()._actions:
        if isinstance(action, argparse._SubParsersAction):
            for name, command in action.choices.items():
                options = [o for a in command._actions for o in a.option_strings if o.startswith("--")]
                found.append((name, options, any(a.dest == "mechanism" for a in command._actions)))
    return found


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
        choices=("auto", "planar", "spherical", "joint", "natural", "quaternion"),
        help="the configuration variables (default: by kind of mechanism)",
    )
    _parts(command)


def _parts(command: argparse.ArgumentParser) -> None:
    """What is meant of a mechanism, where the file holds more."""
    group = command.add_argument_group("parts of the mechanism")
    group.add_argument("--base", metavar="LINK", help="where a URDF file's chain starts (default: its root)")
    group.add_argument(
        "--tip",
        metavar="LINK",
        help="where a URDF file's chain ends (default: its only end); "
        "the site or body of an MJCF file whose twist is the output",
    )
    group.add_argument(
        "--components",
        action="append",
        default=[],
        metavar="A,B,...",
        help="of the output: vx,vy,vz,wx,wy,wz of a link's twist, or x,y,z of a point's velocity",
    )
    group.add_argument(
        "--lock",
        action="append",
        default=[],
        metavar="JOINT=VALUE",
        help="hold an input joint, as elbow=0, elbow=pi/2 or elbow='30 deg'; bare numbers are radians, "
        "lengths those of the file (repeatable)",
    )
    group.add_argument(
        "--joints",
        action="append",
        default=[],
        metavar="A,B,...",
        help="those that move; hold all others at 0, or in a URDF file within limits that leave 0 out",
    )


def _name(command: argparse.ArgumentParser) -> None:
    command.add_argument("name", metavar="NAME", help="of the mechanism; the file is NAME.toml")
    command.add_argument("--force", action="store_true", help="overwrite the file")


def _formats(*names: str) -> Callable[[argparse.ArgumentParser], None]:
    def part(command: argparse.ArgumentParser) -> None:
        command.add_argument("--format", default="text", choices=names, help="of the output (default: text)")

    return part


def _expand(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--expand", action="store_true", help="L before and after the reduction, all terms of polynomials"
    )


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
        help="on the clock, a tenth or 60 for each part; what takes longer is undecided "
        "(default: 3600 of processor time, so that a busy machine changes no answer)",
    )
    who = command.add_mutually_exclusive_group()
    who.add_argument(
        "--workers", type=_at_least_one, default=_workers(), help="processes (default: %(default)s)"
    )
    who.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="of a Dask cluster whose workers are used instead, as tcp://127.0.0.1:8786",
    )
    command.add_argument(
        "--no-cache", dest="cache", action="store_false", help="neither read nor keep results on disk"
    )


def _workers() -> str:
    """The default, as text: argparse takes the same number for an option that was not given."""
    import os

    return str(min(4, os.cpu_count() or 1))


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
    command.add_argument("--tolerance", type=_positive, help="singular values below this count as zero")
    command.add_argument(
        "--distance",
        action="store_true",
        help="how far away the nearest singularity of each type is, and which way leads away",
    )


def _trajectory(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "trajectory",
        metavar="FILE",
        help="comma-separated values with a header: t, then joints (radians, or as 'A deg') or "
        "coordinates as C.x, as many as the mobility",
    )
    command.add_argument(
        "--config", metavar="FILE", help="a configuration to start near, as for `at`: of several, which one"
    )
    command.add_argument("-o", "--output", metavar="FILE", help="a picture of the margins to write")


def _language(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--to",
        dest="language",
        default="python",
        choices=("python", "c"),
        help="Python with its module math, or C99 (default: %(default)s)",
    )


def _mobility(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--n", type=_at_least_one, default=3, help="the mobility (default: 3, which allows all)"
    )


def _output(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "-o", "--output", metavar="FILE", help="to write (default: named after the mechanism)"
    )


def _folder(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "-o", "--output", default="gallery", metavar="DIR", help="folder to write to (default: %(default)s)"
    )
    command.add_argument(
        "--only",
        nargs="+",
        action="extend",
        default=[],
        metavar="NAME",
        help="these mechanisms and no others",
    )


def _shown(command: argparse.ArgumentParser) -> None:
    _output(command)
    choice = command.add_mutually_exclusive_group()
    choice.add_argument(
        "--class", dest="shown", metavar="NUMBER", help="a class at its configuration, as --class 4"
    )
    choice.add_argument(
        "--curves",
        dest="shown",
        choices=("inputs", "outputs"),
        help="the singularity curves over the plane of two inputs or outputs",
    )
    choice.add_argument(
        "--strata", dest="shown", action="store_const", const="strata", help="which class borders on which"
    )
    choice.add_argument(
        "--modules",
        dest="shown",
        action="store_const",
        const="modules",
        help="what is solved after what, driven from the inputs and from the outputs",
    )


def _clear(command: argparse.ArgumentParser) -> None:
    command.add_argument("--clear", action="store_true", help="take all of them away")


def _talk(command: argparse.ArgumentParser, works: bool) -> None:
    """What is said on stderr; works: whether the command may take long."""
    command.set_defaults(talk="usual")
    choice = command.add_mutually_exclusive_group()

    def add(name: str, words: str) -> None:
        choice.add_argument(f"--{name}", dest="talk", action="store_const", const=name, help=words)

    add("quiet", "nothing on stderr but errors")
    if works:
        add("progress", "lines on stderr while it works, where that is no terminal too")
    add("verbose", "all that happens, as lines on stderr")


def _shell(command: argparse.ArgumentParser) -> None:
    command.add_argument("shell", choices=("bash", "zsh"), help='use: eval "$(singsym completion bash)"')


def _install(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--install", action="store_true", help="bring Singular and msolve with pip, beside the packages"
    )
