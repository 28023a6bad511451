"""What the search for a proof is spared."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from singsym.certificates.checker.polynomials import Rejected, polynomial
from singsym.certificates.checker.sets import RealSet, statement
from singsym.certificates.checker.verification import FORMAT, verify
from singsym.certificates.prover import proof, unit_products
from singsym.certificates.prover.proof import Hints, prove
from singsym.certificates.prover.writing import Certificate
from singsym.effort.budget import Undecided
from singsym.polynomials import Ring

EMPTY: dict[str, Any] = {
    key: [] for key in ("constants", "equations", "exclusions", "positive", "nonnegative")
}


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
    x, y = Ring(("x", "y")).gens
    found = prove(statement(EMPTY | data), Hints(((x**2 + y**2 - 1).value,), (), ((1.0, 0.0),)))
    assert [line["rule"] for line in found.lines] == ["split", "derive", "ranks", "ranks"]


def test_a_remainder_that_the_checker_refuses_ends_the_attempt_only(monkeypatch: pytest.MonkeyPatch) -> None:
    """That a set is empty is then not seen; the search goes on without it, as after any attempt in vain."""

    def refuses(*_: object) -> None:
        raise Rejected("a remainder becomes too long")

    data = {"variables": ["x", "y"], "L": [["1", "x"]], "roles": ["output", "input"], "N": 1, "n": 1}
    at = statement(EMPTY | data).whole
    monkeypatch.setattr(unit_products, "remainder", refuses)
    with pytest.raises(Undecided, match="too long"):
        unit_products.cancelled(at.context.constant(1), at)


def _set(*equations: str, units: tuple[str, ...] = ()) -> RealSet:
    own = {"variables": ["x", "y", "z"], "L": [["1", "x"]], "roles": ["output", "input"], "N": 1, "n": 1}
    given = {"equations": list(equations), "exclusions": [[unit] for unit in units]}
    return statement(EMPTY | own | given).whole


def test_units_are_known_modulo_the_equations() -> None:
    """Where x = y the unit x - z is y - z, and 2 z - 2 y is -2 times it."""
    at = _set("x - y", units=("x - z",))
    f = polynomial("2*z - 2*y", at.context)
    found = unit_products.product_of_units(f, at, unit_products.units_of(at))
    assert found == {"units": [0], "scale": "-2"}
    assert unit_products.factors(f, unit_products.units_of(at)) == []


def test_what_a_product_vanishes_by_is_looked_for_among_low_powers_first() -> None:
    """x^3 z = 0 and y^2 z = 0: off y z = 0 by y^2, though x^3 would do as well."""
    at = _set("x^3*z", "y^2*z", units=("x", "y"))
    assert unit_products.cancelled(polynomial("z", at.context), at) == {"units": [1, 1], "power": 1}


def test_where_minors_are_too_many_entries_are_split_on(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """L_I has the minor y z, L_O x z; L has rank 3 off z = 0, else 2; L_p one less where x = y = 0, or z = 0.

    L has four minors of size 3, one more than are looked at, until z, x or y is a pivot.
    """
    monkeypatch.setattr(proof, "MOST_MINORS", 3)
    about = {
        **EMPTY,
        "variables": ["x", "y", "z"],
        "exclusions": [["x", "y", "z"]],
        "L": [["1", "0", "x", "0"], ["0", "1", "y", "0"], ["0", "0", "0", "z"]],
        "roles": ["output", "input", "passive", "passive"],
        "N": 3,
        "n": 1,
    }
    lines = prove(statement(about), Hints()).lines
    header = {"format": FORMAT, "name": "own", "claims": []}
    found = verify(Certificate((header, about, *lines)).write(tmp_path / "own"))
    assert {row.types: row.dimension for row in found.proven if row.occurs} == {
        "RI, IO": 2,
        "RO, II": 2,
        "RPM, IIM": 2,
        "RPM, II, IO": 1,
        "RO, RPM, II, IIM": 1,
        "RI, RPM, IO, IIM": 1,
    }
    assert "open" not in found.rules
