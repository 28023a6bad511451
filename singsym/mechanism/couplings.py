"""Couplings: gears, belts, differentials, racks, cams, as linear relations between the rates of joints.

Source: textbook gear ratios; whole relations between angles as sublattices of Z^m (Cohen, A Course in
Computational Algebraic Number Theory (1993), section 2.4, the Hermite normal form).

With whole coefficients a, the angles of coupled joints satisfy a . theta = constant, and are known modulo
full turns.  Where the rows a span all whole vectors of their rational span, the angles that satisfy this
modulo full turns are those that are reached from one such configuration: gears that turn on come to each.

A rack, or a screw, ties an angle to a length, and no polynomial in its cosine and sine and the length
vanishes on the helix that they are on.  All helices together, one for each way to mount the rack, are all
angles and lengths: these are the configurations, and the mounting is one dimension that no motion has.

A cam gives a slide a length that is a polynomial in the cosine and sine of its angle, or in a length: the
ratio of the rates is its derivative, and no integral is left to be mounted.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from math import gcd, lcm
from typing import Any

import sympy
from flint import fmpq_mat, fmpz_mat
from sympy.polys.matrices import DomainMatrix

from singsym.mechanism.expressions import Quantities, is_angle
from singsym.mechanism.model import Coupling, JointKind, Mechanism
from singsym.mechanism.outputs import moving_polynomial, quantities
from singsym.mechanism.problems import shorten
from singsym.mechanism.reader import Reader

LARGEST = 100
"""Of the coprime whole coefficients of angles, which become exponents of cosines and sines."""

Finding = tuple[str, str, str, str]
_VALUE = re.compile(r"(?:cos|sin|length)\((.+)\)")


@dataclass(frozen=True)
class Relation:
    """The sum of coefficient * value of some joints' freedoms is constant: an angle modulo 2 pi, or a length.

    terms: column label and coefficient, of angles a whole number.
    """

    terms: tuple[tuple[str, sympy.Rational], ...]
    constant: sympy.Expr


# -- reading ----------------------------------------------------------------------------------------------


def read_couplings(value: Any, known: Quantities, reader: Reader) -> tuple[Coupling, ...]:
    """The table `couplings`: name = { rates = { JOINT = coefficient, ... }, constant = value }.

    Of a cam name = { follower = SLIDE, lift = "3 + 2*cos(JOINT)" }.
    """
    couplings = []
    for name, entry in reader.table(value, "couplings").items():
        place = f"couplings.{name}"
        reader.name(name, place)
        expected = 'a table { rates = { A = 1, B = 2 } } or { follower = "P", lift = "3 + cos(A)" }'
        if isinstance(entry, Mapping) and {"follower", "lift"} & entry.keys():
            couplings.append(_cam(name, entry, known, reader))
            continue
        read = reader.table(entry, place, ("rates", "constant"), expected)
        rates = reader.table(read.get("rates", {}), f"{place}.rates", expected="a table { A = 1, B = 2 }")
        terms = tuple(
            (column, reader.expression(number, f"{place}.rates.{column}")) for column, number in rates.items()
        )
        given, where = read.get("constant", 0), f"{place}.constant"
        sliding = [column in known.slides for column in rates]
        constant = reader.expression(given, where) if any(sliding) else reader.angle(given, where)
        if any(sliding) and not all(sliding) and "constant" not in read:
            constant = None
        couplings.append(Coupling(name, terms, constant))
    return tuple(couplings)


def _cam(name: str, entry: Mapping[str, Any], known: Quantities, reader: Reader) -> Coupling:
    """A cam, by the length of its follower."""
    place = f"couplings.{name}"
    read = reader.table(entry, place, ("follower", "lift"))
    follower, text = (reader.text(read.get(key, ""), f"{place}.{key}") for key in ("follower", "lift"))
    if not text:
        reader.report(f"{place}.lift", "no lift", 'the length of the follower, as "3 + 2*cos(A)"')
        return Coupling(name, ((follower, sympy.S.One),))
    lift = sympy.expand(moving_polynomial(text, known, f"{place}.lift", reader))
    names = {symbol.name for symbol in lift.free_symbols} - set(reader.parameters)
    drivers = {_freedom(name) for name in names}
    if names and ("" in drivers or len(drivers) > 1):
        expected = "a polynomial in cos(A) and sin(A) of one joint A, or in length(P) of one slide"
        turning = any(name.startswith("angle(") for name in names)
        advice = "of a length in proportion to an angle write the rates, as of a rack" if turning else ""
        reader.report(f"{place}.lift", shorten(text), expected, advice)
    return Coupling.cam(name, follower, min(drivers, default=""), lift)


def _freedom(name: str) -> str:
    """The joint freedom whose cosine, sine or length this is; "" of other quantities."""
    found = _VALUE.fullmatch(name)
    return "" if found is None else found[1]


# -- checks -----------------------------------------------------------------------------------------------


def check_couplings(mechanism: Mechanism) -> Iterator[Finding]:
    """What is wrong with the couplings of a mechanism whose joints and parameters are right."""
    known = quantities(mechanism.space, mechanism.links, mechanism.joints)
    names = [coupling.name for coupling in mechanism.couplings]
    for name in dict.fromkeys(name for name in names if names.count(name) > 1):
        yield f"couplings.{name}", f"{names.count(name)} couplings of this name", "each name once", ""
    resolved = mechanism.resolved.couplings
    found = [finding for coupling in resolved for finding in _faults(coupling, mechanism, known)]
    yield from found or _dependent(mechanism, resolved)


def _faults(coupling: Coupling, mechanism: Mechanism, known: Quantities) -> Iterator[Finding]:
    place = f"couplings.{coupling.name}"
    columns = [column for column, _ in coupling.terms]
    if len(set(columns)) < max(2, len(columns)):
        found = f"the rates of {', '.join(columns) or 'no joint'}"
        yield place, found, "two joints or more, each once", "write rates = { A = 1, B = 2 }"
    movable = [c for c in mechanism.columns if c in known.angles or c in known.slides]
    if coupling.lift is not None:
        yield from _cam_faults(coupling, known, movable)
        return
    for column, number in coupling.terms:
        where = f"{place}.rates.{column}"
        if column not in movable:
            close = get_close_matches(column, movable, 1)
            advice = f"did you mean {close[0]!r}?" if close else ""
            unknown = column not in mechanism.columns
            found = f"the unknown {column!r}" if unknown else f"{column!r}, a freedom without an angle"
            yield where, found, f"a joint freedom among {', '.join(movable)}", advice
        if not number.is_Rational:
            yield where, str(number), "a rational number, as 2 or -3/5", "give the ratio of numbers of teeth"
        elif number == 0:
            yield where, "the coefficient 0", "a coefficient other than 0", f"leave {column} out"
    slides = [column for column in columns if column in known.slides]
    turns = [column for column in columns if column in known.angles]
    if slides and turns:
        if coupling.constant is not None:
            found = f"a constant, of the slide {slides[0]} with the angle {turns[0]}"
            expected = "none: an angle is not algebraic in a length, and all ways to mount it are looked at"
            advice = "leave it out: a class that is empty for all mountings is so for each"
            yield f"{place}.constant", found, expected, advice
    elif coupling.constant is None:
        yield f"{place}.constant", "no constant", "that of the joints' values, as 0", ""
    elif turns and all(number.is_Rational and number for _, number in coupling.terms):
        largest = max(abs(x) for _, x in _coprime(coupling.terms, coupling.constant).terms)
        if largest > LARGEST:
            yield place, f"coprime whole coefficients up to {largest}", f"at most {LARGEST}", ""
        if not is_angle(coupling.constant):
            yield f"{place}.constant", str(coupling.constant), "an angle such as 40 deg or pi/6", ""


def _cam_faults(coupling: Coupling, known: Quantities, movable: Sequence[str]) -> Iterator[Finding]:
    """What is wrong with a cam whose follower and driver are two."""
    (follower, _), (_, slope) = coupling.terms
    place = f"couplings.{coupling.name}"
    if follower not in known.slides:
        slides = ", ".join(c for c in movable if c in known.slides) or "of which there is none"
        unknown = follower not in movable
        found = f"the unknown {follower!r}" if unknown else f"{follower!r}, which turns"
        advice = "" if unknown else "write the linkage that moves as cam and follower do"
        yield f"{place}.follower", found, f"a slide, {slides}", advice
    circles = [s for s in slope.free_symbols if s.name.startswith("sin(")]
    for sine in circles:
        cosine = sympy.Symbol(f"cos({_freedom(sine.name)})")
        slope = sympy.rem(slope, sine**2 + cosine**2 - 1, sine)
    if slope == 0:
        yield f"{place}.lift", f"the constant {coupling.lift}", "a lift that varies", ""


def _dependent(mechanism: Mechanism, couplings: Sequence[Coupling]) -> Iterator[Finding]:
    """Couplings that follow from others, and such that bind inputs alone."""
    for coupling in couplings:
        if {column for column, _ in coupling.terms} <= set(mechanism.inputs):
            found = f"inputs alone: {', '.join(column for column, _ in coupling.terms)}"
            yield (
                f"couplings.{coupling.name}",
                found,
                "a joint that is no input",
                "leave one of the inputs out",
            )
    names = ", ".join(coupling.name for coupling in couplings)
    if couplings and _rank(couplings, mechanism.columns) < len(couplings):
        yield "couplings", f"{names}, of which one follows from the others", "independent relations", ""
        return
    passive = [column for column in mechanism.columns if column not in mechanism.inputs]
    if couplings and _rank(couplings, passive) < len(couplings):
        yield "couplings", f"{names}, which together bind inputs alone", "inputs that are free", ""
    for relation in angle_relations(mechanism):
        if not is_angle(relation.constant):
            yield (
                "couplings",
                f"the constant {relation.constant} that follows from {names}",
                "a simpler angle",
                "",
            )


def _rank(couplings: Sequence[Coupling], columns: Sequence[str]) -> int:
    """The rank of the coefficients, a row for each coupling, at general values of the joints."""
    rows = [[dict(coupling.terms).get(column, sympy.S.Zero) for column in columns] for coupling in couplings]
    return int(DomainMatrix.from_Matrix(sympy.Matrix(rows)).to_field().rank()) if columns else 0


# -- relations between values -----------------------------------------------------------------------------


def is_sliding(mechanism: Mechanism, coupling: Coupling) -> bool:
    """Whether a coupling is one of slides alone, so that its constant is a length."""
    known = quantities(mechanism.space, mechanism.links, mechanism.joints)
    return all(column in known.slides for column, _ in coupling.terms)


def turning_terms(mechanism: Mechanism, coupling: Coupling) -> tuple[str, ...]:
    """The angles of a coupling."""
    known = quantities(mechanism.space, mechanism.links, mechanism.joints)
    return tuple(column for column, _ in coupling.terms if column not in known.slides)


def mountings(mechanism: Mechanism) -> tuple[str, ...]:
    """The screws and the racks, which may be mounted in any way."""
    racks = (coupling.name for coupling in mechanism.couplings if coupling.constant is None)
    return (*(joint.name for joint in mechanism.joints if joint.kind is JointKind.H), *racks)


def slide_relations(mechanism: Mechanism) -> tuple[Relation, ...]:
    """The relations between lengths of slides."""
    couplings = [c for c in mechanism.resolved.couplings if c.lift is None and is_sliding(mechanism, c)]
    return tuple(Relation(c.terms, c.constant) for c in couplings if c.constant is not None)


def angle_relations(mechanism: Mechanism) -> tuple[Relation, ...]:
    """The whole relations between angles, as many as couplings, from which all others follow."""
    couplings = [c for c in mechanism.resolved.couplings if c.lift is None and not is_sliding(mechanism, c)]
    return _whole([_coprime(c.terms, c.constant) for c in couplings if c.constant is not None])


def _coprime(terms: Sequence[tuple[str, sympy.Rational]], constant: sympy.Expr) -> Relation:
    """A relation between angles with coprime whole coefficients; its constant is divided with them."""
    factor = sympy.Rational(lcm(*(int(x.q) for _, x in terms)), gcd(*(int(x.p) for _, x in terms)))
    return Relation(tuple((column, x * factor) for column, x in terms), constant * factor)


def _whole(relations: Sequence[Relation]) -> tuple[Relation, ...]:
    """A basis of all whole combinations of whole relations, also with rational factors.

    The transposed coefficients have the Hermite normal form U A^T = (H, 0), so that A = H^T B with B a part
    of a unimodular matrix: its rows are the basis.

    >>> one, two = Relation((("A", 1), ("B", 1), ("C", -2)), 0), Relation((("A", 1), ("B", -1)), sympy.pi)
    >>> [dict(r.terms) for r in _whole((one, two))]  # A + B = 2 C and A - B = pi say that C - B = pi/2
    [{'A': 1, 'B': 1, 'C': -2}, {'B': -1, 'C': 1}]
    """
    columns = list(dict.fromkeys(column for relation in relations for column, _ in relation.terms))
    if not relations:
        return ()
    rows = [[int(dict(relation.terms).get(column, 0)) for column in columns] for relation in relations]
    normal = fmpz_mat(rows).transpose().hnf().table()[: len(rows)]
    factors = fmpq_mat(fmpz_mat(normal).transpose()).inv()
    basis = factors * fmpq_mat(fmpz_mat(rows))
    found = []
    for i, row in enumerate(basis.table()):
        terms = tuple((c, sympy.Integer(int(x.p))) for c, x in zip(columns, row, strict=True) if x)
        shares = (sympy.Rational(int(x.p), int(x.q)) for x in factors.table()[i])
        constant = sympy.Add(*(x * r.constant for x, r in zip(shares, relations, strict=True)))
        found.append(Relation(terms, constant))
    return tuple(found)
