"""Real curves: their connected components, singular points and ends, proven, with polylines for drawing.

From equations to critical and singular points, half-branches, tracked and proven arcs, and their graph.
"""
