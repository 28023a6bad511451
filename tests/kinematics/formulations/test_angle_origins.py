"""Angles that are counted inside from elsewhere than the joints' own zeros: links stand where they stood."""

from __future__ import annotations

from itertools import pairwise
from math import cos, sin
from random import Random

import numpy as np
import pytest
import sympy
from numpy.typing import NDArray

from singsym.kinematics.dimensions import dimensions
from singsym.kinematics.formulations.frames import Algebra, rigid
from singsym.kinematics.formulations.local import Geometry, Vector
from singsym.kinematics.formulations.tree import Step, grow, plan, spanning_steps
from singsym.mechanism.model import Joint, JointKind, JointRate, Link, Mechanism, Space
from singsym.polynomials import Polynomial

Floats = NDArray[np.float64]
O, I = sympy.S.Zero, sympy.S.One
HALF, ROOT2, ROOT3 = sympy.Rational(1, 2), sympy.sqrt(2) / 2, sympy.sqrt(3) / 2
AXES = [(O, O, I), (I, O, O), (ROOT3, HALF, O), (-ROOT3, -HALF, O), (HALF, O, ROOT3), (O, ROOT2, -ROOT2)]
POINTS = [(I, O, O), (O, I, O), (O, O, 2 * I), (HALF, ROOT3, O), (I, -2 * ROOT3, I), (O, O, O)]
ROOTS = {"sqrt2": 2**0.5, "sqrt3": 3**0.5, "sqrt6": 6**0.5}


def arm(random: Random) -> Mechanism:
    """Up to three links, hinged one on the other about axes askew, or on cylinders, either side first."""
    names = ["ground", *(f"link{k}" for k in range(1, random.randint(2, 4)))]
    links = [
        Link(
            name,
            {p: random.choice(POINTS) for p in ("from", "to", "tip")},
            {a: random.choice(AXES) for a in ("in", "out", "beside")},
        )
        for name in names
    ]
    joints = []
    for before, after in pairwise(names):
        kind = random.choice([JointKind.R, JointKind.R, JointKind.C])
        sides = [(before, "to", "out"), (after, "from", "in")]
        one, two = sides if random.random() < 0.7 else sides[::-1]
        joints.append(Joint(f"J{len(joints)}", kind, one[0], two[0], (one[1], two[1]), (one[2], two[2])))
    first = JointRate(joints[0].columns[0])
    return Mechanism("arm", Space.SPATIAL, "ground", tuple(links), tuple(joints), (first.column,), (first,))


def floats(vector: Vector) -> Floats:
    return np.array([float(x) for x in vector])


def relative(geometry: Geometry, joint: Joint, cosine: float, sine: float) -> Floats:
    """The second link's frame in the first's: Rodrigues' formula about the joint's axis after its zero."""
    a = floats(geometry.axis(joint.first, joint.axes[0] if joint.axes else ""))
    across = np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
    zero = np.array([[float(x) for x in row] for row in geometry.zero(joint)])
    return (np.eye(3) + sine * across + (1 - cosine) * across @ across) @ zero


@pytest.mark.parametrize("seed", range(15))
def test_links_are_where_the_joints_own_angles_say(seed: int) -> None:
    """By products of rotations and shifts along the chain, in floating point, from the joints' values."""
    random = Random(seed)
    mechanism = arm(random)
    geometry = Geometry(mechanism)
    steps = plan(mechanism, geometry, spanning_steps(mechanism), random.random() < 0.5)
    sized = dimensions(mechanism, [v for step in steps for v in step.variables])
    algebra = Algebra(sized.ring, sized.number)
    grown = grow(geometry, algebra, {"ground": rigid(algebra, algebra.origin, algebra.axes)}, steps)
    known = dict(ROOTS)
    for step in steps:
        for turn in step.turns:
            angle = random.uniform(-3, 3)
            known |= dict(zip(turn.variables, (cos(angle), sin(angle)), strict=True))
        known |= {length: random.uniform(-1, 1) for length in step.lengths}
    point = [known[name] for name in sized.ring.names]

    def value(p: Polynomial | None) -> float:
        assert p is not None
        powers = ((c, np.prod([x ** int(e) for x, e in zip(point, m, strict=True)])) for m, c in p.terms())
        return float(sum(float(c.p) / float(c.q) * power for c, power in powers))

    def shift(step: Step) -> float:
        own = [grown.values[c].length for c in step.joint.columns if grown.values[c].length is not None]
        return value(own[0]) if own else 0.0

    frames, places = {"ground": np.eye(3)}, {"ground": np.zeros(3)}
    for step in steps:
        joint, parent, child = step.joint, step.parent, step.child
        (own,) = (v for c in joint.columns if (v := grown.values[c]).cosine is not None)
        turned = relative(geometry, joint, value(own.cosine), value(own.sine))
        first, second = (floats(p) for p in geometry.points(joint))
        first = first + shift(step) * floats(geometry.axis(joint.first, joint.axes[0] if joint.axes else ""))
        here, there = (first, second) if step.forward else (second, first)
        frames[child] = frames[parent] @ (turned if step.forward else turned.T)
        places[child] = places[parent] + frames[parent] @ here - frames[child] @ there
        for inner in mechanism.link(child).points.values():
            found = [value(x) for x in grown.bodies[child].point(inner)]
            assert np.allclose(found, places[child] + frames[child] @ floats(inner), atol=1e-9)


def test_most_of_these_arms_have_an_angle_that_is_counted_elsewhere() -> None:
    """Else the test above says little."""
    arms = [arm(Random(seed)) for seed in range(15)]
    planned = [plan(m, Geometry(m), spanning_steps(m), False) for m in arms]
    assert sum(any(not t.origin.is_own for step in p for t in step.turns) for p in planned) > 6
