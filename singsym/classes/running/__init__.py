"""How tasks run: on several processes, with a cache on disk of what was found."""
