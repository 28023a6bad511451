"""From a stratum to real answers: whether it occurs, its dimension and points, a certified configuration."""
