"""Tolerances of poses as a file or the command line states them, and what they come to.

A component of a pose has the tolerance that is stated for it, else the default of the task, else 0
where its pose is marked exact, and everywhere else if the task has no default.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from burmester.errors import InputError
from burmester.numerics.arrays import FloatArray
from burmester.tasks.pose_tolerances import COMPONENTS, Component, PoseTolerances, ToleranceAxes

# The columns of numbers, and those of words; by the components that they belong to.
TOLERANCE_ROLES = ("tol_x", "tol_y", "tol_angle")
FREE_WORDS = ("free", "inf", "infinity", "∞")  # in place of a tolerance


class StatedTolerances(NamedTuple):
    """Tolerances as stated for N poses: nan where nothing is stated, inf for free.

    bounds: (N, 3), of x, y and angle, the angle in `angle_unit`.  axes: "" where not stated.
    columns: whether x, y and angle have columns of tolerances, in which a blank is never zero.
    """

    bounds: FloatArray
    axes: list[str]
    columns: tuple[bool, ...] = (False, False, False)
    angle_unit: str | None = None  # None: that of the poses

    @classmethod
    def read(cls, columns: Mapping[str, Sequence[str]], count: int) -> StatedTolerances | None:
        """Those in texts by role, numbers with decimal points; None without such columns."""
        given = [role for role in (*TOLERANCE_ROLES, "free", "tol_axes") if role in columns]
        if not given:
            return None
        bounds = np.full((count, 3), np.nan)
        for k, role in enumerate(TOLERANCE_ROLES):
            if role in columns:
                bounds[:, k] = [float(text) for text in columns[role]]
        for row, text in enumerate(columns.get("free", ())):
            for component in free_components(text) or ():
                bounds[row, COMPONENTS.index(component)] = np.inf
        stated = tuple(role in columns for role in TOLERANCE_ROLES)
        return cls(bounds, list(columns.get("tol_axes", [""] * count)), stated)

    @classmethod
    def none(cls, count: int) -> StatedTolerances:
        """Nothing stated for `count` poses."""
        return cls(np.full((count, 3), np.nan), [""] * count)

    @classmethod
    def joined(cls, parts: Sequence[StatedTolerances]) -> StatedTolerances:
        """Those of all parts, one after the other."""
        axes = [each for part in parts for each in part.axes]
        return parts[0]._replace(bounds=np.concatenate([part.bounds for part in parts]), axes=axes)

    def at(self, kept: NDArray[np.int_]) -> StatedTolerances:
        """Those of some poses."""
        return self._replace(bounds=self.bounds[kept], axes=[self.axes[k] for k in kept.tolist()])


class DefaultTolerance(NamedTuple):
    """The tolerance of all poses that state none: nan where nothing is stated, inf for free.

    bounds: x, y and angle, the angle in `angle_unit`; where: its location.
    """

    bounds: tuple[float, float, float]
    axes: ToleranceAxes = "fixed"
    angle_unit: str | None = None  # None: that of the poses
    where: str = ""


def free_components(text: str) -> tuple[Component, ...] | None:
    """The components named in one text, such as "x y" or "angle"; None if it names another."""
    words = text.replace(",", " ").replace(";", " ").replace("+", " ").lower().split()
    if not set(words) <= set(COMPONENTS):
        return None
    return tuple(component for component in COMPONENTS if component in words)


def combined_tolerances(
    stated: StatedTolerances | None,
    default: DefaultTolerance | None,
    count: int,
    exact: NDArray[np.bool_] | None,
    angle_unit: str,
) -> PoseTolerances | None:
    """The tolerances of a task; None where none are stated.  Raises E135 and E136."""
    if stated is None and default is None:
        return None
    bounds = np.full((count, 3), np.nan)
    axes = [""] * count
    if stated is not None:
        bounds = _in_radians(stated.bounds, stated.angle_unit or angle_unit)
        axes = stated.axes
    if default is not None:
        usual = _in_radians(np.array(default.bounds), default.angle_unit or angle_unit)
        if exact is not None:
            usual = np.where(exact[:, None], 0.0, usual)
        bounds = np.where(np.isnan(bounds), usual, bounds)
        axes = [each or default.axes for each in axes]
    _require_no_blank(bounds, stated, exact)
    bounds = np.where(np.isnan(bounds), 0.0, bounds)
    words: tuple[ToleranceAxes, ...] = tuple("body" if each == "body" else "fixed" for each in axes)
    try:
        return PoseTolerances(bounds[:, :2], bounds[:, 2], words)
    except InputError as error:
        if default is not None and stated is None:
            error.where = error.where or default.where or None
        raise


def _require_no_blank(
    bounds: FloatArray, stated: StatedTolerances | None, exact: NDArray[np.bool_] | None
) -> None:
    """Refuse a blank cell of a tolerance that no default fills: E135."""
    if stated is None:
        return
    blank = np.isnan(bounds) & np.array(stated.columns)
    if exact is not None:
        blank &= ~exact[:, None]
    if blank.any():
        pose, component = np.argwhere(blank)[0].tolist()
        name = COMPONENTS[component]
        raise InputError(
            "E135",
            f"pose {pose + 1}: the tolerance of {name} is blank, and a blank is never zero",
            why="the tolerances of other poses stand in this column",
            help=f"write 0 into it for exact, free if {name} does not count, or a number; "
            "--pose-tolerance X,Y,DEG fills all blanks",
        )


def _in_radians(bounds: FloatArray, angle_unit: str) -> FloatArray:
    """Bounds (*, 3) with the angle in radians."""
    out = np.array(bounds)
    if angle_unit == "deg":
        out[..., 2] = np.radians(out[..., 2])
    return out
