"""The paper's conditions (4), (5) and (i)-(viii), each with its polynomial content.

Source: Zlatanov, Fenton, Benhabib (1998), the propositions of section 2.3, and (4), (5) of section 3.1.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from math import prod
from typing import TYPE_CHECKING

from singsym.conditions.equilibrium import Equilibrium, equilibrium
from singsym.conditions.factor import Factor
from singsym.conditions.incidences.incidences import Incidences
from singsym.conditions.incidences.quantities import Quantity
from singsym.conditions.named_quantities import PointNames
from singsym.kinematics.nonzero import Certifier
from singsym.kinematics.reduction import Reduction, reduce
from singsym.minors.blocks import block_triangular
from singsym.minors.determinant import TooManyTerms
from singsym.minors.factored import FactoredDeterminant, Unit, determinant_factors, factored
from singsym.minors.rank import RankBlocks, alternatives, is_small, minor_factors, rank_blocks
from singsym.polynomials import Polynomial, PolynomialMatrix

if TYPE_CHECKING:
    from singsym.kinematics.velocity import VelocityEquation

LABELS = ("4", "5", "i", "ii", "iii", "iv", "v", "vi", "vii", "viii")
"""The labels of the conditions, in the paper's order of printing."""

LARGEST_DETERMINANT = 7
"""Square blocks up to this size are expanded before elimination; larger ones only after it."""

MOST_TERMS = 50000
"""Determinants with more terms on the way are left as determinants."""

_MATRIX = {"4": "L_I", "5": "L_O", "iii": "L_p", "vi": "L"}
TWINS = {"vii": "4", "viii": "5"}
"""Conditions that say of a matrix what others say of its determinant."""
_COMPARED = {"i": ("L_O", "L_p"), "ii": ("L_I", "L_p"), "iv": ("L_I", "L"), "v": ("L_O", "L")}
_TYPES = {
    "4": "RO or RPM, II or IIM",
    "5": "RI or RPM, IO or IIM",
    "i": "RI",
    "ii": "RO",
    "iii": "RPM",
    "iv": "II",
    "v": "IO",
    "vi": "IIM",
    "vii": "RO or RPM, II or IIM",
    "viii": "RI or RPM, IO or IIM",
}


@dataclass(frozen=True)
class Comparison:
    """rank of `lower` < rank of `upper` + `offset`, by names among L, L_I, L_O, L_p."""

    lower: str
    upper: str
    offset: int


@dataclass(frozen=True)
class Condition:
    """One of the paper's conditions for a mechanism.

    statement, latex_statement: as the paper prints it.
    alternatives: it holds where all factors of at least one alternative vanish (with the loop equations, on
        the feasible set); None where it is left as a comparison of ranks.  No alternative: nowhere.
    everywhere: it holds in every configuration.
    units: the factors that were taken away, each with the reason.
    blocks: the blocks whose ranks add, with the constant, for (iii), (vi) and where a determinant is no way.
    bracket: of a determinant with too many terms, what it is of named lines: it holds where this is zero.
    equilibrium: what (vi), and (4) where it is left as a rank, says of screws of the legs.
    """

    label: str
    types: str
    statement: str
    latex_statement: str
    alternatives: tuple[tuple[Factor, ...], ...] | None = None
    everywhere: bool = False
    units: tuple[Unit, ...] = ()
    comparison: Comparison | None = None
    blocks: RankBlocks | None = None
    bracket: Quantity | None = None
    equilibrium: Equilibrium | None = None

    @property
    def factors(self) -> tuple[Factor, ...]:
        """The factors of a determinant: those of the alternatives that are one equation."""
        return tuple(a[0] for a in self.alternatives or () if len(a) == 1)

    @property
    def all_factors(self) -> tuple[Factor, ...]:
        """The factors of all alternatives, in their order."""
        return tuple(f for alternative in self.alternatives or () for f in alternative)

    @property
    def polynomials(self) -> tuple[tuple[Polynomial, ...], ...]:
        """The alternatives as bare polynomials."""
        return tuple(tuple(f.polynomial for f in a) for a in self.alternatives or ())

    @property
    def is_nowhere(self) -> bool:
        """Whether it holds in no configuration, by its factors."""
        return self.alternatives == () and not self.everywhere

    def __repr__(self) -> str:
        return f"Condition({self.label}: {self.statement})"

    def __str__(self) -> str:
        lines = [f"({self.label}) {self.statement}: {self.types}"]
        if self.everywhere:
            lines.append("  in every configuration")
        elif self.is_nowhere:
            lines.append("  in no configuration")
        elif self.bracket is not None:
            lines.append(f"  {self.bracket.text} = 0  ({self.bracket.words})")
        elif self.blocks is not None and self.alternatives is None:
            sizes = ", ".join("x".join(map(str, block.shape)) for block in self.blocks.blocks)
            lines.append(f"  by the rank {self.blocks.constant} + that of {sizes}, not written out")
        for alternative in self.alternatives or ():
            joined = "\n    and ".join(
                f"{factor} = 0" if not factor.name else f"{factor}" for factor in alternative
            )
            lines.append(f"  {joined}")
        lines += [f"  without the factor {unit}" for unit in self.units]
        return "\n".join(lines)

    def latex(self) -> str:
        """The condition with its content, as lines of an `aligned` environment."""
        lines = [rf"(\mathrm{{{self.label}}})\quad & {self.latex_statement}"]
        if self.everywhere:
            lines.append(r"& \text{in every configuration}")
        elif self.is_nowhere:
            lines.append(r"& \text{in no configuration}")
        elif self.bracket is not None:
            lines.append(rf"& \iff\quad {self.bracket.latex} = 0")
        for place, alternative in enumerate(self.alternatives or ()):
            lead = r"\iff" if place == 0 else r"\text{or}"
            for factor in alternative:
                lines.append(rf"& {lead}\quad {factor.latex()} = 0")
                lead = r"\text{and}"
        body = " \\\\\n".join(lines)
        return f"\\begin{{aligned}}\n{body}\n\\end{{aligned}}"

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self.latex()}$"


@dataclass(frozen=True, eq=False)
class Conditions:
    """The conditions of a mechanism, each worked out when it is first asked for.

    equation: the velocity equation as it is; reduction: the same after section 4.2.
    most_terms: determinants with more terms on the way are left as determinants.
    naming: whether factors get their names.
    """

    equation: VelocityEquation
    reduction: Reduction
    most_terms: int = MOST_TERMS
    naming: bool = True

    def __getitem__(self, label: str) -> Condition:
        """A condition by its label; raises `KeyError` naming the labels."""
        if label not in LABELS:
            raise KeyError(f"no condition {label!r}: the paper has {', '.join(LABELS)}")
        if label not in self._known:
            self._known[label] = self._build(label)
        return self._known[label]

    def __iter__(self) -> Iterator[Condition]:
        return (self[label] for label in LABELS)

    @cached_property
    def _known(self) -> dict[str, Condition]:
        return {}

    @cached_property
    def certifier(self) -> Certifier:
        """What is proved nonzero on the feasible set."""
        return Certifier(self.equation.space)

    @cached_property
    def names(self) -> PointNames:
        """The names for determinants of points."""
        return PointNames(self.certifier, self.incidences)

    @cached_property
    def incidences(self) -> Incidences:
        """What the mechanism's architecture says of its determinants."""
        return Incidences(self.equation, self.certifier)

    def matrix(self, name: str) -> PolynomialMatrix:
        """L, L_I, L_O or L_p of the reduced velocity equation."""
        found: PolynomialMatrix = getattr(self.reduction.equation, name)
        return found

    def rank_blocks(self, name: str) -> RankBlocks:
        """One of the four matrices taken apart; its rank in the mechanism is `constant` + the blocks' ranks.

        The constant counts the reduction's eliminations as well.
        """
        if name not in self._blocks:
            found = rank_blocks(self.matrix(name), self.certifier)
            constant = found.constant + self.reduction.constant
            shape = getattr(self.equation, name).shape
            self._blocks[name] = RankBlocks(shape, found.blocks, constant, found.record)
        return self._blocks[name]

    @cached_property
    def _blocks(self) -> dict[str, RankBlocks]:
        return {}

    # -- building ------------------------------------------------------------------------------------

    def _build(self, label: str) -> Condition:
        N, n = self.equation.N, self.equation.n
        if label in _COMPARED:
            lower, upper = _COMPARED[label]
            offset = n if upper == "L_p" else 0
            tail = f" + {offset}" if offset else ""
            return Condition(
                label,
                _TYPES[label],
                f"rank {lower} < rank {upper}{tail}",
                rf"\operatorname{{rank}} {lower} < \operatorname{{rank}} {upper}{tail}",
                comparison=Comparison(lower, upper, offset),
            )
        if label in TWINS:
            return self._as_rank(label)
        name = _MATRIX[label]
        if label in ("iii", "vi"):
            required = N - n if label == "iii" else N
            return self._rank_condition(
                label,
                name,
                required,
                f"rank {name} < {required}",
                rf"\operatorname{{rank}} {name} < {required}",
            )
        plain, latex = f"det {name} = 0", rf"\det {name}(q) = 0"
        height, width = getattr(self.equation, name).shape
        if height != width:
            latex = rf"\operatorname{{rank}} {name} < {N}"
            return self._rank_condition(label, name, N, f"rank {name} < {N}", latex)
        found = self._determinant(name)
        if found is None:
            blocks, own = self.rank_blocks(name), self.incidences.bracket_of(name)
            apart = None if own else self._equilibrium(label)
            return Condition(
                label, _TYPES[label], plain, latex, blocks=blocks, bracket=own, equilibrium=apart
            )
        factors = tuple(self.factor(p, k) for p, k in found.factors)
        if name == "L_O" and len(factors) == 1 and not factors[0].words and self.naming:
            factors = (replace(factors[0], said=self.incidences.output_at_rest),)
        return Condition(
            label,
            _TYPES[label],
            plain,
            latex,
            None if found.vanishes else tuple((factor,) for factor in factors),
            found.vanishes,
            found.units,
        )

    def _as_rank(self, label: str) -> Condition:
        """(vii) and (viii): what (4) and (5) say, of the matrix."""
        found, name = self[TWINS[label]], _MATRIX[TWINS[label]]
        if found.statement.startswith("det "):
            singular, latex = f"{name} is singular", rf"{name} \text{{ is singular}}"
            found = replace(found, statement=singular, latex_statement=latex)
        return replace(found, label=label, types=_TYPES[label])

    def factor(self, polynomial: Polynomial, multiplicity: int = 1) -> Factor:
        """A polynomial as a factor of the mechanism's, with its name."""
        if not self.naming:
            return Factor(polynomial, multiplicity)
        return Factor.named(polynomial, multiplicity, self.names)

    def _equilibrium(self, label: str) -> Equilibrium | None:
        """The screws of (4) and (vi)."""
        return equilibrium(self.equation, label == "vi") if label in ("4", "vi") else None

    def _determinant(self, name: str) -> FactoredDeterminant | None:
        """The determinant, in the smallest of the forms that the full and reduced matrix and the legs give.

        None where all have too many terms to be written out.
        """
        choices: list[FactoredDeterminant] = []
        for matrix in (self.matrix(name), getattr(self.equation, name)):
            if choices and (not choices[0].factors or _largest_block(matrix) > LARGEST_DETERMINANT):
                break
            try:
                choices.append(determinant_factors(matrix, self.certifier, self.most_terms))
            except TooManyTerms:
                continue
        if (parts := self.incidences.parts_of(name)) is not None:
            choices.append(factored(parts, self.certifier))
        return min(choices, key=lambda choice: (not choice.vanishes, choice.size), default=None)

    def _rank_condition(self, label: str, name: str, required: int, plain: str, latex: str) -> Condition:
        """The locus where a rank is below `required`, as alternatives where that is full rank."""
        apart = self.rank_blocks(name)
        everywhere = apart.constant + sum(min(block.shape) for block in apart.blocks) < required
        found: list[tuple[Polynomial, ...]] = []
        losing = None if everywhere else apart.locus(required)
        if losing and not all(is_small(block) for block in losing):
            losing = None
        for block in losing or ():
            minors = minor_factors(block, self.certifier)
            if minors is None:
                continue
            everywhere = everywhere or not minors
            choices = alternatives(minors, self.certifier)
            found += [tuple(prod(f, start=block.ring.one) for f in minors)] if choices is None else choices
        decided = losing is not None and not everywhere
        return Condition(
            label,
            _TYPES[label],
            plain,
            latex,
            tuple(tuple(self.factor(p) for p in a) for a in _minimal(found)) if decided else None,
            everywhere,
            blocks=apart,
            equilibrium=self._equilibrium(label),
        )


def _minimal(found: list[tuple[Polynomial, ...]]) -> list[tuple[Polynomial, ...]]:
    """Without those that have all the polynomials of another."""
    distinct = dict.fromkeys(found)
    return [a for a in distinct if not any(set(b) < set(a) for b in distinct)]


def _largest_block(matrix: PolynomialMatrix) -> int:
    """The size of the largest diagonal block of the block triangular form."""
    return max((len(rows) for rows, _ in block_triangular(matrix).square), default=0)


def conditions(
    equation: VelocityEquation,
    reduction: Reduction | None = None,
    most_terms: int = MOST_TERMS,
    naming: bool = True,
) -> Conditions:
    """The conditions of a velocity equation; each is worked out when it is asked for.

    reduction: that of section 4.2, where it is at hand; most_terms: of determinants, on the way; naming:
    whether factors get their names.

    >>> from singsym.kinematics.velocity import velocity_equation
    >>> from singsym.mechanism import load
    >>> print(conditions(velocity_equation(load("fourbar")))["vii"])
    (vii) L_I is singular: RO or RPM, II or IIM
      det[S_B S_C S_D] = -By*Cx + Bx*Cy + 4*By - 4*Cy  (B, C, D collinear)
    """
    return Conditions(equation, reduction or reduce(equation), most_terms, naming)
