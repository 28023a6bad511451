"""The options of the commands: each function gives a command some of them.

Source: argparse.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Any

AS_IT_IS: dict[str, Any] = {
    "settings": [],
    "formulation": "auto",
    "base": None,
    "tip": None,
    "components": [],
    "lock": [],
    "joints": [],
}
"""A mechanism of which nothing is chosen: see `mechanism`."""


def mechanism(command: argparse.ArgumentParser) -> None:
    """A mechanism, and what is chosen of it."""
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


def certificate(command: argparse.ArgumentParser) -> None:
    """A certificate to write."""
    command.add_argument(
        "--certificate", metavar="FILE", help="write a proof of the table, which singsym verify checks"
    )


def certified(command: argparse.ArgumentParser) -> None:
    """A certificate to check."""
    command.add_argument("file", metavar="FILE", help="that singsym classify --certificate wrote")
    command.add_argument("--mechanism", metavar="MECHANISM", help="check that it is about this mechanism")
    command.set_defaults(**AS_IT_IS)


def name(command: argparse.ArgumentParser) -> None:
    """The name of a new file."""
    command.add_argument("name", metavar="NAME", help="of the mechanism; the file is NAME.toml")
    command.add_argument("--force", action="store_true", help="overwrite the file")


def formats(*names: str) -> Callable[[argparse.ArgumentParser], None]:
    """The formats of the output."""

    def part(command: argparse.ArgumentParser) -> None:
        command.add_argument("--format", default="text", choices=names, help="of the output (default: text)")

    return part


def expand(command: argparse.ArgumentParser) -> None:
    """All that is cut otherwise."""
    command.add_argument(
        "--expand", action="store_true", help="L before and after the reduction, all terms of polynomials"
    )


def standalone(command: argparse.ArgumentParser) -> None:
    """LaTeX as a document."""
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


def _class_number(text: str) -> str:
    from singsym.classes.taxonomy.types import feasible_classes

    count = len(feasible_classes(3))
    if not text.isdecimal() or not 1 <= int(text) <= count:
        raise argparse.ArgumentTypeError(f"found {text!r}; expected the number of a class, 1 to {count}")
    return text


def work(command: argparse.ArgumentParser) -> None:
    """What governs the work."""
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


def labels(command: argparse.ArgumentParser) -> None:
    """The conditions to solve."""
    labels = ("4", "5", "i", "ii", "iii", "iv", "v", "vi", "vii", "viii", "cusps")
    command.add_argument(
        "labels", nargs="+", metavar="CONDITION", choices=labels, help="of " + ", ".join(labels)
    )


def configuration(command: argparse.ArgumentParser) -> None:
    """A configuration, and what to tell of it."""
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
    command.add_argument(
        "--self-motions",
        action="store_true",
        help="whether null motions are finite, the inputs or the outputs at rest; the chain may be redundant",
    )
    command.add_argument(
        "-o", "--output", metavar="FILE", help="a picture of the curves to write, of --self-motions"
    )


def trajectory(command: argparse.ArgumentParser) -> None:
    """A motion to follow."""
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


def varied(command: argparse.ArgumentParser) -> None:
    """The parameters of a design."""
    choice = command.add_mutually_exclusive_group(required=True)
    choice.add_argument(
        "--parameters", metavar="NAMES", help="one or two, as a,b: exact borders, and cells with their tables"
    )
    choice.add_argument(
        "--values",
        action="append",
        metavar="NAME=VALUES",
        help="values to try, as a=1,3/2,2: tables at all combinations, no claim between (repeatable)",
    )
    command.add_argument("-o", "--output", metavar="FILE", help="a chart to write, of --parameters")


def tables(command: argparse.ArgumentParser) -> None:
    """How tables of many samples are printed."""
    formats("text", "latex", "json", "csv")(command)
    standalone(command)


def ends(command: argparse.ArgumentParser) -> None:
    """A configuration or two, and a picture."""
    command.add_argument(
        "--from",
        dest="start",
        metavar="FILE",
        help="a configuration, as for `at`: alone, a certified box around it that is free of singularities",
    )
    command.add_argument(
        "--to",
        dest="target",
        metavar="FILE",
        help="another: whether a motion without a singularity joins them, with the motion or the reason",
    )
    command.add_argument("-o", "--output", metavar="FILE", help="a picture of all regions to write")


def language(command: argparse.ArgumentParser) -> None:
    """The language of exported code."""
    command.add_argument(
        "--to",
        dest="language",
        default="python",
        choices=("python", "c"),
        help="Python with its module math, or C99 (default: %(default)s)",
    )


def mobility(command: argparse.ArgumentParser) -> None:
    """The mobility."""
    command.add_argument(
        "--n", type=_at_least_one, default=3, help="the mobility (default: 3, which allows all)"
    )


def output(command: argparse.ArgumentParser) -> None:
    """A file to write."""
    command.add_argument(
        "-o", "--output", metavar="FILE", help="to write (default: named after the mechanism)"
    )


def folder(command: argparse.ArgumentParser) -> None:
    """A folder to write, and what goes there."""
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


def shown(command: argparse.ArgumentParser) -> None:
    """What to draw, and where."""
    output(command)
    choice = command.add_mutually_exclusive_group()
    choice.add_argument(
        "--class",
        dest="shown",
        type=_class_number,
        metavar="NUMBER",
        help="a class, one file for each of its families, as --class 4",
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
        "--regions",
        dest="shown",
        action="store_const",
        const="regions",
        help="assemblies and singularity-free regions over the plane of two inputs",
    )
    choice.add_argument(
        "--modules",
        dest="shown",
        action="store_const",
        const="modules",
        help="what is solved after what, driven from the inputs and from the outputs",
    )


def clear(command: argparse.ArgumentParser) -> None:
    """Whether to forget."""
    command.add_argument("--clear", action="store_true", help="take all of them away")


def talk(command: argparse.ArgumentParser, works: bool) -> None:
    """What is said on stderr; works: whether the command may take long."""
    command.set_defaults(talk="usual")
    choice = command.add_mutually_exclusive_group()

    def add(name: str, words: str) -> None:
        choice.add_argument(f"--{name}", dest="talk", action="store_const", const=name, help=words)

    add("quiet", "nothing on stderr but errors")
    if works:
        add("progress", "lines on stderr while it works, where that is no terminal too")
    add("verbose", "all that happens, as lines on stderr")


def shell(command: argparse.ArgumentParser) -> None:
    """The shell."""
    command.add_argument("shell", choices=("bash", "zsh"), help='use: eval "$(singsym completion bash)"')


def install(command: argparse.ArgumentParser) -> None:
    """Whether to install."""
    command.add_argument(
        "--install", action="store_true", help="bring Singular and msolve with pip, beside the packages"
    )
