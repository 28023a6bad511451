"""Real points of polynomial systems, found numerically and proven exactly or by interval arithmetic."""
