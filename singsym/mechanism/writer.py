"""`Mechanism` to TOML text that reads back as the same mechanism.

Source: singsym's own format, in TOML (https://toml.io).
"""

from __future__ import annotations

import json
from collections.abc import Mapping

import sympy

from singsym.mechanism.model import Coupling, JointRate, Mechanism, Output, Parameter, PointVelocity, Vector


def dumps(mechanism: Mechanism) -> str:
    """The file of a mechanism; raises `ValueError` for a dimension outside the file's grammar.

    Shorthands are written out: links as points and axes, k links on a pin as k-1 joints.

    >>> from singsym.mechanism import load, loads
    >>> loads(dumps(load("fourbar")), origin="fourbar.toml") == load("fourbar")
    True
    """
    lines = [f"name = {_quote(mechanism.name)}"]
    lines += [
        f"{key} = {_quote(getattr(mechanism, key))}"
        for key in ("title", "source", "description")
        if getattr(mechanism, key)
    ]
    lines.append(f'space = "{mechanism.space}"')
    lines.append(f"ground = {_quote(mechanism.ground)}")
    if mechanism.formulation != "auto":
        lines.append(f"formulation = {_quote(mechanism.formulation)}")
    if mechanism.mobility is not None:
        lines.append(f"mobility = {mechanism.mobility}")
    if mechanism.translating:
        lines.append(f"translating = {_names(mechanism.translating)}")
    lines.append(f"inputs = {_names(mechanism.inputs)}")
    lines.append(f"output = [{', '.join(_output(o) for o in mechanism.outputs)}]")
    if mechanism.parameters:
        lines += ["", "[parameters]", *(_parameter(p) for p in mechanism.parameters)]
    lines += ["", "[links]"]
    for link in mechanism.links:
        parts = {"points": _vectors(link.points), "axes": _vectors(link.axes)}
        body = ", ".join(f"{key} = {text}" for key, text in parts.items() if text != "{}")
        lines.append(f"{link.name} = {{ {body} }}")
    lines += ["", "[joints]", *_joints(mechanism)]
    if mechanism.limits:
        lines += ["", "[limits]"]
        for limit in mechanism.limits:
            ends = {"min": limit.low, "max": limit.high}
            body = ", ".join(f"{key} = {_number(end)}" for key, end in ends.items() if end is not None)
            lines.append(f"{_quote(spell(limit.expression))} = {{ {body} }}")
    if mechanism.exclusions:
        lines += ["", "[exclusions]"]
        for e in mechanism.exclusions:
            said = (
                f"zero = {_quote(spell(e.expression))}"
                if e.expression is not None
                else f"coincide = {_names(e.points)}"
            )
            lines.append(f"{_quote(e.words)} = {{ {said} }}")
    if mechanism.couplings:
        lines += ["", "[couplings]", *map(_coupling, mechanism.couplings)]
    return "\n".join(lines) + "\n"


def _coupling(coupling: Coupling) -> str:
    if coupling.lift is not None:
        follower = _quote(coupling.terms[0][0])
        return f"{coupling.name} = {{ follower = {follower}, lift = {_number(coupling.lift)} }}"
    rates = ", ".join(f"{_quote(column)} = {_number(x)}" for column, x in coupling.terms)
    constant = "" if coupling.constant is None else f", constant = {_number(coupling.constant)}"
    return f"{coupling.name} = {{ rates = {{ {rates} }}{constant} }}"


def _joints(mechanism: Mechanism) -> list[str]:
    lines = []
    for joint in mechanism.joints:
        pairs = {"at": joint.at, "axis": joint.axes, "reference": joint.reference}
        body = f'type = "{joint.kind}", links = {_names((joint.first, joint.second))}'
        body += "".join(f", {key} = {_names(pair)}" for key, pair in pairs.items() if pair is not None)
        if joint.pitch is not None:
            body += f", pitch = {_number(joint.pitch)}"
        lines.append(f"{joint.name} = {{ {body} }}")
    return lines


def spell(expression: sympy.Expr) -> str:
    """An expression in the file's grammar; raises `ValueError` where it has no such form.

    >>> x = sympy.Symbol("x")
    >>> spell(sympy.sqrt(3) * x / 2 - sympy.sin(2 * sympy.pi / 9))
    'sqrt(3)*x/2 - sin(2*pi/9)'
    >>> spell((1 + sympy.sqrt(2)) ** sympy.Rational(7, 4))
    '(sqrt(2) + 1)*sqrt(sqrt(sqrt(2) + 1))**3'
    """
    # The roots that sqrt gives, also one within another, are written as symbols of that spelling.
    roots = {
        power: _whole(power.base) ** sympy.floor(power.exp) * _root(power) ** (power.exp.p % power.exp.q)
        for power in expression.atoms(sympy.Pow)
        if power.exp.is_Rational and power.exp.q > 1 and int(power.exp.q).bit_count() == 1
    }
    spelled = expression.xreplace(roots)
    allowed = (sympy.Add, sympy.Mul, sympy.Pow, sympy.Rational, sympy.Symbol, sympy.sin, sympy.cos)
    for part in sympy.preorder_traversal(spelled):
        whole = not isinstance(part, sympy.Pow) or part.exp.is_Integer
        if not (isinstance(part, allowed) or part == sympy.pi) or not whole:
            raise ValueError(
                f"{part} cannot be written in a mechanism file: the grammar has no such expression"
            )
    return str(spelled)


def _whole(base: sympy.Expr) -> sympy.Expr:
    """The base of a whole power; one with roots of its own as a symbol of its spelling."""
    return base if base.is_Atom else sympy.Symbol(f"({spell(base)})")


def _root(power: sympy.Pow) -> sympy.Symbol:
    """The root in a power, of index 2, 4, 8, ..., as a symbol spelled with sqrt."""
    times = int(power.exp.q).bit_length() - 1
    return sympy.Symbol(f"{'sqrt(' * times}{spell(power.base)}{')' * times}")


def _number(value: sympy.Expr) -> str:
    return str(value) if value.is_Integer else _quote(spell(value))


def _quote(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _names(names: tuple[str, ...]) -> str:
    return f"[{', '.join(_quote(name) for name in names)}]"


def _vectors(named: Mapping[str, Vector]) -> str:
    body = ", ".join(f"{name} = [{', '.join(map(_number, v))}]" for name, v in named.items())
    return f"{{ {body} }}" if body else "{}"


def _parameter(parameter: Parameter) -> str:
    ends = {"value": parameter.value, "above": parameter.low, "below": parameter.high}
    body = ", ".join(f"{key} = {_number(end)}" for key, end in ends.items() if end is not None)
    return f"{parameter.name} = {{ {body} }}"


def _output(output: Output) -> str:
    if isinstance(output, JointRate):
        return f"{{ rate = {_quote(output.column)} }}"
    parts = _names(output.components)
    if isinstance(output, PointVelocity):
        start = f"velocity = {_quote(output.point)}, link = {_quote(output.link)}"
    else:
        start = f"twist = {_quote(output.link)}, at = {_quote(output.point)}"
    return f"{{ {start}, components = {parts} }}"
