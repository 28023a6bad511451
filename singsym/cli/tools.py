"""The commands about singsym itself: engines, cache, completion.

Source: singsym's own.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import asdict
from typing import TYPE_CHECKING

from singsym.cli.screen import UserError, emit_data, emit_page, say

if TYPE_CHECKING:
    from singsym.elimination.engines.registry import EngineStatus
    from singsym.output.page import Page

_COMPLETION = """\
{prelude}_singsym() {{
    local words="{commands}"
    if [ "$COMP_CWORD" -gt 1 ]; then
        case "${{COMP_WORDS[1]}}" in
{cases}
        esac
    fi
    COMPREPLY=( $(compgen -W "$words" -- "${{COMP_WORDS[COMP_CWORD]}}") )
}}
complete -o default -F _singsym singsym
"""


def run_completion(chosen: argparse.Namespace) -> int:
    """`singsym completion SHELL`: prints the script."""
    from singsym.cli.parser import commands
    from singsym.mechanism.library import names

    mechanisms = " ".join(names())
    found = commands()
    cases = [
        f'            {name}) words="{" ".join(options)}{" " + mechanisms if takes_mechanism else ""}" ;;'
        for name, options, takes_mechanism in found
    ]
    prelude = "autoload -U +X bashcompinit && bashcompinit\n" if chosen.shell == "zsh" else ""
    listed = " ".join(name for name, _, _ in found)
    print(_COMPLETION.format(prelude=prelude, commands=listed, cases="\n".join(cases)), end="")
    return 0


def run_engines(chosen: argparse.Namespace) -> int:
    """`singsym engines [--install]`."""
    from singsym.elimination.engines.registry import install, status

    if chosen.install:
        say("Bringing Singular and msolve with pip, without their dependencies ...")
        try:
            install()
        except RuntimeError as error:
            raise UserError(str(error)) from None
    found = status()
    if chosen.format == "json":
        emit_data([asdict(engine) for engine in found])
        return 0
    emit_page(_engines_page(found))
    return 0


def _engines_page(engines: Sequence[EngineStatus]) -> Page:
    """Which engines there are, what each is for, and how to get the missing ones."""
    from singsym.output.page import Grid

    rows = tuple(
        (e.name, "yes" if e.found else "no", e.version, e.licence, e.used_for, e.path) for e in engines
    )
    grid = Grid(("engine", "there", "version", "licence", "used for", "path"), rows)
    missing = [e for e in engines if not e.found]
    names = ", ".join(e.name for e in missing)
    return (grid, f"Missing: {names}. To get them: {missing[0].how_to_get}") if missing else (grid,)


def run_cache(chosen: argparse.Namespace) -> int:
    """`singsym cache [--clear]`: where results are kept, how many and how large."""
    from singsym.classes.running.disk_cache import user_cache

    cache = user_cache()
    if cache is None:
        raise UserError("there is no folder for a cache: set SINGSYM_CACHE to an absolute path")
    try:
        if chosen.clear:
            cleared = cache.clear()
            say(f"Cleared {cleared} result{'' if cleared == 1 else 's'}.")
        sizes = cache.sizes()
    except OSError as error:
        raise UserError(f"{error.filename or cache.folder}: {error.strerror}") from None
    if chosen.format == "json":
        emit_data({"folder": str(cache.folder), "results": len(sizes), "bytes": sum(sizes)})
    else:
        results = f"{len(sizes)} result{'' if len(sizes) == 1 else 's'}"
        emit_page((f"{cache.folder}: {results}, {sum(sizes) / 1e6:.1f} MB",))
    return 0
