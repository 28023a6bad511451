"""The search for strata, parts of the configuration space on which the four ranks are constant.

A branch is taken apart into patches; on each, the ranks come from minors that do not vanish, and the zeros of
those are further branches.
"""
