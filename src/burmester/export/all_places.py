"""Where the bodies of a linkage are along all of its motion, for collision checks."""

from __future__ import annotations

from typing import Final

import numpy as np

from burmester.export.reference import Reference
from burmester.fourbar.circuits import Circuits, circuit_of
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.bodies import LinkPlaces
from burmester.numerics.arrays import FloatArray
from burmester.synthesis.result import Candidate
from burmester.verdicts.found_linkage import FoundLinkage

ALL_PLACES: Final = 721  # places along the motion at which plates are compared


def all_places(chosen: Candidate, reference: Reference) -> LinkPlaces:
    """Where the bodies of a linkage are along all branches that have poses; those among them."""
    if not isinstance(chosen, FoundLinkage):
        drive = np.union1d(chosen.along(ALL_PLACES), chosen.drive)
        return reference.bodies(drive, chosen.body(drive))
    assert reference.dyads is not None
    places = _on_branches(reference.dyads, reference.places, ALL_PLACES)
    return reference.bodies(places.angle, places)


def _on_branches(linkage: Linkage, places: Displacement, looks: int) -> Displacement:
    """Coupler places (n,) along each branch of a circuit from its first to its last of places (N,).

    The places themselves are among them, in their order along the way.  Whole turns are cut where
    the places leave the widest gap.
    """
    circuits = Circuits.of(linkage, as_given=True)
    here = circuit_of(linkage, places, as_given=True)
    rows: list[FloatArray] = []
    on = np.isfinite(here.parameter) & (here.circuit >= 0)
    for circuit, branch in sorted(set(zip(here.circuit[on], here.branch[on], strict=True))):
        own = circuits[int(circuit)]
        which = on & (here.circuit == circuit) & (here.branch == branch)
        s = here.parameter[which]
        if own.closed and own.branches == 1:
            order = np.sort(s % (2 * np.pi))
            gap = np.append(order[1:], order[0] + 2 * np.pi) - order
            cut = order[(int(gap.argmax()) + 1) % len(order)]
            s = cut + (s - cut) % (2 * np.pi)
        s = np.unique(np.concatenate([np.linspace(s.min(), s.max(), looks), s]))
        with np.errstate(invalid="ignore", divide="ignore"):
            along = own.couplers(s)
        rows.append(np.column_stack([along.translation, along.angle]))
    rows.append(np.column_stack([places.translation, places.angle]))
    table = np.concatenate(rows if len(rows) == 1 else rows[:-1])
    return Displacement.from_poses(table[np.isfinite(table).all(axis=1)])
