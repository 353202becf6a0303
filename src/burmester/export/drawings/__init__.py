"""Drawings: plates for cutting and the assembly, with dimensions, and pages at 1:1."""
