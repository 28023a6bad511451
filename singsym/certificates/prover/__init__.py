"""Certificates are written here: what a search finds is put into steps that the checker can follow."""
