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

from singsym.cli import options

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
    top.add_argument("--version", action=_Version, nargs=0, help="show program's version number and exit")
    top.set_defaults(run=None, on_interrupt="")
    commands = top.add_subparsers(
        title="commands", metavar="", dest="command", prog="singsym", parser_class=argparse.ArgumentParser
    )

    def add(
        name: str, module: str, words: str, *parts: Callable[[argparse.ArgumentParser], None]
    ) -> argparse.ArgumentParser:
        command = commands.add_parser(name, help=words, description=f"{words[0].upper()}{words[1:]}.")
        command.set_defaults(run=_lazily(module, f"run_{name}"))
        for part in parts:
            part(command)
        options.talk(command, works=options.work in parts)
        return command

    short, printed = options.formats("text", "json"), options.formats("text", "latex", "json")
    shown = options.formats("text", "latex", "json", "toml")
    add("list", "mechanisms", "the mechanisms of the library", short)
    add("new", "mechanisms", "write a commented mechanism file to start from", options.name)
    add(
        "show",
        "mechanisms",
        "a mechanism's joints, loop equations, L and modules",
        options.mechanism,
        shown,
        options.standalone,
    )
    add("check", "mechanisms", "what is wrong with a mechanism, if anything", options.mechanism, short)
    whole = (options.mechanism, options.work, printed, options.standalone)
    words = "conditions (4), (5), (i)-(viii), factored"
    add("conditions", "singularities", words, options.mechanism, printed, options.standalone, options.expand)
    add("classify", "singularities", "the singularity set and its classes", *whole, options.certificate)
    words = "for which lengths which classes occur, and a chart"
    add("design", "design", words, options.mechanism, options.work, options.tables, options.varied)
    words = "check a certificate, without any search, and say what it proves"
    add("verify", "certificates", words, options.certified, short)
    add("solve", "singularities", "the solution sets of some conditions", *whole, options.labels)
    words = "ranks, types and null motions of one configuration"
    add("at", "singularities", words, options.mechanism, options.configuration, short)
    words = "L, conditions and assemblies as code for a controller"
    add("export", "motion", words, options.mechanism, options.language)
    words = "the singularities on a trajectory"
    add("follow", "motion", words, options.mechanism, options.trajectory, short)
    words = "regions free of singularities; what joins two configurations"
    add("regions", "motion", words, options.mechanism, options.ends, short)
    add(
        "classes",
        "singularities",
        "the classes that a mobility allows (Table 1)",
        options.mobility,
        printed,
        options.standalone,
    )
    add(
        "plot",
        "pictures",
        "draw a mechanism, its modules, a class or the curves",
        options.mechanism,
        options.work,
        options.shown,
    )
    add(
        "report",
        "pictures",
        "one HTML page with everything about a mechanism",
        options.mechanism,
        options.work,
        options.output,
        options.certificate,
    )
    words = "a web page of each mechanism of the library, and an index"
    add("gallery", "gallery", words, options.work, options.folder).set_defaults(**options.AS_IT_IS)
    add("engines", "tools", "which engines there are, and how to get the others", options.install, short)
    add("cache", "tools", "the results that are kept on disk, and how to clear them", options.clear, short)
    add("completion", "tools", "a script that completes commands in a shell", options.shell)
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


class _Version(argparse.Action):
    """Says the version, which is looked up only then."""

    def __call__(self, parser: argparse.ArgumentParser, *ignored: object) -> None:
        from importlib.metadata import PackageNotFoundError, version

        try:
            found = version("singsym")
        except PackageNotFoundError:
            found = "(not installed)"
        print(f"singsym {found}")
        parser.exit()
