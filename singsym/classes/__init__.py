"""The classification of a mechanism's singular configurations, and the solution sets of single conditions.

`taxonomy` says which classes there are, `strata` searches for the parts of the configuration space where the
ranks are constant, `realisation` finds out which of them are real and how large, `running` has the processes
and the cache; `configuration` is about one given configuration.
"""
