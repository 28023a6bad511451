"""The report: one self-contained HTML page with the classes, figures, equations and proofs of a mechanism.

Source: the layout follows section 3.3 and Table 2 of Zlatanov, Fenton, Benhabib (1998).
"""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from pathlib import Path

from singsym.classes.configuration.null_motions import Motion
from singsym.classes.gathering import gathered
from singsym.classes.result import Classification, ClassResult, Piece
from singsym.classes.summary import empty_classes, known_by, shown_classes
from singsym.classes.taxonomy.types import SingularityType
from singsym.mechanism.model import JointRate, Mechanism, Space
from singsym.output.figures.families import families
from singsym.output.html import mathml as math
from singsym.output.html import page as html
from singsym.output.html.certificate import Proof, certificate, linked
from singsym.output.html.curves import curves
from singsym.output.html.proofs import proofs
from singsym.output.pieces import (
    angles_counted_elsewhere,
    counted,
    extent_of,
    loop_equations,
    moving,
    parts_of,
    varying,
)
from singsym.output.text import number_text
from singsym.polynomials import Polynomial, PolynomialMatrix

LARGEST_MATRIX = 400
"""Matrices with more entries are left out of the page."""

SHORT = 8
"""Terms of a locus shown in lists and tables; all are among the equations, where the link leads."""

WITNESSES = 24
"""Not more configurations of a class are listed."""


def report(classification: Classification, certified: str | Path | None = None) -> str:
    """The page as text: write it to a file that ends in `.html`; it loads nothing from elsewhere.

    certified: the file of a certificate, to whose lines each class is linked; raises `OSError`, and
    `ValueError` where it is rejected, or is about other equations.

    >>> from singsym.classes.classify import classify
    >>> from singsym.mechanism import load
    >>> page = report(classify(load("slider-crank"), cache=False))
    >>> page[:15], "<math" in page, "class-1" in page
    ('<!DOCTYPE html>', True, True)
    """
    from singsym.output.html.scenes import script, style

    proof = None if certified is None else Proof.of(classification, certified)
    name = _title(classification)
    sections = [
        ("singularity-set", "Singularity set", _summary(classification, proof)),
        ("classes", "Classes", _classes(classification)),
        ("curves", "Singularity curves", curves(classification)),
        ("strata", "Strata", _strata(classification)),
        ("equations", "Equations", _equations(classification)),
        ("proofs", "Proofs", proofs(classification, proof)),
        ("certificate", "Certificate", certificate(proof) if proof else ""),
    ]
    shown = [(key, title, body) for key, title, body in sections if body]
    links = "".join(f'<li><a href="#{key}">{title}</a></li>' for key, title, _ in shown)
    parts = [f"<header><h1>{escape(name)}</h1>{_head(classification)}</header>"]
    parts.append(f'<nav aria-label="Contents"><ul>{links}</ul></nav><main>')
    parts += [f'<section id="{key}"><h2>{title}</h2>{body}</section>' for key, title, body in shown]
    work = f"{', '.join(classification.engines)}; seed {classification.seed}; {classification.seconds:.1f} s"
    parts.append(f'</main><footer class="note"><p>singsym, with {escape(work)}</p></footer>')
    return html.page(f"Singularities: {name}", "\n".join(parts), script(), style())


def _title(classification: Classification) -> str:
    mechanism = classification.mechanism
    return "Given equations" if mechanism is None else mechanism.title or mechanism.name


def _head(classification: Classification) -> str:
    """What the mechanism is, with a figure."""
    mechanism, equation = classification.mechanism, classification.equation
    facts = [f"N = {equation.N} joints of one degree of freedom, mobility n = {equation.n}"]
    if classification.parameters_note:
        facts.append(classification.parameters_note)
    if classification.lengths_note:
        facts.append(classification.lengths_note)
    if mechanism is None:
        return f"{_glance(classification)}<p>{'; '.join(facts)}.</p>"
    outputs = [
        f"rate of {o.column}"
        if isinstance(o, JointRate)
        else f"motion of {o.point} ({', '.join(o.components)})"
        for o in mechanism.outputs
    ]
    facts += [f"Inputs: {', '.join(mechanism.inputs)}", f"Output: {'; '.join(outputs)}"]
    lines = "".join(f"<li>{escape(fact)}</li>" for fact in facts)
    text = f"<p>{escape(mechanism.description.strip())}</p>" if mechanism.description else ""
    source = f'<p class="note">Source: {escape(mechanism.source)}</p>' if mechanism.source else ""
    drawn = _portrait(classification, mechanism)
    glance = _glance(classification)
    return f'<div class="class"><div>{glance}{text}<ul>{lines}</ul>{source}</div><div>{drawn}</div></div>'


def _portrait(classification: Classification, mechanism: Mechanism) -> str:
    """The mechanism in a regular configuration, to be turned where it is of space.

    Where none is found numerically it is drawn in a singular one; "" where none of these is known either.
    """
    from singsym.output.figures.figure import plot_mechanism
    from singsym.output.figures.poses import portrait
    from singsym.output.figures.scene import Stage
    from singsym.output.html.scenes import Track, scene_box

    stage = Stage.of(mechanism, classification.equation)
    try:
        point = portrait(stage)
    except ValueError:
        witness = next((w for c in classification.classes for w in c.witnesses), None)
        if witness is None:
            return ""
        point = stage.vector(witness.coordinates)
    names = stage.placement.space.ring.names
    coordinates = dict(zip(names, point.tolist(), strict=True))
    picture = plot_mechanism(mechanism, coordinates, equation=classification.equation)
    drawn = html.figure(picture, "mechanism")
    if mechanism.space is Space.PLANAR:
        return drawn
    note = '<p class="note">Drag, or use the arrow keys, to turn it; Home turns it back.</p>'
    return drawn + scene_box(stage, [Track("", point[None])], mechanism.title or mechanism.name) + note


def _glance(classification: Classification) -> str:
    """What a designer asks, answered."""
    return html.listed(classification.summary, "glance")


# -- summary -------------------------------------------------------------------------------------------


def _summary(classification: Classification, proof: Proof | None) -> str:
    space = [
        f"<li>Configuration space: dimension {p.extent}, smooth: {escape(p.smooth)}"
        f"{'; ' + escape(p.remark) if p.remark else ''}</li>"
        for p in classification.configuration_space
    ] or ["<li>Configuration space: no piece of it is known</li>"]
    rows = []
    for i, locus in enumerate(classification.loci):
        style = "no" if locus.verdict.is_no else "undecided" if locus.verdict.is_undecided else ""
        size = str(locus.extent)
        link = f'<a href="#locus-{i}">{i + 1}</a>'
        said = (link, f"({escape(locus.condition)})", escape(locus.words), size, parts_of(locus))
        rows.append((style, (*said, _locus_name(classification, i))))
    headers = ("locus", "condition", "in words", "dimension", "parts", "vanishes")
    loci = html.table(headers, rows, "Loci of conditions (4) and (5)") if rows else ""
    return (
        f"<ul>{''.join(space)}</ul>"
        "<p>Conditions (4) and (5), det L<sub>I</sub> = 0 and det L<sub>O</sub> = 0, in factors:</p>"
        f"{loci}<h3>The classes</h3>{_class_table(classification, proof)}{_open(classification)}"
    )


def _open(classification: Classification) -> str:
    """What is to be said beside the tables, and what is not decided."""
    notes = "".join(f"<li>{escape(note)}</li>" for note in classification.notes())
    rows = [("", (escape(what), escape(why))) for what, why in gathered(classification.open_questions())]
    listed = f"<h3>Open</h3>{html.table(('what', 'why'), rows, 'What is open')}" if rows else ""
    return (f"<ul>{notes}</ul>" if notes else "") + listed


def _locus_name(classification: Classification, index: int) -> str:
    """The name of a determinant if it has one, else the polynomial, short."""
    locus = classification.loci[index]
    head, named, _ = locus.latex.partition(" = ")
    if named and locus.words:
        return math.formula(math.name(head))
    return math.terms(classification.lengths.shown(locus.factor), longest=SHORT)


def _class_table(classification: Classification, proof: Proof | None) -> str:
    rows = []
    for result in shown_classes(classification):
        number, verdict = result.singularity_class.number, result.verdict
        target = f"class-{number}" if verdict.is_yes else f"proof-{number}"
        style = "undecided" if verdict.is_undecided else ""
        cells = (
            f'<a href="#{target}">{number}</a>',
            escape(result.singularity_class.name),
            str(verdict.answer),
            extent_of(result),
            parts_of(result),
            escape(", ".join(result.steps)),
            known_by(classification, number),
            linked(proof, result) if proof else "",
        )
        rows.append((style, cells))
    headers = ("class", "types", "there?", "dimension", "parts", "step of §3.2", "known by", "certificate")
    table = html.table(headers, rows, "The classes that occur or are open") if rows else ""
    said = []
    for how, numbers in empty_classes(classification).items():
        links = ", ".join(f'<a href="#proof-{n}">{n}</a>' for n in numbers)
        said.append(f"{links} ({escape(how)})")
    empty = f"<p>Empty: {'; '.join(said)}</p>" if said else ""
    types = {line: None for c in shown_classes(classification) for line in c.types.explained}
    return f"{table}{empty}{html.listed(types, 'note')}"


# -- classes -------------------------------------------------------------------------------------------


def _classes(classification: Classification) -> str:
    present = [c for c in classification.classes if c.verdict.is_yes]
    if not present:
        return "<p>No class was found.</p>"
    return "".join(_class(classification, result) for result in present)


def _class(classification: Classification, result: ClassResult) -> str:
    number = result.singularity_class.number
    size = [f"dimension {result.extent}"]
    if parts := parts_of(result):
        size.append(f"{parts} (closed up)" if result.dimension == 1 and result.components else parts)
    defects = dict.fromkeys(
        f"δ = {d.delta}, p = {d.p}, k<sub>I</sub> = {d.k_I}, k<sub>O</sub> = {d.k_O}"
        for d in (p.defects for p in result.pieces)
    )
    return (
        f'<section id="class-{number}"><h3>Class {number}: {escape(result.singularity_class.name)}</h3>'
        f"<p>{escape(result.singularity_class.words.capitalize())}. "
        f"{escape(', '.join(size).capitalize())}.</p><p>Rank defects: {'; '.join(defects)}.</p>"
        f"<ul>{_pieces(classification, result)}</ul>"
        f'<p><a href="#proof-{number}">How this is known</a></p>'
        f"{_families(classification, result)}{_witnesses(classification, result)}</section>"
    )


def _families(classification: Classification, result: ClassResult) -> str:
    """Of each family a figure, and beside it the mechanism that moves along its null motions."""
    from singsym.output.figures.figure import plot_families
    from singsym.output.figures.motions import drawn_motions, motions_at, rates_text
    from singsym.output.figures.scene import Stage
    from singsym.output.html.scenes import scene_box
    from singsym.output.html.tracks import motion_tracks

    mechanism = classification.mechanism
    if mechanism is None or not result.witnesses:
        return ""
    stage = Stage.of(mechanism, classification.equation)
    pictures = plot_families(classification, result)
    found = []
    for k, (family, picture) in enumerate(
        zip(families(classification, result, stage), pictures, strict=True)
    ):
        configuration, defects = family.shown[0]
        point = stage.vector(configuration.coordinates)
        motions = motions_at(stage.equation, point, defects)
        moved = drawn_motions(motions)
        rates = "; ".join(f"{m.type}: {rates_text(m)}" for m in moved)
        drawn = html.figure(picture, f"figure-{result.singularity_class.number}-{k}", rates)
        tracks = motion_tracks(stage, point, moved)
        scene = scene_box(stage, tracks, f"{picture.title}: the mechanism that moves") if tracks else ""
        found.append(f'<div class="class">{drawn}<div>{scene}{_impossible(motions)}</div></div>')
    return "".join(found)


def _pieces(classification: Classification, result: ClassResult) -> str:
    """What vanishes on the pieces of a class as a list, each time with what does not."""
    unequal: dict[str, dict[str, None]] = {}
    for piece in result.pieces:
        unequal.setdefault(_vanishing(classification, piece), {})[_unequal(classification, piece)] = None
    lines = [
        text + "".join(f'<br><span class="note">where {note}</span>' for note in notes if note)
        for text, notes in unequal.items()
    ]
    lines += [f"perhaps also {_vanishing(classification, piece)}" for piece in result.unsure]
    return "".join(f"<li>{line}</li>" for line in lines)


def _place(classification: Classification) -> dict[Polynomial, int]:
    """The number of the first locus of each factor."""
    return {locus.factor: i for i, locus in reversed(list(enumerate(classification.loci)))}


def _vanishing(classification: Classification, piece: Piece) -> str:
    """The factors that are zero on a piece, linked to their loci."""
    place = _place(classification)
    lines = []
    for p in piece.path:
        if p in place:
            i = place[p]
            words = classification.loci[i].words
            shown = escape(words) if words else math.terms(classification.lengths.shown(p), "=", SHORT)
            lines.append(f'<a href="#locus-{i}">{shown}</a>')
        else:
            lines.append(math.terms(p, "=", 12))
    return " and ".join(lines) or "everywhere"


def _unequal(classification: Classification, piece: Piece) -> str:
    """What is not zero on a piece: single factors, and the number of groups that are not all zero."""
    place = _place(classification)
    factors = [f for e in piece.exclusions if len(e) == 1 for f, _ in e[0].factors()]
    said = []
    for f in dict.fromkeys(factors):
        words = classification.loci[place[f]].words if f in place else ""
        said.append(
            f"not {escape(words)}" if words else math.terms(classification.lengths.shown(f), "≠", SHORT)
        )
    groups = sum(len(e) > 1 for e in piece.exclusions)
    if groups:
        said.append(f"{groups} group{'' if groups == 1 else 's'} of polynomials not all zero")
    return "; ".join(said)


def _impossible(motions: Sequence[Motion]) -> str:
    """Which input and output velocities are impossible at the configuration that is drawn."""
    from singsym.output.figures.motions import restriction_text

    lines = [
        f"<li>{'input' if m.type is SingularityType.II else 'output'} velocities must obey "
        f"{escape(restriction_text(m))}</li>"
        for m in motions
        if m.restriction
    ]
    return f"<p>At this configuration:</p><ul>{''.join(lines)}</ul>" if lines else ""


def _witnesses(classification: Classification, result: ClassResult) -> str:
    if not result.witnesses:
        return ""
    shown = result.witnesses[:WITNESSES]
    equation = classification.equation
    places = [moving(w.points, equation) or varying(w.coordinates, equation) for w in shown]
    labels = list(dict.fromkeys(label for place in places for label in place))
    rows = [("", [number_text(place[label], 6) for label in labels]) for place in places]
    listed = html.table(
        [escape(x) for x in labels], rows, f"Configurations of class {result.singularity_class.number}"
    )
    rest = len(result.witnesses) - len(shown)
    more = f"<p>{rest} more are left out.</p>" if rest else ""
    certified = counted(len(result.witnesses), "certified configuration")
    return f"<details><summary>{certified}</summary>{listed}{more}</details>"


# -- strata --------------------------------------------------------------------------------------------


def _strata(classification: Classification) -> str:
    from singsym.output.strata_graph import plot_strata, strata_graph

    graph = strata_graph(classification)
    if len(graph) < 2:
        return ""
    caption = "An arrow goes from a stratum to one whose closure holds it (dashed: holds a part of it)."
    missing = graph.graph["undecided"]
    if missing:
        caption += f" Comparisons that are open, with their arrows missing: {missing}."
    return html.figure(plot_strata(classification, graph), "strata-graph", caption, broad=True)


# -- equations -----------------------------------------------------------------------------------------


def _equations(classification: Classification) -> str:
    equation, reduction = classification.equation, classification.reduction
    space = equation.space
    loops = "".join(_line(math.equation(e, longest=24)) for e in loop_equations(equation))
    parts = [f"<p>Configuration variables: {escape(', '.join(space.variables))}.</p>"]
    parts += [f"<p>{escape(line)}</p>" for line in angles_counted_elsewhere(equation)]
    parts.append(f"<h3>Loop equations</h3>{loops}" if loops else "<p>No loop equations.</p>")
    columns = [c.label for c in equation.columns]
    parts.append(f"<h3>Velocity equation</h3>{_matrix(equation.L, columns)}")
    lines = "".join(f"<li>{escape(line)}</li>" for line in reduction.lines)
    parts.append(f"<h3>Reduction (section 4.2)</h3><ol>{lines}</ol>")
    reduced = [c.label for c in reduction.equation.columns]
    parts.append(_matrix(reduction.equation.L, reduced))
    parts.append("<h3>Loci</h3>")
    for i, locus in enumerate(classification.loci):
        head, named, _ = locus.latex.partition(" = ")
        lead = f"{math.name(head)}<mo>=</mo><mn>0</mn><mo>⇔</mo>" if named and locus.words else ""
        words = f": {escape(locus.words)}" if locus.words else ""
        used = [c.singularity_class.number for c in classification.classes if _uses(c, i, classification)]
        where = ", ".join(f'<a href="#class-{n}">class {n}</a>' for n in used)
        parts.append(
            f'<div id="locus-{i}"><p>({escape(locus.condition)}){words}{" — " + where if where else ""}</p>'
            f"{_line(lead + math.equation(classification.lengths.shown(locus.factor)))}</div>"
        )
    return "".join(parts)


def _uses(result: ClassResult, index: int, classification: Classification) -> bool:
    factor = classification.loci[index].factor
    return result.verdict.is_yes and any(factor in piece.path for piece in result.pieces)


def _line(elements: str) -> str:
    return f'<div class="formula" tabindex="0">{math.formula(elements)}</div>'


def _matrix(matrix: PolynomialMatrix, columns: list[str]) -> str:
    rows, width = matrix.shape
    if rows * width > LARGEST_MATRIX:
        return f"<p>A {rows}×{width} matrix, left out for its size.</p>"
    return f'<div class="formula" tabindex="0">{math.formula(math.matrix(matrix, columns))}</div>'
