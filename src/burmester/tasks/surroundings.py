"""The surroundings of a linkage: regions of F that the body and the links must not touch."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import final

import numpy as np

from burmester.errors import InputError
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Polygon
from burmester.geometry.shapes import distances, nearest_points
from burmester.printable import printable
from burmester.values import real_numbers, require_instance, short_text, shown

MAX_REGIONS = 100  # keep-out regions of a task; each is compared with body and links
POSES_AT_ONCE = 1000  # poses whose outlines are compared at once
MAX_NAME = 100  # characters of the name of a region, which messages repeat


@final
@dataclass(frozen=True, slots=True, eq=False)
class KeepOut:
    """A region of F that nothing which moves may touch.

    Parameters
    ----------
    polygon : Polygon
        In F, convex or not.
    name : str, optional
        What messages and drawings call it.

    Raises
    ------
    InputError
        E176 (no polygon, or a name that is no text).

    Examples
    --------
    >>> KeepOut(Polygon([(0, 0), (60, 0), (60, 20), (0, 20)]), "bumper").name
    'bumper'
    """

    polygon: Polygon
    name: str | None = None

    def __post_init__(self) -> None:
        help = "give a Polygon of three corners or more"
        require_instance(self.polygon, Polygon, "a keep-out region", help, code="E176")
        if self.name is None:
            return
        require_instance(self.name, str, "the name of a region", 'give a text such as "bumper"',
                         code="E176")  # fmt: skip
        what, help = "the name of a keep-out region", "give a shorter name"
        name = short_text(printable(self.name).strip(), MAX_NAME, what, help, code="E176")
        object.__setattr__(self, "name", name or None)


@final
@dataclass(frozen=True, slots=True, eq=False)
class Surroundings:
    """What the body and the links of a linkage must stay clear of between the poses.

    Parameters
    ----------
    keep_out : tuple of KeepOut
        Regions of F; a Polygon alone is one without a name.
    link_width : float
        The width of the links, with round ends about their pivots; 0 for lines.
    margin : float
        The least clearance that is asked for; 0 where parts must only not touch.
    body_in_plane : bool
        Whether the body is checked against the grounded links, too, which then lie in its plane.

    All lengths are in the task's unit.

    Raises
    ------
    InputError
        E176 (malformed, or nothing to stay clear of), E103 and E125 (lengths that are not finite
        real numbers).

    Examples
    --------
    >>> wall = Polygon([(0, 0), (60, 0), (60, 20), (0, 20)])
    >>> around = Surroundings((KeepOut(wall, "bumper"), wall), link_width=8)
    >>> around.names
    ("'bumper'", 'region 2')
    """

    keep_out: tuple[KeepOut, ...] = ()
    link_width: float = 0.0
    margin: float = 0.0
    body_in_plane: bool = False

    def __post_init__(self) -> None:
        given: object = self.keep_out
        if isinstance(given, KeepOut | Polygon):
            given = (given,)
        if isinstance(given, str) or not isinstance(given, Iterable):
            help = "give a tuple of KeepOut, or of polygons"
            raise InputError("E176", f"keep_out is {shown(given)}, not regions", help=help)
        regions = tuple(KeepOut(each) if not isinstance(each, KeepOut) else each for each in given)
        if len(regions) > MAX_REGIONS:
            raise InputError(
                "E176",
                f"{len(regions)} keep-out regions",
                why="each is compared with the body and the links, place by place",
                help=f"give {MAX_REGIONS} at most: join those that touch to one polygon",
            )
        object.__setattr__(self, "keep_out", regions)
        for name, what in (("link_width", "the width of the links"), ("margin", "the margin")):
            value = float(real_numbers(getattr(self, name), (), what))
            if value < 0:
                raise InputError(
                    "E176",
                    f"{what} is negative",
                    why=f"it is {value:g}",
                    help="give a length of zero or more",
                )
            object.__setattr__(self, name, value)
        if not isinstance(self.body_in_plane, bool | np.bool_):
            why = f"body_in_plane is {shown(self.body_in_plane)}, neither true nor false"
            help = "give True where body and links lie in one plane, else False"
            raise InputError("E176", why, help=help)
        object.__setattr__(self, "body_in_plane", bool(self.body_in_plane))

    @property
    def names(self) -> tuple[str, ...]:
        """What messages call the regions: their names in quotes, or their numbers from 1."""
        return tuple(
            f"'{each.name}'" if each.name else f"region {number}"
            for number, each in enumerate(self.keep_out, 1)
        )


def require_clear_at_poses(
    body: Polygon, around: Surroundings, poses: Displacement, names: Sequence[str]
) -> None:
    """Refuse poses (N,) at which the body touches a keep-out region or is within the margin: E175.

    names: of the poses in messages, "pose 2"; poses that are not finite are passed over.
    """
    known = np.flatnonzero(np.isfinite(poses.angle) & np.isfinite(poses.translation).all(axis=-1))
    for start in range(0, len(known), POSES_AT_ONCE):
        some = known[start : start + POSES_AT_ONCE]
        outlines = poses[some][:, None].act(body.vertices)
        for name, region in zip(around.names, around.keep_out, strict=True):
            apart = distances(outlines, region.polygon.vertices)
            at = int(apart.argmin())
            if apart[at] > 0 and apart[at] >= around.margin:
                continue
            help = (
                "correct the outline of the body, the pose or the region; "
                "what may touch at a pose is no keep-out region"
            )
            if apart[at] > 0:
                how = f"is only {apart[at]:.3g} from"
                why = (
                    f"a margin of {around.margin:g} is asked for, and no linkage can keep it there"
                )
                help = f"ask for a margin of {apart[at] * 0.9:.2g} or less, or {help}"
            else:
                how = "touches"
                x, y = nearest_points(outlines[at], region.polygon.vertices)[0]
                why = f"both have the point ({x:.6g}, {y:.6g}) of the ground, "
                why += "and no linkage can meet that pose and stay clear"
            message = f"the body {how} keep-out {name} at {names[some[at]]}"
            raise InputError("E175", message, why=why, help=help)
