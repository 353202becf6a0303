"""Clearance: how far body and links stay from what they must not touch, along the motion."""
