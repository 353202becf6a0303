"""The planar four-bar: its dyads, its links, how it moves, and where it locks."""
