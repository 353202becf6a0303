"""How many decimals the printed dimensions of a linkage or a dyad need to do what is promised.

Poses often leave pivots open by far more than the linkage misses them by: the pivots move together.
Then a dimension that is rounded to its own uncertainty makes another linkage, which misses the
poses by the uncertainty.  So each choice of decimals is tried: the dimensions are printed, read
back, and the linkage that they make is moved to the poses.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import final

import numpy as np
from numpy.typing import NDArray

from burmester.fourbar.dyad import PP, PR, RP, RR, Dyad, line_direction_deg
from burmester.fourbar.foot_points import foot_points, places_of, rows_of
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.pose_error import PoseError, error_frames
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import ROUNDING, FloatArray

GROWTH = 1.1  # times the promised error; the printed dimensions miss by no more
FINEST = 1e-6  # lengths and radians; where "exact" is promised, printed dimensions miss by no more
MOST_POSES = 500  # number of poses, with the greatest errors, for which printed linkages are moved
MOST_TRIALS = 16  # numbers of decimals that are tried; the last ones keep all digits of a double


@final
@dataclass(frozen=True, slots=True)
class Decimals:
    """Decimals of printed dimensions: of `lengths`, and of angles in `degrees`.

    error: the greatest position and angle (radians) errors of what is printed.
    middles: of each dyad the point (2,) by which its line is told, or None where it has no line.
    grid: decimals of the step of which dimensions are multiples, if they were rounded to one.
    """

    lengths: int
    degrees: int
    error: tuple[float, float]
    middles: tuple[FloatArray | None, ...]
    grid: int | None = None

    def of_length(self, value: float) -> int:
        """The decimals of one length: those of the grid where it lies on it."""
        on_grid = self.grid is not None and float(f"{value:.{self.grid}f}") == value
        return self.grid if self.grid is not None and on_grid else self.lengths

    def printed(self, *dyads: Dyad) -> tuple[Dyad, ...]:
        """The dyads that somebody has who reads the printed dimensions."""
        return tuple(map(self._printed, dyads, self.middles))

    def _printed(self, dyad: Dyad, middle: FloatArray | None) -> Dyad:

        def length(value: FloatArray) -> FloatArray:
            texts = [f"{each:.{self.lengths}f}" for each in np.ravel(value).tolist()]
            return np.array([float(text) for text in texts]).reshape(np.shape(value))

        def angle(value: float) -> FloatArray:
            return np.array(math.radians(float(f"{value:.{self.degrees}f}")))

        def line(side: PR | RP) -> tuple[FloatArray, FloatArray]:
            assert middle is not None
            normal = angle(direction_deg(side)) + math.pi / 2
            n = np.array([math.cos(normal), math.sin(normal)])
            return normal, np.asarray(length(middle) @ n)

        match dyad:
            case RR():
                return RR(*map(length, (dyad.fixed_pivot, dyad.moving_pivot, dyad.radius)))
            case PR():
                return PR(*line(dyad), length(dyad.moving_pivot))
            case RP():
                return RP(length(dyad.fixed_pivot), *line(dyad))
            case PP():
                return PP(angle(math.degrees(float(dyad.angle))))


def direction_deg(line: PR | RP) -> float:
    """The direction of a slider's line in its own frame, degrees in (-90, 90]."""
    return float(line_direction_deg(line.normal_angle))


def figures_of(size: float) -> int:
    """Decimals, none or more, that show a size with one digit, or two if the first is 1 or 2."""
    if not size > 0:
        return 12
    return max(0, math.ceil(-math.log10(size / 3))) if math.isfinite(size) else 0


def decimals_of_linkage(
    linkage: Linkage,
    poses: Displacement,
    error: PoseError,
    length: float,
    size: float,
    *,
    free_angles: NDArray[np.bool_] | None = None,
    at_least: int = 0,
) -> Decimals:
    """The least decimals with which a linkage misses its poses by less than a tenth more.

    poses: (N,); error: of the linkage at them; poses that it does not reach do not count.
    length: what a radian counts as; size: the task's characteristic length, both in its unit.
    free_angles: (N,), which count for nothing.
    at_least: decimals of lengths that are printed in any case.
    No fewer than show the error itself.  Both the greatest position error and the greatest angle
    error are kept; where "exact" is promised, they are FINEST lengths and radians at most.
    """
    here = _most_missed(error)
    dyads = linkage.first, linkage.second
    position, angle = (float(each[here].max(initial=0.0)) for each in (error.position, error.angle))
    promised = np.array(
        [
            position if position >= ROUNDING * size else FINEST * size,
            angle if angle >= ROUNDING else FINEST,
        ]
    )
    trials = _trials(dyads, error.places[here], promised, at_least)
    if not len(here) or any(isinstance(dyad, PP) for dyad in dyads):
        return trials[0]
    free = np.zeros(error.angle.shape, dtype=bool) if free_angles is None else free_angles
    asked, free = _asked(poses, error, free)
    errors = _errors_of(
        [linkage, *(Linkage(*each.printed(*dyads)) for each in trials)],
        asked[here],
        error.places[here],
        length,
        free[:, here],
    )
    # By another length for a radian than the caller's, the linkage itself has other errors.
    kept = np.asarray((errors <= GROWTH * np.maximum(promised, errors[0])).all(axis=-1))[1:]
    return _first(trials, kept, errors[1:])


def decimals_of_dyad(dyad: Dyad, poses: Displacement, size: float) -> Decimals:
    """The least decimals with which a dyad alone misses poses (N,) by less than a tenth more.

    Its root mean square and its greatest error.  size: as in `decimals_of_linkage`.
    """

    def errors(one: Dyad) -> tuple[float, float]:
        miss = np.abs(one.residual(poses))
        return float(np.sqrt((miss**2).mean())), float(miss.max())

    rms, worst = errors(dyad)
    least = FINEST * (1.0 if isinstance(dyad, PP) else size)
    exact = worst < ROUNDING * (1.0 if isinstance(dyad, PP) else size)
    promised = np.array([least, least] if exact else [rms, worst])
    trials = _trials((dyad,), poses, promised[[0, 0]], 0)
    values = np.array([errors(each.printed(dyad)[0]) for each in trials])
    return _first(trials, np.asarray((values <= GROWTH * promised).all(axis=-1)), values)


def _asked(
    poses: Displacement, error: PoseError, free_angles: NDArray[np.bool_]
) -> tuple[Displacement, NDArray[np.bool_]]:
    """Poses (N,), the linkage's where free, and which positions and angles (2, N) are free."""
    away = PoseError.at(error.places, poses).position
    moved = away > error.position + ROUNDING * (1 + error.position)
    asked = Displacement(
        np.where(moved[:, None], error.places.translation, poses.translation),
        np.where(free_angles, error.places.angle, poses.angle),
    )
    return asked, np.stack([moved, free_angles])


def _most_missed(error: PoseError) -> NDArray[np.intp]:
    """The poses that a linkage reaches; of many the MOST_POSES with the greatest errors of each."""
    here = np.flatnonzero(np.isfinite(error.position) & np.isfinite(error.angle))
    if len(here) <= MOST_POSES:
        return here
    both = (np.argsort(each[here])[-MOST_POSES:] for each in (error.position, error.angle))
    return here[np.union1d(*both)]


def _trials(
    dyads: tuple[Dyad, ...], places: Displacement, promised: FloatArray, at_least: int
) -> list[Decimals]:
    """Numbers of decimals to try, the fewest first.

    promised: (2,), a position and an angle error, which the first trial shows.  Angles have as many
    decimals as move no point of a line in use by more than lengths are rounded.
    """
    position, angle = promised.tolist()
    first = max(figures_of(position), at_least)
    middles = tuple(
        dyad.middle_of_travel(places) if isinstance(dyad, PR | RP) else None for dyad in dyads
    )
    lines = [dyad for dyad in dyads if isinstance(dyad, PR | RP)]
    lever = max((float(np.ptp(each.along(places))) / 2 for each in lines), default=0.0)
    turned = figures_of(math.degrees(angle))
    out = []
    for lengths in range(first, first + MOST_TRIALS):
        along = lengths + math.log10(math.radians(lever)) if lever > 0 else 0.0
        decimals = max(turned, math.ceil(along))
        out.append(Decimals(lengths, decimals, (math.nan, math.nan), middles))
    return out


def _errors_of(
    linkages: list[Linkage],
    poses: Displacement,
    places: Displacement,
    length: float,
    free: NDArray[np.bool_],
) -> FloatArray:
    """The greatest position and angle errors (k, 2) of linkages (k,) near `places` (N,)."""
    frames = error_frames(poses, length)
    unit = length / float(frames.length)
    batch = LinkageBatch.of(linkages).to_canonical(frames)
    start, target = (rows_of(frames.to_canonical(each), unit) for each in (places, poses))
    rows = foot_points(batch, np.tile(start, (len(batch), 1, 1)), target, unit)
    found = frames.from_canonical(places_of(rows, unit))
    errors = [PoseError.at(found[k], poses) for k in range(len(batch))]
    both = np.array([[each.position, each.angle] for each in errors])
    values = np.where(free & np.isfinite(both), 0.0, both).max(axis=-1)
    return np.asarray(np.nan_to_num(values, nan=np.inf))


def _first(trials: list[Decimals], kept: NDArray[np.bool_], errors: FloatArray) -> Decimals:
    """The first of the trials that keeps what is promised, else the last one."""
    index = int(np.argmax(kept)) if kept.any() else len(trials) - 1
    position, angle = errors[index].tolist()
    return replace(trials[index], error=(position, angle))
