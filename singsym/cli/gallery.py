"""The command that writes the gallery: gallery.

Source: pages are those of `singsym.output.html.gallery` and `singsym.output.html.report`.
"""

from __future__ import annotations

import argparse
import time
from difflib import get_close_matches
from pathlib import Path

from singsym.cli.screen import UserError, say
from singsym.cli.singularities import UNDECIDED, classified
from singsym.mechanism import library


def run_gallery(chosen: argparse.Namespace) -> int:
    """`singsym gallery -o DIR`: a report of each mechanism and an index; prints the index file's name.

    The index is written anew after each mechanism, so that an interruption leaves a gallery of what is done.
    """
    from singsym.output.html.gallery import card, index, page_name
    from singsym.output.html.report import report

    names = _chosen(chosen.only)
    folder = Path(chosen.output)
    cards = []
    for place, name in enumerate(names, 1):
        chosen.mechanism, chosen.started = name, time.monotonic()
        result = classified(chosen)
        cards.append(card(result))
        _write(folder / page_name(name), report(result))
        _write(folder / "index.html", index(cards, len(names)))
        say(f"{place} of {len(names)}: {name}, {result.seconds:.1f} s")
    print(folder / "index.html")
    return UNDECIDED if any(c.undecided for c in cards) else 0


def _chosen(only: list[str]) -> tuple[str, ...]:
    """The names given with --only, each once; all of the library without."""
    known = library.names()
    for name in only:
        if name not in known:
            close = get_close_matches(name, known, 1)
            advice = f"; did you mean {close[0]}?" if close else "; singsym list shows them"
            raise UserError(f"found --only {name}; expected names of the library's mechanisms{advice}")
    return tuple(dict.fromkeys(only)) or known


def _write(path: Path, text: str) -> None:
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise UserError(f"{path} cannot be written: {error.strerror}") from None
