"""How it is known of each class that it occurs, or that it is empty, for the report.

Source: the steps of section 3.2 of Zlatanov, Fenton, Benhabib (1998).
"""

from __future__ import annotations

from collections.abc import Iterator
from html import escape

from singsym.classes.result import Classification, ClassResult
from singsym.effort.verdict import described
from singsym.output.html.certificate import Proof, sentence
from singsym.output.pieces import counted


def proofs(classification: Classification, proof: Proof | None = None) -> str:
    """A section for each of the 21 classes; proof: of a certificate, to whose lines they are linked."""
    return "".join(_section(result, proof) for result in classification.classes)


def _section(result: ClassResult, proof: Proof | None) -> str:
    number, verdict = result.singularity_class.number, result.verdict
    back = f' <a href="#class-{number}">(the class)</a>' if verdict.is_yes else ""
    grounds = [*_grounds(result), sentence(proof, result) if proof else ""]
    lines = "".join(f"<li>{line}</li>" for line in grounds if line)
    answer = {"yes": "It exists", "no": "It is empty", "undecided": "Undecided"}[str(verdict.answer)]
    certainty = f" ({described(verdict.certainty)})" if not verdict.is_undecided else ""
    return (
        f'<section id="proof-{number}"><h3>Class {number}: {escape(result.singularity_class.name)}{back}</h3>'
        f"<p>{answer}{certainty}, step {escape(', '.join(result.steps) or '–')} of section 3.2.</p>"
        f"<ul>{lines}</ul></section>"
    )


def _grounds(result: ClassResult) -> Iterator[str]:
    """The reasons of a verdict, in sentences."""
    if result.verdict.reason:
        yield escape(result.verdict.reason)
    seen: dict[str, int] = {}
    for piece in (*result.pieces, *result.unsure):
        size = "" if piece.extent.at_least < 0 else f", real dimension {piece.extent}"
        points = f", {counted(piece.points, 'real point')}" if piece.points else ""
        engine = f", by {piece.verdict.engine}" if piece.verdict.engine else ""
        reason = f": {piece.verdict.reason}" if piece.verdict.reason else ""
        line = (
            f"a stratum of {len(piece.basis)} equations"
            f"{size}{points}: {piece.verdict.answer} ({described(piece.verdict.certainty)}{engine}){reason}"
        )
        seen[line] = seen.get(line, 0) + 1
    for line, times in seen.items():
        yield escape(line if times == 1 else f"{times} times {line}")
