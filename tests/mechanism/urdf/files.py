"""Small URDF files, written out for the tests."""

from __future__ import annotations

from pathlib import Path

Row = tuple[str, ...]


def joint(kind: str, parent: str, child: str, **parts: str) -> str:
    """A joint named after its child; parts: xyz, rpy, axis, limit ("low high"), mimic (attributes)."""
    name = parts.get("name", f"to_{child}")
    body = f'<origin xyz="{parts.get("xyz", "0 0 0")}" rpy="{parts.get("rpy", "0 0 0")}"/>'
    body += f'<parent link="{parent}"/><child link="{child}"/>'
    body += f'<axis xyz="{parts["axis"]}"/>' if "axis" in parts else ""
    if "limit" in parts:
        low, high = parts["limit"].split()
        body += f'<limit lower="{low}" upper="{high}" effort="1" velocity="1"/>'
    body += f"<mimic {parts['mimic']}/>" if "mimic" in parts else ""
    return f'<joint name="{name}" type="{kind}">{body}</joint>'


def robot(*joints: str, name: str = "robot") -> str:
    """The text of a file with these joints and all their links."""
    names: dict[str, None] = {}
    for text in joints:
        for end in ("parent", "child"):
            names[text.split(f'<{end} link="')[1].split('"')[0]] = None
    links = "".join(f'<link name="{link}"/>' for link in names)
    return f'<?xml version="1.0"?><robot name="{name}">{links}{"".join(joints)}</robot>'


def write(folder: Path, *joints: str, name: str = "robot.urdf") -> Path:
    """The same as a file."""
    path = folder / name
    path.write_text(robot(*joints), encoding="utf-8")
    return path


def arm(count: int, first: str = "l0") -> list[str]:
    """Turning joints to links l1, l2, ... with axes z, y, y, x, y, x, y, of different lengths."""
    axes = ("0 0 1", "0 1 0", "0 1 0", "1 0 0", "0 1 0", "1 0 0", "0 1 0")
    links = [first, *(f"l{i}" for i in range(1, count + 1))]
    return [
        joint("continuous", links[i], links[i + 1], xyz=f"0.{i + 1} 0 0.{2 * i}", axis=axes[i])
        for i in range(count)
    ]
