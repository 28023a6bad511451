"""Designs as pages, plain data, LaTeX and charts.

Source: singsym's own.
"""
