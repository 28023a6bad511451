"""Forward kinematics of a serial `Mechanism` in floats, from its data alone, for the tests."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from singsym.mechanism import JointKind, Mechanism

Matrix = NDArray[np.float64]


def vector(values: Any) -> Matrix:
    return np.array([float(v) for v in values])


def turn(axis: Matrix, angle: float) -> Matrix:
    """Rodrigues' rotation."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def tool(mechanism: Mechanism, values: Mapping[str, float]) -> tuple[Matrix, Matrix]:
    """Position of the tool and rotation of the last link, the joints' values by name."""
    m = mechanism.resolved
    place, frame = np.zeros(3), np.eye(3)
    for joint in m.joints:
        assert joint.axes is not None
        first, second = m.link(joint.first), m.link(joint.second)
        a, b = vector(first.axes[joint.axes[0]]), vector(second.axes[joint.axes[1]])
        p, q = vector(first.points[joint.at[0]]), vector(second.points[joint.at[1]])
        value = values[joint.name]
        if joint.kind is JointKind.P:
            assert np.allclose(a, b)
            place = place + frame @ (p + value * a - q)
            continue
        zero = np.eye(3)
        if joint.reference is not None:
            u, v = vector(first.axes[joint.reference[0]]), vector(second.axes[joint.reference[1]])
            zero = np.column_stack([u, np.cross(a, u), a]) @ np.column_stack([v, np.cross(b, v), b]).T
        relative = turn(a, value) @ zero
        place = place + frame @ (p - relative @ q)
        frame = frame @ relative
    last = m.link(m.joints[-1].second)
    return place + frame @ vector(last.points["tool"]), frame
