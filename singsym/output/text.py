"""Mechanisms, classes and configurations as pages of text.

Source: the layouts of Tables 1 and 2 of Zlatanov, Fenton, Benhabib (1998).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from math import degrees
from typing import TYPE_CHECKING

from singsym.effort.verdict import described
from singsym.mechanism.choices import is_redundant
from singsym.output.page import Block, Grid, Page
from singsym.output.pieces import (
    alike,
    angles_counted_elsewhere,
    extent_of,
    filled,
    grouped,
    loop_equations,
    moving,
    named_polynomials,
    varying,
)

if TYPE_CHECKING:
    from singsym.classes.configuration.at import Analysis
    from singsym.classes.configuration.null_motions import Motion
    from singsym.classes.result import Classification, ClassResult, Configuration, Locus, SpacePiece
    from singsym.classes.solve import Solution
    from singsym.classes.taxonomy.types import SingularityType, Table
    from singsym.conditions.named_lengths import NamedLengths
    from singsym.kinematics.mobility import Mobility
    from singsym.kinematics.velocity import VelocityEquation
    from singsym.mechanism.model import Coupling, Joint, Mechanism, Output, Parameter
    from singsym.polynomials import Polynomial, PolynomialMatrix

LONGEST = 12
"""Polynomials with more terms are cut, with the number of terms left out."""

NO_SPACE = "Configuration space: no piece of it is known"

WIDEST = 30
"""A matrix with a longer entry is not printed as a grid in the terminal."""

_SPACE = ("piece", "dimension", "smooth", "remark")
_LOCI = ("locus", "condition", "factor", "dimension", "components", "points")
_CLASSES = ("class", "types", "there?", "known by", "dimension", "points", "components", "step")

# -- the mechanism -----------------------------------------------------------------------------------


def mechanism_page(mechanism: Mechanism, equation: VelocityEquation) -> Page:
    """A mechanism's parts, its loop equations and its velocity equation."""
    space = equation.space
    head = [f"{mechanism.name}: {mechanism.title}" if mechanism.title else mechanism.name]
    if mechanism.description:
        head.append(mechanism.description.strip())
    if mechanism.source:
        head.append(f"Source: {mechanism.source}")
    inputs = ", ".join(mechanism.inputs)
    outputs = "; ".join(output_text(o) for o in mechanism.outputs)
    facts = [
        f"{mechanism.space} mechanism, N = {equation.N}, n = {equation.n}",
        f"Inputs: {inputs}",
        f"Output: {outputs}",
        *(["Redundant: RI in every configuration"] if is_redundant(mechanism) else []),
        *(f"Parameter: {_parameter_text(p)}" for p in mechanism.parameters),
        *(f"Left out: {e.words or ' = '.join(e.points) or e.expression}" for e in mechanism.exclusions),
        *(f"Coupled: {coupling_text(c)}" for c in mechanism.couplings),
    ]
    joints = tuple(_joint_row(j, mechanism) for j in mechanism.joints)
    variables = "\n".join(
        (
            f"Configuration variables ({space.formulation}): {', '.join(space.variables)}",
            *(f"  {line}" for line in angles_counted_elsewhere(equation)),
        )
    )
    equations = [f"  {e.short_text(LONGEST)} = 0" for e in loop_equations(equation)]
    return (
        "\n".join(head),
        "\n".join(facts),
        Grid(("joint", "kind", "between", "and", "point", "role"), joints),
        "\n".join([variables, "Loop equations:", *equations]) if equations else variables,
        *matrix_page("L", equation.L, equation.rows, [c.label for c in equation.columns]),
    )


def _joint_row(joint: Joint, mechanism: Mechanism) -> tuple[str, ...]:
    active = [c for c in joint.columns if c in mechanism.inputs]
    role = "input" if active == list(joint.columns) else ", ".join(active)
    point = joint.at[0] if joint.at[0] == joint.at[1] else f"{joint.at[0]} / {joint.at[1]}"
    return (joint.name, joint.kind.value, joint.first, joint.second, point, role or "passive")


def output_text(output: Output) -> str:
    """An output in words."""
    from singsym.mechanism.model import JointRate, PointVelocity

    if isinstance(output, JointRate):
        return f"the rate of {output.column}"
    components = ", ".join(output.components)
    if isinstance(output, PointVelocity):
        return f"the velocity of {output.point} ({components})"
    return f"the twist of {output.link} at {output.point} ({components})"


def coupling_text(coupling: Coupling) -> str:
    """The relation between the joints' values: whatever the constant, that of their rates has zero for it."""
    return f"{coupling.name}, {coupling.relation}"


def _parameter_text(parameter: Parameter) -> str:
    if parameter.value is not None:
        return f"{parameter.name} = {parameter.value}"
    low = "" if parameter.low is None else f"{parameter.low} < "
    high = "" if parameter.high is None else f" < {parameter.high}"
    return f"{low}{parameter.name}{high}"


def mobility_page(name: str, equation: VelocityEquation, found: Mobility) -> Page:
    """What `check` says: generic ranks against those of a nonsingular configuration."""
    N, n = equation.N, equation.n
    wanted = {"L": N, "L_I": N, "L_O": N, "L_p": N - n}
    rows = tuple((key, str(rank), str(wanted[key])) for key, rank in found.ranks.items())
    seen = f"{found.samples} random configurations, {found.regular} of them regular"
    head = f"{name}: N = {N}, n = {n}; {seen}"
    said = "\n".join(f"Problem: {m}" for m in found.messages) or "No problem found."
    return (head, Grid(("matrix", "largest rank seen", "expected"), rows), said)


def matrix_page(
    name: str, matrix: PolynomialMatrix, rows: Sequence[str], columns: Sequence[str]
) -> tuple[Block, ...]:
    """A matrix as a grid with labels; only its size where an entry is long."""
    cells = [[str(e) if e else "." for e in row] for row in matrix.rows]
    size = f"{name}, {matrix.shape[0]}x{matrix.shape[1]}"
    if any(len(cell) > WIDEST for row in cells for cell in row):
        return (f"{size}: entries too long to print here; see --format latex or json",)
    body = tuple((label, *row) for label, row in zip(rows, cells, strict=True))
    return (Grid(("", *columns), body, size),)


# -- classes -----------------------------------------------------------------------------------------


def classes_page(table: Table, n: int) -> Page:
    """Table 1: the classes that mobility n allows, by number."""
    rows = tuple(
        (str(row), *(str(c.number) if c is not None else "." for c in cells))
        for row, cells in zip(table.rows, table.cells, strict=True)
    )
    count = sum(c is not None for cells in table.cells for c in cells)
    title = f"The {count} classes for n = {n}{' or more' if n >= 3 else ''} (a dot: impossible)"
    return (Grid(("", *(str(c) for c in table.columns)), rows, title), _legend())


def _legend() -> str:
    """The types explained."""
    from singsym.classes.taxonomy.types import SingularityType

    return types_text(SingularityType)


def types_text(types: Iterable[SingularityType]) -> str:
    """What types say of a configuration, each on a line."""
    head = "The types; motions are velocities at the configuration"
    return "\n".join([head, *(f"  {line}" for kind in types for line in kind.explained)])


def classification_page(result: Classification) -> Page:
    """What was found: at a glance, class by class with configurations, then loci and what is open."""
    from singsym.classes.gathering import gathered
    from singsym.classes.summary import empty_text, shown_classes

    name = result.mechanism.name if result.mechanism is not None else "given equations"
    equation, shown = result.equation, shown_classes(result)
    sizes = f"{name}: N = {equation.N}, n = {equation.n}"
    head = "; ".join(filter(None, (sizes, result.parameters_note, result.lengths_note)))
    pieces = result.configuration_space
    space = tuple(_space_row(i if len(pieces) > 1 else 0, piece) for i, piece in enumerate(pieces, 1))
    names = named_polynomials(result)
    loci = tuple(_locus_row(i, locus, result.lengths, names) for i, locus in enumerate(result.loci, 1))
    blocks: list[Block] = ["\n".join(result.summary), head]
    if shown:
        some_open = any(c.verdict.is_undecided for c in shown)
        title = "Classes that occur or are open" if some_open else "The classes that occur"
        blocks.append(_lean(_CLASSES, tuple(_class_row(c, result, some_open) for c in shown), title))
    blocks += filter(None, [empty_text(result)])
    blocks += [_class_text(found, result, names) for found in shown if found.verdict.is_yes]
    blocks += ["\n".join(f"{name} = {p.short_text(6)}" for p, name in names.items())] if names else []
    if types := {kind for found in shown for kind in found.types}:
        blocks.append(types_text(sorted(types, key=lambda kind: kind.value)))
    if loci:
        blocks.append(_lean(_LOCI, loci, "The singularity set: loci of conditions (4) and (5)"))
    blocks.append(_lean(_SPACE, space, "Configuration space") if space else NO_SPACE)
    if notes := result.notes():
        blocks.append("\n".join(notes))
    if questions := gathered(result.open_questions()):
        blocks.append("\n".join(["Open", *(f"  {what}: {why}" for what, why in questions)]))
    blocks.append(f"Engines: {', '.join(result.engines)}; seed {result.seed}; {result.seconds:.1f} s")
    return tuple(blocks)


def _count(number: int | None) -> str:
    return "" if number is None else str(number)


def _lean(headers: tuple[str, ...], rows: tuple[tuple[str, ...], ...], title: str) -> Grid:
    """A grid without its empty columns."""
    kept = filled(headers, rows)
    lines = tuple(tuple(row[j] for j in kept) for row in rows)
    return Grid(tuple(headers[j] for j in kept), lines, title)


def _space_row(number: int, piece: SpacePiece) -> tuple[str, ...]:
    """number: 0 where there is only one."""
    return (str(number or ""), str(piece.extent), piece.smooth, piece.remark)


def _locus_row(
    number: int, locus: Locus, lengths: NamedLengths, names: Mapping[Polynomial, str]
) -> tuple[str, ...]:
    from singsym.classes.result import counts

    factor = lengths.shown(locus.factor)
    shown = locus.words or names.get(factor) or factor.short_text(6)
    points, components = counts(locus)
    return (str(number), f"({locus.condition})", shown, str(locus.extent), components, points)


def _class_row(result: ClassResult, whole: Classification, some_open: bool) -> tuple[str, ...]:
    """some_open: whether it has to be said that the class occurs."""
    from singsym.classes.result import counts
    from singsym.classes.summary import known_by

    verdict = result.verdict
    return (
        str(result.singularity_class.number),
        str(result.types),
        str(verdict.answer) if some_open else "",
        known_by(whole, result.singularity_class.number),
        extent_of(result),
        *counts(result),
        ", ".join(result.steps),
    )


def _class_text(result: ClassResult, whole: Classification, names: Mapping[Polynomial, str]) -> str:
    """A class that occurs: its pieces by what vanishes on the way, and one configuration."""
    lines = [f"{result.singularity_class.number} ({result.types})"]
    for group in grouped(result.pieces, whole.loci, whole.lengths):
        count = f", {group.points} points" if group.points is not None else ""
        lines.append(f"  dimension {group.extent}{count}: {group.text(names)}")
    lines += [
        f"  perhaps also: {group.text(names)}" for group in grouped(result.unsure, whole.loci, whole.lengths)
    ]
    lines += [f"  for instance {configuration_text(w, whole.equation)}" for w in result.witnesses[:1]]
    return "\n".join(lines)


def configuration_text(found: Configuration, equation: VelocityEquation, digits: int = 7) -> str:
    """A certified configuration: moving points, else the variables; joint values on a line of their own."""
    named = points_text(moving(found.points, equation), digits) or values_text(
        varying(found.coordinates, equation), digits
    )
    joints = joints_text(found.joints, equation, digits)
    return f"{named}\n    {joints}" if joints else named


def points_text(points: Mapping[str, str | float], digits: int = 7) -> str:
    """Points from their coordinates by name, as `B.x`.

    >>> points_text({"B.x": "0.25", "B.y": "1e-40"})
    'B = (0.25, 0)'
    """
    places: dict[str, list[str]] = {}
    for name, value in points.items():
        places.setdefault(name.rpartition(".")[0], []).append(number_text(value, digits))
    return ", ".join(f"{name} = ({', '.join(place)})" for name, place in places.items())


def values_text(values: Mapping[str, str | float], digits: int = 7) -> str:
    """Names with their values."""
    return ", ".join(f"{name} = {number_text(value, digits)}" for name, value in values.items())


def joints_text(joints: Mapping[str, str | float], equation: VelocityEquation, digits: int = 7) -> str:
    """Joint values by name: angles, which come in radians, in degrees, and slides as they are.

    >>> from singsym.kinematics.velocity import velocity_equation
    >>> from singsym.mechanism import load
    >>> joints_text({"A": "3.1415926535897932", "P": "2"}, velocity_equation(load("slider-crank")))
    'A = 180 deg, P = 2'
    """
    said = []
    for name, value in joints.items():
        angle = name in equation.values and equation.values[name].cosine is not None
        said.append(
            f"{name} = {number_text(degrees(float(value)) if angle else value, digits)}{' deg' * angle}"
        )
    return ", ".join(said)


def number_text(value: str | float, digits: int) -> str:
    """A number for reading; what is zero but for rounding is 0."""
    number = float(value)
    return "0" if abs(number) < 1e-14 else f"{number:.{digits}g}"


def solution_page(name: str, solutions: Sequence[Solution], lengths: NamedLengths | None = None) -> Page:
    """The solution sets of conditions, piece by piece; lengths: those that have names."""
    from singsym.conditions.named_lengths import NamedLengths, values_text

    written = lengths or NamedLengths()
    values = written.occurring_in(p for s in solutions for piece in s.pieces for p in piece.path)
    blocks: list[Block] = [f"{name}: {values_text(values)}" if values else name]
    for solution in solutions:
        condition = solution.condition
        head = f"({condition.label}) {condition.statement}: {condition.types}"
        groups = alike(solution.pieces)
        rows = tuple(
            (
                str(number),
                ", ".join(f"{written.shown(p).short_text(6)} = 0" for p in piece.path) or "everywhere",
                "" if many == 1 else str(many),
                str(piece.extent),
                (_count(piece.points and many * piece.points) if piece.is_counted else "?"),
                "?" if piece.verdict.is_undecided else described(piece.verdict.certainty),
            )
            for number, (piece, *rest) in enumerate(groups, 1)
            for many in (1 + len(rest),)
        )
        shown = [
            f"  {number}: for instance {configuration_text(piece.witnesses[0], solution.equation)}"
            for number, pieces in enumerate(groups, 1)
            for piece in [p for p in pieces if p.witnesses][:2]
        ]
        if rows:
            headers = ("", "where", "parts", "dimension", "points", "known by")
            blocks.append(_lean(headers, rows, head))
            if shown:
                blocks.append("\n".join(shown))
        else:
            blocks.append(f"{head}\n  {solution.verdict}")
        blocks += [f"Undecided: {doubt}" for doubt in solution.doubts]
    return tuple(blocks)


# -- one configuration -------------------------------------------------------------------------------


def analysis_page(name: str, found: Analysis) -> Page:
    """Ranks, defects, types, class and null motions of one configuration."""
    N, n = found.equation.N, found.equation.n
    head = f"{name}: N = {N}, n = {n}"
    points = {f"{p}.{axis}": x for p, xs in found.points.items() for axis, x in zip("xyz", xs, strict=False)}
    places = points_text(points) or values_text(found.values)
    where = "\n".join(filter(None, (places, joints_text(found.joints, found.equation))))
    ranks = tuple(
        (name, str(m.rank), str(m.full), _finite(f"{m.distance:.2e}"), _finite(f"{m.gap:.1e}"))
        for name, m in found.matrices.items()
    )
    headers = ("matrix", "rank", "regular", "distance", "gap")
    delta, p, k_I, k_O = found.defects
    number = found.singularity_class.number if found.singularity_class else 0
    types = f"class {number} ({found.types})" if number else str(found.types)
    if found.undecided:
        types = f"undecided, as {found.undecided}: give more digits"
    result = f"delta = {delta}, p = {p}, k_I = {k_I}, k_O = {k_O}: {types}"
    blocks: list[Block] = [head, where, _how(found), Grid(headers, ranks), result]
    if found.motions:
        blocks.append("\n".join(motion_text(m) for m in found.motions))
    if found.remarks:
        blocks.append("\n".join(f"Note: {remark}." for remark in found.remarks))
    return tuple(blocks)


def _finite(number: str) -> str:
    return "" if number == "inf" else number


def _how(found: Analysis) -> str:
    from singsym.classes.configuration.given_values import DOUBLE_DIGITS

    distance = "distance: to the nearest matrix of too low a rank, by singular values"
    scaled = f"lengths over {found.length:.4g}, unit joint screws"
    if found.located is None:
        return f"The configuration is exact, and so are the ranks.\n{distance}; {scaled}."
    near = found.located
    many = f", with {found.digits} digits" if found.digits > DOUBLE_DIGITS else ""
    return (
        f"Brought onto the loops{many}: residual {near.before:.2e} before, {near.after:.2e} after, "
        f"moved by {near.moved:.2e}, relative to the sizes.\n"
        f"Ranks are numerical: {scaled}; singular values below {found.threshold:.1e} count as zero.\n"
        f"{distance}; gap: last counted singular value over the next."
    )


def motion_text(motion: Motion) -> str:
    """A null motion, or a restriction, on one line."""
    if motion.restriction:
        terms = " + ".join(f"{rate:.5g} {label}" for label, rate in motion.rates.items())
        return f"{motion.type.name}: only velocities with {terms} = 0 are possible".replace("+ -", "- ")
    rates = ", ".join(f"{label} {rate:.5g}" for label, rate in motion.rates.items())
    return f"{motion.type.name}: {rates}"
