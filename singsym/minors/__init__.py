"""Determinants, minors, block forms and ranks of polynomial matrices."""
