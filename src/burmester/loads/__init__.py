"""Loads on linkages: what moves them, what holds them, and what their joints bear."""
