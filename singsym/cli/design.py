"""The command about dimensions: design.

Source: singsym's own.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from singsym.cli.mechanisms import complaint, read
from singsym.cli.screen import UserError, drawable, emit_data, emit_latex, emit_page, progress_shown, say
from singsym.cli.singularities import UNDECIDED, cluster_of, limits_of, resumable
from singsym.mechanism import Mechanism, MechanismError

if TYPE_CHECKING:
    from singsym.designs.result import Design


def run_design(chosen: argparse.Namespace) -> int:
    """`singsym design MECHANISM --parameters a,b`, or `--values a=1,2` for samples; exit code 3: open."""
    mechanism = read(chosen)
    if chosen.output:
        drawable(Path(chosen.output))
        if chosen.values:
            raise UserError("found --output with --values; a chart needs --parameters")
    resumable(chosen)
    from singsym.elimination import engines

    try:
        with engines.use(*chosen.engines), progress_shown(), cluster_of(chosen) as executor:
            work: dict[str, Any] = {
                "formulation": chosen.formulation,
                "workers": chosen.workers,
                "executor": executor,
                "limits": limits_of(chosen),
                "cache": chosen.cache,
            }
            return _swept(mechanism, chosen, work) if chosen.values else _designed(mechanism, chosen, work)
    except MechanismError as error:
        raise UserError(complaint(error.problems)) from None


def _designed(mechanism: Mechanism, chosen: argparse.Namespace, work: dict[str, Any]) -> int:
    from singsym.designs.design import design

    names = [name.strip() for name in chosen.parameters.split(",")]
    if not all(names):
        given = f"found --parameters {chosen.parameters!r}"
        raise UserError(f"{given}; expected one or two names, as --parameters a,b")
    found = design(mechanism, names, **work)
    if chosen.output:
        found.plot().save(chosen.output)
        say(f"written: {chosen.output}")
    _emit(found, chosen)
    return UNDECIDED if found.undecided else 0


def _emit(found: Design, chosen: argparse.Namespace) -> None:
    from singsym.output.design import page

    if chosen.format == "json":
        emit_data(page.design_data(found))
    elif chosen.format == "csv":
        print(page.csv_text(page.design_rows(found)), end="")
    elif chosen.format == "latex":
        body = page.border_latex(found)
        title = found.mechanism.title or found.mechanism.name
        emit_latex(f"\\[{body}\\]" if body else "No border divides the ranges.", title, chosen.standalone)
    else:
        emit_page(page.design_page(found))


def _swept(mechanism: Mechanism, chosen: argparse.Namespace, work: dict[str, Any]) -> int:
    from singsym.designs.sampling import sweep
    from singsym.output.design.page import csv_text, sweep_page

    values: dict[str, list[str]] = {}
    for text in chosen.values:
        name, _, listed = text.partition("=")
        if name.strip() in values:
            raise UserError(
                f"found --values {name.strip()} twice; expected all in one, as --values a=1,3/2,2"
            )
        values[name.strip()] = [value.strip() for value in listed.split(",") if value.strip()]
        if not values[name.strip()]:
            raise UserError(f"found --values {text}; expected NAME=VALUES, as --values a=1,3/2,2")
    if chosen.format == "latex":
        raise UserError("found --format latex with --values; expected text, json or csv")
    rows = sweep(mechanism, values, **work)
    if chosen.format == "json":
        emit_data({"mechanism": mechanism.name, "samples": rows})
    elif chosen.format == "csv":
        print(csv_text(rows), end="")
    else:
        emit_page(sweep_page(mechanism.name, rows))
    return UNDECIDED if any(row["verdict"] == "undecided" for row in rows) else 0
