"""Proofs of dyads, in ball arithmetic."""
