"""How long each kind of answer is waited for, in seconds of `processor_time`, and what happens after.

Source: the measurements behind the routing of questions to engines.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass

PATIENT = 10.0
"""Proofs get so many times as long where they are worth waiting for."""

_longer: ContextVar[tuple[float, float]] = ContextVar("patience", default=(1.0, 1.0))


@dataclass(frozen=True)
class Patience:
    """So many seconds of work, and what happens when they are used up.

    is_proof: whether it is longer inside `patiently`.
    """

    seconds: float
    then: str
    is_proof: bool = False

    @property
    def work(self) -> float:
        """The seconds that are waited here."""
        everything, proofs = _longer.get()
        return self.seconds * everything * (proofs if self.is_proof else 1.0)


# who is asked first
FIRST = {
    "flint": Patience(1.5, "Singular is asked"),
    "msolve": Patience(300.0, "Singular is asked"),
    "singular": Patience(300.0, "the engine named next is asked"),
    "sympy": Patience(300.0, "the engine named next is asked"),
}
FLINT_BEFORE_MSOLVE = Patience(0.3, "msolve is asked")
LAST = Patience(3600.0, "undecided; for the last engine, where the caller set no limit")
LAST_DECOMPOSITION = Patience(120.0, "the same for minimal primes and the like")

# proofs of what is known
LEAST_PROOF = Patience(1.0, "what rests on primes stays modular", is_proof=True)
MOST_PROOF = Patience(3.0, "the same, where the answer modulo primes took long", is_proof=True)
SHORT_PROOF = Patience(10.0, "the same of a short basis, often found by way of short ones", is_proof=True)
SECOND_OPINION = Patience(20.0, "an answer that nobody confirms is modular")
RESIDUES = Patience(3.0, "what takes so long modulo a prime is not tried over Q")
SPLITTING = Patience(10.0, "a piece is not proven prime")

# the search for strata
MEMBERSHIP = Patience(2.0, "a minor is not proven to vanish on a patch, which is split", is_proof=True)
MEMBERSHIP_IN_FEW = Patience(
    0.5, "it is asked of all equations, not only those in its variables", is_proof=True
)
SOON_IRREDUCIBLE = Patience(0.3, "what borders a minor is looked at first")
IRREDUCIBLE = Patience(3.0, "a patch counts as reducible")
APART = Patience(0.5, "a set is searched as one, though a few of its equations may come apart")
MEETING = Patience(0.5, "parts of one set that are curves are not counted")
POINTS_BY_MODULES = Patience(20.0, "finitely many points are searched as any other part")
ASSEMBLIES = Patience(2.0, "the other proofs that there is no real point are tried")
FIRST_MODULE = Patience(2.0, "a module without parents is solved on a curve, where its equations have one")
QUICK_EMPTINESS = Patience(1.0, "a patch waits as a branch of its own")
SHORT_EMPTINESS = Patience(5.0, "a part without known points is split further")
HASTY_EMPTINESS = Patience(10.0, "the same where primes will do")
PATIENT_EMPTINESS = Patience(20.0, "the same in a second look, over Q")
EMPTINESS = Patience(30.0, "a part without known points is decomposed")

# what is real of a stratum
FIRST_LOOK = Patience(1.0, "a second look, where more may be said")
FIRST_BOUND = Patience(0.3, "a second look bounds the dimension, if it is not below that of its class")
SECOND_LOOK = Patience(5.0, "undecided, or a last look where its class is not known to be large")
LARGER_PART = Patience(15.0, "the dimension of the class is open from above")
POINT = Patience(10.0, "the next numerical point is tried")
POINT_SEARCH = Patience(15.0, "the system is decomposed")
CHOICE = Patience(1.0, "the equations are taken as they are")
EXTREMA = Patience(2.0, "a sign is not proven")

# bounds of dimensions
BOUND_BY_TOWERS = Patience(0.8, "values of joints are tried")
BOUND_BY_JOINTS = Patience(5.0, "values of coordinates are tried")
BOUND_BY_VALUES = Patience(10.0, "hyperplanes are tried")
BOUND_BY_HYPERPLANES = Patience(10.0, "no bound")
BOUND_PROOF = Patience(3.0, "the bound stays modular")
DIMENSION = Patience(20.0, "the set is decomposed")
HYPERPLANE_CUTS = Patience(10.0, "the dimension is not found by cuts")

# what is said of loci and of the space
LOCUS = Patience(10.0, "a locus is as large as the stratum known inside, at least")
LOCUS_HOLDS_PIECE = Patience(2.0, "a piece is not seen to lie in a locus")
SMOOTHNESS = Patience(5.0, "whether the space is smooth is undecided")


# what holds for many configurations or dimensions together
ARCS = Patience(120.0, "the regions of a curve are undecided")
WALLS = Patience(20.0, "the next plane between two regions with the same signs is tried")
ALL_WALLS = Patience(120.0, "regions with the same signs are not proven to be apart")
ALL_REGIONS = Patience(120.0, "whether the regions that were found are all is undecided")
FREE_BOX = Patience(120.0, "a box that is free of singularities is not grown further")
BORDER = Patience(20.0, "a class is not proven constant over the cells of a design")
REAL_BORDER = Patience(8.0, "a border counts, though there may be nothing real over it")


@contextmanager
def patiently() -> Iterator[None]:
    """Proofs over Q of what is known modulo primes may take much longer for the work inside.

    >>> with patiently():
    ...     proof_patience(), MOST_PROOF.work
    (10.0, 30.0)
    """
    with _set(_longer.get()[0], PATIENT):
        yield


@contextmanager
def scaled(factor: float) -> Iterator[None]:
    """All of the table times a factor, for the work inside: 0 for answers that come at once.

    >>> with scaled(0.5):
    ...     SPLITTING.work
    5.0
    """
    with _set(factor, _longer.get()[1]):
        yield


@contextmanager
def _set(everything: float, proofs: float) -> Iterator[None]:
    token = _longer.set((everything, proofs))
    try:
        yield
    finally:
        _longer.reset(token)


def proof_patience() -> float:
    """So many times as long as usual proofs are waited for here."""
    return _longer.get()[1]


def in_force() -> tuple[float, float]:
    """What everything, and what proofs further, are multiplied with here."""
    return _longer.get()
