"""Proven chains of arcs: tracks between marks, joined into loops and edges, each covered by proven tubes.

Source: the counting of half-edges: every mark on a smooth point has two, every gate one, and each is the end
of exactly one arc.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from singsym.effort.budget import Budget
from singsym.effort.progress import report
from singsym.varieties.real.curves.arithmetic import Array, Balls, System
from singsym.varieties.real.curves.tracking import Marks, Track, newton, track
from singsym.varieties.real.curves.tubes import Tubes, joined, location, prove_tubes

_HALVINGS = 14
_SEGMENTS = 40000


@dataclass(frozen=True, eq=False)
class Chain:
    """A loop through marks, or an edge from one end mark to another, as one polyline.

    marks: the numbers of the marks on it, in order (of an edge: with both ends).  `tubes` is empty where the
    chain is only drawn, not proven.
    """

    points: Array
    marks: tuple[int, ...]
    closed: bool
    tubes: Tubes | None = None


def pair_tracks(system: System, marks: Marks, lanes: np.ndarray, bend: float) -> dict[int, Track] | str:
    """For each of the half-edges the track that starts there; a reason where they do not pair up."""
    tracks = {t.start: t for t in track(system, marks, lanes, bend=bend)}
    lost = [int(k) for k in lanes if int(k) not in tracks]
    if lost:
        return f"tracking from {len(lost)} of {len(lanes)} starting directions did not arrive anywhere"
    if any(t.end not in tracks or tracks[t.end].end != k for k, t in tracks.items()):
        return "arcs tracked from both ends do not agree"
    return tracks


def chains(marks: Marks, tracks: dict[int, Track]) -> list[Chain]:
    """Loops and edges from arcs that pair up."""
    others: dict[int, list[int]] = {}
    for half, mark in enumerate(marks.owner):
        others.setdefault(int(mark), []).append(half)
    ends = [k for k in tracks if len(others[int(marks.owner[k])]) == 1]
    used: set[int] = set()
    found = []
    for start in [*ends, *tracks]:
        if start in used:
            continue
        pieces: list[Array] = []
        names, half = [int(marks.owner[start])], start
        while True:
            arc = tracks[half]
            used.update((half, arc.end))
            pieces.append(arc.points if not pieces else arc.points[1:])
            mark = int(marks.owner[arc.end])
            names.append(mark)
            following = [k for k in others[mark] if k != arc.end]
            if not following or following[0] == start:
                break
            half = following[0]
        closed = start not in ends
        found.append(Chain(np.concatenate(pieces), tuple(names[:-1] if closed else names), closed))
    return found


def prove_chains(system: System, found: list[Chain], budget: Budget) -> list[Chain] | str:
    """The same chains covered by proven tubes, with points put in where needed; a reason where it fails.

    Tubes that a chain has already are kept where they are proven.
    """
    polylines = [c.points for c in found]
    flags = [c.closed for c in found]
    known = [c.tubes for c in found]
    for round_ in range(_HALVINGS):
        budget.check("proof of the arcs of a curve")
        known = _prove_round(system, polylines, known)
        bad = [_unproven(t, closed) for t, closed in zip(known, flags, strict=True) if t is not None]
        count = sum(int(b.sum()) for b in bad)
        report("curve", "segments still to prove", done=count)
        if not count:
            return [Chain(p, c.marks, c.closed, t) for p, c, t in zip(polylines, found, known, strict=True)]
        if round_ == _HALVINGS - 1 or count > _SEGMENTS:
            break
        polylines, known = _halve(system, polylines, known, bad)
    return f"{count} segments of the curve could not be proven after {round_} halvings"


def _prove_round(system: System, polylines: list[Array], known: list[Tubes | None]) -> list[Tubes | None]:
    """Prove all segments that have no tubes yet, in one batch (rows of `known` with nan are to be done)."""
    todo, starts, stops = [], [], []
    for polyline, tubes in zip(polylines, known, strict=True):
        rows = np.arange(len(polyline) - 1) if tubes is None else np.flatnonzero(np.isnan(tubes.radius))
        todo.append(rows)
        starts.append(polyline[rows])
        stops.append(polyline[rows + 1])
    batch = prove_tubes(system, np.concatenate(starts), np.concatenate(stops))
    result: list[Tubes | None] = []
    offset = 0
    for rows, tubes in zip(todo, known, strict=True):
        part = batch.take(np.arange(offset, offset + len(rows)))
        offset += len(rows)
        result.append(part if tubes is None else tubes.replace(rows, part))
    return result


def _unproven(tubes: Tubes, closed: bool) -> np.ndarray:
    """The segments that are not proven or not joined to the next."""
    bad = ~tubes.proven
    count = len(tubes)
    before = np.arange(count if closed else count - 1)
    after = (before + 1) % count
    loose = ~joined(tubes.take(before), tubes.take(after))
    bad = bad.copy()
    bad[before[loose]] = True
    bad[after[loose]] = True
    return bad


def _halve(
    system: System, polylines: list[Array], known: list[Tubes | None], bad: list[np.ndarray]
) -> tuple[list[Array], list[Tubes | None]]:
    """Cut the bad segments in two at points of the curve."""
    starts = np.concatenate([p[:-1][b] for p, b in zip(polylines, bad, strict=True)])
    stops = np.concatenate([p[1:][b] for p, b in zip(polylines, bad, strict=True)])
    direction = stops - starts
    direction = direction / np.maximum(np.linalg.norm(direction, axis=1, keepdims=True), 1e-300)
    middle, _ = newton(system, (starts + stops) / 2, direction)
    offset = 0
    new_lines: list[Array] = []
    new_known: list[Tubes | None] = []
    for polyline, tubes, rows in zip(polylines, known, bad, strict=True):
        where = np.flatnonzero(rows)
        part = middle[offset : offset + len(where)]
        offset += len(where)
        new_lines.append(np.insert(polyline, where + 1, part, axis=0))
        new_known.append(None if tubes is None else tubes.split(where))
    return new_lines, new_known


def halved(system: System, chain: Chain, rows: np.ndarray) -> Chain:
    """A chain with the segments of some of its tubes cut in two, to be proven again."""
    (points,), (tubes,) = _halve(system, [chain.points], [chain.tubes], [rows])
    return replace(chain, points=points, tubes=tubes)


def contained(found: Sequence[Chain], points: Balls) -> tuple[np.ndarray, np.ndarray]:
    """For each ball and chain: is the exact point surely on the chain, surely not on it."""
    inside = np.zeros((len(points.mid), len(found)), dtype=bool)
    outside = np.ones_like(inside)
    for j, chain in enumerate(found):
        if chain.tubes is not None and len(points.mid):
            within, without = location(chain.tubes, points)
            inside[:, j] = within.any(axis=1)
            outside[:, j] = without.all(axis=1)
    return inside, outside
