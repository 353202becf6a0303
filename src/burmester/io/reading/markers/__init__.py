"""Recordings of markers: motion capture as poses."""
