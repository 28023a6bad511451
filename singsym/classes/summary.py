"""A classification at a glance: what a designer asks of a mechanism, answered in a few lines.

Source: the six types in section 2.2 of Zlatanov, Fenton, Benhabib (1998).  Each of the 21 classes has IO, RO,
or RPM and IIM: what these four lines say, they say of all singular configurations.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from singsym.classes.gathering import in_ranges
from singsym.classes.taxonomy.types import IN_WORDS, SingularityType, feasible_classes
from singsym.effort.verdict import described, weakest
from singsym.varieties.real.dimension.extent import union

if TYPE_CHECKING:
    from singsym.classes.result import Classification, ClassResult

_ASKED = {
    SingularityType.IO: "Locks",
    SingularityType.RO: "Goes slack",
    SingularityType.RPM: "Loose inside",
    SingularityType.IIM: "Gains freedom",
}
_ALWAYS = SingularityType.IO | SingularityType.RO
_WEAKER = (described("modular"), described("certified"))
_RESTING = "that there is no more of it rests on random primes"


def summary(result: Classification) -> tuple[str, ...]:
    """Where the mechanism locks and goes slack, where more happens to it, and what is known of the classes.

    Each line says how it is known.  That nothing of a kind occurs is one line only for the first two.  That
    the configuration space has fewer dimensions than n, or no known point, comes first: what cannot move has
    no singularity either.

    >>> from singsym.classes.classify import classify
    >>> from singsym.mechanism import load
    >>> print(*summary(classify(load("fourbar"), cache=False)), sep="\\n")
    Locks (IO, the input cannot move the output): 4 configurations (proven)
    Goes slack (RO, the output can move with the input locked): never (proven)
    Class 1 occurs; every other class is proven empty
    """
    lines = list(_short_of_motions(result))
    for kind, asked in _ASKED.items():
        own = [c for c in result.classes if kind in c.types]
        if kind in _ALWAYS or not all(c.verdict.is_no for c in own):
            meaning = _meaning(kind, result.equation.n)
            lines.append(f"{asked} ({kind.name}, {meaning}): {occurrence(own, result)}")
    return (*lines, _classes(result))


def known_by(result: Classification, number: int) -> str:
    """How the verdict on a class is known: its certainty, or that the mobility forbids the class."""
    found = next(c for c in result.classes if c.singularity_class.number == number)
    if found.singularity_class not in feasible_classes(result.equation.n):
        return f"impossible for n = {result.equation.n}"
    return "" if found.verdict.is_undecided else described(found.verdict.certainty)


def shown_classes(result: Classification) -> tuple[ClassResult, ...]:
    """The classes that have a row of a table: those that occur, then those that are open."""
    there = [c for c in result.classes if c.verdict.is_yes]
    return (*there, *(c for c in result.classes if c.verdict.is_undecided))


def empty_classes(result: Classification) -> dict[str, tuple[int, ...]]:
    """The numbers of the classes that are empty, by how that is known."""
    found: dict[str, list[int]] = {}
    for number in (c.singularity_class.number for c in result.classes if c.verdict.is_no):
        found.setdefault(known_by(result, number), []).append(number)
    return {how: tuple(numbers) for how, numbers in found.items()}


def empty_text(result: Classification) -> str:
    """The classes that are empty on one line; "" where there are none."""
    said = [f"{in_ranges(numbers)} ({how})" for how, numbers in empty_classes(result).items()]
    return f"Empty: {'; '.join(said)}" if said else ""


def _short_of_motions(result: Classification) -> Iterable[str]:
    """That there is less to move than the mobility says."""
    n, pieces = result.equation.n, result.configuration_space
    if not pieces and all(c.verdict.is_no for c in result.classes):
        yield "No configuration is known: loops that close nowhere, or limits and exclusions, leave none"
    most = union(piece.extent for piece in pieces).at_most
    if pieces and most is not None and most < n + result.equation.space.varying:
        yield f"Moves less than n = {n} says: the dimension of the configuration space is {most} at most"


def _meaning(kind: SingularityType, n: int) -> str:
    """What a type says of a mechanism of mobility n."""
    if kind is SingularityType.IIM:
        return f"more than {n} independent motion{'' if n == 1 else 's'}"
    if n == 1 and kind is SingularityType.IO:
        return "the input cannot move the output"
    return IN_WORDS[kind].replace("all inputs", "the input") if n == 1 else IN_WORDS[kind]


def occurrence(own: Sequence[ClassResult], result: Classification) -> str:
    """How many or how large the configurations of some classes are together, and how that is known."""
    there = [c for c in own if c.verdict.is_yes]
    left = [c for c in own if c.verdict.is_undecided]
    empty = weakest(*(c.verdict.certainty for c in own if c.verdict.is_no))
    if not there:
        return f"undecided; {_are(left)} open" if left else f"never ({described(empty)})"
    unsure = [c for c in there if c.unsure]
    said = [_size(there, bool(left or unsure), result)]
    if unsure:
        said.append(f"parts of {_listed(unsure)} are open")
    if left:
        said.append(f"{_are(left)} open")
    said += [c.verdict.reason for c in there if c.verdict.reason and c.dimension is not None]
    if empty != "proven":
        said.append(_RESTING if empty == "modular" else f"that there is no more of it is {empty}")
    return "; ".join(dict.fromkeys(said))


def _size(there: Sequence[ClassResult], is_open: bool, result: Classification) -> str:
    """The number of configurations or the dimension; is_open: whether there may be more of them."""
    extent = union((c.extent for c in there), ["parts are open"] if is_open else [])
    certainty = described(weakest(*(c.verdict.certainty for c in there)))
    if extent.at_least < 1:
        numbers = [c.points for c in there]
        exact = extent.dimension == 0 and None not in numbers
        number = (
            sum(n or 0 for n in numbers) if exact else sum(p.points or 1 for c in there for p in c.pieces)
        )
        return f"{'' if exact else 'at least '}{_configurations(number, result)} ({certainty})"
    whole = union(piece.extent for piece in result.configuration_space).dimension
    size = f"dimension {extent}" if whole is None else f"dimension {extent} of {whole}"
    if names := result.equation.space.parameters:
        return f"a set ({size}, which counts {', '.join(names)}; {certainty})"
    if extent.dimension is not None and extent.dimension == whole:
        return f"a set as large as the configuration space ({size}, {certainty})"
    return f"infinitely many configurations ({size}, {certainty})"


def _configurations(number: int, result: Classification) -> str:
    """A number of points of the configuration space; of its double cover, where turns are quaternions."""
    space = result.equation.space
    double = space.formulation == "quaternion"
    noun = "point" if double else "configuration"
    named = f", each at one value of {', '.join(space.parameters)}" if space.parameters else ""
    return f"{number} {noun}{'' if number == 1 else 's'}{' of the double cover' if double else ''}{named}"


def _classes(result: Classification) -> str:
    """Which classes occur, which are open, and that the others are empty."""
    there = [c for c in result.classes if c.verdict.is_yes]
    left = [c for c in result.classes if c.verdict.is_undecided]
    said = [f"{_listed(there)} occur{'s' if len(there) == 1 else ''}"] if there else []
    if left:
        said.append(f"{_are(left)} open")
    if empty := empty_classes(result):
        every = "every other class" if said else "no singularity: every class"
        weaker = {how: numbers for how, numbers in empty.items() if how in _WEAKER}
        but = "; ".join(f"{in_ranges(numbers)}: {how}" for how, numbers in weaker.items())
        said.append(f"{every} is empty ({but})" if weaker else f"{every} is proven empty")
    further = sum(1 for _ in result.open_questions()) - len(left)
    if further > 0:
        said.append(f"further open questions: {further}")
    whole = "; ".join(said)
    return whole[:1].upper() + whole[1:]


def _are(some: Sequence[ClassResult]) -> str:
    return f"{_listed(some)} {'is' if len(some) == 1 else 'are'}"


def _listed(some: Sequence[ClassResult]) -> str:
    numbers = in_ranges(c.singularity_class.number for c in some)
    return f"class{'' if len(some) == 1 else 'es'} {numbers}"
