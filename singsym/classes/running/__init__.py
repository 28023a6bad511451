"""How tasks run: on several processes or a cluster, with a cache on disk of what was found."""
