"""What a person or a controller sees of configurations in numbers: code, distances, a followed motion."""
