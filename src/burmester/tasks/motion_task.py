"""A task: the poses a body must pass through, and how exactly they are known."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import Literal, TypeAlias, final, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from burmester.errors import Advice, InputError
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Polygon
from burmester.numerics.arrays import FloatArray
from burmester.printable import printable
from burmester.tasks.crank_timing import CrankTiming
from burmester.tasks.limits import Limits, frames_of
from burmester.tasks.loads import Loads, require_possible_loads
from burmester.tasks.pose_tolerances import COMPONENTS, PoseTolerances, kept, nominal_rows
from burmester.tasks.requirements import Requirements, require_loads, require_possible
from burmester.tasks.surroundings import Surroundings, require_clear_at_poses
from burmester.tasks.traced_path import TracedPath
from burmester.values import real_numbers, require_instance, short_text, shown
from burmester.wording import count as count_of

COARSE = 1e-3  # coarser digits than this count as meant exactly, not as measured

AngleUnit: TypeAlias = Literal["deg", "rad"]

CONDITIONS = 5  # that a dyad can meet exactly: it has five dimensions
MOST_POINTS = 9  # of the body, at any angle, that a linkage can meet exactly
MOST = 1e60  # beyond it, or all below its inverse, fourth powers leave a double's range
MOST_TURN = 1e9  # radians; of an angle beyond it few digits say where the body points
MOST_RATIO = 1e12  # of two weights; beyond it the lighter pose is lost in rounding
OFF_ROTATION = 1e-3  # printed matrices are that near to those of a rotation, entry by entry
MOST_NAME = 500  # characters of the name of a pose, which messages repeat
MOST_UNIT = 100  # characters of a unit
LEAST_POSES = 2  # one pose is met by every linkage


@final
@dataclass(frozen=True, slots=True, eq=False)
class Task:
    """What a synthesis is asked for; whatever gets past here can be computed with.

    Attributes
    ----------
    poses : Displacement
        Shape (N,), N >= 2.  One is enough where a limit puts a pivot at a point or on a line.
    weights : (N,) array, optional
        Above zero; None for equal ones.  A pose of weight 2 counts as if it were given twice.
    names : tuple of str, optional
        One name a pose.
    length_unit : str, optional
        The unit of x and y as its user writes it ("mm").
    resolution : (float, float)
        How exactly a pose is known: a length in the task's unit and an angle in radians.  The
        errors of poses are taken to be spread evenly up to it.  Half of the last digit that a
        file gives; sqrt(3) times the standard deviation where that is given instead
        (--pose-sigma), which is as wide a spread; 0 for exact numbers.
    exact : (N,) array of bool, optional
        The poses that must be met exactly.
    limits : tuple of Limits
        None; one for both dyads of a linkage; or two, one for each.
    requirements : Requirements
        The conditions on the whole linkage, none by default.
    body : Polygon, optional
        The outline of the body, in M.  It says what an angle error counts as, and what must stay
        clear of the surroundings.
    surroundings : Surroundings, optional
        What the body and the links must not touch between the poses.
    tolerances : PoseTolerances, optional
        How far from each pose the body may be, per component exact, within a tolerance or free.
        Without them the poses of a task are met exactly where that is possible, else as closely
        as possible.
    notes : tuple of Advice
        What was assumed, passed over or left out when the poses were read.  They are the first
        warnings of a synthesis.

    read_as : str, optional
        How the file was read, in words: its form, and the column of each number.
    path : TracedPath, optional
        How the points of a task without angles are traced: closed, or timed by the crank.  More
        than nine points without angles are a path in any case.
    timing : CrankTiming, optional
        The angles of the driver at the poses.

    loads : Loads, optional
        Weights, forces, springs and a hand, and how the driver moves in time.

    A task keeps its own copy of its numbers, which cannot be written to.

    Raises
    ------
    InputError
        E103 (a number that is not finite), E112 (one too large or too small to compute with, or
        weights too far apart), E120 (too few poses), E122 (weights, names or marks that do not
        fit the poses), E125 (values of a wrong type or shape), E132 (requirements that the limits
        contradict), E133 (more exact conditions than a dyad or a linkage can meet), E134 (a driver
        named by limits that are not two), E135 (tolerances that do not fit the poses), E136
        (tolerances that a pose marked exact contradicts), E175 (a body that touches a keep-out
        region at a pose), E186 (crank angles that do not fit).

    Examples
    --------
    >>> rows = [(-3.97, -2.63, 37.2), (-0.22, -0.32, 27.5), (3.33, 3.96, 8.2), (7.72, 10.01, -14.9)]
    >>> task = Task.from_rows(rows, angle_unit="deg", length_unit="mm")
    >>> task.poses.shape
    (4,)
    """

    poses: Displacement
    weights: FloatArray | None = None
    names: tuple[str, ...] | None = None
    length_unit: str | None = None
    resolution: tuple[float, float] = (0.0, 0.0)
    exact: NDArray[np.bool_] | None = None
    limits: tuple[Limits, ...] = ()
    requirements: Requirements = field(default=Requirements())
    body: Polygon | None = None
    surroundings: Surroundings | None = None
    tolerances: PoseTolerances | None = None
    notes: tuple[Advice, ...] = ()
    read_as: str | None = None
    path: TracedPath | None = None
    timing: CrankTiming | None = None
    loads: Loads | None = None

    @property
    def free_angles(self) -> NDArray[np.bool_]:
        """The poses (N,) whose angle is free: points of the body."""
        if self.tolerances is None:
            return np.zeros(self.poses.shape, dtype=bool)
        return self.tolerances.free[:, 2]

    @property
    def pivot_conditions(self) -> int:
        """How many conditions the limits of both dyads put on their pivots."""
        both = self.limits * (2 if len(self.limits) == 1 else 1)
        return sum(each.conditions for each in both)

    @property
    def angles_are_free(self) -> bool:
        """Whether only points of the body are asked for, and no angle anywhere."""
        return bool(self.free_angles.all())

    @property
    def gives_room(self) -> bool:
        """Whether tolerances let poses be missed, and do not only free components of them."""
        return self.tolerances is not None and self.tolerances.gives_room

    def at(self, index: NDArray[np.intp], weights: FloatArray | None = None) -> Task:
        """The task of some of its poses, by default with their weights."""
        if weights is None and self.weights is not None:
            weights = self.weights[index]
        return replace(
            self,
            poses=self.poses[index],
            weights=weights,
            names=None if self.names is None else tuple(self.names[k] for k in index.tolist()),
            exact=None if self.exact is None else self.exact[index],
            tolerances=None if self.tolerances is None else self.tolerances.at(index),
            path=None if self.path is None else self.path.at(index),
            timing=None if self.timing is None else self.timing.at(index),
        )

    def __post_init__(self) -> None:
        self._own_values()
        count = self.poses.shape[0]
        conditions = max((limits.conditions for limits in self.limits), default=0)
        if count < (1 if conditions else LEAST_POSES):
            raise InputError(
                "E120",
                f"{count} pose{'' if count == 1 else 's'}: too few for a linkage",
                why="a body that stays where it is needs no linkage",
                help="give 2 poses or more; up to 5 are met exactly, 6 or more as closely as "
                "possible",
            )
        self.poses.require_finite()
        _require_computable(self.poses)
        _require_resolution(*self.resolution)
        if (weights := self.weights) is not None:
            if weights.shape != (count,) or not (weights > 0).all():
                raise InputError(
                    "E122",
                    "the weights do not fit the poses",
                    why=f"{count} poses need {count} finite weights above zero",
                    help="give every pose a weight above zero; to drop a pose, delete it",
                )
            least, most = float(weights.min()), float(weights.max())
            if most > MOST_RATIO * least:
                raise InputError(
                    "E112",
                    "the weights are too far apart to compute with",
                    why=f"the greatest is {most:.3g}, the least {least:.3g}",
                    help="mark the heavy poses exact, or leave out the light ones",
                )
        if (exact := self.exact) is not None:
            if exact.shape != (count,):
                raise InputError(
                    "E122",
                    "the marks for exact poses do not fit the poses",
                    why=f"{count} poses need {count} marks, true or false",
                    help="mark every pose, or none",
                )
            if (marked := int(exact.sum())) + conditions > CONDITIONS:
                raise InputError(
                    "E133",
                    f"{marked + conditions} exact conditions, and a dyad can meet {CONDITIONS}",
                    why=f"{marked} poses are marked exact"
                    + (
                        f", and pivots at points or on lines are {conditions} more conditions"
                        if conditions
                        else ""
                    ),
                    help=f"mark {CONDITIONS - conditions} poses or fewer",
                )
        if self.names is not None and len(self.names) != count:
            raise InputError(
                "E122",
                f"{len(self.names)} names for {count} poses",
                help="give one name a pose, or none",
            )
        if self.tolerances is not None:
            pivots = self.pivot_conditions
            if self.path is None and _are_many_points(self.tolerances, pivots):
                object.__setattr__(self, "path", TracedPath())
            # Points of a path are met as closely as possible where they are too many.
            if self.path is not None:
                pivots = -2 * count
            _require_fitting(self.tolerances, count, self.exact, pivots)
        if self.path is not None:
            self.path.require_fitting(count)
        self._require_timed()
        require_possible(self.requirements, self.limits)
        self._require_clear()
        self._require_loadable()

    def _require_timed(self) -> None:
        """Refuse crank angles that do not fit the poses, or beside tolerances: E186."""
        if self.timing is None:
            return
        self.timing.require_fitting(self.poses)
        if self.tolerances is not None or self.path is not None:
            raise InputError(
                "E186",
                "poses timed by the crank, and tolerances or free components of a pose",
                why="a crank angle at a pose needs the pose itself",
                help="leave the tolerances or the crank angles out; of points alone, each with its "
                "crank angle, 5 or more are a timed path",
            )

    def _require_loadable(self) -> None:
        """Refuse loads that do not fit the task, E177 to E179, or bounds on what is not loaded."""
        require_loads(self.requirements, self.loads, self.names, self.poses.shape[0])
        if self.loads is not None:
            outlined = self.body is not None
            require_possible_loads(self.loads, self.poses, self.length_unit, outlined)

    def _require_clear(self) -> None:
        """Refuse a body that touches a region at a pose that is exact, E175, or has none, E176."""
        if self.surroundings is None:
            return
        if self.body is None:
            if self.surroundings.body_in_plane:
                raise InputError(
                    "E176",
                    "links are to stay clear of the body in their plane, and it has no outline",
                    why="body_in_plane is true, and the task has no body",
                    help="give the outline of the body, or leave body_in_plane out",
                )
            return
        exact = np.arange(self.poses.shape[0])
        if self.tolerances is not None:  # others may be met beside the region
            exact = np.flatnonzero(self.tolerances.exact_poses)
        given = self.names or ("",) * self.poses.shape[0]
        names = [f"pose {k + 1}" + (f" ({given[k]})" if given[k] else "") for k in exact]
        require_clear_at_poses(self.body, self.surroundings, self.poses[exact], names)

    def _own_values(self) -> None:
        """Refuse values of a wrong type or shape, and keep a copy of the others."""
        require_instance(
            self.poses,
            Displacement,
            "the poses of a task",
            'give a Displacement, or make the task by Task.from_rows(rows, angle_unit="deg")',
        )
        if len(self.poses.shape) != 1:
            raise InputError(
                "E125",
                "the poses of a task: not of shape (N,)",
                why=f"the shape is {self.poses.shape}",
                help="give one row of poses, and a task for each of several rows",
            )
        poses = Displacement(kept(self.poses.translation), kept(self.poses.angle))
        own: dict[str, object] = {"poses": poses}
        if self.weights is not None:
            own["weights"] = real_numbers(self.weights, (None,), "the weights", code="E122")
        if self.exact is not None:
            own["exact"] = _marks(self.exact)
        if self.names is not None:
            own["names"] = _names(self.names)
        if self.length_unit is not None:
            require_instance(self.length_unit, str, "the length unit", 'give a text such as "mm"')
            help = 'give a unit such as "mm"'
            own["length_unit"] = short_text(
                self.length_unit, MOST_UNIT, "the length unit", help, code="E122"
            )
        position, angle = real_numbers(self.resolution, (2,), "the resolution").tolist()
        if min(position, angle) < 0:
            raise InputError(
                "E122",
                "the resolution of the poses is negative",
                why=f"it is {position:g} for lengths and {angle:g} rad for angles",
                help="give two numbers of zero or more",
            )
        own["resolution"] = (position, angle)
        limits = (self.limits,) if isinstance(self.limits, Limits) else self.limits
        require_instance(limits, tuple, "the limits of a task", "give a tuple of Limits")
        for each in limits:
            require_instance(each, Limits, "the limits of a task", "give a tuple of Limits")
        if len(limits) > 2:
            raise InputError(
                "E125",
                f"the limits of a task: {len(limits)} of them",
                why="a linkage has two dyads",
                help="give one for both dyads, or two, one for each",
            )
        own["limits"] = limits
        require_instance(
            self.requirements, Requirements, "the requirements of a task", "give a Requirements"
        )
        kinds = {"body": Polygon, "surroundings": Surroundings, "tolerances": PoseTolerances}
        for name, kind in kinds.items():
            if (given := getattr(self, name)) is not None:
                require_instance(given, kind, f"the {name} of a task", f"give a {kind.__name__}")
        for name, value in own.items():
            object.__setattr__(self, name, value)

    @classmethod
    def from_rows(
        cls,
        rows: ArrayLike,
        *,
        angle_unit: AngleUnit | None = None,
        length_unit: str | None = None,
        limits: tuple[Limits, ...] = (),
        requirements: Requirements = Requirements(),  # noqa: B008  frozen
        body: Polygon | None = None,
        surroundings: Surroundings | None = None,
        tolerances: PoseTolerances | None = None,
        loads: Loads | None = None,
    ) -> Task:
        """A task from rows of numbers.

        Parameters
        ----------
        rows : (N, 3) array_like
            x, y and angle of the body's frame M, seen in F.  Components that `tolerances` leave
            free may be nan: they get a value between their neighbours, to draw the pose with.
            Or (N, 3, 3), homogeneous matrices of the displacements, which need no unit of angles.
        angle_unit : {"deg", "rad"}
            The unit of the angles; it is never guessed.
        length_unit, limits, requirements, body, surroundings, tolerances, loads
            As in `Task`.

        Raises
        ------
        InputError
            E110 (no such angle unit), E125 (neither rows nor matrices) and what `Task` raises.
        """
        if _shape_of(rows)[1:] == (3, 3):
            poses = _of_matrices(rows, angle_unit)
        else:
            require_angle_unit(angle_unit)
            table = _table_of(rows, finite=tolerances is None)
            if isinstance(tolerances, PoseTolerances) and tolerances.shape == table.shape[:1]:
                table = nominal_rows(table, tolerances.free & np.isnan(table), angle_unit)
            angle = np.radians(table[:, 2]) if angle_unit == "deg" else table[:, 2]
            poses = Displacement(table[:, :2], angle)
        return cls(
            poses,
            length_unit=length_unit,
            limits=limits,
            requirements=requirements,
            body=body,
            surroundings=surroundings,
            tolerances=tolerances,
            loads=loads,
        )


def _shape_of(rows: ArrayLike) -> tuple[int, ...]:
    """The shape of rows; () where they have none."""
    try:
        return np.shape(rows)
    except ValueError:
        return ()


def _table_of(rows: ArrayLike, *, finite: bool) -> FloatArray:
    """Rows (N, 3) of numbers; an E125 that names the columns for others."""
    try:
        return real_numbers(rows, (None, 3), "the poses", finite=finite)
    except InputError as error:
        if error.code == "E125" and (shape := _shape_of(rows)):
            how = "np.column_stack([z.real, z.imag, angle])"
            if not np.iscomplexobj(rows):
                how = "np.column_stack([x, y, angle])"
            if shape[1:] == (4,):
                how = "np.column_stack([x, y, np.arctan2(sin, cos)]) with radians"
            error.help = f"give the columns x, y and angle, such as {how}, or matrices (N, 3, 3)"
        raise


def _of_matrices(rows: ArrayLike, angle_unit: object) -> Displacement:
    """The displacements of homogeneous matrices (N, 3, 3); raises E110, E125."""
    if angle_unit is not None:
        raise InputError(
            "E110",
            "the angles of matrices need no angle_unit",
            help="leave angle_unit out, or give rows of x, y and angle",
        )
    matrix = real_numbers(rows, (None, 3, 3), "the poses")
    poses = Displacement.from_matrix(matrix)
    off = np.abs(matrix - poses.as_matrix()).max(axis=(1, 2)) > OFF_ROTATION
    if off.any():
        raise InputError(
            "E125",
            f"the poses: matrix {int(off.argmax()) + 1} is no displacement of the plane",
            why=f"it is {matrix[off.argmax()].tolist()}",
            help="give [[cos, -sin, x], [sin, cos, y], [0, 0, 1]], or rows of x, y and angle",
        )
    return poses


def require_angle_unit(unit: object) -> None:
    """Refuse an angle unit that is neither "deg" nor "rad": E110."""
    if isinstance(unit, str) and unit in get_args(AngleUnit):
        return
    message = "the angle unit is not stated" if unit is None else f"there is no angle unit {unit!r}"
    raise InputError(
        "E110",
        message,
        why="the unit of angles is never guessed",
        help='say angle_unit="deg" or angle_unit="rad"',
    )


def _are_many_points(tolerances: PoseTolerances, pivots: int) -> bool:
    """Whether only points are asked for, more than a linkage meets; pivots: conditions on them."""
    return tolerances.are_points and len(tolerances.angle) + pivots > MOST_POINTS


def _require_fitting(
    tolerances: PoseTolerances, count: int, exact: NDArray[np.bool_] | None, pivots: int
) -> None:
    """Refuse tolerances that do not fit: E135, E136 (marks), E133; pivots: exact conditions."""
    if tolerances.shape != (count,):
        raise InputError(
            "E135",
            f"tolerances of {count_of(tolerances.shape[0], 'pose')}, and {count} poses",
            why="every pose has tolerances of its own",
            help="give tolerances for every pose; 0 is exact, inf is free",
        )
    if exact is not None and len(both := np.flatnonzero(exact & ~tolerances.exact_poses)):
        pose = int(both[0])
        component = COMPONENTS[int(tolerances.bounds[pose].argmax())]
        raise InputError(
            "E136",
            f"pose {pose + 1} is marked exact, and its {component} has a tolerance above zero",
            why="an exact pose is met in x, y and angle",
            help="take the mark away, or give this pose the tolerance 0 in all three",
        )
    # Poses and points that are too many, and have no tolerances, are met as closely as possible.
    if (conditions := tolerances.conditions + pivots) > 2 * CONDITIONS and not (
        tolerances.are_poses_and_points
    ):
        raise InputError(
            "E133",
            f"{conditions} exact conditions, and a four-bar can meet {2 * CONDITIONS}",
            why="a component of a pose without a tolerance is exact; a pose that is exact in x, y "
            "and angle is two conditions, in two of them one"
            + (", a pivot at a point two, on a line one" if pivots else ""),
            help="give more components a tolerance, all poses the same one by default",
        )


def _marks(value: object) -> NDArray[np.bool_]:
    """Marks, each true or false: E122 for anything else."""
    marks = np.asarray(value)
    if isinstance(value, np.ma.MaskedArray) or marks.ndim != 1 or marks.dtype != np.bool_:
        raise InputError(
            "E122",
            "the marks for exact poses are not a row of true and false",
            why=f"they are {shown(value)}",
            help="mark every pose True or False, or give no marks",
        )
    own: NDArray[np.bool_] = kept(marks)
    return own


def _names(value: object) -> tuple[str, ...]:
    """Names of poses as any screen can show them: E122 for anything but texts."""
    if not isinstance(value, str) and isinstance(value, Iterable):
        names = tuple(value)
        if all(isinstance(name, str) for name in names):
            own = tuple(map(printable, names))
            if own:
                longest = max(own, key=len)
                what = f"the name of pose {own.index(longest) + 1}"
                short_text(longest, MOST_NAME, what, "give a shorter name", code="E122")
            return own
    raise InputError(
        "E122",
        "the names of the poses are not texts",
        why=f"they are {shown(value)}",
        help='give one text a pose, such as ("shut", "open")',
    )


def characteristic_length(task: Task) -> float:
    """The size of a task in its unit, the same in all frames (`frames_of`)."""
    return float(frames_of(task.poses, task.weights, task.limits)[0].length)


def _require_computable(poses: Displacement) -> None:
    """Refuse numbers that cannot be computed with; raises E112."""
    reach, turn = np.abs(poses.translation).max(axis=1), np.abs(poses.angle)
    if (far := reach > MOST).any() or 0 < reach.max() < 1 / MOST:
        bad = int(far.argmax() if far.any() else reach.argmax())
        message = f"the lengths of pose {bad + 1} are too {'large' if far.any() else 'small'}"
        why = f"the fourth power of {reach[bad]:g} is beyond what a number can hold"
        help = "write the lengths in another unit"
    elif (far := turn > MOST_TURN).any():
        bad = int(far.argmax())
        message = f"the angle of pose {bad + 1} is too large"
        why = f"it is {turn[bad]:.3g} rad, {turn[bad] / (2 * np.pi):.3g} turns"
        help = "take whole turns off it"
    else:
        return
    raise InputError("E112", message, why=why, help=help)


def _require_resolution(position: float, angle: float) -> None:
    """Refuse standard deviations that cannot be computed with; raises E112."""
    for value, most, noun in ((position, MOST, "positions"), (angle, MOST_TURN, "angles")):
        if value > most:
            raise InputError(
                "E112",
                f"the standard deviation of the {noun} is too large",
                why=f"it is {value / 3**0.5:.3g}, and {most:g} is the most to compute with",
                help="give a smaller standard deviation, or none",
            )
