"""What is soon known of a piece in a decomposition, and is gone without where it takes longer.

Source: the questions of `irreducibility` and `elimination.ideal`, each with the patience of splitting.
"""

from __future__ import annotations

from collections.abc import Iterable

from singsym.effort.attempts import attempt
from singsym.effort.budget import current
from singsym.effort.patience import SPLITTING
from singsym.effort.verdict import Known, Premises
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Equations, Polynomial
from singsym.varieties.irreducibility import Splitting, analyse


def saturated(ideal: Ideal, polynomial: Polynomial) -> Known[Ideal] | None:
    """The ideal of the zeros outside those of a polynomial; None where it is not found soon."""
    with attempt("decomposition", SPLITTING.work):
        return ideal.saturate(polynomial)
    return None


def analysed(ideal: Ideal, unmixed: bool) -> Known[Splitting]:
    """What an ideal splits into, as far as that is soon seen."""
    with attempt("decomposition", SPLITTING.work):
        return analyse(ideal, macaulay=unmixed)
    # what was known before is no less true
    return Known(Splitting(beside=ideal.ring.one, macaulay=True) if unmixed else Splitting())


_SQUARINGS, _LONGEST = 2, 60
"""So often an equation is squared to see whether a power of it is in an ideal, and no longer ones are."""


def holds_one(ideal: Ideal, sets: Iterable[Equations]) -> Known[bool]:
    """Whether all equations of one of some sets are in an ideal."""
    premises = Premises()
    return premises.conclude(
        any(all(premises.take(ideal.contains(p)) for p in equations) for equations in sets)
    )


def holds_powers_of_one(ideal: Ideal, sets: Iterable[Equations]) -> Known[bool]:
    """Whether low powers of all equations of one of some sets are in an ideal: its zeros lie in that set.

    Where an ideal is not reduced that is seen long before what it splits into.

    >>> from singsym.polynomials import Ring
    >>> x, y, z = Ring(("x", "y", "z")).gens
    >>> [holds_powers_of_one(Ideal(x.ring, (x**2, y - z)), [s]).value for s in ((z, y), (x, x * z))]
    [False, True]
    """
    premises = Premises()

    def has_power(p: Polynomial) -> bool:
        current().check("decomposition")
        for _ in range(_SQUARINGS):
            p = premises.take(ideal.reduce(p))
            if not p or len(p) > _LONGEST:
                break
            p = p * p
        return premises.take(ideal.contains(p))

    return premises.conclude(any(all(map(has_power, equations)) for equations in sets))


def is_inside(ideal: Ideal, sets: Iterable[Equations]) -> Known[bool]:
    """Whether the zeros of an ideal are soon seen to lie in one of some sets.

    >>> from singsym.polynomials import Ring
    >>> x, y, z = Ring(("x", "y", "z")).gens
    >>> [is_inside(Ideal(x.ring, (x**2, y - z)), [(z, y), s]).value for s in ((x, y), (x, x * z))]
    [False, True]
    """
    with attempt("decomposition", SPLITTING.work):
        premises = Premises()
        for equations in sets:
            if all(premises.take(ideal.radical_contains(p)) for p in equations):
                return premises.conclude(True)
    return Known(False)
