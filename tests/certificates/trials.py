"""What becomes of damaged certificates: they are rejected, or prove no more than is true.

Source: singsym's own.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from random import Random

from singsym.certificates.checker.polynomials import Rejected
from singsym.certificates.checker.table import Row
from singsym.certificates.checker.verification import verify
from singsym.certificates.prover.writing import Certificate
from singsym.certificates.wording import row_text
from tests.certificates.damage import Damage, damaged

NAMES = (
    *("fourbar", "slider-crank", "2r", "orthogonal-3r"),
    *("wrist-offset", "parallelogram", "pantograph", "pentagon", "3rpr"),
)
"""Mechanisms of the library with small certificates, which use each rule."""
OUTCOMES = ("rejected", "weaker", "same", "FALSE")


@dataclass(frozen=True)
class Trial:
    """A damaged certificate and its outcome, one of `OUTCOMES`; what: of a false proof, what is wrong."""

    damage: Damage
    outcome: str
    what: str = ""


def says_no_more(row: Row, true: Row) -> bool:
    """Whether all that a row knows is what the true one knows, for the same curves that are together."""
    keys = ("occurs", "dimension", "points", *(["components"] if row.together == true.together else []))
    pairs = [(getattr(row, key), getattr(true, key)) for key in keys]
    return all(known is None or known == right for known, right in pairs)


def trials(whole: Certificate, count: int, random: Random, folder: Path) -> list[Trial]:
    """So many damaged certificates, each checked against the table that is true.

    That is what the whole certificate proves, and of a row that it leaves open what the classification found.
    """
    path = folder / "certificate"
    found = verify(whole.write(path))
    claims = {row.types: row for row in found.claimed}
    true = [_joined(row, claims[row.types]) for row in found.proven]
    return [_trial(damaged(list(whole.lines), random), true, path) for _ in range(count)]


def _joined(row: Row, other: Row) -> Row:
    keys = ("occurs", "dimension", "points", "components")
    known = {key: (getattr(row, key), getattr(other, key)) for key in keys}
    return replace(row, **{key: b if a is None else a for key, (a, b) in known.items()})


def _trial(damage: Damage, true: Sequence[Row], path: Path) -> Trial:
    try:
        found = verify(Certificate(tuple(damage.lines)).write(path))
    except Rejected:
        return Trial(damage, "rejected")
    except Exception as error:  # the checker must not fail, whatever it reads
        return Trial(damage, "FALSE", repr(error))
    rows = {row.types: row for row in true}
    wrong = [row_text(row) for row in found.proven if not says_no_more(row, rows[row.types])]
    if found.complete:
        claims = [claim for claim in found.claimed if claim.occurs]
        wrong += [f"claimed {row_text(c)}" for c in claims if not says_no_more(c, rows[c.types])]
    if wrong:
        return Trial(damage, "FALSE", "; ".join(wrong))
    return Trial(damage, "same" if found.complete else "weaker")


def tally(done: Iterable[Trial], by: str) -> list[str]:
    """A line for each kind of damage, or each field, with how many there were of each outcome; then all."""
    rows: dict[str, Counter[str]] = {}
    for trial in done:
        for key in (getattr(trial.damage, by), "all"):
            rows.setdefault(key, Counter())[trial.outcome] += 1
    head = f"{by:48} {'all':>6} " + " ".join(f"{word:>8}" for word in OUTCOMES)
    lines = [head]
    for key in sorted(rows, key=lambda key: (key == "all", key)):
        counts = " ".join(f"{rows[key][word]:8}" for word in OUTCOMES)
        lines.append(f"{key:48} {rows[key].total():6} {counts}")
    return lines
