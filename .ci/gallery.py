"""The gallery of the docs: a picture and a few words of each mechanism of the library.

Source: what `singsym list` prints, `singsym.output.gallery_list.library_data`.
"""

from __future__ import annotations

from html import escape
from itertools import groupby
from typing import Any

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files

import singsym
from singsym.output.gallery_list import library_data

INTRODUCTION = """\
# Gallery

{count} mechanisms come with singsym. `singsym show NAME` prints the joints and equations of one of them,
`singsym classify NAME` its singularities. Numbers are those of the [classes](theory/classes.md) that occur;
where "..." follows, others are undecided.
"""


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """The page, and its pictures beside it."""
    parts = []
    entries = sorted(library_data(), key=lambda entry: (_group(entry), entry["title"]))
    for group, members in groupby(entries, key=_group):
        cards = []
        for entry in members:
            picture = singsym.plot_mechanism(singsym.load(entry["name"]))
            files.append(File.generated(config, f"gallery/{entry['name']}.svg", content=picture.svg()))
            cards.append(_card(entry, picture.description))
        parts += [f"\n## {group}\n", '<div class="gallery">', *cards, "</div>"]
    text = INTRODUCTION.format(count=len(entries)) + "\n".join(parts)
    files.append(File.generated(config, "gallery.md", content=text))
    return files


def _group(entry: dict[str, Any]) -> str:
    space, _, shape = entry["kind"].partition(", ")
    return "Serial arms" if shape == "serial" else f"{space.capitalize()} linkages"


def _card(entry: dict[str, Any], described: str) -> str:
    """A figure as HTML on one line, which Markdown leaves alone."""
    name = entry["name"]
    classes = " ".join([*map(str, entry["classes"]), *([] if entry["complete"] else ["..."])]) or "none"
    return (
        f'<figure id="{name}"><img src="{name}.svg" alt="{escape(described, quote=True)}" loading="lazy">'
        f"<figcaption><b>{escape(entry['title'])}</b> <code>{name}</code>"
        f"<small>{entry['kind']}, N = {entry['N']}, n = {entry['n']}; classes {classes}</small>"
        f"<small>{escape(entry['source'])}</small></figcaption></figure>"
    )
