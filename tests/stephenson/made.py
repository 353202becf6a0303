"""Stephenson linkages of plain dimensions."""

import numpy as np

from burmester.stephenson.chain import Chain
from burmester.stephenson.linkage import CLASSES, StephensonLinkage
from tests.oracles.stephenson import Dimensions

FIRST, SECOND, THIRD = (f"Stephenson {number} six-bar" for number in ("I", "II", "III"))

# Three linkages to exact decimals.
CRANK_ROCKER = Dimensions(1.0, -1.2 + 1.64j, 0.33, 0.99, -0.91 - 0.43j, 0.4, 1.28, 1.34)
MANY = Dimensions(1.0, 0.44 - 0.36j, 0.77, 1.6, -0.04 - 0.5j, 1.47, 1.79, 0.84)
TWICE = Dimensions(1.0, 0.516 - 0.88j, 1.209, 2.063, 0.529 + 1.258j, 1.174, 3.0, 3.0)


def linkage(own, name=THIRD, carries=None):
    """A linkage of a class; the chain's first link as it stands, if that is the ground."""
    kind = CLASSES[name]
    length, point = np.float64, np.complex128
    chain = Chain(
        base=length(own.b),
        f=point(own.f),
        first=length(own.ac),
        second=length(own.bd),
        arm=length(own.ce),
        d=point(own.d),
        upper=length(own.eg),
        lower=length(own.fg),
    )
    carries = carries or kind.skeleton.moving[-2]
    name = kind.skeleton.name
    plain = StephensonLinkage(name, carries, chain, np.array([0j, 1]), np.array([0j, 1]))
    lengths = dict(zip(kind.skeleton.bars, plain.lengths(), strict=True))
    ends = [kind.skeleton.links[link][:2] for link in (kind.skeleton.ground, carries)]
    ground, body = (np.array([0j, lengths[bar]]) for bar in ends)
    return StephensonLinkage(name, carries, chain, ground, body)
