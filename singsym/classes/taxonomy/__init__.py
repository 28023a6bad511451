"""The six singularity types, the 21 classes, and the steps of the procedure in which each is found."""
