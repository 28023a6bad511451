"""Classifications at chosen values of parameters, side by side: the cells' samples, and sweeps.

Source: singsym's own.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

from singsym.classes.classify import Limits, classify_inside
from singsym.classes.result import Classification
from singsym.classes.running.disk_cache import user_cache
from singsym.classes.running.runner import Runner, running
from singsym.classes.unit_border import Border
from singsym.effort.budget import Budget
from singsym.effort.progress import Sink, to
from singsym.mechanism.checks import check
from singsym.mechanism.model import Mechanism
from singsym.mechanism.problems import MechanismError

_MUCH_MORE = 1.5
"""A sample that is open is asked again for so many times as long."""


@dataclass(frozen=True)
class Sampled:
    """A classification, or the reason why there is none."""

    classification: Classification | None
    reason: str = ""

    @property
    def provisional(self) -> bool:
        """Whether more time could say more."""
        return self.classification is None or self.classification.undecided


@dataclass(frozen=True)
class Sample:
    """A mechanism to be classified."""

    mechanism: Mechanism
    formulation: str
    limits: Limits
    cache: bool

    def unfinished(self, reason: str) -> Sampled:
        """No classification, for this reason."""
        return Sampled(None, reason)


def sampled(sample: Sample) -> Sampled:
    """The task that workers run, which start no processes of their own."""
    border = Border.of(sample.mechanism, sample.formulation)
    runner = Runner(cache=user_cache() if sample.cache else None)
    found = border.classification(classify_inside(sample.mechanism, border, runner, sample.limits))
    return Sampled(found)


def at_samples(
    mechanism: Mechanism,
    values: Sequence[Mapping[str, Any]],
    formulation: str,
    limits: Limits,
    workers: int,
    executor: Executor | None,
    cache: bool,
) -> list[Sampled]:
    """The classifications at values of the parameters, in their order; they share the limits' clock.

    Each has an equal share at first.  What some leave over is for those that are open: they are asked once
    more, as long as that gives them much more than they had.
    """
    chosen = [mechanism.with_parameters(**own) for own in values]
    found, open_, had, whole = dict[int, Sampled](), list(range(len(chosen))), 0.0, Budget(limits.clock)
    with running(workers, executor, limits.clock, False) as runner:
        while open_ and not runner.interrupted:
            left = whole.time_left()
            share = None if left is None else left * workers / max(workers, len(open_))
            if found and (share is None or share < _MUCH_MORE * had):
                break
            each = replace(limits, clock=share)
            tasks = [Sample(chosen[i], formulation, each, cache) for i in open_]
            for i, own in zip(open_, runner.map(sampled, tasks, "samples", Budget(left)), strict=True):
                if own.classification is not None or i not in found:
                    found[i] = own
            open_, had = [i for i in open_ if found[i].provisional], share or 0.0
    return [found[i] for i in range(len(chosen))]


def sweep(
    mechanism: Mechanism,
    values: Mapping[str, Sequence[Any]],
    *,
    formulation: str = "auto",
    workers: int = 1,
    executor: Executor | None = None,
    limits: Limits | None = None,
    cache: bool = True,
    progress: Sink | None = None,
) -> list[dict[str, Any]]:
    """The class tables at all combinations of chosen values, as rows for `pandas.DataFrame`.

    values: for each parameter those to take, as for `Mechanism.with_parameters`.  A row has the parameters,
    and `class`, `types`, `verdict`, `certainty`, `dimension`, `points`, `components` of a class that is not
    proven empty; a sample of which nothing is there, or that came to no end, has one row.  Nothing is said
    of values between the samples.  workers, executor, limits, cache, progress: as for `classify`.
    Raises `MechanismError` for an unknown parameter, or for values outside its range.

    >>> from singsym.mechanism import load
    >>> rows = sweep(load("fourbar"), {"a": [1, 3]}, cache=False)
    >>> [(row["a"], row["types"], row["points"]) for row in rows]
    [('1', 'RI, IO', 4), ('3', 'RI, IO', 2), ('3', 'RO, II', 2)]
    """
    names = tuple(values)
    combinations = [dict(zip(names, own, strict=True)) for own in product(*values.values())]
    # what cannot be put together has a row
    problems = (p for own in combinations for p in check(mechanism.with_parameters(**own)))
    if wrong := dict.fromkeys(p for p in problems if p.place.startswith("parameters.")):
        raise MechanismError(wrong)
    with to(progress):
        found = at_samples(mechanism, combinations, formulation, limits or Limits(), workers, executor, cache)
    return [
        row
        for own, one in zip(combinations, found, strict=True)
        for row in class_rows({name: str(value) for name, value in own.items()}, one)
    ]


def class_rows(values: Mapping[str, str], found: Sampled) -> list[dict[str, Any]]:
    """A row for each class that is not proven empty, one without a class where there is none."""
    empty = dict.fromkeys(("class", "types", "dimension", "points", "components"))
    if found.classification is None:
        return [{**values, **empty, "verdict": "undecided", "certainty": "undecided", "reason": found.reason}]
    kept = ("class", "types", "verdict", "certainty", "dimension", "points", "components", "reason")
    rows = [row for row in found.classification.table() if row["verdict"] != "no"]
    if not rows:
        return [{**values, **empty, "verdict": "no", "certainty": "proven", "reason": "no class occurs"}]
    return [{**values, **{name: row[name] for name in kept}} for row in rows]
