"""Strata that are one up to the names of variables are realised once, others by themselves."""

from __future__ import annotations

from dataclasses import replace

import pytest

from singsym.classes.realisation import alike
from singsym.classes.realisation.alike import AlikeTask, realise_alike, realise_all, together
from singsym.classes.realisation.certified_configuration import Names
from singsym.classes.realisation.realisation import RealTask
from singsym.classes.running.runner import Runner
from singsym.classes.strata.branches import Found
from singsym.classes.strata.ranks import Stratum
from singsym.classes.taxonomy.types import Defects
from singsym.effort.budget import Budget
from singsym.polynomials import Equations, Ring
from singsym.varieties.real.system import RealSystem

R = Ring(("x", "y", "z"))
X, Y, Z = R.gens
PLACES = (X**2 - 2, Y - 3, Z - X), (Y**2 - 2, Z - 3, X - Y), (Z**2 - 2, X - 5, Y - Z)
"""Two coordinates are sqrt(2) or both -sqrt(2), and one is 3; in the last set it is 5."""


def task(equations: Equations, feasible: RealSystem) -> RealTask:
    return RealTask(Found((equations[0],), Stratum(equations, Defects(0, 0, 1, 0))), feasible, Names())


def test_what_is_alike_is_realised_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each comes to what it does by itself, in its own names."""
    tasks = [task(place, RealSystem(R, ())) for place in PLACES]
    alone = [realise_alike(AlikeTask(t)).parts[0] for t in tasks]
    asked, examined = [], alike.examined
    monkeypatch.setattr(alike, "examined", lambda t: (asked.append(t), examined(t))[1])
    found = realise_all(Runner(), tasks, "", Budget())
    assert len(asked) == 2
    for one, other in zip(found, alone, strict=True):
        (piece,), (known,) = one.pieces, other.pieces
        assert replace(piece, witnesses=()) == replace(known, witnesses=())
        floats = [sorted(tuple(w.floats().values()) for w in p.witnesses) for p in (piece, known)]
        assert floats[0] == [pytest.approx(point) for point in floats[1]]


def test_conditions_tell_sets_apart() -> None:
    """x -> y -> z -> x carries the first place over to the second one, but x > 0 over to y > 0.

    Where x and z may be exchanged, as y differs from both, what is left of it is alike."""
    signed = [task(place, RealSystem(R, (), positive=(X,))) for place in PLACES[:2]]
    assert [places for _, places in together(signed)] == [(0,), (1,)]
    off = RealSystem(R, (), exclusions=((X - Y,), (Y - Z,)))
    mirrored = (Z**2 - 2, Y - 3, X - Z), (X**2 - 2, Y - 3, X - Z)
    assert [places for _, places in together([task(place, off) for place in mirrored])] == [(0, 1)]
