"""Flat parts: plates with their holes, and pins, in layers that nothing is in the way of."""
