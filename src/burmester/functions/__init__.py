"""Functions: linkages whose output angle is a given function of the input angle."""
