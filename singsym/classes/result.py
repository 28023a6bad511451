"""The result of a classification: loci, the 21 classes, their pieces and witnesses, as data.

Source: Zlatanov, Fenton, Benhabib (1998), section 3.2 and the layout of Table 2.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

from singsym.classes.gathering import gathered
from singsym.classes.taxonomy.types import Defects, SingularityClass, SingularityType
from singsym.conditions.named_lengths import NamedLengths, named_lengths, values_text
from singsym.effort.verdict import Verdict
from singsym.kinematics.reduction import Reduction
from singsym.kinematics.velocity import VelocityEquation
from singsym.mechanism.model import Mechanism
from singsym.polynomials import Equations, Polynomial
from singsym.varieties.real.dimension.extent import UNKNOWN, Extent

if TYPE_CHECKING:
    from singsym.output.figures.style import Picture


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

    def floats(self) -> dict[str, float]:
        """Coordinates, points and joints as floats, by name; the decimals have more digits.

        >>> Configuration({"Bx": "0.25"}, {"B.x": "0.25"}, {"A": "1.318"}, "1e-3").floats()
        {'Bx': 0.25, 'B.x': 0.25, 'A': 1.318}
        """
        return {name: float(value) for name, value in self.decimals().items()}

    def decimals(self) -> dict[str, str]:
        """Coordinates, points and joints together, as decimal strings by name."""
        return {**self.coordinates, **self.points, **self.joints}

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

    extent: its real dimension.  components: connected components of a curve, each piece counted by itself and
    closed up, before points of other classes are taken out.  open: why a count is not known although it was
    looked for; remark: why it was not.
    steps: the steps of section 3.2 in which it was found or excluded.
    unsure: further pieces, of which neither a point is known nor that there is none.
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
    unsure: tuple[Piece, ...] = ()

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
    """Everything found out about a mechanism's singularities.

    `result[4]` and `result["RO, II"]` are single classes; iteration goes through all.
    mechanism: None where a velocity equation was given by itself; seed: of all random choices; remarks: what
    is to be said of the conditions as a whole; interrupted: whether a user ended the work.
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
    interrupted: bool = False

    @property
    def undecided(self) -> bool:
        """Whether a class, a dimension or a number is open, of the classes, the loci or the space."""
        return any(True for _ in self.open_questions())

    def notes(self) -> tuple[str, ...]:
        """What is to be said beside the numbers, of the whole and of loci and classes, each once."""
        remarks = [(what, remark) for what, found in self._counted() for remark in _remarks(found)]
        return (*self.remarks, *(f"{what}: {remark}" for what, remark in gathered(remarks)))

    def open_questions(self) -> Iterator[tuple[str, str]]:
        """What is not decided, each with the reason."""
        if not self.configuration_space and any(c.verdict.is_undecided for c in self.classes):
            yield "the configuration space", "no piece of it is known"
        for number, piece in enumerate(self.configuration_space, 1):
            if piece.dimension is None:
                which = f", piece {number}" if len(self.configuration_space) > 1 else ""
                yield f"dimension of the configuration space{which}", piece.extent.open
        for what, found in self._counted():
            yield from _open(what, found)

    def _counted(self) -> Iterator[tuple[str, Locus | ClassResult]]:
        """Loci and classes, each with what it is called."""
        for number, locus in enumerate(self.loci, 1):
            yield f"locus {number}", locus
        for found in self.classes:
            yield f"class {found.singularity_class.number}", found

    @property
    def summary(self) -> tuple[str, ...]:
        """Where the mechanism locks and goes slack, and what is known of the classes, in a few lines."""
        from singsym.classes.summary import summary

        return summary(self)

    @cached_property
    def lengths(self) -> NamedLengths:
        """The factors of (4) and (5) in the names of the lengths that have values."""
        if self.mechanism is None:
            return NamedLengths()
        return named_lengths(self.mechanism, self.equation, ("4", "5"))

    @property
    def lengths_note(self) -> str:
        """The lengths whose names are in the loci, with their values; empty where there are none."""
        return values_text(self.lengths.occurring_in(locus.factor for locus in self.loci))

    @property
    def parameters_note(self) -> str:
        """Which parameters have no value and count as dimensions, and which mountings; empty without any."""
        space = self.equation.space
        names = (*space.parameters, *(f"how {name} is mounted" for name in space.mountings))
        return f"dimensions count {', '.join(names)}, which may vary" if names else ""

    def __iter__(self) -> Iterator[ClassResult]:
        """All classes, by their numbers."""
        return iter(self.classes)

    def __getitem__(self, key: int | str | SingularityType) -> ClassResult:
        """The result for a class, by its number (`4`), or by exactly its types (`"RO, II"`, in any order).

        Raises `KeyError` where there is no such class.
        """
        wanted = key
        if isinstance(key, str):
            with suppress(KeyError):
                wanted = SingularityType.named(key)
        for result in self.classes:
            if wanted in (result.singularity_class.number, result.types):
                return result
        raise KeyError(f"{key!r}: expected a number from 1 to {len(self.classes)}, or types as 'RO, II'")

    def table(self) -> list[dict[str, Any]]:
        """The classes as rows of plain data, for example for `pandas.DataFrame(result.table())`."""
        from singsym.output.plain_data import class_rows

        return class_rows(self)

    def to_dict(self) -> dict[str, Any]:
        """Everything as plain data to be read by people and programs: what `--format json` prints."""
        from singsym.output.plain_data import classification_data

        return classification_data(self)

    def to_json(self) -> str:
        """Everything as text from which `from_json` makes an equal classification again.

        Raises `ValueError` for a mechanism that no file can describe.
        """
        from singsym.classes.result_file import dumps

        return dumps(self)

    @classmethod
    def from_json(cls, text: str) -> Classification:
        """The classification that `to_json` wrote; raises `ValueError` for any other text.

        Only a version of singsym whose results have the same parts reads it.
        """
        from singsym.classes.result_file import loads

        return loads(text)

    def plot(
        self, what: int | str | SingularityType | None = None, *, witness: int | None = None, ax: Any = None
    ) -> Picture:
        """A picture, which a notebook shows and `Picture.save` writes.

        what: a class as for `result[...]`, at its configuration number `witness` (None: the one farthest from
        degenerate); "inputs" or "outputs", the singularity curves over two of these; "regions", those free of
        singularities over two inputs; "strata", which class borders on which; None: the mechanism.
        ax: axes of matplotlib to draw on, but for regions; None: those of a new figure.
        Raises `ValueError` where there is nothing to draw, `KeyError` where there is no such class.
        """
        from singsym.output.pictures import picture

        return picture(self, what, witness=witness, axes=ax)

    def report(self, path: str | Path, certificate: str | Path | None = None) -> Path:
        """Write one HTML page with everything, which loads nothing from elsewhere; raises `OSError`.

        certificate: a file of one; each class is linked to its lines. `ValueError` where it is rejected.
        """
        from singsym.output.html.report import report

        target = Path(path)
        target.write_text(report(self, certificate), encoding="utf-8")
        return target

    def _repr_html_(self) -> str:
        from singsym.classes.summary import empty_text, shown_classes

        headers = ("class", "types", "there?", "dimension", "points", "components", "step")
        rows = [
            (c.singularity_class.number, c.singularity_class.name, c.verdict.answer, *_sizes(c), *c.steps)
            for c in shown_classes(self)
        ]
        questions = gathered(self.open_questions())
        parts = ["<br>".join(map(escape, self.summary)), _html_table(headers, rows) if rows else ""]
        parts += [escape(empty_text(self)), _html_table(("open", "why"), questions) if questions else ""]
        parts += map(escape, self.notes())
        return "".join(p if p.startswith("<table") else f"<p>{p}</p>" for p in parts if p)


def _open(what: str, found: Locus | ClassResult) -> Iterator[tuple[str, str]]:
    """What is not known of a locus or a class, each with the reason."""
    if found.verdict.is_undecided:
        yield f"occurrence of {what}", found.verdict.reason
    elif found.verdict.is_yes and found.dimension is None:
        yield f"dimension of {what}", found.extent.open
    elif found.open or (_is_uncounted(found) and not found.remark):
        parts = "points" if found.dimension == 0 else "components"
        yield f"number of {parts} of {what}", found.open or found.verdict.reason or "it was not counted"
    if found.verdict.is_yes and isinstance(found, ClassResult):
        for reason in dict.fromkeys(piece.verdict.reason for piece in found.unsure):
            yield f"occurrence of parts of {what}", reason


def _is_uncounted(found: Locus | ClassResult) -> bool:
    """Whether there is a number of points, or of components of a curve, that is not known."""
    points, curve = found.dimension == 0, found.dimension == 1
    return (points and found.points is None) or (curve and found.components is None)


def _remarks(found: Locus | ClassResult) -> Iterator[str]:
    """What is not known of a locus or a class as it was not looked for, and what rests on random primes."""
    if found.verdict.is_yes and found.dimension is not None:
        said = (
            found.remark,
            found.verdict.reason if isinstance(found, ClassResult) else found.extent.resting,
        )
        yield from filter(None, said)


def counts(found: Locus | ClassResult) -> tuple[str, str]:
    """The numbers of points and of connected components as text, "" where there are none to count.

    "?" where one is open, "not counted" where it was not looked for.
    """
    at_least = found.extent.at_least
    if found.verdict.is_no or at_least > 1:
        return "", ""
    missing = "not counted" if found.remark and not found.open else "?"
    points, components = (missing if x is None else str(x) for x in (found.points, found.components))
    if found.dimension == 0 and found.components is None:
        components = "" if found.points is not None else missing
    return ("" if at_least == 1 else points), components


def _sizes(result: ClassResult) -> tuple[str, str, str]:
    """Dimension, points and components, blank where there is none."""
    return "" if result.verdict.is_no else str(result.extent), *counts(result)


def _html_table(headers: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A plain table, as notebooks show it."""
    head = "".join(f"<th>{escape(h)}</th>" for h in headers)
    body = "".join("<tr>" + "".join(f"<td>{escape(str(x))}</td>" for x in row) + "</tr>" for row in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"
