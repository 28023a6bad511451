"""Which engine does which task, in which order, and what happens when one fails.

Source: the measurements behind the routing: FLINT is fastest on small ideals, msolve on large bases.
"""

from __future__ import annotations

import logging
import os
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, replace

from singsym.elimination import progress
from singsym.elimination.budget import Budget, BudgetExceeded, Undecided, current
from singsym.elimination.engines import checks
from singsym.elimination.engines.base import (
    Engine,
    EngineAnswer,
    EngineFailure,
    EngineUnavailable,
    Task,
)
from singsym.elimination.engines.discovery import HOW_TO_GET, PACKAGES
from singsym.elimination.engines.flint_engine import FlintEngine
from singsym.elimination.engines.msolve import MsolveEngine
from singsym.elimination.engines.singular import SingularEngine
from singsym.elimination.engines.sympy_engine import SympyEngine
from singsym.elimination.verdict import note
from singsym.polynomials import Polynomial

log = logging.getLogger("singsym")

flint = FlintEngine()
msolve = MsolveEngine()
singular = SingularEngine()
sympy = SympyEngine()

_ENGINES: dict[str, Engine] = {e.name: e for e in (flint, msolve, singular, sympy)}
_DEFAULT = ("flint", "msolve", "singular")
# seconds after which the next engine is asked, when there is a next one
_PATIENCE = {"flint": 1.5, "msolve": 300.0, "singular": 300.0, "sympy": 300.0}
# the same for FLINT where msolve is the next one
_FLINT_BEFORE_MSOLVE = 0.3
# the same for the last engine, when the caller set no limit
_LAST_PATIENCE, _DECOMPOSITION_PATIENCE = 3600.0, 120.0
_CHECK_SECONDS = 20.0
# a proof of what is known modulo primes may take so many times as long, between these limits
_PROOF_FACTOR, _LEAST_PROOF, _MOST_PROOF = 4.0, 1.0, 3.0
# the same of a short basis, which is often found by way of short ones
_SHORT_PROOF = 10.0
# so many times as long where a proof is worth waiting for
_PATIENT = 10.0
# what a short one has at most: terms in all, bits of a coefficient
_FEW_TERMS, _FEW_BITS = 200, 32

_allowed: ContextVar[tuple[str, ...]] = ContextVar("engines", default=_DEFAULT)
_proof_patience: ContextVar[float] = ContextVar("proof patience", default=1.0)


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


@contextmanager
def patiently() -> Iterator[None]:
    """Proofs over Q of what is known modulo primes may take much longer for the work inside.

    >>> with patiently():
    ...     proof_patience()
    10.0
    """
    token = _proof_patience.set(_PATIENT)
    try:
        yield
    finally:
        _proof_patience.reset(token)


def proof_patience() -> float:
    """So many times as long as usual proofs are waited for here."""
    return _proof_patience.get()


def has(name: str) -> bool:
    """Whether an engine is installed and allowed here."""
    return name in allowed() and _ENGINES[name].available()


def solve(task: Task, budget: Budget | None = None) -> EngineAnswer:
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
        patience = _patience(task, engine, candidates, budget.remaining())
        if (answer := _attempt(engine, task, patience, budget, failures)) is not None:
            return _noted(task, answer)
    # engines that broke down give FLINT back the time that it was refused before
    broken = any(isinstance(failure, EngineFailure) for failure in failures)
    if broken and flint in candidates[:-1]:
        answer = _attempt(flint, task, None if budget.deadline else _LAST_PATIENCE, budget, failures)
        if answer is not None:
            return _noted(task, answer)
    raise EngineFailure(", ".join(e.name for e in candidates), "; ".join(map(str, failures)))


def _noted(task: Task, answer: EngineAnswer) -> EngineAnswer:
    """The answer, after `certainties` has heard how it is known; what holds modulo a prime is no matter."""
    if not task.characteristic:
        note(answer.certainty)
    return answer


def _attempt(
    engine: Engine, task: Task, patience: float | None, budget: Budget, failures: list[Undecided]
) -> EngineAnswer | None:
    """The checked answer; `None`, with the failure noted, where there is none within so many seconds."""
    start = time.monotonic()
    try:
        answer = _run(engine, task, budget.part(patience))
        return _checked(task, answer, time.monotonic() - start, budget)
    except (EngineFailure, BudgetExceeded) as failure:
        budget.check(task.kind)
        failures.append(failure)
        log.debug("%s", failure)
        return None


def _patience(task: Task, engine: Engine, candidates: list[Engine], left: float | None) -> float | None:
    """Seconds for this engine: all that is left for the last one, but never without end outside Python."""
    if engine is not candidates[-1]:
        patience = _PATIENCE[engine.name]
        if candidates[:2] == [flint, msolve] and engine is flint:
            patience = _FLINT_BEFORE_MSOLVE
        return min(patience, float("inf") if left is None else left / 2)
    if left is not None or engine.name in ("flint", "sympy"):
        return None
    return _LAST_PATIENCE if task.kind == "groebner" else _DECOMPOSITION_PATIENCE


def _run(engine: Engine, task: Task, budget: Budget) -> EngineAnswer:
    """The engine's answer; a second try where its process was killed from outside."""
    progress.report("engine", f"{task.kind} of {len(task.generators)} polynomials by {engine.name}")
    try:
        return engine.run(task, budget)
    except EngineFailure as failure:
        log.debug("%s", failure)
        return engine.run(task, budget)


def _checked(task: Task, answer: EngineAnswer, seconds: float, budget: Budget) -> EngineAnswer:
    """The answer, which took so many seconds, with a lower certainty where a check could not be made."""
    if task.characteristic:
        return answer
    if task.kind != "groebner":
        certainty = checks.check_ideals(task, answer, lambda t: solve(t, budget))
        return replace(answer, certainty=certainty)
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
        exact = over_rationals(task, seconds, _is_short(answer.ideals[0]), budget)
        if exact is not None:
            if set(exact) != set(answer.ideals[0]):
                raise EngineFailure(answer.engine, "returned a wrong basis: it differs from that over Q")
            return replace(answer, certainty="proven")
    compared = checks.compare_modulo_prime(task, answer, lambda t: _second_opinion(t, answer.engine, budget))
    return answer if complete and compared else replace(answer, certainty="modular")


def over_rationals(
    task: Task, seconds: float, short: bool, budget: Budget | None = None
) -> tuple[Polynomial, ...] | None:
    """The basis by an engine that computes over Q, as msolve's word rests on primes; None where it is slow.

    seconds: how long the answer took modulo primes; short: whether that is short.
    """
    engine: Engine = singular if has(singular.name) else flint
    if not has(engine.name):
        return None
    kind = "slim" if short and engine is singular else "groebner"
    usual = _SHORT_PROOF if short else min(max(_PROOF_FACTOR * seconds, _LEAST_PROOF), _MOST_PROOF)
    try:
        return engine.run(replace(task, kind=kind), current(budget).part(usual * proof_patience())).ideals[0]
    except (EngineFailure, BudgetExceeded) as failure:
        log.debug("no proof: %s", failure)
        return None


def _is_short(basis: Sequence[Polynomial]) -> bool:
    return sum(map(len, basis)) <= _FEW_TERMS and all(
        c.p.bit_length() <= _FEW_BITS for p in basis for c in p.value.coeffs()
    )


def _second_opinion(task: Task, asked: str, budget: Budget) -> EngineAnswer | None:
    """The same task by another engine if there is one, else by the same engine once more."""
    others: tuple[Engine, ...] = (msolve, singular)
    order = sorted(others, key=lambda e: e.name == asked)
    for engine in order:
        if engine.can(task) and engine.available():
            try:
                return engine.run(task, budget.part(_CHECK_SECONDS))
            except (EngineFailure, BudgetExceeded) as failure:
                log.debug("no second opinion: %s", failure)
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
    """Bring Singular and msolve into the running environment with pip, without their dependencies.

    Raises `RuntimeError` with what pip said.  There are no wheels for Windows.
    """
    if sys.platform == "win32":
        raise RuntimeError("no wheels of Singular and msolve for Windows: work without them")
    command = [sys.executable, "-m", "pip", "install", "--no-deps", *PACKAGES]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(command[1:])} failed:\n{done.stderr.strip() or done.stdout.strip()}")
