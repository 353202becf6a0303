"""Solid parts: STEP, STL and OpenSCAD."""
