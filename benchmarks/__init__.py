"""Figures of speed, memory and accuracy, each beside what it replaces; see README.md."""
