"""Configurations in numbers: many at once, how far they are from a singularity, and along a trajectory."""
