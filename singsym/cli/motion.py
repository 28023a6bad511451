"""The commands about numbers and motion: export, follow.

Source: singsym's own.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from singsym.cli.mechanisms import complaint, placed, read
from singsym.cli.screen import UserError, drawable, emit_data, emit_page, progress_shown, say
from singsym.cli.singularities import UNDECIDED
from singsym.mechanism import Mechanism, MechanismError

if TYPE_CHECKING:
    from singsym.motion.follow import FollowedMotion


def run_export(chosen: argparse.Namespace) -> int:
    """`singsym export MECHANISM --to LANGUAGE`."""
    from singsym.output.motion.code import code

    mechanism = read(chosen)
    try:
        print(code(placed(mechanism, chosen.formulation), chosen.language, mechanism.name))
    except MechanismError as error:
        raise UserError(complaint(error.problems)) from None
    return 0


def run_follow(chosen: argparse.Namespace) -> int:
    """`singsym follow MECHANISM FILE`; exit code 3 where the motion is not proven throughout."""
    mechanism = read(chosen)
    placed(mechanism, chosen.formulation)
    if chosen.output:
        drawable(Path(chosen.output))
    try:
        found = _followed(mechanism, chosen)
        if chosen.output:
            from singsym.output.motion.follow_page import plot_margins

            plot_margins(found, mechanism.title or mechanism.name).save(chosen.output)
            say(f"written: {chosen.output}")
    except MechanismError as error:
        raise UserError(complaint(error.problems)) from None
    except ValueError as error:
        raise UserError(str(error)) from None
    except OSError as error:
        raise UserError(f"{error.filename} cannot be read or written: {error.strerror}") from None
    from singsym.output.motion.follow_page import follow_data, follow_page

    if chosen.format == "json":
        emit_data(follow_data(mechanism.name, found))
    else:
        emit_page(follow_page(mechanism.name, found))
    return 0 if found.is_decided else UNDECIDED


def _followed(mechanism: Mechanism, chosen: argparse.Namespace) -> FollowedMotion:
    from singsym.classes.configuration.at import at
    from singsym.classes.configuration.given_values import Given
    from singsym.motion.follow import follow
    from singsym.motion.trajectory import Trajectory

    trajectory = Trajectory.from_file(chosen.trajectory)
    start = None
    if chosen.config:
        given = Given.from_file(chosen.config)
        start = at(mechanism, given, formulation=chosen.formulation, file=chosen.config)
    with progress_shown():
        return follow(mechanism, trajectory, start=start, formulation=chosen.formulation)
