"""What the search for a proof is spared."""

from __future__ import annotations

import pytest

from singsym.certificates.checker.polynomials import Rejected
from singsym.certificates.checker.sets import statement
from singsym.certificates.prover import proof, unit_products
from singsym.certificates.prover.proof import Hints, prove
from singsym.effort.budget import Undecided
from singsym.polynomials import Ring


def test_a_set_with_a_known_point_is_not_asked_whether_it_is_empty(monkeypatch: pytest.MonkeyPatch) -> None:
    """T = (x^2 + y^2 - 1) A: the locus is the unit circle, which has (1, 0); off it is the plane."""

    def fails(*_: object) -> None:
        raise AssertionError("products of units are searched for a proof that nothing is there")

    monkeypatch.setattr(proof, "cancelled", fails)
    data = {
        "variables": ["x", "y"],
        "L": [["1", "x^2 + y^2 - 1"]],
        "roles": ["output", "input"],
        "N": 1,
        "n": 1,
    }
    empty = {key: [] for key in ("constants", "equations", "exclusions", "positive", "nonnegative")}
    x, y = Ring(("x", "y")).gens
    found = prove(statement(data | empty), Hints(((x**2 + y**2 - 1).value,), (), ((1.0, 0.0),)))
    assert [line["rule"] for line in found.lines] == ["split", "derive", "ranks", "ranks"]


def test_a_remainder_that_the_checker_refuses_ends_the_attempt_only(monkeypatch: pytest.MonkeyPatch) -> None:
    """That a set is empty is then not seen; the search goes on without it, as after any attempt in vain."""

    def refuses(*_: object) -> None:
        raise Rejected("a remainder becomes too long")

    data = {"variables": ["x", "y"], "L": [["1", "x"]], "roles": ["output", "input"], "N": 1, "n": 1}
    empty = {key: [] for key in ("constants", "equations", "exclusions", "positive", "nonnegative")}
    at = statement(data | empty).whole
    monkeypatch.setattr(unit_products, "remainder", refuses)
    with pytest.raises(Undecided, match="too long"):
        unit_products.cancelled(at.context.constant(1), at)
