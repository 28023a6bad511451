"""Proofs about the real solutions of equations, exclusions and inequalities: that there are none, above all.

Sums of squares, signs of polynomials in unit vectors, bounds, and a point on every connected component.
"""
