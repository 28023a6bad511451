"""singsym finds and classifies every singularity of a mechanism, exactly."""
