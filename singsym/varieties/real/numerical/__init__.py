"""Numerical real points: Gauss-Newton from random starts.  They find; they prove nothing."""
