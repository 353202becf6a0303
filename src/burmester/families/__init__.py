"""The linkages that few poses, or poses with tolerances, leave open, and the best of them."""
