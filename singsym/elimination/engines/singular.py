"""Singular, a persistent process on a pipe: elimination, saturation, decomposition, Groebner bases.

Source: W. Decker, G.-M. Greuel, G. Pfister, H. Schönemann, Singular (https://www.singular.uni-kl.de).
"""

from __future__ import annotations

import re
import threading
from collections.abc import Sequence
from itertools import count

from singsym.effort.budget import Budget
from singsym.elimination.engines.base import EngineAnswer, EngineFailure, EngineUnavailable, Task
from singsym.elimination.engines.discovery import HOW_TO_GET, find_program, output_of
from singsym.elimination.engines.process import Child
from singsym.elimination.engines.text import read, used_variables, write
from singsym.polynomials import Polynomial

_ORDERS = {"degrevlex": "dp", "lex": "lp", "deglex": "Dp"}

# `singsym_i` are the generators, `singsym_j` the others; the answer is a list of ideals `singsym_a`
_COMMANDS = {
    "groebner": ("", "list singsym_a = list(std(singsym_i));"),
    "slim": ("", "list singsym_a = list(slimgb(singsym_i));"),
    "eliminate": ("", "list singsym_a = list(eliminate(singsym_i, singsym_p));"),
    "saturate": (
        'LIB "elim.lib";',
        "ideal singsym_s = singsym_i; int singsym_k;"
        "for (singsym_k = 1; singsym_k <= ncols(singsym_j); singsym_k++)"
        "{ singsym_s = singsym_sat(singsym_s, singsym_j[singsym_k]); }"
        "list singsym_a = list(singsym_s);",
    ),
    "facstd": ("", "list singsym_a = facstd(singsym_i);"),
    "minimal_primes": (
        'LIB "primdec.lib";',
        "list singsym_a; if (dim(std(singsym_i)) == 0) { singsym_a = minAssGTZ(singsym_i); }"
        "else { singsym_a = minAssChar(singsym_i); }",
    ),
}
_SHOW = (
    "proc singsym_show(list a) { int i, k; ideal g; for (i = 1; i <= size(a); i++) { g = a[i]; "
    'print("I"); for (k = 1; k <= ncols(g); k++) { print("P " + string(g[k])); } } }\n'
    # `sat` is a kernel command that returns an ideal, but was a library procedure that returns a list
    "proc singsym_sat(ideal i, poly p) { def s = sat(i, ideal(p)); ideal r = i;"
    ' if (typeof(s) == "list") { r = s[1]; } else { r = s; } return(r); }\n'
)


class SingularEngine:
    """Elimination, saturation and decompositions; one process is kept, and started again after failures."""

    name = "singular"

    def __init__(self) -> None:
        self.start_afresh()

    def start_afresh(self) -> None:
        """Know of no process."""
        self._child: Child | None = None
        self._program = ""
        self._loaded: set[str] = set()
        self._lock = threading.Lock()
        self._numbers = count(1)

    def available(self) -> bool:
        return bool(self.path())

    def can(self, task: Task) -> bool:
        return task.kind in _COMMANDS and task.ring.order in _ORDERS

    def run(self, task: Task, budget: Budget) -> EngineAnswer:
        """The ideals that Singular prints; every task has a ring of its own."""
        used = used_variables(task.generators, task.others)
        if not used:
            raise EngineFailure(self.name, "was asked about constants")
        budget.ask("Singular")
        library, command = _COMMANDS[task.kind]
        with self._lock:
            lines = self._converse(library, self._program_text(task, used, command), budget)
        ideals: list[list[Polynomial]] = []
        try:
            for line in lines:
                if line == "I":
                    ideals.append([])
                elif line.startswith("P ") and ideals:
                    ideals[-1].append(read(line[2:], task.ring, used))
                else:
                    raise ValueError(f"unexpected line {line[:80]!r}")
        except ValueError as error:
            self.close()
            raise EngineFailure(self.name, str(error)) from None
        answer = tuple(tuple(p.primitive() for p in ideal if p) for ideal in ideals)
        return EngineAnswer(answer, self.name)

    def _program_text(self, task: Task, used: Sequence[int], command: str) -> str:
        variables = ",".join(f"x{k}" for k in range(1, len(used) + 1))
        product = "*".join(write(v, used).removeprefix("1*") for v in task.others)
        second = f"poly singsym_p = {product};" if task.kind == "eliminate" else ""
        return (
            f"ring singsym_r = {task.characteristic},({variables}),{_ORDERS[task.ring.order]};\n"
            f"ideal singsym_i = {_listing(task.generators, used, task.characteristic)};\n"
            f"ideal singsym_j = {_listing(task.others, used)};\n{second}\n"
            f"{command}\nsingsym_show(singsym_a);\n"
            "kill singsym_r; if (defined(singsym_k)) { kill singsym_k; }\n"
        )

    def _converse(self, library: str, text: str, budget: Budget) -> list[str]:
        """Send a program, and return the lines that it prints before the sentinel."""
        child = self._running_child()
        mark = f"<singsym {next(self._numbers)}>"
        load = "" if library in self._loaded else library + "\n"
        child.send(f'{load}{text}print("{mark}");\n'.encode())
        ending = f"{mark}\n".encode()
        try:
            output = child.read_until(lambda b: _after(b, ending), budget).decode(errors="replace")
        except BaseException:
            self.close()
            raise
        lines = [line.rstrip() for line in output.removesuffix(ending.decode()).splitlines() if line.strip()]
        errors = [line for line in lines if re.match(r"\s*\?", line)]
        if errors:
            self.close()
            raise EngineFailure(self.name, "; ".join(line.strip(" ?") for line in errors[:2]))
        self._loaded.add(library)
        return [line for line in lines if not line.startswith("//")]

    def _running_child(self) -> Child:
        program = self.path()
        if not program:
            raise EngineUnavailable(f"Singular is not there: {HOW_TO_GET}")
        if self._child is None or not self._child.running or program != self._program:
            self.close()
            self._child = Child(self.name, [program, "-q", "--no-rc", "--no-warn", "--no-tty"])
            self._program = program
            self._child.send(f"short = 0; option(redSB); option(noredefine);\n{_SHOW}".encode())
        return self._child

    def version(self) -> str:
        program = self.path()
        if not program:
            return ""
        found = re.search(r"version (\d+[\d.]*)", output_of([program, "--version"]))
        return found[1] if found else "unknown"

    def path(self) -> str:
        return find_program("Singular", "SINGSYM_SINGULAR")

    def cite(self) -> str:
        return (
            "W. Decker, G.-M. Greuel, G. Pfister, H. Schönemann, Singular: a computer algebra system for "
            "polynomial computations, https://www.singular.uni-kl.de"
        )

    def close(self) -> None:
        if self._child is not None:
            self._child.kill()
        self._child = None
        self._loaded = set()


def _listing(polynomials: Sequence[Polynomial], used: Sequence[int], characteristic: int = 0) -> str:
    return ",\n".join(write(p, used, characteristic) for p in polynomials if p) or "0"


def _after(buffer: bytearray, ending: bytes) -> int:
    position = buffer.rfind(ending)
    return position + len(ending) if position >= 0 else -1
