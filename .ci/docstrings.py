"""Docstrings as Markdown for the API reference: examples as code, each argument in a line of its own.

Source: extensions of Griffe, https://mkdocstrings.github.io/griffe/guide/users/extending/.
"""

from __future__ import annotations

import re
from typing import Any

import griffe

_NAMED = re.compile(r"^((?:\w+)(?:, \w+)*): (?=\S)")


class Docstrings(griffe.Extension):
    """Rewrites the docstring of every object."""

    def on_object(self, *, obj: griffe.Object, **kwargs: Any) -> None:
        """Called for each object when its members are there."""
        if obj.docstring is not None:
            obj.docstring.value = markdown(obj.docstring.value)


def markdown(docstring: str) -> str:
    """The same docstring, with code fences around examples and names of arguments in bold."""
    lines: list[str] = []
    example = False
    for line in docstring.split("\n"):
        if example and not line.strip():
            lines.append("```")
            example = False
        if line.startswith(">>> ") and not example:
            lines += ["", "```python"]
            example = True
        if example:
            lines.append(line)
            continue
        named = _NAMED.match(line)
        if named or line.startswith("Raises "):
            lines.append("")
        lines.append(line if named is None else f"**{named[1]}**: {line[named.end() :]}")
    return "\n".join([*lines, "```"] if example else lines)
