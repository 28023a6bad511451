"""The script of a worker process for Groebner bases in Python libraries, which cannot be interrupted.

Source: FLINT's `fmpz_mpoly_buchberger_naive`; SymPy's `groebner`.  Imports only the library named on its
command line, to start fast.  Messages are pickles behind an eight-byte length: (names, order, polynomials
as lists of (exponents, coefficient)) in, a list of such polynomials out.
"""

from __future__ import annotations

import pickle
import sys
from typing import Any

Request = tuple[tuple[str, ...], str, list[list[tuple[tuple[int, ...], str]]]]


def by_flint(request: Request) -> list[Any]:
    """The reduced Groebner basis by FLINT."""
    from flint import Ordering, fmpz, fmpz_mpoly_ctx, fmpz_mpoly_vec

    names, order, polynomials = request
    context = fmpz_mpoly_ctx.get(names, Ordering[order])
    vector = fmpz_mpoly_vec([context.from_dict({m: fmpz(c) for m, c in p}) for p in polynomials], context)
    basis = vector.buchberger_naive().autoreduction()
    return [[(m, str(c)) for m, c in p.terms()] for p in basis]


def by_sympy(request: Request) -> list[Any]:
    """The reduced Groebner basis by SymPy."""
    import sympy

    names, order, polynomials = request
    symbols = sympy.symbols([f"x{i}" for i in range(len(names))])
    known = {"degrevlex": "grevlex", "lex": "lex", "deglex": "grlex"}[order]
    given = [sympy.Poly({m: sympy.Integer(c) for m, c in p}, *symbols, domain="QQ") for p in polynomials]
    basis = sympy.groebner(given, *symbols, order=known, domain="QQ").polys
    cleared = [p.clear_denoms(convert=True)[1] for p in basis]
    return [[(m, str(c)) for m, c in p.terms()] for p in cleared]


def serve(answer: Any) -> None:
    """Answer requests until the input ends."""
    sys.set_int_max_str_digits(0)
    while len(header := sys.stdin.buffer.read(8)) == 8:
        request = pickle.loads(sys.stdin.buffer.read(int.from_bytes(header, "big")))
        reply = pickle.dumps(answer(request))
        sys.stdout.buffer.write(len(reply).to_bytes(8, "big") + reply)
        sys.stdout.buffer.flush()


if __name__ == "__main__":
    serve({"flint": by_flint, "sympy": by_sympy}[sys.argv[1]])
