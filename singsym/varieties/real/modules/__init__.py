"""Square systems solved module by module: exactly where a module stands first, in balls where it has parents.

A module is a small square system in its own unknowns; all its real solutions over a point of its parents are
its assemblies there.
"""
