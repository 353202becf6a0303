"""The figures of four-bars for what is asked and for the standard; degenerate ones."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from burmester.errors import Finding
from burmester.fourbar.circuits import Circuits
from burmester.fourbar.defects import Driven
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import GRASHOF_SUMS, TYPES, Linkage, grashof_numbers
from burmester.fourbar.linkage_batch import LinkageBatch, pin_distances
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Point, Polygon
from burmester.numerics.arrays import FloatArray
from burmester.requirements.figures import Figures
from burmester.requirements.links import CHANGE_POINT, EXTENT
from burmester.requirements.requirement import Bounds, Requirement
from burmester.requirements.table import standard
from burmester.requirements.table import violations as violations_of
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import length_of, span
from burmester.tasks.problem import SynthesisProblem
from burmester.tasks.repeated_poses import rotation_range
from burmester.tasks.requirements import Requirements
from burmester.wording import figure

SAME_ANGLE = 1e-9  # radians; a body that turns by less has nothing but parallelograms
FOOTPRINT_SAMPLES = 181  # number of places between the poses checked against the footprint


MIN_LINK_SHARE: Final = 1 / 200  # spans of the motion; a shorter link makes no usable linkage
# Position error at a pose per unit of error in all dimensions; a linkage above it is not usable.
MAX_SENSITIVITY: Final = 100.0


def figures_of(linkage: Linkage, transmission: ArrayLike, turns: ArrayLike) -> Figures:
    """The figures of four-bars (*,) driven by their first dyads; of sliders the radii are links.

    transmission: the least angle over the range, radians; turns: whether the driver turns fully.
    """
    dyads, links = (linkage.first, linkage.second), linkage.links
    lengths = links or [each.radius for each in dyads if isinstance(each, RR)]
    if not lengths:
        return Figures(transmission, type=TYPES.index(linkage.type), turns=turns)
    every = np.stack(lengths, axis=-1)
    least, most = every.min(axis=-1), every.max(axis=-1)
    out = Figures(transmission, least, most, turns=turns)
    if links is None:
        return out._replace(type=TYPES.index(linkage.type))
    change = np.abs(every @ GRASHOF_SUMS.T).min(axis=-1) / every.sum(axis=-1)
    ratio = most / np.maximum(least, 1e-300)
    return out._replace(ratio=ratio, change=change, type=grashof_numbers(links))


def four_bar_figures(linkage: Linkage, driven: Driven, footprint: Polygon | None = None) -> Figures:
    """The figures of one four-bar, driven by its first dyad."""
    out = figures_of(linkage, driven.least_over_range, driven.turns_fully)
    if footprint is None:
        return out
    pivots = pivots_of(linkage, places_between(linkage, driven))
    far = ((float(np.nanmax(footprint.distance(at))), name) for name, at in pivots)
    away, pivot = max(far, key=lambda each: each[0], default=(0.0, ""))
    return out._replace(outside=away, pivot=pivot)


def violations(
    linkage: Linkage, driven: Driven, asked: Requirements, unit: str | None = None
) -> tuple[Finding, ...]:
    """The requirements that a linkage, driven by its first dyad, violates.

    asked: the requirements; unit: the task's length unit, for messages.
    """
    if not asked.has_any:
        return ()
    return violations_of(asked.bounds, four_bar_figures(linkage, driven, asked.footprint), unit)


def places_between(linkage: Linkage, driven: Driven) -> Displacement | None:
    """FOOTPRINT_SAMPLES places of the body from pose to pose; None where they have no circuit.

    The linkage is driven by its first dyad.
    """
    ends = driven.parameter[np.isfinite(driven.parameter)]
    if not len(ends) or driven.circuit < 0:
        return None
    parameter = np.linspace(ends.min(), ends.max(), FOOTPRINT_SAMPLES)
    return Circuits.of(linkage, as_given=True)[driven.circuit].couplers(parameter)


def outside(linkage: Linkage, places: Displacement | None, footprint: Polygon) -> FloatArray:
    """How far pivots of linkages (*,) leave a footprint where the body is at places (*, N)."""
    out = [footprint.distance(points).max(axis=-1) for _, points in pivots_of(linkage, places)]
    return np.asarray(np.max(out, axis=0))


def pivots_of(linkage: Linkage, places: Displacement | None) -> Iterator[tuple[str, FloatArray]]:
    """What pivots are, and their points (*, N, 2)."""
    dyads = linkage.first, linkage.second
    for dyad in dyads:
        if isinstance(dyad, RR | RP):
            yield "a fixed pivot", dyad.fixed_pivot[..., None, :]
        if isinstance(dyad, RR | PR) and places is not None:
            yield "a moving pivot", places.act(dyad.moving_pivot[..., None, :])


def standard_of(task: Task) -> Bounds:
    """The standard of four-bars for a task; a bound that it sets itself is not asked again."""
    return standard(task.requirements.bounds, span(task), not_asked(task))


def not_asked(task: Task) -> tuple[Requirement, ...]:
    """What of the standard is not asked of four-bars for a task."""
    either = task.requirements.types is not None or rotation_range(task.poses.angle) <= SAME_ANGLE
    return (EXTENT, CHANGE_POINT) if either else (EXTENT,)


def timing_error(inputs: FloatArray, task: Task) -> FloatArray | None:
    """How far driver angles (N,) are from those of a task, signed, in radians; nan where untimed.

    None for a task that is not timed.
    """
    return None if task.timing is None else task.timing.missed(inputs)


def mistimed(inputs: FloatArray, task: Task, numbers: list[int]) -> tuple[Finding, ...]:
    """The violation of a driver's angles at the poses, if it is one; numbers: of the poses."""
    if (timing := task.timing) is None or (missed := timing_error(inputs, task)) is None:
        return ()
    known = np.abs(missed[timing.timed])
    if (known <= timing.bound).all():
        return ()
    at = int(timing.timed[np.nan_to_num(known, nan=np.inf).argmax()])
    away = math.degrees(float(np.abs(missed[at])))
    given = "" if task.names is None else f" ({task.names[at]})"
    told = f"is {figure(away)}° off" if math.isfinite(away) else "is not at"
    text = f"its crank {told} its angle at pose {numbers[at] + 1}{given}"
    return (Finding("timing", f"{text}; {figure(math.degrees(timing.bound))}° is allowed"),)


def least_link(problem: SynthesisProblem) -> float:
    """The length of the shortest link of a usable linkage, in the task's unit."""
    return MIN_LINK_SHARE * (span(problem.given) or problem.motion_size)


def least_cranks(problem: SynthesisProblem) -> tuple[float, float]:
    """The same of the dyads' own links: shorter where their limits state lengths as short."""
    least, limits = least_link(problem), problem.given.limits
    lengths = [each.length for each in (limits * 2)[:2]] or [(0.0, np.inf)] * 2
    one, two = (min(least, low) if low > 0 or high < least else least for low, high in lengths)
    return one, two


def least_links(problem: SynthesisProblem) -> FloatArray:
    """The least lengths (4,) of links as `pin_distances` has them.

    Two pivots at points that the task states are as near to each other as it says.
    """
    limits = (problem.given.limits * 2)[:2]
    fixed, moving = (
        0.0 if pivots and all(isinstance(at, Point) for at in pivots) else least_link(problem)
        for pivots in (
            [each.fixed_pivot for each in limits],
            [each.moving_pivot for each in limits],
        )
    )
    return np.array([*least_cranks(problem), fixed, moving])


def degenerate_defects(
    batch: LinkageBatch, sensitivity: FloatArray, problem: SynthesisProblem
) -> list[tuple[Finding, ...]]:
    """For each of linkages (k,), in the task's own frames, why it is degenerate; () is sound.

    sensitivity: (k,), as `quality.Quality` has it; nan where there is none.
    """
    lengths, least = pin_distances(batch), least_links(problem)
    out = []
    for length, each in zip(lengths, sensitivity, strict=True):
        reasons = list(too_short(length, least, problem.given))
        if each > MAX_SENSITIVITY:
            # At a change point it is infinite but for rounding, and its digits say nothing.
            times = f"up to {figure(each)}" if each < 1e6 else "over a million"
            reasons.append(f"magnifies errors of its pivots and lengths {times} times at a pose")
        out.append(tuple(Finding("degenerate", reason, ()) for reason in reasons))
    return out


def too_short(lengths: FloatArray, least: FloatArray, task: Task) -> Iterator[str]:
    """That of links (b,) some are shorter than the least lengths, the shortest of these; or not."""
    with np.errstate(invalid="ignore"):
        short = np.where(lengths < least, lengths, np.inf)
    if np.isfinite(short).any():
        at = int(short.argmin())
        share = f"1/{1 / MIN_LINK_SHARE:.0f}"
        yield (
            f"has a link of {length_of(float(lengths[at]), task)}, shorter than {share} of the "
            f"motion's span ({length_of(float(least[at]), task)})"
        )
