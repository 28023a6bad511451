"""The checker of certificates: it reads, multiplies, reduces, evaluates and compares, without any search.

It imports nothing of singsym but its own modules, and beside the standard library FLINT's polynomials and
balls.
"""
