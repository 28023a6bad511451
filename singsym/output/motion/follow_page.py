"""A followed motion, as a page, as plain data, and as a picture of its margins.

Source: what is printed is as `singsym.motion.follow` says.
"""

from __future__ import annotations

from typing import Any

from singsym.motion.follow import FollowedMotion, Passage
from singsym.output.figures.style import INK, PALE, SERIES, Picture, canvas
from singsym.output.page import Block, Grid, Page
from singsym.output.text import motion_text

_SAID = {
    "met": "singular",
    "narrow": "narrowly passed",
    "open": "undecided",
    "end": "ends here",
}
_LOSES = {"L_I": "RO or RPM, II or IIM", "L_O": "RI or RPM, IO or IIM"}


def follow_page(name: str, found: FollowedMotion) -> Page:
    """How far the motion is proven, the singularities on its way with their null motions, the margins."""
    driven = ", ".join(found.labels)
    whole = f"Time {found.start:g} to {found.end:g}, driven by {driven}"
    if found.until == found.end:
        proven = f"{whole}: followed on one assembly mode with proof, in {found.pieces} boxes."
    else:
        proven = (
            f"{whole}: followed with proof up to {found.until:.9g}, in {found.pieces} boxes, not further."
        )
    blocks: list[Block] = [f"{name}: N = {found.equation.N}, n = {found.equation.n}", proven]
    if found.passages:
        rows = tuple(_row(p) for p in found.passages)
        blocks.append(Grid(("time", "what", "class", "types", "where", "margin"), rows))
        motions = [f"{_time(p)}  {motion_text(m)}" for p in found.passages for m in p.motions]
        if motions:
            blocks.append("\n".join(motions))
    if all(p.kind in ("narrow", "end") for p in found.passages) and not found.unwritten:
        span = "" if found.until == found.end else f" up to {found.until:.9g}"
        blocks.append(f"Proven: no singularity is met{span}.")
    least = ", ".join(f"{name} {values.min():.3g}" for name, values in found.margins.items())
    blocks.append(f"Least margins of {len(found.times)} samples, by smallest singular values: {least}.")
    space = found.equation.space
    if space.positive or space.nonnegative or space.exclusions:
        blocks.append(
            "Note: limits and exclusions are not looked at; what is proven holds where they allow it."
        )
    for label in found.unwritten:
        blocks.append(f"Note: condition ({label}) is not written out: where it holds is not looked for.")
    return tuple(blocks)


def _row(p: Passage) -> tuple[str, ...]:
    number = p.singularity_class.number if p.singularity_class else 0
    types = str(p.types) if p.types else ""
    if types and not p.types_certified:
        types = f"{types}, numerically"
    return _time(p), _SAID[p.kind], str(number or ""), types, p.words, f"{p.margin:.2e}"


def _time(p: Passage) -> str:
    return f"{(p.start + p.end) / 2:.7g}"


def follow_data(name: str, found: FollowedMotion) -> dict[str, Any]:
    """The same as plain data, with the samples."""
    return {
        "mechanism": name,
        "driven": list(found.labels),
        "start": found.start,
        "end": found.end,
        "proven_until": found.until,
        "boxes": found.pieces,
        "decided": found.is_decided,
        "passages": [
            {
                "kind": p.kind,
                "time": [p.start, p.end],
                "condition": p.condition or None,
                "class": p.singularity_class.number if p.singularity_class else None,
                "types": list(p.types.names),
                "types_certified": p.types_certified,
                "where": p.words,
                "margin": p.margin,
                "variables": dict(p.values),
                "motions": [
                    {"type": m.type.name, "restriction": m.restriction, "rates": dict(m.rates)}
                    for m in p.motions
                ],
            }
            for p in found.passages
        ],
        "unwritten": list(found.unwritten),
        "times": found.times.tolist(),
        "margins": {name: values.tolist() for name, values in found.margins.items()},
    }


def plot_margins(found: FollowedMotion, title: str = "Margins") -> Picture:
    """The smallest singular values of L_I and L_O over time, with the singularities on the way."""
    figure = canvas(7.2, 3.6)
    axes = figure.add_subplot()
    for colour, (name, values) in zip(SERIES, found.margins.items(), strict=False):
        label = f"${name}$: {_LOSES[name]}"
        axes.plot(found.times, values, color=colour, linewidth=1.4, label=label)
    top = max(float(values.max()) for values in found.margins.values()) or 1.0
    for p in found.passages:
        time = (p.start + p.end) / 2
        axes.axvline(time, color=PALE, linewidth=0.8, linestyle="-" if p.kind == "met" else ":")
        number = p.singularity_class.number if p.singularity_class else 0
        text = f"class {number}" if number else _SAID[p.kind]
        axes.text(time, 1.02 * top, text, fontsize=8, color=INK, rotation=60, va="bottom", ha="left")
    axes.set_xlim(found.start, found.end)
    axes.set_ylim(0, 1.3 * top)
    axes.set_xlabel("time", color=INK)
    axes.set_ylabel("smallest singular value", color=INK)
    axes.legend(loc="upper right", fontsize=8, frameon=False)
    axes.spines[["top", "right"]].set_visible(False)
    axes.set_title(title, fontsize=11, color=INK)
    met = [p for p in found.passages if p.kind == "met"]
    many = f"{len(met)} singularit{'y is' if len(met) == 1 else 'ies are'} met"
    said = f"Smallest singular values of L_I and L_O over time; {many}."
    return Picture(figure, title, said)
