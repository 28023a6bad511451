"""Real solution sets of polynomial systems.

`numerical` finds points, `points` makes them exact, `proofs` shows that there are none, `dimension` says how
large a set is, `curves` takes a set of dimension 1 apart.
"""
