"""One self-contained page: style for light and dark, narrow and wide, and figures that follow it.

Source: singsym's own; colours follow the reader's setting by the media query prefers-color-scheme.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from html import escape

from singsym.output.figures.style import (
    INK,
    INPUT,
    LINK,
    MOTION,
    OUTPUT,
    PALE,
    PAPER,
    PLATFORM,
    SERIES,
    Picture,
)
from singsym.output.pieces import filled

_LIGHT = {
    INK: "--ink",
    PALE: "--pale",
    LINK: "--link",
    PLATFORM: "--platform",
    INPUT: "--input",
    OUTPUT: "--output",
    PAPER: "--paper",
    MOTION["RI"]: "--ri",
    MOTION["RO"]: "--ro",
    MOTION["RPM"]: "--rpm",
    **{colour: f"--s{i}" for i, colour in enumerate(SERIES[3:], 3) if colour != MOTION["RPM"]},
}
_DARK = {
    "--ink": "#e6e9ee",
    "--pale": "#8791a0",
    "--link": "#3d4a5c",
    "--platform": "#6b5a33",
    "--input": "#ff9a52",
    "--output": "#3fd0b4",
    "--paper": "#15181d",
    "--ri": "#7fb0ff",
    "--ro": "#ff7d9c",
    "--rpm": "#c79bff",
    "--s3": "#e0b354",
    "--s5": "#8cc3da",
    "--s6": "#e69a72",
    "--s7": "#b3c96a",
}

_STYLE = """
:root { color-scheme: light dark; LIGHT }
@media (prefers-color-scheme: dark) { :root { DARK } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 72rem; padding: 1rem; color: var(--ink); background: var(--paper);
  font: 1rem/1.5 system-ui, sans-serif; overflow-wrap: anywhere; }
h1 { line-height: 1.2; } h2 { margin-top: 2.5rem; border-bottom: 1px solid var(--pale); }
a { color: var(--ri); } a:focus-visible, input:focus-visible, select:focus-visible, summary:focus-visible,
  .wide:focus-visible, .formula:focus-visible { outline: 3px solid var(--input); outline-offset: 2px; }
nav ul { display: flex; flex-wrap: wrap; gap: .25rem 1.25rem; padding: 0; list-style: none; }
.wide { overflow-x: auto; } table { border-collapse: collapse; }
th, td { padding: .3rem .7rem; text-align: left; vertical-align: top; border-bottom: 1px solid var(--pale);
  white-space: nowrap; }
.glance { padding: 0; list-style: none; }
tr.no { color: var(--faint); } .undecided { color: var(--input); font-weight: 600; }
figure { margin: 1rem 0; } figure svg { max-width: 100%; height: auto; }
figcaption, .note { color: var(--faint); font-size: .92rem; }
.class { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(22rem, 100%), 1fr)); gap: 0 2rem; }
.class > * { min-width: 0; } .figures { display: flex; flex-wrap: wrap; gap: 1rem; }
.figures > figure { flex: 1 1 24rem; min-width: 0; }
.broad svg { max-width: none; }
math { font-size: 1.05em; white-space: nowrap; overflow-wrap: normal; }
.formula { overflow-x: auto; padding: .2rem 0; }
mtr.labels { color: var(--faint); font-size: .8em; }
"""


def page(title: str, body: str, script: str = "", more_style: str = "") -> str:
    """The whole page, with nothing that is loaded from elsewhere."""
    light = " ".join(f"{name}: {colour};" for colour, name in _LIGHT.items()) + " --faint: #59626e;"
    dark = " ".join(f"{name}: {colour};" for name, colour in _DARK.items()) + " --faint: #a3adba;"
    style = _STYLE.replace("LIGHT", light, 1).replace("DARK", dark, 1) + more_style
    scripts = f"<script>{script}</script>\n" if script else ""
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{escape(title)}</title>\n<style>{style}</style>\n</head>\n<body>\n{body}\n"
        f"{scripts}</body>\n</html>\n"
    )


def figure(picture: Picture, key: str, caption: str = "", *, broad: bool = False, plane: str = "") -> str:
    """A picture inline: its colours follow the page, its ids begin with `key`, it is described in words.

    broad: it scrolls on a narrow screen, and is not made smaller; plane: the name by which scenes of the page
    mark points on it, hidden at first.
    """
    svg = picture.svg(letters="none")
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    # a hundredth of a point is finer than a screen shows
    svg = re.sub(r' d="[^"]*"', lambda d: re.sub(r"(\.\d\d)\d+", r"\1", d[0]), svg)
    svg = re.sub(r'\bid="', f'id="{key}-', svg)
    svg = re.sub(r'href="#', f'href="#{key}-', svg).replace("url(#", f"url(#{key}-")
    for colour, name in _LIGHT.items():
        svg = svg.replace(colour, f"var({name})")
    if plane:
        mark = f'<circle class="here" data-plane="{escape(plane)}" r="5" visibility="hidden"/>'
        svg = svg.replace("</svg>", f"{mark}</svg>")
    described = f'role="img" aria-label="{escape(picture.description, quote=True)}"'
    svg = svg.replace("<svg ", f"<svg {described} ", 1)
    below = f"<figcaption>{escape(caption)}</figcaption>" if caption else ""
    if broad:
        svg = f"{_scroll(picture.title, 'wide broad')}{svg}</div>"
    return f"<figure>{svg}{below}</figure>"


def _scroll(label: str, style: str = "wide") -> str:
    """The start of a part that scrolls by itself, also by keyboard."""
    return f'<div class="{style}" tabindex="0" role="region" aria-label="{escape(label, quote=True)}">'


def listed(lines: Iterable[str], style: str) -> str:
    """Lines of text as a list of that CSS class; "" where there are none."""
    items = "".join(f"<li>{escape(line)}</li>" for line in lines)
    return f'<ul class="{style}">{items}</ul>' if items else ""


def table(headers: Sequence[str], rows: Sequence[tuple[str, Sequence[str]]], label: str) -> str:
    """A table that scrolls by itself where it is wider than the page; rows with their CSS class, as HTML.

    Columns without an entry are left out.
    """
    kept = filled(headers, [cells for _, cells in rows])
    headers, rows = [headers[j] for j in kept], [(style, [cells[j] for j in kept]) for style, cells in rows]
    head = "".join(f'<th scope="col">{h}</th>' for h in headers)
    lines = "".join(
        f'<tr class="{style}">' + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"
        for style, cells in rows
    )
    return f"{_scroll(label)}<table><thead><tr>{head}</tr></thead><tbody>{lines}</tbody></table></div>"
