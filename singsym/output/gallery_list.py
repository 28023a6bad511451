"""The library as a list: what each mechanism is, and which classes occur in it.

Source: the files of `singsym.mechanism.library`.
"""

from __future__ import annotations

from typing import Any

from singsym.mechanism import library, load
from singsym.mechanism.model import Mechanism
from singsym.output.page import Grid, Page


def kind(mechanism: Mechanism) -> str:
    """The space and the number of independent loops.

    >>> kind(load("zlatanov-2dof")), kind(load("scara"))
    ('planar, 2 loops', 'spatial, serial')
    """
    loops = len(mechanism.joints) - len(mechanism.links) + 1
    shape = f"{loops} loop{'' if loops == 1 else 's'}" if loops else "serial"
    return f"{mechanism.space}, {shape}"


def gallery_page() -> Page:
    """Names, kinds, sizes, classes, titles and sources of all mechanisms of the library."""
    rows = []
    for mechanism in map(load, library.names()):
        size = str(mechanism.N), str(mechanism.n)
        about = mechanism.title, mechanism.source
        rows.append((mechanism.name, kind(mechanism), *size, _numbers(mechanism.name), *about))
    headers = ("name", "kind", "N", "n", "classes", "what it is", "source")
    note = "classes: numbers of those that occur, see singsym classes; ... where others are undecided"
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
