"""Figures: mechanisms in their configurations with null motions, and singularity curves."""
