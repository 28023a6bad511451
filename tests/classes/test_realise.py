"""Configurations as decimals: angles of pi are pi, and the error bound is small."""

from __future__ import annotations

from math import isclose, pi

from singsym.classes.classify import classify
from singsym.classes.types import SingularityType as T
from singsym.mechanism import load


def test_an_extended_joint_has_its_angle_and_a_small_error() -> None:
    """Where A, B, C are in line with B between, B is straight; with B outside it is folded by pi."""
    dead = classify(load("slider-crank"), cache=False).of(T.RI | T.IO)
    assert len(dead.witnesses) == 2
    for witness in dead.witnesses:
        assert float(witness.radius) < 1e-12
    bends = sorted(abs(float(w.joints["B"])) for w in dead.witnesses)
    assert bends[0] == 0
    assert isclose(bends[1], pi, rel_tol=1e-12)
