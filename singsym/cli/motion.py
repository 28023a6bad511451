"""The commands about numbers and motion: export.

Source: singsym's own.
"""

from __future__ import annotations

import argparse

from singsym.cli.mechanisms import complaint, placed, read
from singsym.cli.screen import UserError
from singsym.mechanism import MechanismError


def run_export(chosen: argparse.Namespace) -> int:
    """`singsym export MECHANISM --to LANGUAGE`."""
    from singsym.output.motion.code import code

    mechanism = read(chosen)
    try:
        print(code(placed(mechanism, chosen.formulation), chosen.language, mechanism.name))
    except MechanismError as error:
        raise UserError(complaint(error.problems)) from None
    return 0
