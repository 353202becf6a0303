"""Poses and points mixed: every four-bar through them, by following solved problems.

A pose asks for a place of the body and its angle, a point for the place alone (Alt-Burmester).
"""
