"""The gallery: an index page of many mechanisms, each with a figure and its classes, that leads to reports.

Source: the layout of Table 2 of Zlatanov, Fenton, Benhabib (1998), one table a mechanism.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape
from itertools import groupby

from singsym.classes.gathering import gathered
from singsym.classes.result import Classification, ClassResult
from singsym.classes.taxonomy.types import feasible_classes
from singsym.mechanism.model import Mechanism
from singsym.output.figures.style import Picture
from singsym.output.gallery_list import kind
from singsym.output.html import page as html
from singsym.output.pieces import counted, parts_of


@dataclass(frozen=True)
class Card:
    """A mechanism in the index: what it is, the classes found and those left open, its part of the page.

    undecided: whether anything is open, be it a class, a dimension or a number.
    """

    name: str
    title: str
    kind: str
    found: tuple[int, ...]
    open: tuple[int, ...]
    undecided: bool
    body: str

    @property
    def group(self) -> str:
        """The heading that it stands under."""
        space, _, shape = self.kind.partition(", ")
        return "Serial arms" if shape == "serial" else f"{space.capitalize()} linkages"


def page_name(name: str) -> str:
    """The file of a mechanism's report beside the index."""
    return f"{name}.html"


def card(classification: Classification) -> Card:
    """The part of the index for one classification; raises `ValueError` where no mechanism was given.

    >>> from singsym.classes.classify import classify
    >>> from singsym.mechanism import load
    >>> made = card(classify(load("slider-crank"), cache=False))
    >>> made.kind, made.found, made.open, "<svg" in made.body
    ('planar, 1 loop', (1,), (), True)
    """
    mechanism = classification.mechanism
    if mechanism is None:
        raise ValueError("equations were given without a mechanism: they have no place in a gallery")
    found = [c for c in classification.classes if c.verdict.is_yes]
    left = [c for c in classification.classes if c.verdict.is_undecided]
    sizes = f"{kind(mechanism)}, N = {classification.equation.N}, n = {classification.equation.n}"
    parts = [
        f'<h3><a href="{page_name(mechanism.name)}">{escape(mechanism.title or mechanism.name)}</a></h3>',
        f'<p class="note">{escape(mechanism.name)}: {sizes}</p>',
        f"<p>{escape(mechanism.description.strip())}</p>" if mechanism.description else "",
        html.listed(classification.summary, "glance"),
        _table(mechanism, found) if found else "",
        f"<p>{_open(classification)}</p>" if classification.undecided else "",
        "".join(f'<p class="note">{escape(note)}</p>' for note in classification.notes()),
        f'<p class="note">Source: {escape(mechanism.source)}</p>' if mechanism.source else "",
    ]
    picture = _picture(classification, mechanism, found)
    drawn = html.figure(picture, f"figure-{mechanism.name}") if picture else ""
    body = f'<section id="{mechanism.name}" class="class"><div>{"".join(parts)}</div>{drawn}</section>'
    occurring, undecided = (tuple(c.singularity_class.number for c in group) for group in (found, left))
    title = mechanism.title or mechanism.name
    return Card(mechanism.name, title, kind(mechanism), occurring, undecided, classification.undecided, body)


def _picture(
    classification: Classification, mechanism: Mechanism, found: Sequence[ClassResult]
) -> Picture | None:
    """The first class that has a configuration, else the mechanism; None where no configuration is found."""
    from singsym.output.figures.figure import plot_class, plot_mechanism

    shown = next((c for c in found if c.witnesses), None)
    if shown is not None:
        return plot_class(classification, shown)
    try:
        return plot_mechanism(mechanism, equation=classification.equation, seed=1)
    except ValueError:
        return None


def _table(mechanism: Mechanism, found: Sequence[ClassResult]) -> str:
    rows = []
    for result in found:
        number = result.singularity_class.number
        link = f'<a href="{page_name(mechanism.name)}#class-{number}">{number}</a>'
        rows.append(("", (link, escape(result.singularity_class.name), str(result.extent), parts_of(result))))
    label = f"Classes of {mechanism.title or mechanism.name}"
    return html.table(("class", "types", "dimension", "parts"), rows, label)


def _open(classification: Classification) -> str:
    """What is open, each with its reason."""
    return "<br>".join(
        f'<span class="undecided">Open: {escape(what)}</span> ({escape(why)}).'
        for what, why in gathered(classification.open_questions())
    )


def index(cards: Iterable[Card], planned: int) -> str:
    """The whole page; planned: how many mechanisms there will be, where the work is not finished.

    Loads nothing from elsewhere; its links lead to the reports beside it, see `page_name`.
    """
    shown = sorted(cards, key=lambda c: (c.group, c.title))
    groups = [(group, list(members)) for group, members in groupby(shown, key=lambda c: c.group)]
    links = "".join(f'<li><a href="#{_key(group)}">{group}</a></li>' for group, _ in groups)
    missing = planned - len(shown)
    note = f'<p class="undecided">{missing} of {planned} are not classified yet.</p>' if missing else ""
    parts = [
        "<header><h1>Singularities of mechanisms</h1>"
        f"<p>{counted(len(shown), 'mechanism')} with the classes of singular configurations, each shown to"
        " occur by a certified configuration, shown to be empty, or left open.  A title leads to the"
        f" mechanism's report, with all figures, equations and proofs.</p>{note}</header>",
        f'<nav aria-label="Contents"><ul><li><a href="#overview">Overview</a></li>{links}</ul></nav><main>',
        f'<section id="overview"><h2>Overview</h2>{_overview(shown)}</section>',
    ]
    for group, members in groups:
        bodies = "".join(member.body for member in members)
        parts.append(f'<section id="{_key(group)}"><h2>{group}</h2>{bodies}</section>')
    parts.append("</main>")
    return html.page("Singularities of mechanisms", "\n".join(parts))


def _key(group: str) -> str:
    return group.lower().replace(" ", "-")


def _overview(cards: Sequence[Card]) -> str:
    """Which class occurs in which mechanism, as a matrix of links."""
    classes = feasible_classes()
    headers = ["mechanism"]
    headers += [f'<abbr title="{escape(c.name, quote=True)}">{c.number}</abbr>' for c in classes]
    rows = [
        (
            "",
            [
                f'<a href="#{c.name}" title="{escape(c.title, quote=True)}">{c.name}</a>',
                *(_mark(c, k.number) for k in classes),
            ],
        )
        for c in cards
    ]
    return html.table(headers, rows, "Which class occurs in which mechanism")


def _mark(card: Card, number: int) -> str:
    if number in card.found:
        label = f"class {number} occurs"
        return f'<a href="{page_name(card.name)}#class-{number}" aria-label="{label}">●</a>'
    return '<span class="undecided" aria-label="undecided">?</span>' if number in card.open else ""
