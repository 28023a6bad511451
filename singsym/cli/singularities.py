"""The commands about singularities: conditions, classes, classify, solve, at.

Source: sections 2.3, 3.1 and 3.2 of Zlatanov, Fenton, Benhabib (1998).
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, cast

from singsym.cli.mechanisms import complaint, placed, read
from singsym.cli.screen import UserError, emit_data, emit_latex, emit_page, writable
from singsym.mechanism import Mechanism, MechanismError
from singsym.mechanism.choices import is_redundant

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from singsym.classes.classify import Limits
    from singsym.classes.result import Classification
    from singsym.classes.solve import Solution

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
    _resumable(chosen)
    with engines.use(*chosen.engines), progress_shown(), _cluster(chosen) as executor:
        return classify(
            mechanism,
            formulation=chosen.formulation,
            workers=chosen.workers,
            executor=executor,
            limits=_limits(chosen),
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
    _resumable(chosen)
    asked = [own for label in chosen.labels for own in (CUSPS if label == "cusps" else (label,))]
    try:
        with engines.use(*chosen.engines), progress_shown(), _cluster(chosen) as executor:
            found = solve(
                mechanism,
                *dict.fromkeys(asked),
                formulation=chosen.formulation,
                workers=chosen.workers,
                executor=executor,
                limits=_limits(chosen),
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
def _cluster(chosen: argparse.Namespace) -> Iterator[Executor | None]:
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


def _limits(chosen: argparse.Namespace) -> Limits:
    """The time for everything, a tenth of it at most for each part; the defaults without --budget.

    What has passed since the command began counts, too.
    """
    from singsym.classes.classify import Limits

    usual = Limits()
    if chosen.budget is None:
        return usual
    left = max(0.0, chosen.budget - (time.monotonic() - chosen.started))
    return Limits(usual.part(chosen.budget / 10), clock=left)


def _resumable(chosen: argparse.Namespace) -> None:
    if chosen.cache:
        chosen.on_interrupt = "; finished parts are kept: the same command goes on from there"


def run_at(chosen: argparse.Namespace) -> int:
    """`singsym at MECHANISM --config FILE`."""
    from singsym.classes.configuration.at import at
    from singsym.classes.configuration.given_values import Given

    mechanism = read(chosen)
    placed(mechanism, chosen.formulation)
    distance = None
    try:
        given = Given.from_file(chosen.config)
        found = at(
            mechanism, given, formulation=chosen.formulation, tolerance=chosen.tolerance, file=chosen.config
        )
        if chosen.distance:
            from singsym.motion.distance import singularity_distance

            distance = singularity_distance(found)
    except MechanismError as error:
        raise UserError(complaint(error.problems)) from None
    except OSError as error:
        raise UserError(f"{chosen.config} cannot be read: {error.strerror}") from None
    if chosen.format == "json":
        from singsym.output.motion.distance_page import distance_data
        from singsym.output.plain_data import analysis_data

        more = {} if distance is None else {"nearest": distance_data(distance)}
        emit_data({**analysis_data(mechanism.name, found), **more})
    else:
        from singsym.output.motion.distance_page import distance_page
        from singsym.output.text import analysis_page

        more_blocks = () if distance is None else distance_page(distance)
        emit_page((*analysis_page(mechanism.name, found), *more_blocks))
    return UNDECIDED if found.undecided else 0
