"""The commands about numbers and motion: export, follow, regions.

Source: singsym's own.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from singsym.cli.mechanisms import complaint, placed, read
from singsym.cli.screen import UserError, drawable, emit_data, emit_page, progress_shown, say
from singsym.cli.singularities import UNDECIDED
from singsym.mechanism import Mechanism, MechanismError

if TYPE_CHECKING:
    from singsym.classes.configuration.at import Analysis
    from singsym.motion.follow import FollowedMotion
    from singsym.output.page import Page


def run_export(chosen: argparse.Namespace) -> int:
    """`singsym export MECHANISM --to LANGUAGE`."""
    from singsym.output.motion.code import code

    mechanism = read(chosen)
    try:
        print(code(placed(mechanism, chosen.formulation), chosen.language, mechanism.name))
    except MechanismError as error:
        raise UserError(complaint(error.problems)) from None
    return 0


@contextmanager
def _in_words() -> Iterator[None]:
    """What is wrong with a configuration, its values or files inside is said to the user."""
    try:
        yield
    except MechanismError as error:
        raise UserError(complaint(error.problems)) from None
    except ValueError as error:
        raise UserError(str(error)) from None
    except OSError as error:
        raise UserError(f"{error.filename} cannot be read or written: {error.strerror}") from None


def run_follow(chosen: argparse.Namespace) -> int:
    """`singsym follow MECHANISM FILE`; exit code 3 where the motion is not proven throughout."""
    mechanism = read(chosen)
    placed(mechanism, chosen.formulation)
    if chosen.output:
        drawable(Path(chosen.output))
    with _in_words():
        start = _examined(mechanism, chosen, chosen.config) if chosen.config else None
        found = _followed(mechanism, chosen, start)
        if chosen.output:
            from singsym.output.motion.follow_page import plot_margins

            plot_margins(found, mechanism.title or mechanism.name).save(chosen.output)
            say(f"written: {chosen.output}")
    from singsym.output.motion.follow_page import follow_data, follow_page

    page, data = follow_page(mechanism.name, found), follow_data(mechanism.name, found)
    _emit_noted(chosen, page, data, _notes((chosen.config, start)))
    return 0 if found.is_decided else UNDECIDED


def _notes(*given: tuple[str, Analysis | None]) -> list[str]:
    """What is to be said of configurations that files give: freedoms that they leave, and the like."""
    return [f"{file}: {remark}" for file, found in given if found is not None for remark in found.remarks]


def _emit_noted(chosen: argparse.Namespace, page: Page, data: dict[str, Any], notes: Sequence[str]) -> None:
    """A page or plain data, with notes."""
    if chosen.format == "json":
        emit_data({**data, "notes": [*notes]} if notes else data)
    else:
        emit_page((*page, "\n".join(f"Note: {note}." for note in notes)) if notes else page)


def _followed(mechanism: Mechanism, chosen: argparse.Namespace, start: Analysis | None) -> FollowedMotion:
    from singsym.motion.follow import follow
    from singsym.motion.trajectory import Trajectory

    trajectory = Trajectory.from_file(chosen.trajectory)
    with progress_shown():
        return follow(mechanism, trajectory, start=start, formulation=chosen.formulation)


def run_regions(chosen: argparse.Namespace) -> int:
    """`singsym regions MECHANISM [--from FILE [--to FILE]]`: all, a free box, or whether two are joined."""
    mechanism = read(chosen)
    placed(mechanism, chosen.formulation)
    if chosen.target and not chosen.start:
        raise UserError("found --to without --from; expected two configurations, or --from alone for a box")
    if chosen.output and chosen.start:
        raise UserError("found -o with --from; expected it without: the picture is of all regions")
    if chosen.output:
        drawable(Path(chosen.output))
    with _in_words(), progress_shown():
        page, data, notes, is_decided = _regions(mechanism, chosen)
    _emit_noted(chosen, page, data, notes)
    return 0 if is_decided else UNDECIDED


def _regions(
    mechanism: Mechanism, chosen: argparse.Namespace
) -> tuple[Page, dict[str, Any], list[str], bool]:
    """The page, the plain data, notes on both, and whether all is decided."""
    from singsym.output.motion import regions_page as pages

    name = mechanism.name
    if not chosen.start:
        from singsym.motion.regions.regions import regions

        every = regions(mechanism, formulation=chosen.formulation)
        if chosen.output:
            from singsym.output.figures.regions import plot_regions

            plot_regions(every).save(chosen.output)
            say(f"written: {chosen.output}")
        return pages.regions_page(name, every), pages.regions_data(name, every), [], every.verdict.is_yes
    one = _examined(mechanism, chosen, chosen.start)
    if not chosen.target:
        from singsym.motion.regions.free_box import free_box

        box = free_box(one)
        notes = _notes((chosen.start, one))
        page, data, is_decided = pages.box_page(name, box), pages.box_data(name, box), True
    else:
        from singsym.motion.regions.joined import joined

        other = _examined(mechanism, chosen, chosen.target)
        notes = _notes((chosen.start, one), (chosen.target, other))
        found = joined(one, other)
        page, data = pages.joined_page(name, found), pages.joined_data(name, found)
        is_decided = not found.verdict.is_undecided
    return page, data, notes, is_decided


def _examined(mechanism: Mechanism, chosen: argparse.Namespace, file: str) -> Analysis:
    """The configuration that a file gives."""
    from singsym.classes.configuration.at import at
    from singsym.classes.configuration.given_values import Given

    return at(mechanism, Given.from_file(file), formulation=chosen.formulation, file=file)
