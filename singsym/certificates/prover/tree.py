"""A certificate under way: lines, and the sets that they lead to, as the checker sees them.

Source: the rules of `checker`, which are applied to each line as it is written.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from singsym.certificates.checker.rules import RULES
from singsym.certificates.checker.sets import RealSet, Statement


@dataclass(frozen=True)
class Node:
    """A set and its number.

    based: so many of its first equations hold a Groebner basis of their ideal; full: whether it has complex
    points, as far as they are looked for.
    """

    number: int
    at: RealSet
    based: int = 0
    full: bool = False


@dataclass
class Tree:
    """The lines so far."""

    about: Statement
    lines: list[dict[str, Any]] = field(default_factory=list)
    numbers: int = 0

    @property
    def root(self) -> Node:
        """The whole configuration space."""
        return Node(0, self.about.whole)

    @property
    def next_line(self) -> int:
        """The number in the file of the next line, after header and statement."""
        return len(self.lines) + 3

    def apply(self, node: Node, rule: str, **data: Any) -> tuple[Node, ...]:
        """A set taken apart by a rule; raises `checker.polynomials.Rejected` where the checker would."""
        parts = RULES[rule](node.at, data)
        known = node.at.equations[: node.based]
        numbers = list(range(self.numbers + 1, self.numbers + 1 + len(parts)))
        self.numbers += len(parts)
        self.lines.append({"at": node.number, "rule": rule, **data, "into": numbers})
        return tuple(
            Node(number, part, node.based if part.equations[: node.based] == known else 0)
            for number, part in zip(numbers, parts, strict=True)
        )

    def leaf(self, node: Node, rule: str, **data: Any) -> None:
        """The end of a set; what is claimed is not checked here."""
        self.lines.append({"at": node.number, "rule": rule, **data})
