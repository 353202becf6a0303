"""Numerics that knows no mechanism: arrays, least squares, quadratic programs."""
