"""The notebooks as pages of the docs: their stored outputs, without the cells that only check.

Source: nbconvert, https://nbconvert.readthedocs.io, Markdown and the removal of cells by their tags.
"""

from __future__ import annotations

from pathlib import Path

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from nbconvert import MarkdownExporter
from traitlets.config import Config

FOLDER = Path(__file__).resolve().parents[1] / "notebooks"


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """A page for each notebook, its pictures beside it."""
    chosen = Config()
    chosen.TagRemovePreprocessor.remove_cell_tags = ("remove-cell",)
    chosen.TagRemovePreprocessor.enabled = True
    exporter = MarkdownExporter(config=chosen)
    for path in sorted(FOLDER.glob("*.ipynb")):
        text, made = exporter.from_filename(str(path), {"output_files_dir": f"{path.stem}-files"})
        text += f"\n\nThis page is the notebook `notebooks/{path.name}`.\n"
        files.append(File.generated(config, f"notebooks/{path.stem}.md", content=text))
        for name, picture in made["outputs"].items():
            files.append(File.generated(config, f"notebooks/{name}", content=picture))
    return files
