"""The ground on which ranks are looked for: a patch or a component, with points on it.

Source: Zlatanov, Fenton, Benhabib (1998), section 3.2; what vanishes on a ground is singsym's own.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property

from singsym.classes.strata.patches import Patch, is_combination
from singsym.effort import patience
from singsym.effort.attempts import attempt
from singsym.effort.budget import Undecided
from singsym.effort.verdict import Known, Premises
from singsym.elimination.ideal import Ideal
from singsym.kinematics.nonzero import Certifier
from singsym.kinematics.placement import ConfigurationSpace
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.decomposition import Component, decompose
from singsym.varieties.real.numerical.sampling import Points, is_large
from singsym.varieties.real.proofs.vector_charts import Cartesian
from singsym.varieties.real.system import RealSystem
from singsym.varieties.splitting import used_ring

_LONGEST_FACTORED = 3000
"""A longer polynomial is taken as it is, as it might take long to factor."""


class NotEvident(Undecided):
    """What a polynomial does on a set has to be known before more can be said of it."""

    def __init__(self, polynomial: Polynomial, reason: str) -> None:
        super().__init__(reason)
        self.polynomial = polynomial

    def __reduce__(self) -> tuple[type[NotEvident], tuple[Polynomial, str]]:
        return NotEvident, (self.polynomial, str(self))


@dataclass(frozen=True)
class Ground:
    """Where ranks are asked for: a patch or one component of it, with points on it to guess from.

    system: the patch off the exclusions.
    """

    patch: Patch
    samples: Points = ()
    component: Component | None = None
    system: RealSystem | None = None

    @cached_property
    def _chart(self) -> tuple[Cartesian, tuple[Ideal, ...]] | None:
        if self.system is None:
            return None
        chart = Cartesian.of(self.system)
        return chart, chart.based(patience.MEMBERSHIP.work)

    @cached_property
    def _few(self) -> dict[Ring, Ideal | None]:
        """Ideals of the equations in some of the variables, where their bases were asked for."""
        return {}

    def _seeming_factors(self, polynomial: Polynomial) -> Iterator[Polynomial]:
        """The factors that are small at some known point, those in few variables first."""
        short = len(polynomial) <= _LONGEST_FACTORED
        factors = [factor for factor, _ in polynomial.factors()] if short else [polynomial]
        for factor in sorted(factors, key=lambda p: (len(p.variables), len(p))):
            if not all(is_large(factor, (point,)) for point in self.samples):
                yield factor

    def _is_among_few(self, polynomial: Polynomial) -> Known[bool]:
        """Whether it is in the ideal of the equations in its variables, where a basis is soon found."""
        ring = used_ring(polynomial.ring, (polynomial,))
        if ring not in self._few:
            self._few[ring] = None
            with attempt("a basis of a few equations", patience.MEMBERSHIP_IN_FEW.work):
                own = (ring.convert(p) for p in self.patch.rest if {*ring.names} >= {*p.variables})
                ideal = Ideal(ring, own)
                ideal.groebner_basis()
                self._few[ring] = ideal
        known = self._few[ring]
        return Known(False) if known is None else known.contains(ring.convert(polynomial))

    @property
    def equations(self) -> tuple[Polynomial, ...]:
        """The equations of all of the ground."""
        return self.component.generators if self.component else self.patch.generators

    def has_no_zeros_inside(self, polynomial: Polynomial, *, soon: bool = False) -> Known[bool]:
        """Whether the zeros of a polynomial are seen to hold no open part of the ground.

        soon: only where that does not take long.

        On an irreducible ground those are such that do not vanish on all of it; then what vanishes off their
        zeros vanishes on the whole ground.
        """
        if self.component is not None:
            prime, left = self.component.ideal if self.component.prime else None, polynomial
        else:
            left = self.patch.restrict(polynomial)
            prime = (self._soon_prime if soon else self._prime) if left else None
        if prime is None:
            return Known(False)
        return prime.contains(left).map(lambda inside: not inside)

    @cached_property
    def _soon_prime(self) -> Ideal | None:
        return self._proven_prime(patience.SOON_IRREDUCIBLE.work)

    @cached_property
    def _prime(self) -> Ideal | None:
        return self._soon_prime or self._proven_prime(patience.IRREDUCIBLE.work)

    def _proven_prime(self, seconds: float) -> Ideal | None:
        """The ideal of the patch in the variables that are not solved for, where it is soon proven prime."""
        with attempt("whether a part is irreducible", seconds):
            components = decompose(self.patch.rest, ring=self.patch.ring)
            if len(components.value) == 1 and components.value[0].prime and components.is_proven:
                return components.value[0].ideal
        return None

    def certifier(self, feasible: RealSystem, loci: Iterable[tuple[Polynomial, ...]]) -> Certifier:
        """What is known of signs and zeros on the ground off the exclusions and off some loci."""
        restrict = self.patch.restrict
        groups = (tuple(map(restrict, group)) for group in (*feasible.exclusions, *loci))
        rest = self.component.generators if self.component else self.patch.rest
        positive = tuple(map(restrict, feasible.positive))
        exclusions = tuple(group for group in groups if any(group))
        return Certifier(ConfigurationSpace(feasible.ring, rest, exclusions, positive))

    def seems_zero(self, polynomial: Polynomial) -> bool:
        """Whether a polynomial is small at all known points, and a proof that it vanishes may take long."""
        return self.component is None and not is_large(polynomial, self.samples)

    def vanishes(self, polynomial: Polynomial, certifier: Certifier) -> Known[bool]:
        """Whether a polynomial is zero on the ground, where True is as certain as is said.

        On a component False may be a guess, which only makes a stratum empty and sends its closure down as a
        locus again.  Raises `NotEvident` on a patch where it seems to be, unproven.
        """
        restricted = self.patch.restrict(polynomial)
        if certifier.normal_form(restricted).is_zero or certifier.shorten(restricted).is_zero:
            return Known(True)
        if is_large(polynomial, self.samples):
            return Known(False)
        premises = Premises()
        if self.component is not None and premises.take(self.component.ideal.contains(polynomial)):
            return premises.conclude(True)
        if is_combination(restricted, self.equations if self.component else self.patch.rest):
            return Known(True)
        if self.component is None:
            for factor in self._seeming_factors(restricted):
                among_few = self._is_among_few(factor)
                if among_few.value:
                    return premises.pass_on(among_few)
            if self._chart is not None and premises.grants(
                self._chart[0].vanishes(restricted, self._chart[1])
            ):
                return premises.conclude(True)
            raise NotEvident(restricted, "a minor seems to vanish on a part of the configuration space")
        if self.component.prime:
            return premises.conclude(False)
        return premises.pass_on(self.component.ideal.radical_contains(polynomial))
