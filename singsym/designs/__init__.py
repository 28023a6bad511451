"""How the table of classes depends on dimensions: borders in the space of parameters, and cells between them.

Source: D. Lazard, F. Rouillier, Solving parametric polynomial systems, J. Symb. Comput. 42 (2007) 636-667.
"""
