"""Dyads of any kind, of about the size of 1, drawn at random."""

from burmester.fourbar.dyad import PR, RP, RR

KINDS = (RR, PR, RP)


def a_dyad(kind, rng):
    """One of a kind."""
    a, b, normal = rng.normal(size=2), rng.normal(size=2), rng.uniform(-3, 3)
    if kind is RR:
        return RR(a, b, rng.uniform(0.5, 2.0))
    return PR(normal, rng.normal(), b) if kind is PR else RP(a, normal, rng.normal())
