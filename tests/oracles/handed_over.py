"""Linkages as they come from a result file, made here without a search: every kind of pair.

The places are those of the linkage at a few parameters along a circuit; the poses miss them by a
known little.
"""

import numpy as np

from burmester.dyads.selection import FoundDyad
from burmester.export import FORMATS, Options, export
from burmester.fourbar.circuits import Circuits
from burmester.fourbar.defects import Driven, Verdict
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.pose_error import PoseError
from burmester.geometry.displacement import Displacement
from burmester.tasks.length_units import MILLIMETRES
from burmester.tasks.motion_task import Task
from burmester.verdicts.found_linkage import FoundLinkage


def rr(fixed, moving, radius):
    return RR(np.array(fixed, float), np.array(moving, float), np.array(float(radius)))


def pr(degrees, offset, moving):
    return PR(np.radians(degrees), np.array(float(offset)), np.array(moving, float))


def rp(fixed, degrees, offset):
    return RP(np.array(fixed, float), np.radians(degrees), np.array(float(offset)))


# name: both dyads, the unit, parameters along the first circuit
GIVEN = {
    "crank-rocker, mm": (rr([0, 0], [5, -8], 20), rr([70, 10], [65, 10], 50), "mm", (0.4, 3.2)),
    "double-rocker, in": (rr([0, 0], [0, 1], 4), rr([5, 0.5], [2, 0], 3.5), "in", (0.5, 2.6)),
    "double-crank, cm": (rr([0, 0], [1, 0], 6), rr([2, 0.3], [5, 1], 7), "cm", (0.2, 4.0)),
    "slider-crank, no unit": (rr([1, 0], [0.1, 0], 1), pr(80, 0.4, [3, 0.2]), None, (0.4, 3.4)),
    "inverted slider-crank, ft": (rr([0, 0], [1, 0.3], 2), rp([5, 1], 70, 1.2), "ft", (0.3, 3)),
    "slider drives, m": (pr(95, 0.3, [0.2, 0.1]), rr([2, -1], [1.5, 0.4], 1.8), "m", (0.4, 2.4)),
    "slot drives, um": (rp([900, 100], 60, 200), rr([0, 0], [300, 40], 350), "um", (0.4, 1.8)),
    "trammel, mm": (pr(90, 5, [0, 0]), pr(10, -3, [80, -40]), "mm", (0.3, 2.8)),
    "Rapson slide, mm": (pr(80, 10, [5, 5]), rp([60, 70], 20, 12), "mm", (-20, 40)),
}
NAMES = list(GIVEN)


def found(linkage, task, error, id="L1"):
    """A usable linkage of an answer, driven by its first dyad; how it moves is left open."""
    nan, every = np.full(2, np.nan), np.full(len(error.position), np.nan)
    driven = Driven((), -1, False, every, np.nan, np.nan, every, nan, every)
    dyads = FoundDyad("D1", linkage.first, 0.0, 0.0), FoundDyad("D2", linkage.second, 0.0, 0.0)
    verdict = Verdict((), driven, driven)
    return FoundLinkage(
        1, dyads, linkage, 0.0, verdict, "first", True, id=id, error=error, task=task
    )


def saved(name, poses=6, given=None):
    """The linkage of that name, or one given as they are."""
    first, second, unit, span = given or GIVEN[name]
    linkage = Linkage(first, second)
    parameter = np.linspace(*span, poses)
    places = Circuits.of(linkage)[0].couplers(parameter)
    places = Displacement(places.translation, np.unwrap(places.angle))
    size = float(np.ptp(places.translation, axis=0).max())
    wave = np.arange(poses)
    off = 1e-3 * size * np.column_stack([np.cos(wave), np.sin(2 * wave)])
    wanted = Displacement(places.translation + off, places.angle + 1e-3 * np.sin(wave))
    return found(linkage, Task(wanted, length_unit=unit), PoseError.at(places, wanted))


def complex_places(chosen, scale=1.0):
    """The coupler's places as (d, e^(i angle)), complex."""
    places = chosen.error.places
    d = places.translation @ np.array([1, 1j]) * scale
    return d, np.exp(1j * places.angle)


def joints(chosen, number, scale=1.0):
    """The joints at a place, complex points of F: {"fixed1": , "moving1": , ...}.

    Sliders have the joint that they have: a PR its moving pivot, an RP its fixed one.
    """
    d, turn = (values[number] for values in complex_places(chosen, scale))
    found = {}
    for k, dyad in enumerate((chosen.linkage.first, chosen.linkage.second), start=1):
        if not isinstance(dyad, PR):
            found[f"fixed{k}"] = complex(*dyad.fixed_pivot) * scale
        if not isinstance(dyad, RP):
            found[f"moving{k}"] = d + complex(*dyad.moving_pivot) * scale * turn
    return found


PLAIN = Options()


def scale_of(chosen):
    return MILLIMETRES[chosen.unit or "mm"]


def dxf_unit(chosen):
    """The unit of a linkage's DXF, by ezdxf's code, and millimetres in it."""
    return (1, 25.4) if chosen.unit in ("in", "ft") else (4, 1.0)


def span_of(chosen, scale=1.0):
    every = [z for k in range(6) for z in joints(chosen, k, scale).values()]
    return float(np.hypot(np.ptp(np.real(every)), np.ptp(np.imag(every))))


def written(name, to, folder, options=PLAIN):
    chosen = saved(name)
    (path,) = export(chosen, to, folder / f"out{FORMATS[to].suffix}", options)
    return chosen, path
