"""msolve, one subprocess a task: Groebner bases, elimination, points of zero-dimensional systems.

Source: J. Berthomieu, C. Eder, M. Safey El Din, msolve: a library for solving polynomial systems, ISSAC 2021.
"""

from __future__ import annotations

import re
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from singsym.effort.budget import Budget, current
from singsym.elimination.engines.base import (
    EngineAnswer,
    EngineFailure,
    EngineUnavailable,
    NotZeroDimensional,
    Task,
)
from singsym.elimination.engines.discovery import HOW_TO_GET, find_program, output_of
from singsym.elimination.engines.process import Child
from singsym.elimination.engines.text import read, used_variables, write
from singsym.polynomials import Polynomial, Ring

_TOKEN = re.compile(r"\s*([\[\],:]|-?\d+)")


@dataclass(frozen=True)
class RawParametrization:
    """Solutions as msolve prints them: x_i = -numerators[i] / (divisors[i] denominator) at minimal(t) = 0.

    order: the places of the variables in msolve's order; t is the last variable, which then has no numerator,
    or a further one, and then sum form_i x_i is t up to sign.  Coefficients start with the constant one.
    """

    order: tuple[int, ...]
    form: tuple[int, ...]
    minimal: tuple[int, ...]
    denominator: tuple[int, ...]
    numerators: tuple[tuple[int, ...], ...]
    divisors: tuple[int, ...]


class MsolveEngine:
    """Big Groebner bases, and the default for real solving; its answers over Q are multi-modular."""

    name = "msolve"

    def available(self) -> bool:
        return bool(self.path())

    def can(self, task: Task) -> bool:
        return task.kind in ("groebner", "eliminate") and task.ring.order == "degrevlex"

    def run(self, task: Task, budget: Budget) -> EngineAnswer:
        """The reduced Groebner basis, or that of the elimination ideal."""
        generators = [p for p in task.generators if p]
        used = used_variables(generators)
        eliminated = [task.ring.index(v.variables[0]) for v in task.others]
        to_eliminate = [i for i in used if i in eliminated]
        used = (*to_eliminate, *(i for i in used if i not in eliminated))
        if not used or len(to_eliminate) == len(used):
            unit = not used and bool(generators)
            return EngineAnswer(((task.ring.one,) if unit else (),), self.name)
        options = ["-g", "2", *(["-e", str(len(to_eliminate))] if to_eliminate else [])]
        text = self._call(generators, used, options, budget, task.characteristic)
        match = re.fullmatch(r"((?:#.*\n)*)\[(.*)\]:\s*", text, re.DOTALL)
        shown = used[len(to_eliminate) :] if to_eliminate else used
        if match is None:
            raise EngineFailure(self.name, f"printed no basis: {text[:200]!r}")
        if f"#variable order:       {', '.join(f'x{used.index(i) + 1}' for i in shown)}\n" not in match[1]:
            raise EngineFailure(self.name, "changed the order of the variables")
        try:
            basis = [read(piece, task.ring, used) for piece in match[2].split(",") if piece.strip()]
        except ValueError as error:
            raise EngineFailure(self.name, str(error)) from None
        return EngineAnswer((tuple(p.primitive() for p in basis if p),), self.name, "modular")

    def parametrization(
        self, equations: Sequence[Polynomial], ring: Ring, *, budget: Budget | None = None
    ) -> RawParametrization | None:
        """All complex solutions as functions of the roots of one polynomial; `None` where there are none.

        Raises `NotZeroDimensional`, `EngineFailure`, `BudgetExceeded`.  The answer is unchecked, and complete
        on msolve's word ("no solution" rests on one prime): compare it with a count, or prove it apart.
        """
        generators = [p for p in equations if p]
        missing = set(ring.names) - {name for p in generators for name in p.variables}
        if any(p.is_constant for p in generators):
            return None
        if missing:
            raise NotZeroDimensional(f"{', '.join(sorted(missing))} in no equation")
        text = self._call(generators, range(len(ring.names)), ["-P", "2"], current(budget))
        return _read_parametrization(text)

    def _call(
        self,
        generators: Sequence[Polynomial],
        used: Sequence[int],
        options: Sequence[str],
        budget: Budget,
        characteristic: int = 0,
    ) -> str:
        if not self.available():
            raise EngineUnavailable(f"msolve is not there: {HOW_TO_GET}")
        budget.ask("msolve")
        header = ",".join(f"x{k}" for k in range(1, len(used) + 1))
        lines = ",\n".join(write(p, used, characteristic) for p in generators)
        try:
            return self._conversation(f"{header}\n{characteristic}\n{lines}\n", options, budget)
        except (OSError, UnicodeError) as error:
            raise EngineFailure(self.name, f"files could not be written or read: {error}") from None

    def _conversation(self, text: str, options: Sequence[str], budget: Budget) -> str:
        """What the program writes about a text."""
        with tempfile.TemporaryDirectory(prefix="singsym-") as directory:
            source, target = Path(directory, "in.ms"), Path(directory, "out.ms")
            source.write_text(text)
            command = [self.path(), "-f", str(source), "-o", str(target), *options]
            child = Child(self.name, command)
            child.end_input()
            child.wait_exit(budget)
            if not target.exists():
                raise EngineFailure(self.name, "wrote no answer")
            return target.read_text()

    def version(self) -> str:
        program = self.path()
        if not program:
            return ""
        return output_of([program, "-V"]).strip() or "unknown"

    def path(self) -> str:
        return find_program("msolve", "SINGSYM_MSOLVE")

    def cite(self) -> str:
        return (
            "J. Berthomieu, C. Eder, M. Safey El Din, msolve: a library for solving polynomial systems, "
            "ISSAC 2021, 51-58, https://doi.org/10.1145/3452143.3465545"
        )

    def close(self) -> None:
        """Nothing to end: each task has its own process."""


def _tree(text: str) -> list[object]:
    """The nested lists of msolve's output, numbers as text."""
    stack: list[list[object]] = [[]]
    position = 0
    while position < len(text.rstrip()):
        match = _TOKEN.match(text, position)
        if match is None:
            raise EngineFailure("msolve", f"printed rubbish: {text[position : position + 40]!r}")
        position, token = match.end(), match[1]
        if token == "[":
            stack.append([])
        elif token == "]":
            if len(stack) < 2:
                raise EngineFailure("msolve", "printed unbalanced brackets")
            done = stack.pop()
            stack[-1].append(done)
        elif token not in ",:":
            stack[-1].append(token)
    if len(stack) != 1 or len(stack[0]) != 1:
        raise EngineFailure("msolve", "printed half an answer")
    top = stack[0][0]
    if not isinstance(top, list) or not top:
        raise EngineFailure("msolve", f"printed {text[:80]!r}")
    return top


def _read_parametrization(text: str) -> RawParametrization | None:
    names = re.findall(r"'([^']*)'", text)
    match _tree(re.sub(r"'[^']*'", "0", text)):
        case ["-1"]:
            return None
        case ["1", _, "-1", []]:
            raise NotZeroDimensional("infinitely many complex solutions")
        case ["0", ["0", _, _, _, [*form], ["1", [[_, [*minimal]], [_, [*denominator]], [*rest]]]]]:
            pass
        case _:
            raise EngineFailure("msolve", f"printed no parametrisation: {text[:80]!r}")
    numerators, divisors = [], []
    for entry in rest:
        match entry:
            case [[_, [*numerator]], divisor]:
                numerators.append(_integers(numerator))
                divisors.append(_integer(divisor))
            case _:
                raise EngineFailure("msolve", "printed a coordinate that is no polynomial")
    order = tuple(int(n[1:]) - 1 for n in names if re.fullmatch(r"x\d+", n))
    return RawParametrization(
        order, _integers(form), _integers(minimal), _integers(denominator), tuple(numerators), tuple(divisors)
    )


def _integers(entries: Sequence[object]) -> tuple[int, ...]:
    return tuple(map(_integer, entries))


def _integer(entry: object) -> int:
    if not isinstance(entry, str):
        raise EngineFailure("msolve", "printed a list where a number is expected")
    return int(entry)
