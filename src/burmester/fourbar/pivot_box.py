"""The box that holds all pivots of a linkage while it moves over a range.

Fixed pivots stay.  A moving pivot runs along an arc or a line between the ends of its dyad's own
input; the arc's extreme points are at whole quarter turns.  The driver's input runs from end to
end of the range.  The other dyad's turns back where it would lock as a driver itself, and these
places are known in closed form.  So the box is exact, and nothing is sampled, except where a
linkage is at a change point: there the two dyads may divide the places differently into circuits.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.circuit_parameter import RangeType
from burmester.fourbar.circuits import Circuits
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.loop_closure import KINDS
from burmester.fourbar.traversal import QUARTER_TURN, quarters_inside
from burmester.geometry.displacement import Displacement
from burmester.mechanisms.pose_order import FULL_TURN, BoolArray
from burmester.numerics.arrays import FloatArray

# Of f (see `loop_closure`): where a linkage at a change point has a bound this near to an end of
# the range of f, the change point is at that end.
CHANGE_POINT_BOUND: Final = 1e-6
AT_STOP: Final = (
    1e-3  # radians, or spans of the range; a range that ends this near to a stop is there
)

CRANK, RAIL, SLOT = map(KINDS.index, (RR, PR, RP))
ROUNDING_STEP: Final = 1e-9  # radians; a step back round a circuit that is less is rounding
SAMPLES: Final = 361  # number of places at which a linkage at a change point is looked at


def extent(circuits: Circuits, parameters: FloatArray, inputs: FloatArray) -> FloatArray:
    """The diagonal (k,) of `pivot_box`, a length."""
    box = pivot_box(circuits, parameters, inputs)
    return np.asarray(np.linalg.norm(box[:, 1] - box[:, 0], axis=-1))


def pivot_box(circuits: Circuits, parameters: FloatArray, inputs: FloatArray) -> FloatArray:
    """The least and the greatest coordinates (k, 2, 2), in F, of all pivots over a range.

    circuits: (k,), of linkages that their first dyads drive, as given (see `Circuits.of`).
    parameters, inputs: (k, 2), the ends of the range by the parameter of the circuit and by the
        driver's input (`PoseRange.along` and `PoseRange.input_range`).

    An RP has no moving pivot: the point of its line that is in use is its fixed pivot.
    nan where there is no circuit.
    """
    loop = circuits.loop
    other, whole = _other_inputs(circuits, parameters)
    (one, two), (first, second) = loop.kinds, loop.dimensions
    paths = _paths(two, second, other)
    paths[~whole] = np.nan
    points = [_fixed(one, first), _fixed(two, second), _paths(one, first, inputs), paths]
    lost = np.flatnonzero(~whole & np.isfinite(parameters).all(axis=1) & (two != SLOT))
    if len(lost):
        some = circuits[lost]
        at = np.linspace(parameters[lost, 0], parameters[lost, 1], SAMPLES, axis=-1)
        path = np.full((len(whole), SAMPLES, 2), np.nan)
        path[lost] = some.couplers(at).act(second[2:4, lost].T[:, None])
        points.append(path)
    every = np.concatenate(points, axis=1)
    box = np.stack([end.reduce(every, axis=1) for end in (np.fmin, np.fmax)], axis=1)
    known = np.isfinite(inputs).all(axis=1)
    return np.where(known.reshape(-1, 1, 1), box, np.nan)


def _fixed(kind: NDArray[np.int8], z: FloatArray) -> FloatArray:
    """The fixed pivots (k, 1, 2) of dyads, as in `_paths`; nan where there is none."""
    return np.where((kind == RAIL)[:, None, None], np.nan, z[:2].T[:, None])


def _paths(kind: NDArray[np.int8], z: FloatArray, inputs: FloatArray) -> FloatArray:
    """Points (k, 6, 2) of moving pivots: the ends of their paths, and where an arc is extreme.

    kind: (k,), z: (5, k), of the dyads; inputs: (k, 2), the ends of their own input.  nan where
    there are fewer points: of an RP there is none.
    """
    out = np.full((len(kind), 6, 2), np.nan)
    crank, rail = np.flatnonzero(kind == CRANK), np.flatnonzero(kind == RAIL)
    if len(crank):
        low, high = inputs[crank, :1], inputs[crank, 1:]
        at = QUARTER_TURN * (np.floor(low / QUARTER_TURN) + np.arange(1, 5))
        angle = np.concatenate([low, high, np.where(at < high, at, low)], axis=1)
        x, y, _, _, radius = z[:, crank, None]
        out[crank, :, 0] = x + radius * np.cos(angle)
        out[crank, :, 1] = y + radius * np.sin(angle)
    if len(rail):
        normal, offset = np.exp(1j * z[0, rail, None]), z[1, rail, None]
        point = (offset + 1j * inputs[rail]) * normal
        out[rail, :2, 0], out[rail, :2, 1] = point.real, point.imag
    return out


def _other_inputs(circuits: Circuits, parameters: FloatArray) -> tuple[FloatArray, BoolArray]:
    """The least and greatest input (k, 2) of the second dyads over a range, and which are sure."""
    own = circuits.exchanged()
    low, high = parameters[:, 0], parameters[:, 1]
    with np.errstate(invalid="ignore", divide="ignore"):
        places = circuits.couplers(np.stack([low, (low + high) / 2, high], axis=-1))
        location = own.locate(places)
        number, start = location.circuit, location.parameter
        sure = (number >= 0).all(axis=1) & (number == number[:, :1]).all(axis=1)
        sure &= np.isfinite(start).all(axis=1) & ~circuits.near_change_point
        own = own[np.arange(len(sure)), np.maximum(number[:, 1], 0)]
        along = np.where(own.closed[:, None], _unwrapped(start), start)[:, [0, 2]]
        # Both ends in the order of this parameter.
        order = np.argsort(along, axis=1)
        ends = np.take_along_axis(along, order, axis=1)
        outer = places[:, [0, 2]][np.arange(len(sure))[:, None], order]
        at, inside = quarters_inside(ends, own)
        between = own.couplers(at)
        every = Displacement(
            np.concatenate([outer.translation, between.translation], axis=1),
            np.concatenate([outer.angle, between.angle], axis=1),
        )
        inputs = own.inputs(np.concatenate([ends, at], axis=1), every)
    inputs[:, 2:][~inside] = np.nan
    ends = np.stack([end.reduce(inputs, axis=1) for end in (np.fmin, np.fmax)], axis=-1)
    return ends, np.asarray(sure & np.isfinite(ends).all(axis=1))


def _unwrapped(start: FloatArray) -> FloatArray:
    """Three angles (k, 3) round a circle, without jumps, in the sense of one turn at most."""
    step = np.diff(start, axis=1)
    tried = []
    for sense in (1.0, -1.0):
        way = np.mod(sense * step, FULL_TURN)
        tried.append(np.where(way > FULL_TURN - ROUNDING_STEP, way - FULL_TURN, way))
    up, down = tried
    use_up = up.sum(axis=1) <= down.sum(axis=1)
    way = np.where(use_up[:, None], up, -down)
    return np.concatenate([start[:, :1], start[:, :1] + np.cumsum(way, axis=1)], axis=1)


def reserve(circuits: Circuits, inputs: FloatArray) -> FloatArray:
    """How far drivers go on below and above a range (k, 2) of their input, (k, 2).

    Radians, or a length where the input slides.  To the next dead point on the branch or, of a
    linkage at a change point, to the next place where its branches cross; where a slot turns
    along a rail, to where the coupler would be at infinity.  Infinite where nothing stops the
    driver: where it turns fully, or slides without end.  0 where the range ends at a stop, nan
    where there is no circuit.

    circuits: (k,), as given (see `Circuits.of`).
    """
    least, greatest = np.moveaxis(circuits.input_range, -1, 0)
    free = circuits.range_type == RangeType.WHOLE
    low, high = np.where(free, -np.inf, least), np.where(free, np.inf, greatest)
    out = np.stack([inputs[:, 0] - low, high - inputs[:, 1]], axis=-1)
    for stop in _crossings(circuits):
        beyond = np.stack([inputs[:, 0] - stop, stop - inputs[:, 1]], axis=-1)
        turned = np.mod(beyond + AT_STOP, FULL_TURN) - AT_STOP
        behind = beyond < -AT_STOP * np.ptp(inputs, axis=1)[:, None]
        slid = np.where(behind, np.inf, beyond)
        beyond = np.where(circuits.turns[:, None], turned, slid)
        out = np.fmin(out, np.where(np.isnan(beyond), np.inf, beyond))
    return np.where(np.isnan(low)[:, None], np.nan, np.maximum(out, 0.0))


def _crossings(circuits: Circuits) -> list[FloatArray]:
    """Inputs (k,) at which linkages at a change point have all links in line; nan for others."""
    loop, change = circuits.loop, circuits.near_change_point & circuits.exists
    if not change.any():
        return []
    below = change & (np.abs(loop.low.down) <= CHANGE_POINT_BOUND * loop.low.scale)
    above = change & (np.abs(loop.high.up) <= CHANGE_POINT_BOUND * loop.high.scale) & loop.turns
    return [
        np.where(above & (loop.high.scale > 0), loop.centre, np.nan),
        np.where(below & (loop.low.scale > 0), loop.centre + np.pi * loop.turns, np.nan),
    ]
