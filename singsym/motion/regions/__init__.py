"""Regions without singularities: what joins two configurations or keeps them apart, and free boxes."""
