"""Ideals, and the engines that compute with them: bases, elimination, minimal primes, dimensions."""
