"""Limits on one dyad: places of its pivots, length of its link, line of its slider, kinds.

A region of the plane is a point, a line, a segment or a polygon.  Its faces are the pieces of
it without an edge of their own: the inside, the edges, the corners.  The best pivot in a region
is a stationary point on one of them, from which no way into the region leads down.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from typing import Final, Literal, TypeAlias, final, get_args

import numpy as np

from burmester.errors import InputError
from burmester.fourbar.canonical_frames import CanonicalFrames
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Region, require_searchable
from burmester.numerics.arrays import FloatArray
from burmester.tasks.rails import Rail, moved_region
from burmester.values import real_numbers, require_instance, shown

Kind: TypeAlias = Literal["RR", "PR", "RP", "PP"]
KINDS: Final[tuple[Kind, ...]] = get_args(Kind)


FEW_POSES = 2  # as many poses at most share a pole


@final
@dataclass(frozen=True, slots=True, eq=False)
class Limits:
    """What one dyad is allowed to be.

    Parameters
    ----------
    fixed_pivot : Point, Line, Segment, Polygon or None
        Where the fixed pivot may lie, in F; None is anywhere.  A dyad whose pivot is limited has
        that pivot: no PR, for the line of a slider on the ground has none.
    moving_pivot : Point, Line, Segment, Polygon or None
        The same for the moving pivot, in M; no RP where it is limited.
    length : (float, float)
        Least and greatest length of an RR dyad's link, in the task's unit.
    kinds : set of str
        Which of RR, PR, RP and PP.
    rail : Rail or None
        The line of a slider on the ground, in F.  A dyad with a rail is a PR.
    slot : Rail or None
        The line of a slot in the body, in M.  A dyad with a slot is an RP.

    Raises
    ------
    InputError
        E131 (malformed), E132 (limits that contradict each other).

    Examples
    --------
    >>> from burmester.geometry.regions import Line
    >>> limits = Limits(fixed_pivot=Line([0, 0], [1, 0]), length=(10, 200))
    >>> sorted(limits.allowed)
    ['RP', 'RR']
    >>> Limits(kinds={"RRR"})
    Traceback (most recent call last):
        ...
    burmester.errors.InputError: error[E131]: there is no dyad kind RRR
      help: choose among RR, PR, RP, PP
    """

    fixed_pivot: Region | None = None
    moving_pivot: Region | None = None
    length: tuple[float, float] = (0.0, float("inf"))
    kinds: frozenset[Kind] = field(default=frozenset(KINDS))
    rail: Rail | None = None
    slot: Rail | None = None

    def __post_init__(self) -> None:
        for name in ("fixed_pivot", "moving_pivot"):
            if (region := getattr(self, name)) is not None:
                help = "give a region such as Point((1, 2)), or None for any place"
                require_instance(region, get_args(Region), name, help, code="E131")
                require_searchable(region)
        for name in ("rail", "slot"):
            if (line := getattr(self, name)) is not None:
                help = "give a Rail such as Rail(direction_deg=0), or None for any line"
                require_instance(line, Rail, name, help, code="E131")
        bounds = real_numbers(self.length, (2,), "length", code="E131", finite=False)
        least, most = (float(bound) for bound in bounds)
        if not (least >= 0 and most > 0 and least < float("inf")):
            raise InputError(
                "E131",
                f"a link length from {least:g} to {most:g} is no range",
                help="give a least length of zero or more and a greatest one above it",
            )
        if least > most:
            raise InputError(
                "E132",
                "the limits contradict each other: "
                f"a link at least {least:.15g} long and at most {most:.15g} long",
                help="exchange the two, or give up one of them",
            )
        kinds = _dyad_kinds(self.kinds)
        object.__setattr__(self, "length", (least, most))
        object.__setattr__(self, "kinds", kinds)
        if not self.allowed:
            raise self._contradiction()
        if self.has_length and ("RR" not in self.kinds or self.line is not None):
            raise InputError(
                "E132",
                "the limits contradict each other: a link "
                f"from {least:g} to {most:g} long, and dyads of kind "
                f"{', '.join(sorted(self.allowed))} only",
                why="only an RR dyad has a link with a length",
                help="allow RR as well, or leave the length free",
            )

    @property
    def allowed(self) -> frozenset[Kind]:
        """The kinds whose dyads have the limited pivots."""
        out: set[Kind] = set()
        if self.fixed_pivot is not None:
            out |= {"PR", "PP"}
        if self.moving_pivot is not None:
            out |= {"RP", "PP"}
        if self.rail is not None:
            out |= {"RR", "RP", "PP"}
        if self.slot is not None:
            out |= {"RR", "PR", "PP"}
        return self.kinds - out

    @property
    def has_length(self) -> bool:
        """Whether the length is limited at all."""
        return self.length != (0.0, float("inf"))

    @property
    def line(self) -> Rail | None:
        """The rail or the slot, whichever there is."""
        return self.slot if self.rail is None else self.rail

    @property
    def conditions(self) -> int:
        """The number of exact conditions on a dyad: two for a point, one for a line, see `Rail`."""
        regions = (self.fixed_pivot, self.moving_pivot)
        number = sum(len(region.equations()) for region in regions if region)
        return number + (0 if self.line is None else self.line.conditions)

    def _contradiction(self) -> InputError:
        """The error for limits that no kind of dyad keeps: E132."""
        pivots = {"fixed": self.fixed_pivot, "moving": self.moving_pivot}
        limited = [f"{name} pivot {at}" for name, at in pivots.items() if at is not None]
        missing = "both pivots" if len(limited) > 1 else "that pivot"
        why, help = f"no dyad of that kind has {missing}", "allow RR as well, or leave a pivot free"
        lines = {"rail": self.rail, "slot": self.slot}
        stated = [f"a {name} {line}" for name, line in lines.items() if line is not None]
        if stated:
            why = "a dyad with a rail is a PR and has no fixed pivot; one with a slot is an RP and "
            why += "has no moving pivot"
            help = "leave out what another kind of dyad has, or give it to the other dyad"
        return InputError(
            "E132",
            f"the limits contradict each other: {', '.join(stated + limited)}, and dyads of kind "
            f"{', '.join(sorted(self.kinds))} only",
            why=why,
            help=help,
        )


def _dyad_kinds(given: object) -> frozenset[Kind]:
    """A set of dyad kinds, or E131."""
    help = f"choose among {', '.join(KINDS)}"
    if isinstance(given, str) or not isinstance(given, Iterable):
        raise InputError("E131", f"kinds is {shown(given)}, not a set of dyad kinds", help=help)
    names = list(given)
    kinds: frozenset[Kind] = frozenset(
        kind for kind in KINDS if any(isinstance(name, str) and name == kind for name in names)
    )
    unknown = [name for name in names if not (isinstance(name, str) and name in kinds)]
    if unknown:
        written = sorted(name if isinstance(name, str) else shown(name) for name in unknown)
        raise InputError("E131", f"there is no dyad kind {', '.join(written)}", help=help)
    if not kinds:
        raise InputError("E131", "no dyad kind is left", help=help)
    return kinds


def frames_of(
    poses: Displacement, weights: FloatArray | None, limits: Sequence[Limits]
) -> tuple[CanonicalFrames, Displacement]:
    """The canonical frames of poses (N,) within limits, and the poses seen in them.

    Of three poses and more, and where no pivot is limited, those of the poses.  Of one or two the
    origins are the middle of the regions, and the length is the rms distance from it of their
    corners, at all poses; a line counts by its point nearest to that middle.  So they go along
    with F, M and the unit of length.
    """
    own = CanonicalFrames.of(poses, weights)
    in_f = [each.fixed_pivot for each in limits if each.fixed_pivot is not None]
    in_m = [each.moving_pivot for each in limits if each.moving_pivot is not None]
    fixed, moving = _corners(in_f), _corners(in_m)
    if poses.shape[0] > FEW_POSES or not len(fixed) + len(moving):
        return own
    pulled_back = poses.inverse()[:, None].act(fixed).reshape(-1, 2)
    m = np.concatenate([moving, pulled_back]).mean(axis=0)
    c = poses.act(m).mean(axis=0)
    fixed = np.concatenate([fixed, *(_nearest(region, c) for region in in_f)])
    moving = np.concatenate([moving, *(_nearest(region, m) for region in in_m)])
    # Differences first: far origins cost no digits.
    arms = [poses[:, None].rotate(moving - m) + (poses.act(m) - c)[:, None], fixed - c]
    squares = np.concatenate([(arm.reshape(-1, 2) ** 2).sum(axis=-1) for arm in arms])
    length = np.sqrt(squares.mean())
    if not length > 0:
        return own
    frames = CanonicalFrames(c, m, np.asarray(length))
    return frames, frames.to_canonical(poses)


def _corners(regions: Sequence[Region]) -> FloatArray:
    """The corners (k, 2) of all regions that have some."""
    corners = [region.corners() for region in regions]
    return np.concatenate([np.empty((0, 2)), *(each for each in corners if each is not None)])


def _nearest(region: Region, point: FloatArray) -> FloatArray:
    """The nearest point (1, 2) of a line to another; none (0, 2) of a region with corners."""
    if region.corners() is not None:
        return np.empty((0, 2))
    row = region.equations()[0]
    return np.asarray(point - (point @ row[1:] + row[0]) * row[1:])[None]


def limits_in(frames: CanonicalFrames, limits: Limits) -> Limits:
    """Limits as canonical frames see them."""
    unit = float(frames.length)
    in_f, in_m = (frames.fixed_origin, unit), (frames.moving_origin, unit)
    return replace(
        limits,
        fixed_pivot=moved_region(limits.fixed_pivot, *in_f),
        moving_pivot=moved_region(limits.moving_pivot, *in_m),
        length=(limits.length[0] / unit, limits.length[1] / unit),
        rail=limits.rail and limits.rail.moved(*in_f),
        slot=limits.slot and limits.slot.moved(*in_m),
    )
