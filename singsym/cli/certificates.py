"""The command about certificates: verify; and the file that classify writes.

Source: singsym's own; the format is in `docs/certificates.md`.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from singsym.cli.screen import UserError, emit_data, emit_page, say

if TYPE_CHECKING:
    from singsym.certificates.checker.verification import Verification
    from singsym.classes.result import Classification

INCOMPLETE = 3


def write_certificate(result: Classification, path: str) -> None:
    """The certificate of a classification as a file, and on stderr how large it is."""
    from singsym.certificates.prover.writing import certificate

    try:
        target = certificate(result).write(path)
    except OSError as error:
        raise UserError(f"{path} cannot be written: {error.strerror}") from None
    say(f"Certificate: {target}, {target.stat().st_size / 1000:.1f} kB; singsym verify {target} checks it.")


def run_verify(chosen: argparse.Namespace) -> int:
    """`singsym verify FILE [--mechanism MECHANISM]`: the table that a certificate proves."""
    from singsym.certificates.checker.verification import verify
    from singsym.certificates.wording import TRUSTED

    try:
        found = verify(chosen.file)
    except OSError as error:
        raise UserError(f"{chosen.file}: {error.strerror}") from None
    except ValueError as error:
        raise UserError(f"{chosen.file} is rejected: {error}") from None
    trusted = list(TRUSTED)
    if chosen.mechanism:
        _check_statement(found, chosen)
        trusted[0] = "that singsym derives L, the loop equations and the conditions rightly"
    if chosen.format == "json":
        emit_data(_data(found, trusted))
    else:
        emit_page(tuple(_page(found, trusted)))
    return 0 if found.complete else INCOMPLETE


def _check_statement(found: Verification, chosen: argparse.Namespace) -> None:
    """Whether a certificate is about a mechanism as singsym places it."""
    from singsym.certificates.prover.writing import statement_data
    from singsym.cli.mechanisms import placed, read

    own = statement_data(placed(read(chosen), chosen.formulation))
    if own != found.data:
        different = [key for key in own if own[key] != found.data.get(key)]
        raise UserError(
            f"{chosen.file} is not about {chosen.mechanism}: {', '.join(different)} of its statement differ"
        )


def _page(found: Verification, trusted: list[str]) -> Iterator[str]:
    from singsym.certificates.wording import row_text

    occurring = [row_text(row) for row in found.proven if row.occurs]
    empty = [row.types for row in found.proven if row.occurs is False]
    open_rows = [row.types for row in found.proven if row.occurs is None]
    word = "proven in full" if found.complete else "not proven in full"
    yield f"{found.name}: the table is {word}"
    yield "\n".join(("Proven:", *(f"  {line}" for line in occurring or ["no singular configuration"])))
    yield f"Proven to be empty: {'; '.join(empty) or 'none'}"
    if open_rows:
        yield f"Not known to occur or to be empty: {'; '.join(open_rows)}"
    if found.missing:
        yield "\n".join(("Not proven:", *(f"  {line}" for line in found.missing)))
    yield f"Steps: {', '.join(f'{k} {rule}' for rule, k in sorted(found.rules.items()))}"
    yield "\n".join(("Taken on trust:", *(f"  {line}" for line in trusted)))


def _data(found: Verification, trusted: list[str]) -> dict[str, Any]:
    return {
        "mechanism": found.name,
        "complete": found.complete,
        "proven": [asdict(row) for row in found.proven],
        "not_proven": list(found.missing),
        "steps": dict(found.rules),
        "trusted": trusted,
    }
