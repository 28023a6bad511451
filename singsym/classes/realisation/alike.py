"""Strata that are one up to the names of variables, as those of legs that are alike: realised once.

Lemma.  A renaming of the variables that carries the equations and conditions of one set over to those of
another carries its real points over: both have the same dimension, and as many points and components.
Source: singsym's own; the renamings are found and checked by `polynomials.renamings`.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain

from singsym.classes.realisation.realisation import Realised, RealTask, examined, images
from singsym.classes.running.runner import Runner
from singsym.classes.strata.branches import Found
from singsym.effort.budget import Budget
from singsym.polynomials.renamings import Group, Likeness


@dataclass(frozen=True)
class AlikeTask:
    """A stratum to be realised, and others with the pairs of names that carry it over to each of them."""

    first: RealTask
    others: tuple[tuple[Found, tuple[tuple[str, str], ...]], ...] = ()

    def unfinished(self, reason: str) -> RealisedAlike:
        """All of them undecided, for this reason."""
        tasks = (self.first, *(replace(self.first, found=found) for found, _ in self.others))
        return RealisedAlike(tuple(task.unfinished(reason) for task in tasks))


@dataclass(frozen=True)
class RealisedAlike:
    """What strata that are alike come to, in their order."""

    parts: tuple[Realised, ...]

    @property
    def provisional(self) -> bool:
        """Whether a larger budget could say more."""
        return any(part.provisional for part in self.parts)


def realise_alike(task: AlikeTask) -> RealisedAlike:
    """The real side of strata that are alike: the task that workers run."""
    piece, points = examined(task.first)
    parts = [images(piece, points, task.first)]
    for found, names in task.others:
        stratum = found.stratum
        own = replace(
            piece,
            path=found.path,
            basis=stratum.equations,
            exclusions=stratum.loci,
            defects=stratum.defects,
        )
        there = tuple(point.rename(dict(names)) for point in points)
        parts.append(images(own, there, replace(task.first, found=found)))
    return RealisedAlike(tuple(parts))


def realise_all(
    runner: Runner,
    tasks: Sequence[RealTask],
    stage: str,
    budget: Budget,
    seen: Callable[[Realised], None] | None = None,
) -> list[Realised]:
    """All strata realised, in their order; those that are alike once.

    seen: called with what each stratum comes to, as it comes.
    """
    groups = list(together(tasks))

    def each(found: RealisedAlike) -> None:
        for part in found.parts:
            if seen is not None:
                seen(part)

    found = runner.map(realise_alike, [task for task, _ in groups], stage, budget, each)
    places = chain.from_iterable(places for _, places in groups)
    parts = dict(zip(places, chain.from_iterable(f.parts for f in found), strict=True))
    return [parts[k] for k in range(len(tasks))]


def together(tasks: Sequence[RealTask]) -> Iterator[tuple[AlikeTask, tuple[int, ...]]]:
    """Tasks with those that are alike, and the places of all of these, in the order of the first ones."""
    if not tasks:
        return
    likeness = Likeness(tasks[0].feasible.ring)
    families = [_family(task) for task in tasks]
    marks: dict[Hashable, list[int]] = {}
    for k, (task, family) in enumerate(zip(tasks, families, strict=True)):
        mark = likeness.mark(family)
        asked = task.seconds, task.memory_mb, task.most, task.known, task.seen
        marks.setdefault((k,) if mark is None else (mark, asked), []).append(k)
    done: set[int] = set()
    for places in sorted(marks.values()):
        for first in places:
            if first in done:
                continue
            done.add(first)
            own, others = [first], list[tuple[Found, tuple[tuple[str, str], ...]]]()
            for k in places:
                names = None if k in done else likeness.renaming(families[first], families[k])
                if names is not None:
                    done.add(k)
                    own.append(k)
                    others.append((tasks[k].found, tuple(names.items())))
            yield AlikeTask(tasks[first], tuple(others)), tuple(own)


def _family(task: RealTask) -> list[Group]:
    """All that the real side of a stratum, and of its images, depends on."""
    stratum, feasible = task.found.stratum, task.feasible
    gen = feasible.ring.gen
    family = [
        Group("equations", stratum.equations),
        Group("positive", feasible.positive, signed=True),
        Group("nonnegative", feasible.nonnegative, signed=True),
        *(Group("exclusion", group) for group in (*feasible.exclusions, *stratum.loci)),
        *(Group("elsewhere", locus) for locus in stratum.elsewhere),
        *(Group("image", tuple(map(gen, reflection))) for reflection in task.found.images),
    ]
    if stratum.component is not None:
        component = stratum.component
        label = f"component {component.dimension} {component.prime} {component.purity}"
        family.append(Group(label, component.generators))
    return family
