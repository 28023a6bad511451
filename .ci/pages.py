"""Pages of the docs while they are built: commands run beside the files that a page shows.

A block of code with a title is a file of that name, in a folder that each page has for itself. Blocks with
`exec` run there, with `singsym` as it is in this repository. What they draw and write goes into the site.
Formulas become MathML, so that no page loads anything from elsewhere.

Source: events of MkDocs, https://www.mkdocs.org/dev-guide/plugins/#events; blocks that run are those of
https://pawamoy.github.io/markdown-exec/.
"""

from __future__ import annotations

import os
import re
import shutil
import sys
from html import unescape
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from latex2mathml.converter import convert
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.plugins import get_plugin_logger
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page
from pygments.formatters import HtmlFormatter

log = get_plugin_logger(__name__)
ROOT = Path(__file__).resolve().parents[1]
SHOWN = (".svg", ".png", ".html")
"""Endings of files that readers are shown."""
FILE = re.compile(r'^```\w+ title="([\w.-]+)"\n(.*?)^```$', re.MULTILINE | re.DOTALL)
FORMULA = re.compile(r'<(span|div) class="arithmatex">\\[(\[](.*?)\\[)\]]</\1>', re.DOTALL)

COMMAND = """\
#!/bin/sh
"{python}" -m singsym "$@"
code=$?
[ $code -eq 0 ] || echo "singsym $*" >> "{failed}"
exit $code
"""
"""Keeps commands that fail also where they are at the head of a pipe."""
FAILED = "failed"

_temporary: TemporaryDirectory[str] | None = None
_folder = Path("/nonexistent")
_environment: dict[str, str] = {}


def on_pre_build(config: MkDocsConfig) -> None:
    """A folder for all pages, and an environment with the command and without results from before."""
    global _temporary, _folder
    _temporary = TemporaryDirectory(prefix="singsym-docs-")
    _folder = Path(_temporary.name)
    _environment.update(os.environ)
    command = _folder / "bin" / "singsym"
    command.parent.mkdir()
    command.write_text(COMMAND.format(python=sys.executable, failed=_folder / FAILED), encoding="utf-8")
    command.chmod(0o755)
    os.environ.update(
        PATH=os.pathsep.join((str(command.parent), str(Path(sys.executable).parent), os.environ["PATH"])),
        PYTHONPATH=str(ROOT),
        SINGSYM_CACHE=str(_folder / "cache"),
        COLUMNS="80",
        NO_COLOR="1",
    )


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """The style of the pages, with that of highlighted code."""
    code = HtmlFormatter(style="friendly").get_style_defs(".highlight")
    style = Path(__file__).with_name("site.css").read_text(encoding="utf-8")
    files.append(File.generated(config, "site.css", content=f"{code}\n{style}"))
    return files


def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Where commands run, the page's own folder with its files is the current one until the page is made."""
    if ' exec="on"' not in markdown:
        return markdown
    here = _folder / page.file.src_uri
    here.mkdir(parents=True)
    for name, text in FILE.findall(markdown):
        (here / name).write_text(text, encoding="utf-8")
    os.chdir(here)
    return markdown


def on_page_content(html: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Back from the page's folder, with what its commands drew."""
    os.chdir(ROOT)
    _complain(page)
    target = Path(page.file.abs_dest_path).parent
    for made in (_folder / page.file.src_uri).glob("*"):
        if made.suffix in SHOWN:
            target.mkdir(parents=True, exist_ok=True)
            shutil.copy(made, target)
    return FORMULA.sub(_mathml, html)


def on_post_build(config: MkDocsConfig) -> None:
    """The folder and the environment go."""
    _tidy()


def on_build_error(error: Exception) -> None:
    """The same where a page could not be made."""
    _tidy()


def _tidy() -> None:
    global _temporary
    if _temporary is None:
        return
    os.chdir(ROOT)
    _temporary.cleanup()
    _temporary = None
    os.environ.clear()
    os.environ.update(_environment)


def _complain(page: Page) -> None:
    """Warn of commands that failed on the page, but for those of blocks that say so."""
    kept = _folder / FAILED
    failed = kept.read_text(encoding="utf-8").splitlines() if kept.exists() else []
    if len(failed) != (page.markdown or "").count(' returncode="'):
        log.warning("%s: these commands failed: %s", page.file.src_uri, "; ".join(failed) or "none")
    kept.unlink(missing_ok=True)


def _mathml(formula: re.Match[str]) -> str:
    display: Any = "inline" if formula[1] == "span" else "block"
    return convert(unescape(formula[2]), display=display)
