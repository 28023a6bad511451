"""From where a spatial scene is seen: an orthographic view in which its points lie well apart.

Source: the oblique drawings of Figs 5-12 of Zlatanov, Fenton, Benhabib (1998).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from singsym.output.figures.motions import Moving
from singsym.output.figures.scene import Scene, openness
from singsym.output.figures.style import Floats

_ELEVATION = np.deg2rad(24)
_AZIMUTHS = np.deg2rad([-62, -50, -38, -74, -26, -86, -110, -134])


def viewpoint(scene: Scene) -> Floats:
    """The view as a 3 x 3 rotation: to the right, up, and towards the reader, one a row.

    >>> import numpy as np
    >>> from singsym.mechanism import load
    >>> from singsym.output.figures.poses import portrait
    >>> from singsym.output.figures.scene import Stage
    >>> stage = Stage.of(load("rssr"))
    >>> view = viewpoint(stage.scene(portrait(stage)))
    >>> bool(np.allclose(view @ view.T, np.eye(3)))
    True
    """
    views = [_rotation(float(azimuth)) for azimuth in _AZIMUTHS]
    # the usual view, unless another shows clearly more
    scores = [openness(scene.all_points @ view[:2].T) - 0.02 * rank for rank, view in enumerate(views)]
    return views[int(np.argmax(scores))]


def _rotation(azimuth: float) -> Floats:
    c, s, up, flat = np.cos(azimuth), np.sin(azimuth), np.sin(_ELEVATION), np.cos(_ELEVATION)
    return np.array([[-s, c, 0.0], [-up * c, -up * s, flat], [flat * c, flat * s, up]])


def seen(scene: Scene, view: Floats) -> Scene:
    """The scene with every place and direction in the view's coordinates."""
    return scene.mapped(lambda place: view @ place)


def motion_seen(moving: Moving, view: Floats) -> Moving:
    """A motion's velocities and its later scene in the view's coordinates."""
    later = None if moving.later is None else seen(moving.later, view)
    return replace(moving, velocities={key: view @ v for key, v in moving.velocities.items()}, later=later)
