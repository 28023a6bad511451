"""What an answer may cost and how it is known: budgets, patience, random draws, progress, verdicts.

All of it is counted in processor time or in work, so that a busy machine changes how long an answer takes,
and a short budget how much is decided, never what.
"""
