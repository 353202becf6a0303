"""Outlines from drawings: a closed curve of a DXF or SVG file as a polygon."""
