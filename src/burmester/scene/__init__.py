"""Linkages as display lists: what is drawn, whoever draws it."""
