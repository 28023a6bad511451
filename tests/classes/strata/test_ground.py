"""What is seen to vanish on a part of the configuration space."""

from __future__ import annotations

import pytest

from singsym.classes.strata.ground import Ground
from singsym.classes.strata.patches import Patch
from singsym.polynomials import Ring
from singsym.varieties.real.proofs.vector_charts import Cartesian
from singsym.varieties.real.system import RealSystem


def test_first_the_equations_in_its_variables(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where z = x y and y = x^2, z^2 = x^2 y^2 = y^3; no multiple of one equation makes what is left shorter.

    The third equation has nothing to do with it; with all loops of a linkage a basis was not found in time,
    and a part on which a minor vanished was split by it.  Nor has a factor in w."""

    def based(*_: object) -> None:
        pytest.fail("a basis of all equations is asked")

    monkeypatch.setattr(Cartesian, "based", based)
    ring = Ring(("x", "y", "z", "w"))
    x, y, z, w = ring.gens
    system = RealSystem(ring, (x * y - z, x**2 - y, w**3 - x * w - z))
    ground = Ground(Patch(ring, {}, system.equations), ((1.0, 1.0, 1.0, 1.3247179572447458),), system=system)
    free = ground.certifier(RealSystem(ring, ()), ())
    assert ground.vanishes(y**3 - z**2 + x * y - z, free).value
    assert ground.vanishes((y**3 - z**2 + x * y - z) * (w + x + 5) * (w - 7), free).value
    assert not ground.vanishes(y**3 - 2 * z**2, free).value
