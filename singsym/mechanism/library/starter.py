"""The commented file that `singsym new NAME` writes: a four-bar linkage that checks and classifies as it is.

Source: singsym's own format.
"""

from __future__ import annotations

_TEXT = """\
# A mechanism for singsym.  Lines that start with # are comments; those after a key show more.
name = "@NAME@"
title = "Four-bar linkage"
source = ""                    # where it is published
space = "planar"               # planar, spherical or spatial
ground = "ground"              # the link that stands still
# formulation = "auto"         # or planar, spherical, joint (serial arms), natural (spatial)
# translating = ["BC"]         # only the mode in which these links keep their orientation

# Inputs are joints by name; a joint with two or three freedoms by name and freedom, as P.slide.
inputs = ["A"]

# As many outputs as inputs: one table, or a list of tables.
output = { rate = "D" }
# output = { velocity = "B" }                               # of a point; components = ["x"] for one
# output = { twist = "BC", at = "B", components = ["w"] }   # of w vx vy; spatial: wx wy wz vx vy vz
# output = [{ rate = "D" }, { velocity = "B", components = ["y"] }]

# Numbers are exact: 7/2, 3.5 and sqrt(3)/2 are what they spell; sin and cos take 40 deg or pi/3.
# Write everything but plain numbers in quotes.
[parameters]
l = 1
# a = { between = ["2/sqrt(3)*l", "2*l"] }                        # stays symbolic
# b = { value = "3/2", above = 0 }

[links]
ground = { points = { A = [0, 0], D = ["4*l", 0] } }              # named points in the link's own frame
AB = "l"                                                          # a link of length l from point A to point B
BC = "7/2"
CD = 3
# plate = { sides = { BC = 3, CE = 4, EB = 5 } }                  # a triangle by its sides
# slider = { points = { C = [0, 0] }, axes = { x = [1, 0] } }     # axes are unit vectors
# arm = { points = { A0 = [0, 0, 0], A = ["l", 0, 0] }, axes = { z = [0, 0, 1] } }   # in space

# A joint "A" joins the links that have a point A, unless links = [...] says which.  Three or more links on
# one pin become joints A1, A2, ... in that order.  Types: R P H C U S E.
[joints]
A = "R"
B = "R"
C = "R"
D = "R"
# P = { type = "P", links = ["ground", "slider"], at = ["A", "C"], axis = "x" }   # C slides along x through A
# U = { type = "U", links = ["arm", "fork"], at = "A", axis = ["u", "v"] }        # u in arm, v in fork

# [limits]
# "cos(A)" = { min = 0 }              # also sin(A), length(P), coordinates as C.x, in any polynomial
# "angle(A)" = [-90, 120]             # degrees; angle 0 is where the frames of both links are parallel

# [exclusions]                        # configurations to leave out
# "leg folded" = { coincide = ["A", "C"] }

# [couplings]                         # gears, belts, differentials: sums of multiples of rates that are 0
# gears = { rates = { A = 3, D = 2 } }                          # D turns against A, 3/2 as fast
# belt = { rates = { A = 1, D = "-1/2" }, constant = "30 deg" } # for the joints' values A - D/2 = 30 deg
# rack = { rates = { P = 1, A = "1/2" } }                       # a pinion of radius 1/2, mounted anyhow
# cam = { follower = "P", lift = "3 + cos(A)" }                 # the slide P follows a cam on A: its length

# A serial arm needs no links and joints:
# [dh]
# convention = "standard"             # or modified
# rows = [ { joint = "R", a = 0, alpha = "90 deg", d = 1, theta = 0 } ]
"""


def starter(name: str) -> str:
    """The text of a new mechanism file; raises `ValueError` where the name is no file name.

    >>> from singsym.mechanism import loads
    >>> loads(starter("mine"))
    Mechanism('mine', 4 links, 4 joints)
    """
    if (
        not name
        or not all(c.isalnum() or c in "-_. " for c in name)
        or len(name) > 100
        or name.startswith(".")
    ):
        raise ValueError(f"found the name {name[:60]!r}; expected letters, digits, - and _")
    return _TEXT.replace("@NAME@", name)
