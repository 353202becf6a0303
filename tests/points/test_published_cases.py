"""Published problems with points: as many solutions, and as many real ones, as others counted."""

import numpy as np

from burmester.geometry.displacement import Displacement
from burmester.points.real_linkages import linkages_through
from tests.oracles import witness

# C. W. Wampler, A. P. Morgan and A. J. Sommese, Complete solution of the nine-point path synthesis
# problem for four-bar linkages, Journal of Mechanical Design 114, 1992, problem 3.  Of its 8,652 =
# 6 x 1,442 solutions 384 = 6 x 64 are real, which J. D. Hauenstein and F. Sottile certified (ACM
# Transactions on Mathematical Software 38, 2012, algorithm 921): six are the cognates of one curve,
# each with its dyads in both orders.
NINE = [
    (0.25, 0.00), (0.52, 0.10), (0.80, 0.70), (1.20, 1.00), (1.40, 1.30),
    (1.10, 1.48), (0.70, 1.40), (0.20, 1.00), (0.02, 0.40),
]  # fmt: skip
# A. P. Morgan and C. W. Wampler, Solving a planar four-bar design problem using continuation,
# Journal of Mechanical Design 112, 1990, problem 7: five points on a line, with the fixed pivots
# (0, 0) and (1, 0).  J. Verschelde's PHCpack finds 36 solutions of points in general position, 33
# of these, of which 15 are real.
FIVE_ON_A_LINE = [(0.50, 1.06), (-0.83, -0.27), (-0.34, 0.22), (-0.13, 0.43), (0.22, 0.78)]


def through(points, pivots=None):
    """The four-bars through points; that each of them meets them is seen by other code."""
    places = Displacement(np.array(points), np.zeros(len(points)))
    found = linkages_through(places, np.ones(len(points), dtype=bool), pivots)
    for k in range(0, len(found.batch), 16):
        linkage = found.batch.linkage(k)
        assert max(witness.missed(linkage, place) for place in found.places[k]) < 1e-6
    return found


def test_nine_points_of_wampler_morgan_and_sommese():
    found = through(NINE)
    assert (found.classes, found.found, found.real, len(found.batch)) == (1442, 1442, 64, 192)


def test_five_points_on_a_line_of_morgan_and_wampler():
    pivots = np.array([(0.0, 0.0), (1.0, 0.0)])
    found = through(FIVE_ON_A_LINE, pivots)
    assert (found.classes, found.found, found.real) == (36, 33, 15)
    assert np.abs(found.batch.dimensions[..., :2] - pivots).max() < 1e-12
