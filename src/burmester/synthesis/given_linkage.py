"""A linkage that exists: two dyads, of which lengths may be left to the poses.

E112 a number too large to compute with
E154 two dyads that make no linkage
E155 lengths with which the linkage cannot be assembled at all
E158 pivots alone, and points that do not say how long their link is
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import TypeAlias, final

import numpy as np
from numpy.typing import ArrayLike

from burmester.cures import Cure, Help
from burmester.errors import Advice, InputError
from burmester.fourbar.circuits import Circuits
from burmester.fourbar.dyad import PP, PR, RP, RR, Dyad
from burmester.fourbar.linkage import Linkage
from burmester.numerics.arrays import FloatArray, weights_or_ones
from burmester.tasks.motion_task import MOST, Task, characteristic_length
from burmester.tasks.notation import length_of, span
from burmester.wording import figure

SAME_PIVOT = 1e-6  # sizes of the motion; pivots that are nearer to each other are one
FARTHEST = 1e6  # sizes of the motion; of what is farther away rounding takes too many digits
# Share of a length; it is said where the poses put the pivots apart by lengths that differ more.
LENGTH_SPREAD = 0.02


@final
@dataclass(frozen=True, slots=True, eq=False)
class OpenLink:
    """An RR dyad of which the pivots are known; the length of its link follows from the poses.

    From those with an angle: a point of the body does not say where the moving pivot is.

    fixed_pivot: (2,), in F; moving_pivot: (2,), in M, in the task's unit.

    Examples
    --------
    >>> from burmester import Task
    >>> task = Task.from_rows([(3, 0, 0), (0, 3, 90), (-3, 0, 180)], angle_unit="deg")
    >>> float(OpenLink([0, 0], [1, 0]).at(task).radius)
    4.0
    """

    fixed_pivot: FloatArray
    moving_pivot: FloatArray

    def __post_init__(self) -> None:
        for each in fields(self):
            object.__setattr__(self, each.name, np.asarray(getattr(self, each.name), dtype=float))

    def lengths(self, task: Task) -> FloatArray:
        """The distances (N,) of its pivots at the poses that have an angle."""
        poses = task.poses[~task.free_angles]
        return RR(self.fixed_pivot, self.moving_pivot, np.zeros(())).residual(poses)

    def at(self, task: Task) -> RR:
        """The dyad with the length of the least sum of squared residuals over the poses.

        That is the weighted mean of the distances; exact poses alone decide where there are some.
        Raises InputError E158 where no pose has an angle.
        """
        turned = ~task.free_angles
        if task.path is not None or not turned.any():
            raise InputError(
                "E158",
                "the length of a link is not given, and points do not determine it",
                why="they say where the body's origin is, and not where its other points are",
                help=Help.of("give the length of the link of each dyad with {}", Cure("length")),
            )
        share = weights_or_ones(task.weights, turned.shape)[turned]
        if task.exact is not None and task.exact.any():
            share = np.where(task.exact[turned], share, 0.0)
        return RR(self.fixed_pivot, self.moving_pivot, self.lengths(task) @ share / share.sum())


GivenDyad: TypeAlias = Dyad | OpenLink


def dyads_at_poses(
    dyads: Sequence[GivenDyad], task: Task
) -> tuple[tuple[Dyad, Dyad], tuple[Advice, ...]]:
    """Both dyads with their lengths, and what is to be said of lengths that the poses gave."""
    first, second = (each.at(task) if isinstance(each, OpenLink) else each for each in dyads)
    advice = [
        _spread_advice(f"D{number}", each, task)
        for number, each in enumerate(dyads, start=1)
        if isinstance(each, OpenLink)
    ]
    return (first, second), tuple(each for each in advice if each is not None)


def _spread_advice(name: str, link: OpenLink, task: Task) -> Advice | None:
    """W219, where the poses put the pivots apart by different lengths."""
    lengths, taken = link.lengths(task), float(link.at(task).radius)
    low, high = float(lengths.min()), float(lengths.max())
    if not high - low > LENGTH_SPREAD * taken:
        return None
    ends = f"{figure(low)} to {length_of(high, task)}"
    return Advice(
        "W219",
        f"the poses put the pivots of {name} from {ends} apart, and a link has one length: "
        f"{length_of(taken, task)} is taken",
        Help.of(
            "check both pivots (the fixed one is in the frame of the ground, the moving one in "
            "that of the body), or give the length with {}",
            Cure("length"),
        ),
        "the length with the least sum of squares over the poses is taken, or over the exact ones",
    )


def require_linkage(dyads: tuple[Dyad, Dyad], task: Task, *, assembled: bool = False) -> Linkage:
    """The linkage of two dyads; raises E112, E154 and E155.

    assembled: whether one that cannot be assembled anywhere is refused.
    """
    first, second = dyads
    for number, dyad in enumerate(dyads, start=1):
        _require_dyad(number, dyad, task)
    size = SAME_PIVOT * _size(task)
    pairs = []
    if isinstance(first, RR | RP) and isinstance(second, RR | RP):
        pairs.append(("fixed", first.fixed_pivot, second.fixed_pivot))
    if isinstance(first, RR | PR) and isinstance(second, RR | PR):
        pairs.append(("moving", first.moving_pivot, second.moving_pivot))
    for name, one, other in pairs:
        if float(np.hypot(*(one - other))) <= size:
            raise InputError(
                "E154",
                f"both dyads have the same {name} pivot",
                why=f"it is {_point(one)}; the link between two pivots at one place has no length",
                help=f"give the two dyads different {name} pivots",
            )
    linkage = Linkage(first, second)
    if assembled and not bool(Circuits.of(linkage, as_given=True).exists.any()):
        raise InputError(
            "E155",
            "the linkage cannot be assembled at any place",
            why=_why_open(linkage, task),
            help="give other lengths, or leave them out: then they follow from the poses",
        )
    return linkage


def _require_dyad(number: int, dyad: Dyad, task: Task) -> None:
    """Refuse numbers that cannot be computed with, and links without length."""
    numbers = {each.name: getattr(dyad, each.name) for each in fields(dyad)}
    require_computable(f"D{number}", numbers)
    if (away := _farthest(dyad, task)) > FARTHEST * _size(task):
        raise InputError(
            "E112",
            f"D{number} is too far from the poses to compute with",
            why=f"a pivot, its link or its line is {length_of(away, task)} away; the poses span "
            f"{length_of(span(task), task)}",
            help="give pivots nearer to the poses, in their unit; for a link that long, a slider",
        )
    if isinstance(dyad, PP):
        raise InputError(
            "E154",
            f"D{number} is a dyad of two sliders (PP)",
            why="no single joint drives a linkage with one",
            help="give an RR, a PR or an RP dyad",
        )
    if isinstance(dyad, RR) and not dyad.radius > SAME_PIVOT * _size(task):
        raise InputError(
            "E154",
            f"the moving pivot of D{number} is its fixed pivot",
            why=f"its link from {_point(dyad.fixed_pivot)} to the moving pivot is "
            f"{figure(float(dyad.radius))} long",
            help="move one of them: the fixed pivot is in the frame of the ground, the moving one "
            "in that of the body",
        )


def require_computable(what: str, numbers: Mapping[str, ArrayLike]) -> None:
    """Refuse dimensions that are too large to compute with: E112."""
    for name, given in numbers.items():
        value = np.asarray(given)
        if not np.isfinite(value).all() or np.abs(value).max() > MOST:
            raise InputError(
                "E112",
                f"a number of {what} is too large to compute with",
                why=f"its {name.replace('_', ' ')} is {value.tolist()}",
                help="write the lengths in another unit",
            )


def _size(task: Task) -> float:
    """The size of the motion."""
    return max(span(task), characteristic_length(task))


def _farthest(dyad: Dyad, task: Task) -> float:
    """The greatest length of a dyad: its link, and how far it is from the body at the poses."""
    middle = task.poses.translation.mean(axis=0)
    lengths = [0.0]
    if isinstance(dyad, RR | RP):
        lengths.append(float(np.hypot(*(dyad.fixed_pivot - middle))))
    if isinstance(dyad, RR | PR):
        lengths.append(float(np.hypot(*dyad.moving_pivot)))
    if isinstance(dyad, RR):
        lengths.append(float(dyad.radius))
    if isinstance(dyad, PR | RP):
        lengths.append(float(np.abs(dyad.residual(task.poses)).max()))
    return max(lengths)


def _why_open(linkage: Linkage, task: Task) -> str:
    """Which link is too long for the others."""
    if linkage.links is None:
        return "its slider is out of reach of the link"
    lengths = {name: float(value) for name, value in linkage.links._asdict().items()}
    longest = max(lengths, key=lambda name: lengths[name])
    others = sum(lengths.values()) - lengths[longest]
    names = {"driver": "link of D1", "follower": "link of D2", "ground": "ground link"}
    return (
        f"the {names.get(longest, longest)} is {length_of(lengths[longest], task)} long, "
        f"the three others together {length_of(others, task)}"
    )


def _point(at: FloatArray) -> str:
    return f"({', '.join(f'{float(value):.6g}' for value in at)})"
