"""The commands about singsym itself: engines.

Source: singsym's own.
"""

from __future__ import annotations

import argparse
from dataclasses import asdict

from singsym.cli.screen import UserError, emit_data, emit_page, say


def run_engines(chosen: argparse.Namespace) -> int:
    """`singsym engines [--install]`."""
    from singsym.elimination.engines.registry import install, status

    if chosen.install:
        say("Installing Singular and msolve with pip, without their dependencies ...")
        try:
            install()
        except RuntimeError as error:
            raise UserError(str(error)) from None
    found = status()
    if chosen.format == "json":
        emit_data([asdict(engine) for engine in found])
        return 0
    from singsym.output.text import engines_page

    emit_page(engines_page(found))
    return 0
