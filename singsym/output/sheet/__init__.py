"""The paper's sheet in LaTeX: L in blocks with short names, and the steps 1 to 6 with what each found."""
