"""Models for simulation: MJCF and URDF, with masses, limits and a motor."""
