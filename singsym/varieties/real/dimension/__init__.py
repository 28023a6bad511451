"""The real dimension of a set: from below by a smooth point, from above by elimination and random values."""
