"""Paths timed by the crank: poses of a cognate.

Where the coupler point of a crank-driven linkage is at P_j while the crank has turned by tau_j, one
of its cognates carries a body that turns as the crank does, with its origin at the same point.  So
that cognate guides a body through the poses (P_j, tau_j), and motion generation finds it.  Of a
pair of dyads there, each gives a crank: at its fixed pivot G, with the crank vector -T z and the
moving pivot G - T z at the turn T, z being its moving pivot.  Five timed points are met exactly by
at most twelve such linkages; of more, every locally best dyad of the poses is a start value.
"""

from __future__ import annotations

import numpy as np

from burmester.curves.crank_linkages import CrankLinkages
from burmester.dyads.five_poses import dyads_of_five
from burmester.dyads.local_minima import best_dyads
from burmester.fourbar.cognates import cognates
from burmester.fourbar.dyad import RR
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of, pairs_of

MAX_DYADS = 12  # the best of the poses of more points; each pair of them is two start values
LONGEST = 50.0  # radii of gyration; dyads with longer links are none to start from


def linkages_of_five_points(
    points: FloatArray, crank_angles: FloatArray
) -> tuple[LinkageBatch, FloatArray]:
    """All linkages (k,) that trace five points (5, 2) at five crank angles (5,), in radians.

    Their first dyad is the crank, and it turns from point to point as the angles do; the coupler
    point is the origin of M.  Returns them with their places (k, 5, 3): x, y, angle.  They may need
    another branch, or meet the points in another order: nothing here judges them.

    Raises
    ------
    InputError
        E121 (other than five points), E103 (a number that is not finite).
    """
    places = Displacement(np.asarray(points, dtype=np.float64), np.asarray(crank_angles))
    found = dyads_of_five(places)
    return _with_cranks(found.dyads, places)


def timed_starts(points: ComplexArray, timing: FloatArray) -> tuple[CrankLinkages, FloatArray]:
    """Linkages (k,) near five or more timed points (n,) about 1 in size; crank angles (k, n)."""
    places = Displacement(pairs_of(points), timing)
    circles = best_dyads(places).dyads
    near = np.flatnonzero(circles.radius < LONGEST)[:MAX_DYADS]
    batch, rows = _with_cranks(circles[near], places)
    return CrankLinkages.of(batch, rows)


def _with_cranks(dyads: RR, poses: Displacement) -> tuple[LinkageBatch, FloatArray]:
    """The cognates of all pairs of dyads (k,) that have a crank at the first one's fixed pivot."""
    number = len(dyads.radius)
    one, two = np.nonzero(~np.eye(number, dtype=bool))
    (found, *_) = cognates(Linkage(dyads[one], dyads[two]))
    batch = LinkageBatch.of_pins(found)
    # The body of a cognate turns as the link of the dyad, and its angle is that link's direction.
    link = complex_of(poses.act(dyads[one].moving_pivot[:, None, :]))
    angle = np.unwrap(np.angle(link - complex_of(dyads[one].fixed_pivot)[:, None]), axis=-1)
    origin = np.broadcast_to(poses.translation, (*angle.shape, 2))
    rows = np.concatenate([origin, angle[..., None]], axis=-1)
    z = batch.dimensions
    sound = np.isfinite(z).all(axis=(1, 2)) & (z[:, :, 4] > 0).all(axis=1)
    return batch[sound], rows[sound]
