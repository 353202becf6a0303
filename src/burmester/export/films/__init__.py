"""Films: the linkage drawn frame by frame."""
