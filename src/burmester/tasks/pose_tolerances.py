"""Tolerances of poses: per component exact, within a tolerance, or free.

The tolerances of one pose make a box around it, in x, y and angle: a place of the coupler is
inside if no component is farther from the pose than its tolerance.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Final, Literal, Self, TypeAlias, final, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from burmester.cures import Cure
from burmester.errors import InputError
from burmester.geometry.displacement import Displacement
from burmester.numerics.arrays import FloatArray, wrapped_angle
from burmester.values import real_numbers, require_instance, shown

Component: TypeAlias = Literal["x", "y", "angle"]
COMPONENTS: Final[tuple[Component, ...]] = get_args(Component)

# Along x and y of F, or along the axes that the body's own frame M has at the pose.
ToleranceAxes: TypeAlias = Literal["fixed", "body"]

ANY_ANGLE: Final = math.pi  # radians; a body within it of an angle may point anywhere
LEAST_TOLERANCE: Final = 1e-60  # lengths and radians; a smaller one is taken for 0


@final
@dataclass(frozen=True, slots=True, eq=False)
class PoseTolerances:
    """How far from each of N poses the body may be: 0 is exact, inf is free.

    Attributes
    ----------
    position : (N, 2) array
        Of x and y along `axes`, in the task's unit.
    angle : (N,) array
        In radians.  Half a turn or more is free.
    axes : tuple of {"fixed", "body"}
        One a pose: along x and y of F, or along the axes of M at that pose.  One word counts for
        all poses.

    A value keeps its own copy of its numbers, which cannot be written to.

    Raises
    ------
    InputError
        E135 (malformed), E136 (a pose that is free in everything, or tolerances along the axes of
        a body that may point anywhere).

    Examples
    --------
    >>> tolerances = PoseTolerances([[0, 0], [0.5, np.inf]], [0, 0.01])
    >>> tolerances.free.tolist()
    [[False, False, False], [False, True, False]]
    >>> tolerances.exact_poses.tolist()
    [True, False]
    >>> PoseTolerances([[0, -1]], [0])
    Traceback (most recent call last):
        ...
    burmester.errors.InputError: error[E135]: pose 1: a tolerance of -1 for y is impossible
      why: a tolerance is the greatest distance from the pose, to both sides
      help: give 0 for exact, a number above zero, or inf for free
    """

    position: FloatArray
    angle: FloatArray
    axes: tuple[ToleranceAxes, ...] | ToleranceAxes = "fixed"

    def __post_init__(self) -> None:
        position = real_numbers(
            self.position, (None, 2), "tolerances of positions", code="E135", finite=False
        )
        angle = real_numbers(self.angle, (None,), "tolerances of angles", code="E135", finite=False)
        if len(position) != len(angle):
            raise InputError(
                "E135",
                f"tolerances of {len(position)} positions and {len(angle)} angles",
                why="a pose has both",
                help="give one row of two and one angle for each pose; inf is free",
            )
        axes = _axes(self.axes, len(angle))
        bounds = np.column_stack([position, angle])
        _require_bounds(bounds)
        bounds[bounds < LEAST_TOLERANCE] = 0.0
        bounds[bounds[:, 2] >= ANY_ANGLE, 2] = np.inf
        _require_meaning(bounds, axes)
        object.__setattr__(self, "position", kept(bounds[:, :2]))
        object.__setattr__(self, "angle", kept(bounds[:, 2]))
        object.__setattr__(self, "axes", axes)

    @classmethod
    def uniform(
        cls, count: int, x: float, y: float, angle: float, axes: ToleranceAxes = "fixed"
    ) -> Self:
        """The same tolerances at `count` poses; angle in radians."""
        return cls(np.tile([float(x), float(y)], (count, 1)), np.full(count, angle), axes)

    @property
    def shape(self) -> tuple[int, ...]:
        """(N,)."""
        return self.angle.shape

    @property
    def bounds(self) -> FloatArray:
        """The tolerances (N, 3) of x, y (along the axes) and angle."""
        return np.column_stack([self.position, self.angle])

    @property
    def exact(self) -> NDArray[np.bool_]:
        """Which components (N, 3) are exact."""
        return np.asarray(self.bounds == 0)

    @property
    def free(self) -> NDArray[np.bool_]:
        """Which components (N, 3) are free."""
        return np.asarray(np.isinf(self.bounds))

    @property
    def gives_room(self) -> bool:
        """Whether some component may be missed by a tolerance, and is neither exact nor free."""
        return not bool((self.exact | self.free).all())

    @property
    def are_points(self) -> bool:
        """Whether x and y are exact, and all angles free."""
        return bool(self.exact[:, :2].all() and self.free[:, 2].all())

    @property
    def constraints(self) -> int:
        """How many equations or bounds the components that are not free are for a linkage."""
        return int(np.maximum((~self.free).sum(axis=1) - 1, 0).sum())

    @property
    def are_poses_and_points(self) -> bool:
        """Whether x and y are exact, and angles exact at some poses and free at the others."""
        free = self.free[:, 2]
        return bool(self.exact[:, :2].all() and (free | self.exact[:, 2]).all() and free.any())

    @property
    def exact_poses(self) -> NDArray[np.bool_]:
        """The poses (N,) that are exact in all three components."""
        return np.asarray(self.exact.all(axis=1))

    @property
    def conditions(self) -> int:
        """How many equations the exact components are for a linkage.

        The coupler of a linkage may be anywhere on its way, which meets one component of a pose.
        """
        return int(np.maximum(self.exact.sum(axis=1) - 1, 0).sum())

    def directions(self, poses: Displacement) -> FloatArray:
        """The unit vectors (N, 2, 2), in F, of both axes at poses (N,): first axis, second axis."""
        turned = np.array([each == "body" for each in self.axes])
        angle = np.where(turned, poses.angle, 0.0)
        first = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        second = np.stack([-np.sin(angle), np.cos(angle)], axis=-1)
        return np.stack([first, second], axis=-2)

    def deviations(self, places: Displacement, poses: Displacement) -> FloatArray:
        """How far places (*, N) are from poses (N,), (*, N, 3): along both axes, and in angle.

        The angle within half a turn.
        """
        gap = places.translation - poses.translation
        along = (self.directions(poses) * gap[..., None, :]).sum(axis=-1)
        turn = wrapped_angle(places.angle - poses.angle)
        return np.concatenate([along, turn[..., None]], axis=-1)

    def share(self, places: Displacement, poses: Displacement, rounding: ArrayLike) -> FloatArray:
        """How much of its tolerance each component of places (*, N) uses, (*, N, 3).

        0 for free ones, at most 1 inside.  rounding: of x, y and angle (3,), what an exact
        component may be missed by, and is measured by.
        """
        least = np.asarray(rounding, dtype=np.float64)
        bounds = np.maximum(self.bounds, least)
        away = np.where(self.free, 0.0, np.abs(self.deviations(places, poses)))
        return np.asarray(away / np.where(self.free, 1.0, bounds))

    def at(self, index: NDArray[np.int_] | slice) -> PoseTolerances:
        """The tolerances of some poses."""
        axes = np.array(self.axes)[index]
        return PoseTolerances(self.position[index], self.angle[index], tuple(axes.tolist()))

    def merged(self, group: NDArray[np.int_]) -> PoseTolerances:
        """Those of repeated poses in one, so tight that they hold for each.

        group: (N,), which of the distinct poses each pose is.  Of boxes along different axes the
        one taken is inside all of them.
        """
        bounds = np.full((int(group.max()) + 1, 3), np.inf)
        np.minimum.at(bounds, group, self.bounds)
        body = np.array([each == "body" for each in self.axes])
        some, every = np.zeros(len(bounds), dtype=bool), np.ones(len(bounds), dtype=bool)
        np.logical_or.at(some, group, body)
        np.logical_and.at(every, group, body)
        mixed = some & ~every
        bounds[mixed, :2] = bounds[mixed, :2].min(axis=1, keepdims=True) / math.sqrt(2)
        axes: list[ToleranceAxes] = ["body" if each else "fixed" for each in every.tolist()]
        return PoseTolerances(bounds[:, :2], bounds[:, 2], tuple(axes))


def nominal_values(
    values: FloatArray, free: NDArray[np.bool_], *, turn: float | None = None
) -> FloatArray:
    """Values (N,), those of free components between their neighbours, to draw the pose with.

    By the poses' numbers, in a straight line between the neighbours that are not free; outside
    them the nearest one; 0 where all are free.  turn: a whole turn, for angles: the way from one
    neighbour to the next is then the shorter one.
    """
    known = np.flatnonzero(~free)
    if not len(known):
        return np.zeros(len(values))
    given = np.array(values[known], dtype=np.float64)
    if turn is not None:
        given = np.unwrap(given, period=turn)
    between = np.interp(np.arange(len(values)), known, given)
    return np.where(free, between, values)


def nominal_rows(table: FloatArray, free: NDArray[np.bool_], angle_unit: str | None) -> FloatArray:
    """Rows (N, 3) of x, y and angle, those of free components (N, 3) between their neighbours."""
    out, turn = np.array(table), 360.0 if angle_unit == "deg" else 2 * math.pi
    for column, whole in enumerate((None, None, turn)):
        out[:, column] = nominal_values(table[:, column], free[:, column], turn=whole)
    return out


def _require_bounds(bounds: FloatArray) -> None:
    """Refuse tolerances (N, 3) that are negative or no numbers: E135."""
    wrong = np.argwhere(~(bounds >= 0))
    if not len(wrong):
        return
    pose, component = wrong[0].tolist()
    value = float(bounds[pose, component])
    raise InputError(
        "E135",
        f"pose {pose + 1}: a tolerance of {value:g} for {COMPONENTS[component]} is impossible",
        why="a tolerance is the greatest distance from the pose, to both sides",
        help="give 0 for exact, a number above zero, or inf for free",
    )


def _require_meaning(bounds: FloatArray, axes: Sequence[ToleranceAxes]) -> None:
    """Refuse poses that ask for nothing, and axes that have no direction: E136."""
    free = np.isinf(bounds)
    if len(nothing := np.flatnonzero(free.all(axis=1))):
        raise InputError(
            "E136",
            f"pose {nothing[0] + 1} is free in x, y and angle",
            why="a pose that may be anywhere asks for nothing",
            help="leave this pose out, or give one of its components a tolerance",
        )
    for pose, (x, y, _) in enumerate(bounds.tolist()):
        if axes[pose] == "body" and free[pose, 2] and not (x == y and x in (0.0, math.inf)):
            raise InputError(
                "E136",
                f"pose {pose + 1}: tolerances along the body's axes, and its angle is free",
                why="the axes of a body that may point anywhere have no direction",
                help='give the tolerances of this pose along x and y of F (axes = "fixed"), or '
                "give its angle a tolerance",
            )


def tolerance_cure(x: float, y: float, degrees: float) -> Cure:
    """What says how far every pose may be missed; infinity: however far."""
    text = ",".join(f"{each:g}" if each < math.inf else "free" for each in (x, y, degrees))
    return Cure("tolerances", (x, y, degrees), "--pose-tolerance", text)


def _axes(value: object, count: int) -> tuple[ToleranceAxes, ...]:
    """One word for each of `count` poses: E135 for anything else."""
    if isinstance(value, str):
        words: tuple[object, ...] = (value,) * count
    else:
        help = 'give "fixed" or "body", or one of these words for each pose'
        require_instance(value, Iterable, "the axes of tolerances", help, code="E135")
        assert isinstance(value, Iterable)
        words = tuple(value)
    if len(words) != count:
        raise InputError(
            "E135",
            f"axes of {len(words)} tolerances for {count} poses",
            help='give one word a pose, "fixed" or "body", or one for all poses',
        )
    for word in words:
        if not isinstance(word, str) or word not in get_args(ToleranceAxes):
            raise InputError(
                "E135",
                f"there are no axes {shown(word)}",
                why="tolerances are along x and y of F, or along the body's own axes",
                help='say "fixed" for those of F, or "body" for those of the body',
            )
    out: tuple[ToleranceAxes, ...] = tuple("body" if word == "body" else "fixed" for word in words)
    return out


def kept(values: Any) -> Any:
    """A copy of an array that cannot be written to."""
    own = np.array(values)
    own.setflags(write=False)
    return own
