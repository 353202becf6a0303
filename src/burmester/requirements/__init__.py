"""What can be asked of a linkage: each thing said once, for all who ask, judge, search or tell."""
