"""What a computation asks and does, counted from outside: functions are wrapped where they are looked up."""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from functools import wraps
from typing import Any
from unittest.mock import patch

from singsym.elimination.engines.flint_engine import FlintEngine
from singsym.elimination.engines.msolve import MsolveEngine
from singsym.elimination.engines.singular import SingularEngine
from singsym.elimination.engines.sympy_engine import SympyEngine
from singsym.polynomials.compiled_map import CompiledMap
from singsym.varieties.real.curves import tracking, tubes
from singsym.varieties.real.points import boxed_point, intervals

NEWTON, BOXES = "Newton steps", "boxes"
ENGINES = ("flint", "msolve", "singular", "sympy")


@contextmanager
def counted() -> Iterator[Counter[str]]:
    """What the work inside does in this process.

    Of each engine the tasks that it begins; Newton steps, of each point for itself: evaluations of values
    with their slopes, corrections onto curves, and steps in balls; boxes: Krawczyk tests of points, and tubes
    about segments of curves.
    """
    counts: Counter[str] = Counter()
    with ExitStack() as stack:

        def watch(home: Any, name: str, what: str, number: Callable[..., int]) -> None:
            noting = _counting(vars(home)[name], counts, what, number)
            for place in _places(home, name):
                stack.enter_context(patch.object(place, name, noting))

        for engine in (FlintEngine, MsolveEngine, SingularEngine, SympyEngine):
            watch(engine, "run", engine.name, _one)
        watch(MsolveEngine, "parametrization", MsolveEngine.name, _one)
        watch(CompiledMap, "__call__", NEWTON, lambda own, points: points.size // own.size if own.size else 1)
        watch(tracking, "_solve", NEWTON, lambda system, points, *rest: len(points))
        watch(boxed_point, "_newton_step", NEWTON, _one)
        watch(intervals, "krawczyk", BOXES, _one)
        watch(tubes, "prove_tubes", BOXES, lambda system, start, end: len(start))
        yield counts


def _one(*given: Any, **named: Any) -> int:
    return 1


def _places(home: Any, name: str) -> list[Any]:
    """Where a function is looked up: its home, and the modules that imported it by name."""
    function = getattr(home, name)
    modules = [m for n, m in sys.modules.items() if n.partition(".")[0] == "singsym" and m is not home]
    return [home, *(m for m in modules if vars(m).get(name) is function)]


def _counting(
    function: Callable[..., Any], counts: Counter[str], what: str, number: Callable[..., int]
) -> Callable[..., Any]:
    """The function, that notes how often it is called."""

    @wraps(function)
    def noting(*given: Any, **named: Any) -> Any:
        counts[what] += number(*given, **named)
        return function(*given, **named)

    return noting
