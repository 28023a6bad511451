"""Singularity types, the 21 classes, and the classification of a mechanism's configurations."""
