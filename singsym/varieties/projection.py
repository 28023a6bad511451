"""Projections of constructible sets: the exact image by the extension theorem, else the closure.

Source: D. Cox, J. Little, D. O'Shea, "Ideals, Varieties, and Algorithms", 3.1-3.2.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

from singsym.effort.budget import Undecided
from singsym.effort.verdict import Known, Premises, Verdict
from singsym.elimination.ideal import Ideal
from singsym.polynomials import Polynomial, Ring
from singsym.varieties.cells import Cell
from singsym.varieties.constructible import ConstructibleSet

_MOST_STEPS = 60


@dataclass(frozen=True)
class Projection:
    """An image under a projection, and whether it is exact for the complex points, else their closure.

    The certainty of `exact` is that of the image, too.
    """

    image: ConstructibleSet
    exact: Verdict

    def _repr_latex_(self) -> str:
        return self.image._repr_latex_()


@dataclass
class _Work:
    """Cells still to be projected, in rings that may have further variables, and those that are done.

    premises: what those rest on.
    """

    target: Ring
    waiting: list[Cell]
    done: list[Cell] = field(default_factory=list)
    premises: Premises = field(default_factory=Premises)
    steps: int = 0


def project(given: ConstructibleSet, names: Sequence[str]) -> Projection:
    """The image in the space of `names` (constants of the ring stay); raises `KeyError` for a foreign name.

    Inequalities among the kept variables stay; others are left out, and the image is then not exact.

    >>> R = Ring(("x", "y"))
    >>> x, y = R.gens
    >>> project(ConstructibleSet.zeros(R, x * y - 1), ("x",)).image
    {everything} \\ {x = 0}
    """
    for name in names:
        given.ring.index(name)
    kept = {*names, *(c.name for c in given.ring.constants)}
    target = given.ring.with_names((n for n in given.ring.names if n in kept), "degrevlex")
    lost = [p for c in given.cells for p in (*c.positive, *c.nonnegative) if not set(p.variables) <= kept]
    work = _Work(target, [_on_kept(cell, kept) for cell in given.cells])
    reason = f"an inequality involves a projected variable: {lost[0]}" if lost else ""
    while work.waiting:
        cell = work.waiting.pop()
        work.steps += 1
        try:
            if work.steps > _MOST_STEPS:
                reason = "the exact image has too many cells"
                work.done += _closures(cell, work)
            else:
                _project_one(cell, work)
        except Undecided as failure:
            reason = str(failure)
            work.done.append(_moved(Cell(Ideal(target), (), cell.positive, cell.nonnegative), target))
    image = ConstructibleSet(target, tuple(dict.fromkeys(work.done)))
    known = work.premises.certainty
    return Projection(image, Verdict.no(known, reason=reason) if reason else Verdict.yes(known))


def _on_kept(cell: Cell, kept: set[str]) -> Cell:
    return replace(
        cell,
        positive=tuple(p for p in cell.positive if set(p.variables) <= kept),
        nonnegative=tuple(p for p in cell.nonnegative if set(p.variables) <= kept),
    )


def _closures(cell: Cell, work: _Work) -> Iterator[Cell]:
    """The closures of the images of a cell's pieces."""
    for piece in work.premises.take(cell.pieces()):
        gone = set(piece.ideal.ring.names) - set(work.target.names)
        ideal = work.premises.take(piece.ideal.eliminate(gone))
        yield _moved(Cell(ideal, (), cell.positive, cell.nonnegative), work.target)


def _project_one(cell: Cell, work: _Work) -> None:
    """Take one variable out of a cell; what that yields is done or waits."""
    extra = [n for n in cell.ring.names if n not in work.target.names]
    if not extra:
        work.done.append(_moved(cell, work.target))
        return
    group = next((g for g in cell.exclusions if any(set(p.variables) & set(extra) for p in g)), None)
    if group is not None:
        rest = replace(cell, exclusions=tuple(g for g in cell.exclusions if g != group))
        work.waiting += [_with_inverse(rest, p) for p in group if p]
        return
    take = work.premises.take
    for piece in take(cell.pieces()):
        basis = take(piece.ideal.groebner_basis())
        name = min(extra, key=lambda n: _difficulty(basis, n))
        heads = take(_leading_coefficients(piece.ideal, name))
        image = replace(cell, ideal=take(piece.ideal.eliminate({name})))
        smaller = cell.ring.with_names(n for n in cell.ring.names if n != name)
        if heads and not any(a.is_constant for a in heads):
            # The extension theorem: a zero of the elimination ideal lifts where one of these is not zero.
            work.waiting.append(replace(cell, ideal=piece.ideal + Ideal(cell.ring, heads)))
            image = replace(image, exclusions=(*image.exclusions, heads))
        work.waiting.append(_moved(image, smaller))


def _difficulty(basis: Sequence[Polynomial], name: str) -> tuple[int, int]:
    """How far a variable is from having a constant leading coefficient in a polynomial of low degree."""
    degrees = [(p.degree(name), p) for p in basis if p.degree(name) > 0]
    if not degrees:
        return 0, 0
    return min((p.coefficient(name, d).total_degree, d) for d, p in degrees)


def _leading_coefficients(ideal: Ideal, name: str) -> Known[tuple[Polynomial, ...]]:
    """The leading coefficients in one variable of generators, none of them in the ideal."""
    found: dict[Polynomial, None] = {}
    v, premises = ideal.ring.gen(name), Premises()
    for p in premises.take(ideal.groebner_basis()):
        while (d := p.degree(name)) > 0:
            head = p.coefficient(name, d)
            if not premises.take(ideal.contains(head)):
                found[head.primitive()] = None
                break
            p = p - head * v**d
    return premises.conclude(tuple(found))


def _with_inverse(cell: Cell, p: Polynomial) -> Cell:
    """The part of a cell where p is not zero, as the image of a cell with one variable more."""
    name = next(n for k in range(len(cell.ring.names) + 1) if (n := f"inverse{k}") not in cell.ring.names)
    ring = cell.ring.with_names((*cell.ring.names, name))
    larger = _moved(cell, ring)
    return replace(larger, ideal=larger.ideal + Ideal(ring, (ring.gen(name) * ring.convert(p) - 1,)))


def _moved(cell: Cell, ring: Ring) -> Cell:
    def all_in(polynomials: Sequence[Polynomial]) -> tuple[Polynomial, ...]:
        return tuple(ring.convert(p) for p in polynomials)

    return Cell(
        Ideal(ring, all_in(cell.ideal.generators)),
        tuple(map(all_in, cell.exclusions)),
        all_in(cell.positive),
        all_in(cell.nonnegative),
    )
