"""A linkage of a result: its numbers, and its way into a drawing, a film or another program."""

from __future__ import annotations

import base64
import os
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field, fields
from html import escape
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, TypeVar, cast, final

import numpy as np

from burmester.api.python_words import in_python_words
from burmester.api.table import as_line, dimensions_as_html, plain_html
from burmester.describe import six_bar_words
from burmester.errors import InputError
from burmester.io import files
from burmester.sixbar.found import FoundSixBar
from burmester.tasks.loads import malformed
from burmester.values import shown
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.web.still import still
from burmester.wording import listed, with_article

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from burmester.loads.kinematics import Kinematics
    from burmester.loads.load_curves import LoadCurves, SwingCurves
    from burmester.loads.loaded_motion import LoadedLinkage
    from burmester.synthesis.result import Candidate
    from burmester.tasks.loads import Drive
    from burmester.tasks.motion_task import Task
    from burmester.verdicts.motion import Configuration


SWEPT_PLACES = 49  # of the body along the motion; each is a thin outline


Value = TypeVar("Value")


def as_type(kind: Callable[..., Value], found: Any, **others: Any) -> Value:
    """A value of an answer as one that can be drawn and handed over; others: fields to change."""
    own = {each.name: getattr(found, each.name) for each in fields(found)}
    return kind(**own | others)


@final
@dataclass(frozen=True, slots=True)
class MovingPicture:
    """A GIF of a linkage that goes through its poses.

    gif: the bytes of the file; title: a sentence in place of the picture.
    """

    gif: bytes = field(repr=False)
    title: str

    def save(self, path: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Write the picture; raises InputError E140 (the file exists) and E141 (no writing)."""
        with in_python_words():
            files.write(path, self.gif, force=force)
        return Path(path)

    def _repr_html_(self) -> str:
        data = base64.b64encode(self.gif).decode()
        return f'<img alt="{self.title}" src="data:image/gif;base64,{data}">'


class Chosen:
    """What a linkage of a result can do, four-bar or six-bar."""

    __slots__ = ()

    if TYPE_CHECKING:  # what linkages of any kind have

        @property
        def id(self) -> str: ...

        @property
        def type(self) -> str: ...

        @property
        def task(self) -> Task: ...

        def motion(self, count: int = 100) -> Configuration: ...

    def export(
        self,
        path: str | os.PathLike[str],
        *,
        to: str | None = None,
        force: bool = False,
        **dimensions: Any,
    ) -> Path:
        """Write the linkage for another program, read the file back and compare it.

        Parameters
        ----------
        path : str or path
            The file.  Its ending names the format: .dxf, .svg, .pdf, .step, .stl, .scad, .xml
            (MuJoCo), .urdf, .sdf, .py (pylinkage), .csv, .json, .gif, .mp4.
        to : str, optional
            The format, one of `burmester.export.FORMATS`, where the ending does not say it.
        force : bool
            Whether a file that exists is replaced.
        **dimensions
            Fields of `burmester.export.Options`: unit, hole, width, thickness, gap, pin, pose,
            dimensions, assembled, density, up, seconds, frames_per_second, width_px.

        Returns
        -------
        Path
            The file that was written.

        Raises
        ------
        InputError
            E130 (a library is missing), E140 (the file exists), E141 (it cannot be written), E161
            (no such format), E162 and E163 (dimensions that cannot be made).
        """
        from burmester.export import Options, export  # noqa: PLC0415

        known = [each.name for each in fields(Options)]
        for each in dimensions:
            if each not in known:
                raise InputError(
                    "E162",
                    f"an export has no option {each!r}",
                    help=f"choose among {', '.join(known)}",
                )
        with in_python_words():
            (written,) = export(cast("Candidate", self), to, path, Options(**dimensions), force)
        return written

    def plot(self, ax: Axes | None = None) -> Figure:
        """The linkage at its poses, with the curve of the body's origin, by Matplotlib.

        Parameters
        ----------
        ax : Axes, optional
            Axes to draw on; a new figure if not given.

        Raises
        ------
        InputError
            E130, where Matplotlib is missing.
        """
        from burmester import plot  # noqa: PLC0415  it loads Matplotlib

        along = None
        if self.task.body is not None:
            with suppress(InputError):  # nothing leads from the first pose to the last
                along = self.motion(SWEPT_PLACES).body
        return plot.linkage_figure(cast("Candidate", self), ax, along=along)

    def animate(self, *, seconds: float = 4.0, width_px: int = 640) -> MovingPicture:
        """The linkage on its way through the poses, as a GIF that a notebook shows.

        Parameters
        ----------
        seconds : float
            How long it takes.
        width_px : int
            The width of the picture.

        Raises
        ------
        InputError
            E130, where Matplotlib or Pillow is missing.
        """
        with TemporaryDirectory() as folder:
            path = Path(folder) / "linkage.gif"
            self.export(path, seconds=seconds, width_px=width_px)
            return MovingPicture(path.read_bytes(), self._title())

    def loaded(self, count: int = 361) -> LoadCurves:
        """What the linkage bears at so many places from the first pose to the last.

        It is held still at each place; where the task states a drive, `moving` has the same in
        time.  The greatest and least values are in the attribute `loads`.

        Parameters
        ----------
        count : int
            The number of places, at even steps of the motion.

        Returns
        -------
        LoadCurves
            Effort of the driver (N m, or N where it slides), force of the hand and of the pins (N),
            energy (J), lengths (the task's unit) and forces (N) of springs.

        Raises
        ------
        InputError
            E163 (a linkage that goes from no pose to another), E177 (a task without loads).

        Examples
        --------
        >>> import burmester
        >>> loads = burmester.Loads(body=burmester.Mass(4.0, [200, 0]), hand=[420, 0])
        >>> poses = [(0, 0, 0), (-20, -10, 25), (-60, -5, 60)]
        >>> task = burmester.Task.from_rows(poses, angle_unit="deg", length_unit="mm", loads=loads)
        >>> best = burmester.synthesize(task).best
        >>> curves = best.loaded(5)
        >>> curves.effort.shape, sorted(curves.pins)
        ((5,), ['A', 'B', 'C', 'D'])
        >>> round(float(curves.energy[-1] - curves.energy[0]), 2)
        6.6
        """
        from burmester.loads.load_curves import load_curves  # noqa: PLC0415

        with in_python_words():
            return load_curves(self._loaded(), np.linspace(0.0, 1.0, count))

    def kinematics(self, drive: Drive | None = None, count: int = 361) -> Kinematics:
        """Places, velocities and accelerations while the driver moves in time.

        Parameters
        ----------
        drive : Drive, optional
            How the driver goes from the first pose to the last; the task's own if not given.
        count : int
            The number of times, evenly from beginning to end.

        Returns
        -------
        Kinematics
            Times (s), the driver, the body, and its velocity and acceleration by the task's unit
            and seconds; `point` says the same of a point of the body.

        Raises
        ------
        InputError
            E163 (a linkage that goes from no pose to another), E177 (no drive).

        Examples
        --------
        >>> import burmester
        >>> best = burmester.synthesize(burmester.read_task("case:motiongen-shoulder")).best
        >>> moved = best.kinematics(burmester.Drive(2.0, "3-4-5"), count=101)
        >>> float(moved.time[-1]), moved.velocity.shape, moved.point([1.0, 0.5]).acceleration.shape
        (2.0, (101, 2), (101, 2))
        """
        from burmester.loads.kinematics import kinematics  # noqa: PLC0415

        if drive is None and self.task.loads is not None:
            drive = self.task.loads.drive
        if drive is None:
            help = 'give a drive, such as burmester.Drive(2.0, "3-4-5")'
            raise malformed("nothing says how the driver moves in time", help=help)
        with in_python_words():
            return kinematics(cast("Candidate", self), drive, count)

    def swing(self, from_pose: int = 1, seconds: float = 2.0) -> SwingCurves:
        """How the linkage moves if it is let go, at rest, at a pose; without friction.

        Parameters
        ----------
        from_pose : int
            The number of the pose, from 1.
        seconds : float
            For how long.  It ends before where an end of the motion is reached.

        Returns
        -------
        SwingCurves
            Times (s), the driver's angle and speed (degrees, or lengths), and the energy (J).

        Raises
        ------
        InputError
            E163 (a linkage that goes from no pose to another), E177 (a task without loads, or a
            pose that is not there).

        Examples
        --------
        >>> import burmester
        >>> loads = burmester.Loads(body=burmester.Mass(4.0, [200, 0], 0.05))
        >>> poses = [(0, 0, 0), (-20, -10, 25), (-60, -5, 60)]
        >>> task = burmester.Task.from_rows(poses, angle_unit="deg", length_unit="mm", loads=loads)
        >>> falls = burmester.synthesize(task).best.swing(from_pose=2)
        >>> falls.ended
        True
        """
        from burmester.loads.load_curves import swing_from  # noqa: PLC0415

        with in_python_words():
            loaded = self._loaded()
            reached = np.flatnonzero(np.isfinite(loaded.pose_shares)) + 1
            if from_pose not in reached:
                help = f"choose among {listed([str(each) for each in reached])}"
                raise malformed(f"it goes through no pose {shown(from_pose)}", help=help)
            return swing_from(loaded, from_pose - 1, seconds)

    def _loaded(self) -> LoadedLinkage:
        """The linkage with its loads; raises E163 and E177."""
        from burmester.loads.loaded_motion import LoadedLinkage  # noqa: PLC0415

        if self.task.loads is None:
            help = "give them to the task: Task(..., loads=burmester.Loads(...))"
            raise malformed("the task states no loads", help=help)
        return LoadedLinkage.of(cast("Candidate", self))

    def _title(self) -> str:
        return f"{self.id}, {with_article(self.type)}, and {len(self.task.poses.angle)} poses"

    def _drawing(self) -> str:
        """The linkage at its poses, as SVG."""
        return still(cast("Candidate", self), self._title())

    def _dimensions(self) -> str:
        """A table of its dimensions, as HTML."""
        raise NotImplementedError

    def _repr_html_(self) -> str:
        caption = f"<figcaption>{escape(self._title())}</figcaption>"
        return f"<figure>{self._drawing()}{caption}{self._dimensions()}</figure>"

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, str]:
        """In a notebook: text, HTML without scripts, and the drawing alone."""
        return {
            "text/plain": repr(self),
            "text/html": self._repr_html_(),
            "image/svg+xml": self._drawing(),
        }


@final
@dataclass(frozen=True, slots=True, eq=False, repr=False)
class ResultLinkage(FoundLinkage, Chosen):
    """A `FoundLinkage` that can be drawn and handed over.

    Examples
    --------
    >>> import burmester
    >>> best = burmester.synthesize(burmester.read_task("case:motiongen-shoulder")).best
    >>> best
    L1: crank-rocker of D2 and D3, passes every pose exactly, transmission angle 29.1° or more
    """

    def _dimensions(self) -> str:
        return dimensions_as_html(self)

    def __repr__(self) -> str:
        return as_line(self)


@final
@dataclass(frozen=True, slots=True, eq=False, repr=False)
class ResultSixBar(FoundSixBar, Chosen):
    """A `FoundSixBar` that can be drawn and handed over."""

    def _dimensions(self) -> str:
        return plain_html((), six_bar_words.dimension_rows(self), ())

    def __repr__(self) -> str:
        return six_bar_words.headline(self)
