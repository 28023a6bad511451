"""Exact and boxed real points, and all points of a finite set.

An exact point is a rational function of an isolated root of one polynomial, a boxed one the only solution in
a box; both decide signs.  `certified_point` finds one on a system, `finite_sets` all.
"""
