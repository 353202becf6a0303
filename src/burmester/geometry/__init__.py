"""Displacements of the plane, their image points, and what lies among them."""
