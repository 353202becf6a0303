"""Dyad synthesis: every link, slider and slot that guides a body near its poses."""
