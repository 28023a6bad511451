"""Certificates of classifications: `prover` writes them, `checker` verifies them and knows nothing else."""
