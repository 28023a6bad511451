"""The block triangular form, on systems whose modules are seen by eye."""

from __future__ import annotations

from singsym.polynomials import Ring
from singsym.polynomials.block_form import block_form

R = Ring(("c", "s", "u", "v", "x", "y"))
C, S, U, V, X, Y = R.gens
CRANK = C**2 + S**2 - 1
FIRST = ((U - C) ** 2 + (V - S) ** 2 - 4, (U - 3) ** 2 + V**2 - 4)
SECOND = ((X - U) ** 2 + (Y - V) ** 2 - 9, (X - 6) ** 2 + Y**2 - 9)


def test_dyads_over_a_crank_held() -> None:
    """Held at an angle, the crank carries one dyad, which carries the other one."""
    form = block_form((*SECOND, *FIRST), given=("c", "s"))
    assert [m.unknowns for m in form.modules] == [("u", "v"), ("x", "y")]
    assert [m.parents for m in form.modules] == [("c", "s"), ("u", "v")]
    assert form.ancestors(form.modules[1]) == (form.modules[0],)
    assert (form.left_over, form.free) == ((), ())


def test_a_condition_on_the_last_dyad_turns_the_order_round() -> None:
    """Where the last dyad is stretched, it is solved with the link that carries it; the crank comes last."""
    stretched = (X - U) * Y - (X - 6) * (Y - V)
    form = block_form((CRANK, *FIRST, *SECOND, stretched))
    assert [set(m.unknowns) for m in form.modules] == [{"u", "v", "x", "y"}, {"c", "s"}]


def test_what_has_no_equation_and_what_no_unknown() -> None:
    form = block_form((X**2 - 2, X - 1, U * V - 1))
    assert form.left_over == (X - 1,)
    assert len(form.free) == 1
    assert form.free[0] in ("u", "v")
