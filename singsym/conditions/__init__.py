"""The paper's conditions (4), (5) and (i) to (viii): their polynomials, and what they say of points.

They come from the determinants and minors of the velocity equation; `elimination` solves them.
"""
