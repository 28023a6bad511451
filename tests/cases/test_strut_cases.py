"""A leg between two spherical joints whose length may be zero, though something is said of it.

A body turns about the z axis through O and carries B at (cos, sin, 0); a leg S-P-S, the input, goes from
A = (1, 0, 0) to B, so that d = |AB| and B = A + d u with a unit vector u, of either sign.
"""

from __future__ import annotations

import pytest

from singsym.classes.classify import classify
from singsym.classes.taxonomy.types import SingularityType as T
from singsym.mechanism import loads

LEG = """
name = "leg"
space = "spatial"
inputs = ["P"]
output = {{ rate = "O" }}
[links]
ground = {{ points = {{ O = [0, 0, 0], A = [1, 0, 0], C = [5, 0, 0] }}, axes = {{ O = [0, 0, 1] }} }}
body = {{ points = {{ O = [0, 0, 0], B = [1, 0, 0] }}, axes = {{ O = [0, 0, 1] }} }}
lower = {{ points = {{ A = [0, 0, 0], K = [0, 0, -2] }}, axes = {{ u = [0, 0, 1] }} }}
upper = {{ points = {{ B = [0, 0, 0] }}, axes = {{ u = [0, 0, 1] }} }}
[joints]
O = "R"
A = "S"
P = {{ type = "P", links = ["lower", "upper"], at = ["{at}", "B"], axis = "u" }}
B = "S"
{more}
"""


@pytest.mark.parametrize(
    ("at", "more", "dead_centres"),
    [
        ("A", "", 2),
        ("A", '[exclusions]\n"two points of the ground" = { coincide = ["A", "C"] }', 2),
        ("K", '[limits]\n"length(P)" = ["1/2", 20]', 1),
    ],
    ids=["nothing is said", "A is off C", "the slide is longer than the leg"],
)
def test_a_leg_of_length_zero(at: str, more: str, dead_centres: int) -> None:
    """An exclusion of A = C says nothing of AB, and from K the slide has the length d + 2, at d = 0 allowed.

    Where B is opposite A, d = 2 or -2, the leg is in line with O and B moves across it: (RO, II); d = -2 is
    a slide of length 0 from K.  Where B = A, d = 0, the velocity of B, along y, is the slide's along u.  With
    u = y or -y they go together and the leg's two rotations come on top: delta = p = 2, (RPM, IIM).  With any
    other u body and slide stand still and the rotations are all there is: p = k_I = k_O = 2, delta = 1.
    """
    result = classify(loads(LEG.format(at=at, more=more)), cache=False)
    assert not result.undecided
    found = {c.types: (c.dimension, c.points) for c in result.classes if c.verdict.is_yes}
    assert found == {
        T.RO | T.II: (0, dead_centres),
        T.RPM | T.IIM: (0, 2),
        T.RPM | T.II | T.IO | T.IIM: (2, None),
    }
