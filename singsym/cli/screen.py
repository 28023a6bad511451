"""What reaches the screen: pages and documents on stdout, progress and messages on stderr.

Source: rich (https://rich.readthedocs.io) on terminals, plain text in pipes.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING, Any

from singsym.cli.watch import print_line, talk, watched

if TYPE_CHECKING:
    from singsym.effort.progress import Event
    from singsym.output.page import Grid, Page


class UserError(Exception):
    """What the user can put right, as one paragraph."""


def writable(path: Path) -> None:
    """Say before the work starts that its result could not be written."""
    if not path.absolute().parent.is_dir():
        raise UserError(f"{path} cannot be written: there is no folder {path.parent}")


def drawable(path: Path) -> None:
    """The same of a picture, whose ending says its format."""
    from singsym.output.figures.style import picture_path

    writable(path)
    try:
        picture_path(path)
    except ValueError as error:
        raise UserError(str(error)) from None


def say(text: str) -> None:
    """A message on stderr, unless the user wants none."""
    if talk.get() != "quiet":
        print_line(text)


def emit_data(data: Any) -> None:
    """JSON on stdout, in one line for a pipe and indented for a terminal."""
    unicode = (sys.stdout.encoding or "").lower().replace("-", "") == "utf8"
    print(json.dumps(data, indent=2 if sys.stdout.isatty() else None, ensure_ascii=not unicode))


def emit_latex(body: str, title: str, standalone: bool) -> None:
    """LaTeX on stdout: a whole document, or what others take in by \\input."""
    from singsym.output.document import document, fragment

    print(document(body, title) if standalone else fragment(body))


def emit_page(page: Page) -> None:
    """A page on stdout: rich tables on a terminal, aligned text elsewhere."""
    if not sys.stdout.isatty():
        from singsym.output.page import plain

        print(plain(page))
        return
    from rich import box
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    console = Console(highlight=False)
    for block in page:
        if isinstance(block, str):
            console.print(Text(_wrapped(block, console.width)))
        else:
            table = Table(title=block.title or None, title_justify="left", box=box.SIMPLE_HEAD)
            table.show_edge = table.pad_edge = False
            table.padding = (0, 1, 0, 0)
            words = _longest_words(block)
            fits = sum(words) + len(words) <= console.width
            for place, header in enumerate(block.headers):
                # what a row is called stays in one line, words stay whole where they can, nothing is cut off
                least = words[place] if fits else None
                table.add_column(Text(header), no_wrap=place == 0, overflow="fold", min_width=least)
            for row in block.rows:
                table.add_row(*(Text(cell) for cell in row))
            console.print(table)
        console.print()


def _longest_words(grid: Grid) -> list[int]:
    """How wide each column has to be for its words; what a row is called is one word.

    >>> from singsym.output.page import Grid
    >>> _longest_words(Grid(("class", "known by"), (("1", "certified"),)))
    [5, 9]
    """
    columns = list(zip(grid.headers, *grid.rows, strict=True))
    names = max(map(len, columns[0]), default=0)
    return [names, *(max(len(w) for cell in column for w in [*cell.split(), ""]) for column in columns[1:])]


def _wrapped(block: str, width: int) -> str:
    """Lines of a text broken between words, not beside "=" or before a unit, the rest indented under it.

    >>> print(_wrapped("  one two A = 90 deg", 13))
      one two
          A = 90 deg
    """
    lines = []
    for whole in block.splitlines():
        line = whole.replace(" = ", "\xa0=\xa0").replace(" deg", "\xa0deg")
        indent = " " * (len(line) - len(line.lstrip()) + 4)
        broken = wrap(line, width, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)
        lines += broken or [""]
    return "\n".join(lines).replace("\xa0", " ")


@contextmanager
def progress_shown() -> Iterator[None]:
    """Show the events of the work inside on stderr, as `singsym.cli.watch` says.

    A `KeyboardInterrupt` that passes through gets the last stage as its message.
    """
    from singsym.effort import progress

    last = ["starting"]

    def note(event: Event) -> None:
        if event.stage != "engine":
            last[0] = str(event)

    try:
        with watched(note) as sink, progress.to(sink):
            yield
    except KeyboardInterrupt as interruption:
        interruption.args = interruption.args or (last[0],)
        raise
