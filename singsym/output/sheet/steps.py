"""The steps 1 to 6 of the procedure, each with what it found, in LaTeX.

Source: section 3.2 of Zlatanov, Fenton, Benhabib (1998); sections 3.3 and 5.3.2 tell examples in this way.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from singsym.classes.result import counts
from singsym.classes.summary import occurrence
from singsym.classes.taxonomy.types import SingularityType
from singsym.output.document import escaped
from singsym.output.pieces import counted, grouped, named_polynomials
from singsym.polynomials.latex import polynomial_latex

if TYPE_CHECKING:
    from singsym.classes.result import Classification, ClassResult, Locus
    from singsym.conditions.named_lengths import NamedLengths
    from singsym.output.pieces import Group
    from singsym.polynomials import Polynomial

MOST = 6
"""Of more ways than these the first are told."""

_T = SingularityType
_NEITHER = _T.RPM | _T.IIM


def steps_latex(result: Classification) -> str:
    """What each step found; steps that have nothing to look at are left out, as the paper leaves them out."""
    increased = [c for c in result.classes if _T.IIM in c.types]
    passive = [c for c in result.classes if _T.RPM in c.types]
    items = [
        _item("1", "IIM, condition (vi)", increased, result, where=True),
        _item("2", "RPM, condition (iii)", passive, result, where=True),
    ]
    some, others = _is_there(increased), _is_there(passive)
    if some:
        items.append(
            _kinds("3.1", "of those of step 1, by (iv) and (v)", _T.IIM, (_T.II, _T.IO), increased, result)
        )
    if others:
        items.append(
            _kinds("3.2", "of those of step 2, by (i) and (ii)", _T.RPM, (_T.RI, _T.RO), passive, result)
        )
    if some and others:
        items.append(_classes("3.3", "both", [c for c in increased if c in passive], result))
    if some:
        items.append(_classes("3.4", "IIM and not RPM", [c for c in increased if c not in passive], result))
    if others:
        items.append(_classes("3.5", "RPM and not IIM", [c for c in passive if c not in increased], result))
    rest = [c for c in result.classes if not c.types & _NEITHER]
    names = named_polynomials(result)
    for step, label, condition, kind in (("4", "4", "vii", _T.RO), ("5", "5", "viii", _T.RI)):
        loci = [x for x in result.loci if x.condition == label and not x.verdict.is_no]
        own = [c for c in rest if kind in c.types]
        items.append(_item(step, f"condition ({condition}), without steps 1 and 2", own, result))
        items += [f"\\item[] {_locus(locus, result.lengths, names)}" for locus in loci]
    items.append(_classes("6", "neither RPM nor IIM", rest, result))
    return "\\begin{itemize}\n" + "\n".join(items) + "\n\\end{itemize}"


def _is_there(some: Iterable[ClassResult]) -> bool:
    return not all(c.verdict.is_no for c in some)


def _size(own: Sequence[ClassResult], result: Classification) -> str:
    """How many configurations there are, or how large their set is."""
    return occurrence(own, result) if own and _is_there(own) else "none"


def _item(
    step: str, what: str, own: Sequence[ClassResult], result: Classification, where: bool = False
) -> str:
    """A step that looks for configurations; where: with what vanishes there."""
    said = f"\\item[{step}] {escaped(f'{what}: {_size(own, result)}')}."
    if not where:
        return said
    names = named_polynomials(result)
    pieces = [piece for c in own for piece in c.pieces]
    ways = list(dict.fromkeys(where_latex(g, names) for g in grouped(pieces, result.loci, result.lengths)))
    more = f"; and {len(ways) - MOST} more ways" if len(ways) > MOST else ""
    return f"{said} Where {'; or '.join(ways[:MOST])}{more}." if ways else said


def _kinds(
    step: str,
    what: str,
    base: SingularityType,
    kinds: tuple[SingularityType, SingularityType],
    own: Sequence[ClassResult],
    result: Classification,
) -> str:
    """A step that divides a set in four, by two more types."""
    first, second = kinds
    said = []
    for extra in (SingularityType(0), first, second, first | second):
        some = [c for c in own if c.types & (first | second) == extra]
        said.append(f"{str(base | extra).replace(', ', ' and ')}: {_size(some, result)}")
    return f"\\item[{step}] {escaped(f'{what}: ' + '; '.join(said))}."


def _classes(step: str, what: str, own: Sequence[ClassResult], result: Classification) -> str:
    """A step that yields classes."""
    said = [f"({c.types}): {_size([c], result)}" for c in own if not c.verdict.is_no]
    empty = len(own) - len(said)
    if empty:
        said.append(
            f"{'the other ' if said else ''}{empty} {'classes are' if empty > 1 else 'class is'} empty"
        )
    return f"\\item[{step}] {escaped(f'{what}: ' + '; '.join(said))}."


def _locus(locus: Locus, lengths: NamedLengths, names: Mapping[Polynomial, str]) -> str:
    points, components = counts(locus)
    parts = [f"dimension {locus.extent}"]
    parts += [counted(points, "point")] if points else []
    parts += [counted(components, "component")] if components else []
    return f"{locus_latex(locus, lengths, names)}: {escaped(', '.join(parts))}."


def where_latex(group: Group, names: Mapping[Polynomial, str]) -> str:
    """What vanishes on the pieces of a group."""
    said = [
        escaped(w) if w else f"${_cited(p, names)} = 0$" for p, w in zip(group.path, group.words, strict=True)
    ]
    return r" \emph{and} ".join(said) or "everywhere"


def locus_latex(locus: Locus, lengths: NamedLengths, names: Mapping[Polynomial, str]) -> str:
    """What vanishes on a locus."""
    shown = lengths.shown(locus.factor)
    return escaped(locus.words) if locus.words else f"${_cited(shown, names)} = 0$"


def _cited(polynomial: Polynomial, names: Mapping[Polynomial, str]) -> str:
    name = names.get(polynomial)
    return f"{name[0]}_{{{name[1:]}}}" if name else polynomial_latex(polynomial, 8)


def named_latex(names: Mapping[Polynomial, str]) -> str:
    """What the names of polynomials stand for, each once; "" without names."""
    said = [f"${_cited(p, names)} = {polynomial_latex(p, 12)}$" for p in names]
    return f"Here {', '.join(said)}." if said else ""
