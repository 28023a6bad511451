"""Mechanisms as data: model, file format, checks, library."""
