"""Classifications shared by the tests of published results: each mechanism is classified once a session."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from singsym.classes.classify import Limits, classify
from singsym.classes.result import Classification
from singsym.mechanism.model import Mechanism


@pytest.fixture(scope="session")
def classified() -> Callable[[Mechanism], Classification]:
    """A function from mechanisms to their classifications, on one process and without the cache on disk."""
    known: dict[str, Classification] = {}

    def find(mechanism: Mechanism) -> Classification:
        m = mechanism.resolved
        key = repr((m.links, m.joints, m.inputs, m.outputs, m.translating))
        if key not in known:
            known[key] = classify(mechanism, limits=Limits(total=3000), cache=False)
        return known[key]

    return find


@pytest.fixture(scope="session")
def occurring(
    classified: Callable[[Mechanism], Classification],
) -> Callable[[Mechanism], dict[str, int | None]]:
    """A function from mechanisms to {class: points}, points None where infinite; nothing may be undecided."""

    def find(mechanism: Mechanism) -> dict[str, int | None]:
        result = classified(mechanism)
        assert not result.undecided
        return {c.singularity_class.name: c.points for c in result.classes if c.verdict.is_yes}

    return find
