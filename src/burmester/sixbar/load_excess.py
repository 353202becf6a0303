"""How much too much a six-bar of a search bears at its poses, before it is judged in between."""

from __future__ import annotations

from typing import Final

import numpy as np

from burmester.loads.loaded_motion import LoadedBodies, LoadedMotion
from burmester.loads.masses import Masses
from burmester.mechanisms.bodies import LinkPlaces, bodies_of_skeleton, plate_names
from burmester.numerics.arrays import pairs_of
from burmester.requirements.loads import DRIVER_TORQUE, HAND_FORCE, PIN_FORCE
from burmester.sixbar.candidates import Candidates
from burmester.tasks.length_units import MILLIMETRES
from burmester.tasks.motion_task import Task

SEARCHED: Final = (HAND_FORCE, DRIVER_TORQUE, PIN_FORCE)
BETWEEN: Final = 0.03  # relative; so much more may be borne between the poses


def load_excess(found: Candidates, k: int, task: Task) -> float:
    """Logarithms of its greatest forces at the poses to their bounds, in one sum; 0 keeps them."""
    loads, linkage = task.loads, found.linkages[k]
    assert loads is not None
    if any(spring.kind == "torsion" for spring in loads.springs):
        return 0.0  # how far it is turned follows from the whole motion, which is judged later
    skeleton, frames = linkage.skeleton, linkage.frames()
    pivot = skeleton.drivers[int(found.driver[k])]
    metre = MILLIMETRES[task.length_unit or ""] / 1000
    own = bodies_of_skeleton(skeleton, frames, linkage.carries, pivot)
    bodies, named = own.scaled(metre), plate_names(skeleton)
    at = dict(zip(skeleton.joints, pairs_of(found.joints[k].T), strict=True))
    there = skeleton.places(frames, at)
    places = LinkPlaces({named[link]: each for link, each in there.items()}).scaled(metre)
    drive = np.unwrap(there[skeleton.crank(pivot)].angle)
    masses = Masses.of(bodies, loads, task.body, metre)
    of = LoadedBodies(loads, metre, bodies, masses, drive, (drive, places))
    loaded = LoadedMotion(of, drive, places)
    borne = {DRIVER_TORQUE: np.abs(loaded.effort)}
    if loads.hand is not None:
        pushed = [np.abs(loaded.hand_force(each)) for each in (loaded.effort, loaded.friction)]
        borne[HAND_FORCE] = pushed[0] + pushed[1]
    pins = loaded.pin_forces(-loaded.applied).values()
    borne[PIN_FORCE] = np.max([np.hypot(*each.T) for each in pins], axis=0)
    out = 0.0
    for each, bound in task.requirements.bounds.items():
        if each in SEARCHED:
            most = max(map(abs, bound)) if isinstance(bound, tuple) else bound
            share = float(np.nanmax(borne[each])) * (1 + BETWEEN) / most
            out += float(np.log(max(share, 1.0)))
    return out if np.isfinite(out) else np.inf
