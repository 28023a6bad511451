"""The commands about singularities: conditions, classes, classify, solve, at.

Source: sections 2.3, 3.1 and 3.2 of Zlatanov, Fenton, Benhabib (1998).
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from singsym.cli.mechanisms import complaint, placed, read
from singsym.cli.screen import UserError, drawable, emit_data, emit_latex, emit_page, say, writable
from singsym.mechanism import Mechanism, MechanismError
from singsym.mechanism.choices import is_redundant

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from singsym.classes.classify import Limits
    from singsym.classes.configuration.self_motions import SelfMotion
    from singsym.classes.result import Classification
    from singsym.classes.solve import Solution
    from singsym.output.page import Block

UNDECIDED = 3


def run_conditions(chosen: argparse.Namespace) -> int:
    """`singsym conditions MECHANISM`."""
    from singsym.conditions.conditions import conditions
    from singsym.conditions.named_lengths import named_lengths
    from singsym.output.citations import printed_labels

    mechanism = read(chosen, redundant=True)
    if is_redundant(mechanism):
        return _redundant_conditions(chosen, mechanism)
    found = conditions(placed(mechanism, chosen.formulation))
    everything = chosen.expand or chosen.format == "json"
    lengths = named_lengths(mechanism, found.equation, printed_labels(found, everything))
    if chosen.format == "json":
        from singsym.output.plain_data import conditions_data

        emit_data(conditions_data(mechanism.name, found, lengths))
    elif chosen.format == "latex":
        from singsym.output.latex import conditions_latex

        body = conditions_latex(found, mechanism, lengths, expand=chosen.expand)
        emit_latex(body, mechanism.title or mechanism.name, chosen.standalone)
    else:
        from singsym.output.conditions_page import conditions_page

        emit_page((mechanism.name, *conditions_page(found, lengths, expand=chosen.expand)))
    return 0


def _redundant_conditions(chosen: argparse.Namespace, mechanism: Mechanism) -> int:
    """Of a serial chain with more inputs than output components: where the rank of L_O drops."""
    from singsym.conditions.redundant import redundant_chain
    from singsym.output import redundant_page

    found = redundant_chain(placed(mechanism, chosen.formulation))
    if chosen.format == "json":
        emit_data(redundant_page.redundant_data(mechanism.name, found))
    elif chosen.format == "latex":
        body = redundant_page.redundant_latex(mechanism, found, expand=chosen.expand)
        emit_latex(body, mechanism.title or mechanism.name, chosen.standalone)
    else:
        emit_page((mechanism.name, *redundant_page.redundant_page(found, expand=chosen.expand)))
    return 0


def run_classes(chosen: argparse.Namespace) -> int:
    """`singsym classes [--n N]`."""
    from singsym.classes.taxonomy.types import table

    found = table(chosen.n)
    if chosen.format == "json":
        from singsym.output.plain_data import classes_data

        emit_data(classes_data(found, chosen.n))
    elif chosen.format == "latex":
        from singsym.output.latex import classes_latex

        body = classes_latex(found, chosen.n)
        emit_latex(body, "Classes of singular configurations", chosen.standalone)
    else:
        from singsym.output.text import classes_page

        emit_page(classes_page(found, chosen.n))
    return 0


def classified(chosen: argparse.Namespace) -> Classification:
    """The classification that the options ask for, with progress on stderr."""
    from singsym.classes.classify import classify
    from singsym.cli.screen import progress_shown
    from singsym.elimination import engines

    mechanism = read(chosen)
    placed(mechanism, chosen.formulation)
    resumable(chosen)
    with engines.use(*chosen.engines), progress_shown(), cluster_of(chosen) as executor:
        return classify(
            mechanism,
            formulation=chosen.formulation,
            workers=chosen.workers,
            executor=executor,
            limits=limits_of(chosen),
            cache=chosen.cache,
        )


def run_classify(chosen: argparse.Namespace) -> int:
    """`singsym classify MECHANISM`; what is known when it is interrupted is printed too."""
    from singsym.classes.running.runner import Interrupted

    if chosen.certificate:
        writable(Path(chosen.certificate))
    try:
        result = classified(chosen)
    except Interrupted as interruption:
        _emit_classification(cast("Classification", interruption.partial), chosen)
        raise
    _emit_classification(result, chosen)
    if chosen.certificate:
        from singsym.cli.certificates import write_certificate

        write_certificate(result, chosen.certificate)
    return UNDECIDED if result.undecided else 0


def _emit_classification(result: Classification, chosen: argparse.Namespace) -> None:
    if chosen.format == "json":
        from singsym.output.plain_data import classification_data

        emit_data(classification_data(result))
    elif chosen.format == "latex":
        from singsym.output.latex import classification_latex

        body = classification_latex(result)
        title = result.mechanism.title or result.mechanism.name if result.mechanism else "Given equations"
        emit_latex(body, title, chosen.standalone)
    else:
        from singsym.output.text import classification_page

        emit_page(classification_page(result))


def run_solve(chosen: argparse.Namespace) -> int:
    """`singsym solve MECHANISM CONDITION ...`; what is known when it is interrupted is printed too."""
    from singsym.classes.running.runner import Interrupted
    from singsym.classes.solve import CUSPS, solve
    from singsym.cli.screen import progress_shown
    from singsym.elimination import engines

    mechanism = read(chosen)
    placed(mechanism, chosen.formulation)
    resumable(chosen)
    asked = [own for label in chosen.labels for own in (CUSPS if label == "cusps" else (label,))]
    try:
        with engines.use(*chosen.engines), progress_shown(), cluster_of(chosen) as executor:
            found = solve(
                mechanism,
                *dict.fromkeys(asked),
                formulation=chosen.formulation,
                workers=chosen.workers,
                executor=executor,
                limits=limits_of(chosen),
                cache=chosen.cache,
            )
    except Interrupted as interruption:
        _emit_solutions(mechanism, cast("tuple[Solution, ...]", interruption.partial), chosen)
        raise
    _emit_solutions(mechanism, found, chosen)
    return UNDECIDED if any(s.undecided for s in found) else 0


def _emit_solutions(mechanism: Mechanism, found: Sequence[Solution], chosen: argparse.Namespace) -> None:
    from singsym.conditions.named_lengths import named_lengths

    if not found:
        return
    lengths = named_lengths(mechanism, found[0].equation)
    if chosen.format == "json":
        from singsym.output.plain_data import solution_data

        emit_data(solution_data(mechanism.name, found, lengths))
    elif chosen.format == "latex":
        from singsym.output.latex import solution_latex

        body = solution_latex(found, lengths)
        emit_latex(body, mechanism.title or mechanism.name, chosen.standalone)
    else:
        from singsym.output.text import solution_page

        emit_page(solution_page(mechanism.name, found, lengths))


@contextmanager
def cluster_of(chosen: argparse.Namespace) -> Iterator[Executor | None]:
    """The cluster of --scheduler; None without, where the work is done by processes of this machine."""
    if chosen.scheduler is None:
        yield None
        return
    from singsym.classes.running.cluster import ClusterError, cluster

    try:
        with cluster(chosen.scheduler) as executor:
            yield executor
    except ClusterError as error:
        raise UserError(str(error)) from None


def limits_of(chosen: argparse.Namespace) -> Limits:
    """The time for everything, a tenth of it at most for each part; the defaults without --budget.

    What has passed since the command began counts, too.
    """
    from singsym.classes.classify import Limits

    usual = Limits()
    if chosen.budget is None:
        return usual
    left = max(0.0, chosen.budget - (time.monotonic() - chosen.started))
    return Limits(usual.part(chosen.budget / 10), clock=left)


def resumable(chosen: argparse.Namespace) -> None:
    """Have an interruption say that finished parts are kept, where they are."""
    if chosen.cache:
        chosen.on_interrupt = "; finished parts are kept: the same command goes on from there"


def _draw_self_motions(motions: Sequence[SelfMotion], file: str) -> None:
    from singsym.output.figures.self_motions import plot_self_motions

    try:
        picture = plot_self_motions(motions)
    except ValueError as reason:
        raise UserError(f"{file} is not written: {reason}") from None
    picture.save(file)
    say(f"written: {file}")


def run_at(chosen: argparse.Namespace) -> int:
    """`singsym at MECHANISM --config FILE`; of a redundant chain its self-motions alone."""
    mechanism = read(chosen, redundant=chosen.self_motions)
    placed(mechanism, chosen.formulation)
    try:
        return _examined(mechanism, chosen)
    except MechanismError as error:
        raise UserError(complaint(error.problems)) from None
    except OSError as error:
        raise UserError(f"{chosen.config} cannot be read: {error.strerror}") from None


def _examined(mechanism: Mechanism, chosen: argparse.Namespace) -> int:
    from singsym.classes.configuration.at import at
    from singsym.classes.configuration.given_values import Given
    from singsym.classes.configuration.self_motions import self_motions
    from singsym.motion.distance import singularity_distance
    from singsym.output.motion.distance_page import distance_data, distance_page
    from singsym.output.motion.self_motion_page import self_motion_data, self_motion_page
    from singsym.output.plain_data import analysis_data
    from singsym.output.text import analysis_page

    given = Given.from_file(chosen.config)
    how = {"formulation": chosen.formulation, "file": chosen.config}
    page: list[Block] = []
    data: dict[str, Any] = {"mechanism": mechanism.name}
    if chosen.output:
        if not chosen.self_motions:
            raise UserError("found -o without --self-motions; expected both: the picture is of their curves")
        drawable(Path(chosen.output))
    is_open = False
    if not is_redundant(mechanism):
        found = at(mechanism, given, tolerance=chosen.tolerance, **how)
        page, data = [*analysis_page(mechanism.name, found)], analysis_data(mechanism.name, found)
        is_open = bool(found.undecided)
        if chosen.distance:
            distance = singularity_distance(found)
            page += distance_page(distance)
            data["nearest"] = distance_data(distance)
    if chosen.self_motions:
        motions = self_motions(mechanism, given, **how)
        page += self_motion_page(motions)
        data["self_motions"] = self_motion_data(motions)
        if chosen.output:
            _draw_self_motions(motions, chosen.output)
        is_open = is_open or any(m.dimension is None for m in motions)
    if chosen.format == "json":
        emit_data(data)
    else:
        emit_page(tuple(page))
    return UNDECIDED if is_open else 0
