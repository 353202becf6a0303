"""Linkage synthesis: pairs of dyads refined, judged and ranked."""
