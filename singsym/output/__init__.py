"""What a person sees: text, LaTeX and plain data of conditions, classes and configurations."""
