"""Certificates shared by the tests: each mechanism's is made once a session."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from singsym.certificates.prover.writing import Certificate, certificate
from singsym.classes.classify import Limits, classify
from singsym.mechanism import load


@pytest.fixture(scope="session")
def certified() -> Callable[[str], Certificate]:
    """A function from names of the library to certificates."""
    known: dict[str, Certificate] = {}

    def find(name: str) -> Certificate:
        if name not in known:
            known[name] = certificate(classify(load(name), limits=Limits(total=600), cache=False))
        return known[name]

    return find
