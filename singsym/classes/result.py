"""The result of a classification: loci, the 21 classes, their pieces and witnesses, as data.

Source: Zlatanov, Fenton, Benhabib (1998), section 3.2 and the layout of Table 2.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from typing import Any

from singsym.classes.extent import UNKNOWN, Extent
from singsym.classes.types import Defects, SingularityClass, SingularityType
from singsym.elimination.conditions import polynomial_latex
from singsym.elimination.verdict import Verdict
from singsym.kinematics.reduction import Reduction
from singsym.kinematics.velocity import VelocityEquation
from singsym.mechanism.model import Mechanism
from singsym.polynomials import Polynomial

Equations = tuple[Polynomial, ...]


@dataclass(frozen=True)
class Configuration:
    """A certified configuration: decimal strings by name, each within `radius` of the exact value.

    coordinates: the configuration variables; points: coordinates of the named points as `B.x`;
    joints: joint angles in radians and slides, by column.
    """

    coordinates: Mapping[str, str]
    points: Mapping[str, str]
    joints: Mapping[str, str]
    radius: str

    def as_json(self) -> dict[str, str]:
        """One flat object name -> decimal string, with `radius`."""
        return {**self.coordinates, **self.points, **self.joints, "radius": self.radius}

    def floats(self) -> dict[str, float]:
        """The configuration variables as floats, for drawing."""
        return {name: float(value) for name, value in self.coordinates.items()}

    def _repr_html_(self) -> str:
        rows = [(name, value) for name, value in (self.points or self.coordinates).items()]
        return _html_table((), [*rows, ("error below", self.radius)])


@dataclass(frozen=True)
class Piece:
    """A part of a class: the real zeros of `basis` off the common zeros of each exclusion.

    path: the factors and minors set to zero on the way here, as they are printed.
    basis: generators of the ideal of the piece, loop equations included.
    extent: its real dimension.
    points: the number of real points of a finite piece; components: connected components where known;
    uncounted: why those of a curve are not known; countable: whether a larger budget could say more.
    """

    path: Equations
    basis: Equations
    exclusions: tuple[Equations, ...]
    defects: Defects
    verdict: Verdict
    extent: Extent = UNKNOWN
    points: int | None = None
    components: int | None = None
    witnesses: tuple[Configuration, ...] = ()
    uncounted: str = ""
    countable: bool = True

    @property
    def dimension(self) -> int | None:
        """The real dimension, -1 when empty, None where it is not known."""
        return self.extent.dimension

    @property
    def provisional(self) -> bool:
        """Whether a larger budget could say more."""
        uncounted = self.dimension == 0 and self.points is None
        rests = "modular" in (self.verdict.certainty, self.extent.bounded)
        return self.verdict.is_undecided or self.dimension is None or uncounted or rests


@dataclass(frozen=True)
class Locus:
    """The zero set of one factor of condition (4) or (5) on the configuration space.

    words: what the factor says of the mechanism's points and axes, or ""; extent: its real dimension.
    points: real points of a finite locus; components: connected components of a curve, where known; open: why
    one of these is not known although it was looked for; remark: why it was not.
    """

    condition: str
    factor: Polynomial
    words: str
    latex: str
    verdict: Verdict
    extent: Extent = UNKNOWN
    components: int | None = None
    points: int | None = None
    open: str = ""
    remark: str = ""

    @property
    def dimension(self) -> int | None:
        """The real dimension, -1 when empty, None where it is not known."""
        return self.extent.dimension

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self.latex} = 0$"


@dataclass(frozen=True)
class ClassResult:
    """One of the 21 classes for a mechanism.

    extent: its real dimension.  components: connected components of a curve, each locus counted by itself and
    closed up, before points of other classes are taken out.  open: why a count is not known although it was
    looked for; remark: why it was not.
    steps: the steps of section 3.2 in which it was found or excluded.
    """

    singularity_class: SingularityClass
    verdict: Verdict
    pieces: tuple[Piece, ...]
    extent: Extent
    points: int | None
    components: int | None
    steps: tuple[str, ...]
    conditions: str
    open: str = ""
    remark: str = ""

    @property
    def dimension(self) -> int | None:
        """The real dimension, None where it is not known and where the class is empty."""
        return self.extent.dimension if self.extent.at_least >= 0 else None

    @property
    def types(self) -> SingularityType:
        """The types of the class."""
        return self.singularity_class.types

    @property
    def witnesses(self) -> tuple[Configuration, ...]:
        """Certified configurations, those of the largest pieces first."""
        return tuple(w for piece in self.pieces for w in piece.witnesses)

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self.conditions}$" if self.conditions else "no configuration"


@dataclass(frozen=True)
class SpacePiece:
    """A piece of the configuration space: its dimension, whether it is smooth, its generic defects."""

    extent: Extent
    smooth: str
    defects: Defects
    verdict: Verdict
    basis: Equations = ()
    remark: str = ""

    @property
    def dimension(self) -> int | None:
        """The real dimension, None where it is not known."""
        return self.extent.dimension


@dataclass(frozen=True)
class Classification:
    """Everything found out about a mechanism's singularities; see `as_json` for the fields in plain data.

    mechanism: None where a velocity equation was given by itself; seed: of all random choices; remarks: what
    is to be said of the conditions as a whole.
    """

    mechanism: Mechanism | None
    equation: VelocityEquation
    reduction: Reduction
    configuration_space: tuple[SpacePiece, ...]
    loci: tuple[Locus, ...]
    classes: tuple[ClassResult, ...]
    engines: tuple[str, ...]
    seconds: float = field(compare=False)
    seed: int = field(default=0, compare=False)
    remarks: tuple[str, ...] = ()

    @property
    def undecided(self) -> bool:
        """Whether a class, a dimension or a number is open, of the classes, the loci or the space."""
        return any(True for _ in self.open_questions())

    def notes(self) -> tuple[str, ...]:
        """All remarks, of the whole, of loci and of classes, each once."""
        of_loci, of_classes = (x.remark for x in self.loci), (x.remark for x in self.classes)
        return tuple(filter(None, dict.fromkeys((*self.remarks, *of_loci, *of_classes))))

    def open_questions(self) -> Iterator[tuple[str, str]]:
        """What is not decided, each with the reason."""
        for piece in self.configuration_space:
            if piece.dimension is None:
                yield "dimension of the configuration space", piece.extent.open
        for number, locus in enumerate(self.loci, 1):
            yield from _open(f"locus {number} of ({locus.condition})", locus)
        for found in self.classes:
            yield from _open(f"class {found.singularity_class.number}", found)

    @property
    def parameters_note(self) -> str:
        """Which parameters have no value and count as dimensions; empty where all have."""
        names = self.equation.space.parameters
        return f"dimensions count {', '.join(names)}, which may vary" if names else ""

    def of(self, types: SingularityType) -> ClassResult:
        """The result for the class of exactly these types; raises `KeyError` for others."""
        for result in self.classes:
            if result.types == types:
                return result
        raise KeyError(f"{types!r} is not one of the {len(self.classes)} classes")

    def _repr_html_(self) -> str:
        headers = ("class", "types", "there?", "dimension", "points", "components", "step")
        rows = [
            (c.singularity_class.number, c.singularity_class.name, c.verdict.answer, *_sizes(c), *c.steps)
            for c in self.classes
        ]
        return _html_table(headers, rows)

    def as_json(self) -> dict[str, Any]:
        """The fields that `singsym classify --format json` prints."""
        return {
            "mechanism": self.mechanism.name if self.mechanism else "",
            "N": self.equation.N,
            "n": self.equation.n,
            "parameters": list(self.equation.space.parameters),
            "configuration_space": [
                {
                    **_extent(piece.extent),
                    "smooth": piece.smooth,
                    "delta": piece.defects.delta,
                    "types": piece.defects.types.names,
                    "certainty": piece.verdict.certainty,
                    "remark": piece.remark,
                }
                for piece in self.configuration_space
            ],
            "loci": [
                {
                    "condition": locus.condition,
                    "factor": str(locus.factor),
                    "latex": locus.latex,
                    "words": locus.words,
                    **_extent(locus.extent),
                    "components": locus.components,
                    "points": locus.points,
                    "verdict": str(locus.verdict.answer),
                    "reason": locus.verdict.reason or locus.open or locus.remark,
                }
                for locus in self.loci
            ],
            "classes": [
                {
                    "number": result.singularity_class.number,
                    "types": result.types.names,
                    "verdict": str(result.verdict.answer),
                    "certainty": str(result.verdict.certainty),
                    **_extent(result.extent),
                    "dimension": result.dimension,
                    "points": result.points,
                    "components": result.components,
                    "witnesses": [w.as_json() for w in result.witnesses],
                    "conditions": result.conditions,
                    "steps": list(result.steps),
                    "reason": result.verdict.reason or result.open or result.remark,
                }
                for result in self.classes
            ],
            "open": [{"what": what, "reason": reason} for what, reason in self.open_questions()],
            "remarks": list(self.notes()),
            "engines": list(self.engines),
            "seed": self.seed,
            "seconds": round(self.seconds, 3),
        }


def _extent(extent: Extent) -> dict[str, Any]:
    """A dimension, None where it is not known, with what is known of it then; None for an empty set."""
    found: dict[str, Any] = {"dimension": extent.dimension}
    if extent.dimension is None and extent.at_least >= 0:
        found |= {"at_least": extent.at_least, "dimension_reason": extent.open}
    elif extent.bounded != "proven":
        found["dimension_reason"] = "that it is no larger rests on random primes"
    return found


def _open(what: str, found: Locus | ClassResult) -> Iterator[tuple[str, str]]:
    """What is not known of a locus or a class, each with the reason."""
    if found.verdict.is_undecided:
        yield what, found.verdict.reason
    elif found.verdict.is_yes and found.dimension is None:
        yield f"dimension of {what}", found.extent.open
    elif found.open:
        yield f"number of {what}", found.open


def conditions_latex(pieces: Sequence[Piece]) -> str:
    """The equations and inequations of a class as LaTeX: the factors on the way to each piece."""
    lines: dict[str, None] = {}
    for piece in pieces:
        equal = [f"{polynomial_latex(p)} = 0" for p in piece.path]
        unequal = [_nonzero_latex(e) for e in piece.exclusions]
        lines[r",\; ".join((*equal, *unequal))] = None
    return r" \quad\text{or}\quad ".join(lines)


def _nonzero_latex(exclusion: tuple[Polynomial, ...]) -> str:
    if len(exclusion) == 1:
        factors = [p for p, _ in exclusion[0].factors()]
        if len(factors) > 1:
            return r",\; ".join(f"{polynomial_latex(p)} \\ne 0" for p in factors)
        return f"{polynomial_latex(exclusion[0])} \\ne 0"
    listed = ", ".join(polynomial_latex(p, 6) for p in exclusion)
    return rf"\left({listed}\right) \ne 0"


def _sizes(result: ClassResult) -> tuple[str, str, str]:
    """Dimension, points and components, blank where there is none or it is not known."""
    dimension, points, components = (
        "" if x is None else str(x) for x in (result.dimension, result.points, result.components)
    )
    return dimension, points, components


def _html_table(headers: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A plain table, as notebooks show it."""
    head = "".join(f"<th>{escape(h)}</th>" for h in headers)
    body = "".join("<tr>" + "".join(f"<td>{escape(str(x))}</td>" for x in row) + "</tr>" for row in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"
