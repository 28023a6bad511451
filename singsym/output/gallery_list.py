"""The library as a list: what each mechanism is, and which classes occur in it.

Source: the files of `singsym.mechanism.library`.
"""

from __future__ import annotations

from textwrap import wrap
from typing import Any

from singsym.mechanism import library, load
from singsym.mechanism.model import Mechanism
from singsym.output.page import Grid, Page

WIDTH = 80
"""Columns of a terminal that the list fits."""


def kind(mechanism: Mechanism) -> str:
    """The space and the number of independent loops.

    >>> kind(load("zlatanov-2dof")), kind(load("scara"))
    ('planar, 2 loops', 'spatial, serial')
    """
    loops = len(mechanism.joints) - len(mechanism.links) + 1
    shape = f"{loops} loop{'' if loops == 1 else 's'}" if loops else "serial"
    return f"{mechanism.space}, {shape}"


def gallery_page() -> Page:
    """Names, sizes, titles, kinds and classes of all mechanisms of the library, within `WIDTH` columns."""
    mechanisms = [load(name) for name in library.names()]
    longest = max(len(m.name) for m in mechanisms)
    rows: list[tuple[str, ...]] = []
    for m in mechanisms:
        about = [m.title, f"{kind(m)}; classes {_numbers(m.name)}"]
        lines = [line for text in about for line in wrap(text, WIDTH - longest - len("  NN  n  "))]
        rows.append((m.name, str(m.N), str(m.n), lines[0]))
        rows += [("", "", "", line) for line in lines[1:]]
    headers = ("name", "N", "n", "what it is, and the classes that occur")
    note = (
        "classes: see singsym classes; ... where others are undecided\n"
        "sources: singsym show NAME, or --format json"
    )
    return (Grid(headers, tuple(rows)), note)


def _numbers(name: str) -> str:
    found = library.occurring()[name]
    return " ".join([*map(str, found.numbers), *(() if found.complete else ("...",))]) or "none"


def library_data() -> list[dict[str, Any]]:
    """The same as plain data; `complete` where the classes left out are proven empty."""
    return [
        {
            "name": m.name,
            "kind": kind(m),
            "N": m.N,
            "n": m.n,
            "classes": list(library.occurring()[m.name].numbers),
            "complete": library.occurring()[m.name].complete,
            "title": m.title,
            "source": m.source,
        }
        for m in map(load, library.names())
    ]
