"""Coupler curves: linkages whose coupler point comes nearest to many points of a path."""
