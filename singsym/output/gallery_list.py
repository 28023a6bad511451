"""The library as a list: what each mechanism is, and which classes occur in it.

Source: the files of `singsym.mechanism.library`.
"""

from __future__ import annotations

from textwrap import wrap
from typing import Any

from singsym.mechanism import library, load
from singsym.mechanism.model import Mechanism
from singsym.output.page import Page

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
    """Names, kinds, sizes, classes, titles and sources of all mechanisms, within `WIDTH` columns."""
    lines: list[str] = []
    for m in map(load, library.names()):
        lines += _wrapped(f"{m.name}: {kind(m)}, N = {m.N}, n = {m.n}; classes {_numbers(m.name)}", 0)
        lines += [*_wrapped(m.title, 2), *_wrapped(m.source, 2)]
    note = "classes: numbers of those that occur, see singsym classes; ... where others are undecided"
    return ("\n".join(lines), "\n".join(_wrapped(note, 0)))


def _wrapped(text: str, indent: int) -> list[str]:
    """Lines of at most `WIDTH` columns; those after the first are indented more."""
    return wrap(text, WIDTH, initial_indent=" " * indent, subsequent_indent=" " * (indent + 2))


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
