"""The same as plain data, for `--format json`: dicts, lists, text and numbers.

Source: singsym's own; polynomials are text in the ring's variables.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from singsym.classes.configuration.at import Analysis
    from singsym.classes.result import Classification, Configuration
    from singsym.classes.solve import Solution
    from singsym.classes.taxonomy.types import Table
    from singsym.conditions.conditions import Condition, Conditions
    from singsym.conditions.named_lengths import NamedLengths
    from singsym.kinematics.mobility import Mobility
    from singsym.kinematics.velocity import VelocityEquation
    from singsym.mechanism.model import Mechanism
    from singsym.polynomials import PolynomialMatrix
    from singsym.varieties.real.dimension.extent import Extent


def mechanism_data(mechanism: Mechanism, equation: VelocityEquation) -> dict[str, Any]:
    """A mechanism with its loop equations and velocity equation."""
    from singsym.output.text import output_text

    return {
        "mechanism": mechanism.name,
        "title": mechanism.title,
        "source": mechanism.source,
        "space": str(mechanism.space),
        "inputs": list(mechanism.inputs),
        "output": [output_text(o) for o in mechanism.outputs],
        "joints": [
            {"name": j.name, "kind": j.kind.value, "links": [j.first, j.second], "columns": list(j.columns)}
            for j in mechanism.joints
        ],
        "couplings": [
            {
                "name": c.name,
                "rates": {column: str(x) for column, x in c.terms},
                "constant": None if c.constant is None else str(c.constant),
                **({} if c.lift is None else {"lift": str(c.lift)}),
            }
            for c in mechanism.couplings
        ],
        **equation_data(equation),
    }


def equation_data(equation: VelocityEquation) -> dict[str, Any]:
    """N, n, the configuration space and L."""
    space = equation.space
    return {
        "N": equation.N,
        "n": equation.n,
        "formulation": space.formulation,
        "variables": list(space.variables),
        "parameters": list(space.parameters),
        "mountings": list(space.mountings),
        "constants": {c.name: c.text for c in space.ring.constants},
        "equations": [str(e) for e in space.equations],
        "exclusions": [[str(e) for e in group] for group in space.exclusions],
        "positive": [str(e) for e in space.positive],
        "nonnegative": [str(e) for e in space.nonnegative],
        "columns": [{"label": c.label, "role": c.role} for c in equation.columns],
        "rows": list(equation.rows),
        "L": _entries(equation.L),
    }


def _entries(matrix: PolynomialMatrix) -> list[list[str]]:
    return [[str(e) for e in row] for row in matrix.rows]


def conditions_data(name: str, conditions: Conditions, lengths: NamedLengths | None = None) -> dict[str, Any]:
    """The velocity equation, its reduction, and the conditions; lengths: those that have names."""
    from singsym.conditions.named_lengths import NamedLengths

    written = lengths or NamedLengths()
    reduced = conditions.reduction.equation
    return {
        "mechanism": name,
        **equation_data(conditions.equation),
        "reduction": {
            "constant": conditions.reduction.constant,
            "record": list(conditions.reduction.lines),
            "columns": [c.label for c in reduced.columns],
            "rows": list(reduced.rows),
            "L": _entries(reduced.L),
        },
        "lengths": {name: str(value) for name, value in written.values.items()},
        "conditions": [condition_data(c, written) for c in conditions],
    }


def condition_data(condition: Condition, lengths: NamedLengths | None = None) -> dict[str, Any]:
    """A condition with its factors, null in names of lengths where they have no such form.

    alternatives: null where it is left as a rank; bracket: what a long determinant is of lines.
    """
    alternatives, bracket = condition.alternatives, condition.bracket
    return {
        "label": condition.label,
        "statement": condition.statement,
        "types": condition.types,
        "everywhere": condition.everywhere,
        "bracket": None
        if bracket is None
        else {"name": bracket.text, "words": bracket.words, "latex": bracket.latex},
        "alternatives": None
        if alternatives is None
        else [
            [
                {
                    "polynomial": str(f.polynomial),
                    "multiplicity": f.multiplicity,
                    "name": f.name.quantity.text if f.name else "",
                    "words": f.words,
                    "joint": None
                    if f.joint is None
                    else {
                        "name": f.joint.joint,
                        "values": list(f.joint.values),
                        "unit": f.joint.unit,
                        "rounded": f.joint.rounded,
                    },
                    "latex": f.latex(),
                    "in_lengths": str(named) if lengths and (named := lengths.of(f.polynomial)) else None,
                }
                for f in alternative
            ]
            for alternative in alternatives
        ],
        "units": [{"polynomial": str(u.polynomial), "reason": u.reason} for u in condition.units],
    }


def classes_data(table: Table, n: int) -> dict[str, Any]:
    """Table 1 for mobility n."""
    listed = [c for cells in table.cells for c in cells if c is not None]
    return {
        "n": n,
        "rows": [list(r.names) for r in table.rows],
        "columns": [list(c.names) for c in table.columns],
        "cells": [[None if c is None else c.number for c in cells] for cells in table.cells],
        "classes": [
            {"number": c.number, "types": list(c.types.names), "words": c.words}
            for c in sorted(listed, key=lambda c: c.number)
        ],
    }


def classification_data(found: Classification) -> dict[str, Any]:
    """Everything that a classification found out."""
    from singsym.classes.conclusions import conditions_latex

    return {
        "mechanism": found.mechanism.name if found.mechanism else "",
        "N": found.equation.N,
        "n": found.equation.n,
        "summary": list(found.summary),
        "parameters": list(found.equation.space.parameters),
        "mountings": list(found.equation.space.mountings),
        "lengths": {name: str(value) for name, value in found.lengths.values.items()},
        "configuration_space": [
            {
                **extent_data(piece.extent),
                "smooth": piece.smooth,
                "delta": piece.defects.delta,
                "types": piece.defects.types.names,
                "certainty": piece.verdict.certainty,
                "remark": piece.remark,
            }
            for piece in found.configuration_space
        ],
        "loci": [
            {
                "number": number,
                "condition": locus.condition,
                "factor": str(locus.factor),
                "latex": locus.latex,
                "in_lengths": str(named) if (named := found.lengths.of(locus.factor)) else None,
                "words": locus.words,
                **extent_data(locus.extent),
                "components": locus.components,
                "points": locus.points,
                "verdict": str(locus.verdict.answer),
                "reason": locus.verdict.reason or locus.open or locus.remark,
            }
            for number, locus in enumerate(found.loci, 1)
        ],
        "classes": [
            {
                "number": result.singularity_class.number,
                "types": result.types.names,
                "verdict": str(result.verdict.answer),
                "certainty": str(result.verdict.certainty),
                **extent_data(result.extent),
                "dimension": result.dimension,
                "points": result.points,
                "components": result.components,
                "witnesses": [_witness(w) for w in result.witnesses],
                "witness_numbers": [w.floats() for w in result.witnesses],
                "conditions": result.conditions,
                "unsure": [conditions_latex([piece]) for piece in result.unsure],
                "steps": list(result.steps),
                "reason": result.verdict.reason or result.open or result.remark,
            }
            for result in found.classes
        ],
        "open": [{"what": what, "reason": reason} for what, reason in found.open_questions()],
        "remarks": list(found.notes()),
        "engines": list(found.engines),
        "seed": found.seed,
        "seconds": round(found.seconds, 3),
    }


def class_rows(found: Classification) -> list[dict[str, Any]]:
    """The 21 classes, a row of text and numbers each; None where there is no number, or it is open.

    at_least: the dimension, as far as it is known; witnesses: how many certified configurations there are.
    """
    return [
        {
            "class": result.singularity_class.number,
            "types": result.singularity_class.name,
            "verdict": str(result.verdict.answer),
            "certainty": str(result.verdict.certainty),
            "dimension": result.dimension,
            "at_least": result.extent.at_least if result.verdict.is_yes else None,
            "points": result.points,
            "components": result.components,
            "witnesses": len(result.witnesses),
            "steps": ", ".join(result.steps),
            "reason": result.verdict.reason or result.open or result.remark,
        }
        for result in found.classes
    ]


def extent_data(extent: Extent) -> dict[str, Any]:
    """The dimension, None where it is not known, with what is known of it then and why no more is.

    >>> from singsym.varieties.real.dimension.extent import Extent
    >>> extent_data(Extent(1, None, open="out of time"))
    {'dimension': None, 'at_least': 1, 'dimension_reason': 'out of time'}
    """
    found: dict[str, Any] = {"dimension": extent.dimension}
    if extent.dimension is None and extent.at_least >= 0:
        return {**found, "at_least": extent.at_least, "dimension_reason": extent.open}
    return {**found, "dimension_reason": extent.resting} if extent.resting else found


def _witness(found: Configuration) -> dict[str, str]:
    """One flat object name -> decimal string, with `radius`."""
    return {**found.decimals(), "radius": found.radius}


def mobility_data(name: str, equation: VelocityEquation, found: Mobility) -> dict[str, Any]:
    """Generic ranks at random configurations, and what they contradict."""
    return {
        "mechanism": name,
        "N": equation.N,
        "n": equation.n,
        "ranks": found.ranks,
        "samples": found.samples,
        "regular": found.regular,
        "problems": list(found.messages),
    }


def solution_data(
    name: str, solutions: Iterable[Solution], lengths: NamedLengths | None = None
) -> dict[str, Any]:
    """The solution sets of conditions; lengths: those that have names."""
    from singsym.conditions.named_lengths import NamedLengths

    written = lengths or NamedLengths()
    return {
        "mechanism": name,
        "lengths": {name: str(value) for name, value in written.values.items()},
        "solutions": [
            {
                "condition": s.condition.label,
                "statement": s.condition.statement,
                "verdict": str(s.verdict.answer),
                **extent_data(s.extent),
                "pieces": [
                    {
                        "equations": [str(p) for p in piece.path],
                        "in_lengths": [str(written.shown(p)) for p in piece.path],
                        "basis": [str(p) for p in piece.basis],
                        "exclusions": [[str(p) for p in group] for group in piece.exclusions],
                        "verdict": str(piece.verdict.answer),
                        "certainty": str(piece.verdict.certainty),
                        **extent_data(piece.extent),
                        "points": piece.points,
                        "witnesses": [_witness(w) for w in piece.witnesses],
                    }
                    for piece in s.pieces
                ],
                "undecided": list(s.doubts),
            }
            for s in solutions
        ],
    }


def analysis_data(name: str, found: Analysis) -> dict[str, Any]:
    """Everything about one configuration."""
    located = found.located
    return {
        "mechanism": name,
        "N": found.equation.N,
        "n": found.equation.n,
        "exact": found.exact,
        "variables": {k: _number(x, found.digits) for k, x in found.values.items()},
        "points": {k: [_number(x, found.digits) for x in place] for k, place in found.points.items()},
        "joints": {k: _number(x, found.digits) for k, x in found.joints.items()},
        "residual": None
        if located is None
        else {"before": located.before, "after": located.after, "moved": located.moved},
        "threshold": found.threshold,
        "length": found.length,
        "ranks": found.ranks,
        "matrices": {
            key: {
                "rank": m.rank,
                "regular": m.full,
                "singular_values": list(m.singular_values),
                "distance": _finite(m.distance),
                "gap": _finite(m.gap),
            }
            for key, m in found.matrices.items()
        },
        **found.defects._asdict(),
        "types": list(found.types.names),
        "class": found.singularity_class.number if found.singularity_class else None,
        "motions": [
            {"type": m.type.name, "restriction": m.restriction, "rates": dict(m.rates)} for m in found.motions
        ],
        "remarks": list(found.remarks),
        "undecided": found.undecided or None,
    }


def _finite(value: float) -> float | None:
    return None if value == float("inf") else value


def _number(value: Any, digits: int) -> float | str:
    """A float as it is, an mpmath number as text with its digits."""
    if isinstance(value, (int, float)):
        return float(value)
    import mpmath

    return str(mpmath.nstr(value, digits))
