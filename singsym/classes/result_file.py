"""Classifications as JSON text and back, whole and exact.

Source: singsym's own; values are written by `running.json_codec`, mechanisms as their files.
"""

from __future__ import annotations

import json
from importlib.metadata import PackageNotFoundError, version

from singsym.classes.result import Classification
from singsym.classes.running.json_codec import decode, encode, shape

FORMAT = "singsym classification"


def dumps(found: Classification) -> str:
    """The text of a classification; raises `ValueError` for a mechanism that no file can describe."""
    head = {"format": FORMAT, "version": _version(), "shape": shape(Classification)}
    return json.dumps({**head, **encode(found, Classification)}, separators=(",", ":"))


def loads(text: str) -> Classification:
    """The classification that was written; raises `ValueError` for any other text, and says what it is.

    >>> loads("[1, 2]")
    Traceback (most recent call last):
    ...
    ValueError: this is no classification that Classification.to_json wrote
    """
    foreign = "this is no classification that Classification.to_json wrote"
    try:
        data = json.loads(text)
    except ValueError as error:
        raise ValueError(f"{foreign}: it is no JSON, {error}") from None
    if not isinstance(data, dict) or data.pop("format", "") != FORMAT:
        raise ValueError(foreign)
    written = data.pop("version", "")
    if data.pop("shape", "") != shape(Classification):
        raise ValueError(
            f"this classification is of singsym {written}, whose results have other parts than those of "
            f"singsym {_version()} here: classify the mechanism again"
        )
    try:
        found: Classification = decode(data, Classification)
    except (ValueError, TypeError, ArithmeticError, LookupError, RecursionError) as error:
        raise ValueError(f"this classification is damaged: {error}") from None
    return found


def _version() -> str:
    try:
        return version("singsym")
    except PackageNotFoundError:
        return "(not installed)"
