"""Solution sets: decomposition, constructible sets, and real points, dimensions and curves."""
