"""Ideals, the engines that compute with them, and the conditions of the classification."""
