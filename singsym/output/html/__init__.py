"""Pages for a browser: the report of one mechanism, and the gallery of many."""
