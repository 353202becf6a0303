"""Whether the parts of a result agree: what its dyads and poses determine is computed again.

From the dyads of a linkage, its places and the poses follow its errors, its links and its type;
whether it is usable, with which driver, its defects, its transmission angles, its quality and
its clearance.
Other numbers (the regions of uncertainty, the spread of errors as built, the certificate) are not
computed again, and nothing is made of them where a result is read.

E152 a part of a result that its own dyads and poses do not give
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import fields
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from burmester.describe.decimals import direction_deg
from burmester.errors import InputError
from burmester.fourbar.defects import Defect, Driven, Verdict
from burmester.fourbar.dyad import PP, PR, RP, RR, Dyad
from burmester.fourbar.linkage import Linkage
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.fourbar.pose_error import PoseError
from burmester.geometry.displacement import Displacement
from burmester.io.saved_model import (
    WrittenDrive,
    WrittenDyad,
    WrittenLinkage,
    WrittenResult,
    path_of,
)
from burmester.linkages.evaluation import Evaluation
from burmester.linkages.from_dyads import target_of
from burmester.refinement.tolerance_boxes import counted_error, shares_used
from burmester.synthesis.result import JUDGED
from burmester.tasks.motion_class import classify_motion
from burmester.tasks.motion_task import Task, characteristic_length
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.pose_tolerances import COMPONENTS
from burmester.tasks.problem import SynthesisProblem
from burmester.values import shown
from burmester.verdicts.clearance_check import clearance_of, too_close
from burmester.verdicts.found_linkage import Side, with_driver_first
from burmester.verdicts.quality import Quality

if TYPE_CHECKING:
    from burmester.clearance.least_clearance import Clearance

__all__ = ["Judged", "judged_again"]

CLOSENESS = 1e-9  # of the task's size or of a number itself; rounding changes less
ROUNDING = 1e-14  # of the farthest pivot; rounding of what is computed from it
SHARE_CLOSENESS = 1e-5  # of a tolerance; shares are of places that are written with all digits
NONE = ("R302", "R306", "R309")  # outcomes without a linkage, or with near misses alone
NOT_USABLE = ("R301", "R304", "R341")  # outcomes with linkages of which none is usable
PLACE_ERROR = 1e-6  # of the task's size; places are found by iteration, to fewer digits
# Of a figure of quality: beside a dead point, and for bodies that hardly are determined, rounding
# changes the last digits.
QUALITY_CLOSENESS = 1e-5
ANGLE_CLOSENESS = 1e-5  # degrees; beside a dead point a transmission angle loses half its digits
WORKING = ("R300", "R305", "R307", "R308", "R340", "R350")  # outcomes with a usable linkage
CLEARANCE_ERROR = 2  # times that computed again; the error that a least clearance may state
AGAIN = "the file has been changed: make it anew with `burmester synthesize POSES -o result.json`"


_Keys = tuple[str | int, ...]


class Judged(NamedTuple):
    """A linkage of a result, and what its own dyads and the poses give.

    linkage: in the order of the file; driver: the preferred one, also where it is not usable.
    """

    linkage: Linkage
    error: PoseError
    driver: Side
    usable: bool
    verdict: Verdict
    quality: Quality | None = None

    @property
    def led(self) -> Linkage:
        """The linkage with its driver first."""
        return with_driver_first(self.linkage, self.driver)

    @property
    def driven(self) -> Driven:
        """The motion with that driver."""
        return self.verdict.first if self.driver == "first" else self.verdict.second


class _Part(NamedTuple):
    """A part of a result: as the file states it, as it is computed, how far both may differ."""

    keys: _Keys
    stated: Any
    given: Any
    tolerance: float = 0.0


_Parts = Iterator[_Part]


def judged_again(result: WrittenResult, task: Task) -> list[Judged]:
    """The linkages of a result, judged again; raises E152 where the file says otherwise."""
    _require_parts(_task_parts(result, task), "this result contradicts itself")
    if not result.linkages:
        return []
    linkages = [_linkage(each, k) for k, each in enumerate(result.linkages)]
    errors = [
        _error(each, linkage, task, k)
        for k, (each, linkage) in enumerate(zip(result.linkages, linkages, strict=True))
    ]
    options = SynthesisOptions(length_per_radian=result.length_per_radian or None)
    problem = SynthesisProblem.of(task, classify_motion(task), options).merged()
    evaluation = Evaluation(problem, target_of(problem))
    numbers = problem.pose_numbers
    places = Displacement(
        np.stack([each.places.translation[numbers] for each in errors]),
        np.stack([each.places.angle[numbers] for each in errors]),
    )
    once = evaluation.errors(places)
    batch = LinkageBatch.of(linkages)
    sensitivity = evaluation.sensitivities(batch, places)
    verdicts = evaluation.verdicts(batch, places, once, sensitivity)
    size, judged = characteristic_length(task), []
    for k, (written, verdict) in enumerate(zip(result.linkages, verdicts, strict=True)):
        side, _, usable = evaluation.driver(linkages[k], verdict)
        clearance = clearance_of(linkages[k], verdict, side, problem)
        usable = usable and not too_close(clearance, problem)
        if written.coupler is None or any(each.kind == "rounding" for each in written.unmet):
            usable = False
        own = Judged(linkages[k], errors[k], side, usable, verdict)
        if written.coupler is not None:
            (quality,) = evaluation.qualities(
                [own.led], places[[k]], [own.driven], sensitivity[[k]]
            )
            own = own._replace(quality=quality)
        slack = CLOSENESS * size + ROUNDING * _reach(_sides(own.linkage))
        parts = [
            *_verdict_parts(written, k, own),
            *_error_parts(written, k, own, slack),
            *_share_parts(written, k, own, task, problem.length),
            *_dyad_parts(written, k, own.linkage, evaluation, slack),
        ]
        if written.coupler is not None:  # else there are no places to judge it at
            for number, dyad in enumerate(written.dyads):
                keys = ("linkages", k, "dyads", number)
                parts += _line_parts(dyad, keys, own.error.places, slack)
            parts += [*_type_parts(written, k, own, slack), *_motion_parts(written, k, own)]
            parts += _quality_parts(written, k, own)
            parts += _clearance_parts(written, k, own, clearance, task)
        _require_parts(parts, f"linkage {written.id} does not do what the file says of it")
        judged.append(own)
    return judged


def _require_parts(parts: Iterator[_Part] | Sequence[_Part], what: str) -> None:
    """Refuse parts that are not what is computed."""
    for part in parts:
        stated, given = part.stated, part.given
        if isinstance(stated, float) and isinstance(given, float):
            agree = abs(stated - given) <= part.tolerance + CLOSENESS * abs(given)
        else:
            agree = stated == given and type(stated) is type(given)
        if not agree:
            why = (
                f"{path_of(*part.keys)} is {_told(stated)}; "
                f"the rest of the file gives {_told(given)}"
            )
            raise InputError("E152", what, why=why, help=AGAIN)


def _told(value: Any) -> str:
    """A value as JSON has it."""
    words = {None: "null", True: "true", False: "false"}
    if value is None or isinstance(value, bool):
        return words[value]
    return f"{value:.12g}" if isinstance(value, float) else shown(value)


def _number(value: float | np.floating[Any]) -> float | None:
    """A number as a result has it: None where there is none."""
    return float(value) if math.isfinite(value) else None


# --- what follows from the dyads, the places and the poses


def _task_parts(result: WrittenResult, task: Task) -> _Parts:
    """The order of dyads and linkages, the dyads' errors, and what the outcome says of all."""
    size = characteristic_length(task)
    for k, each in enumerate(result.linkages, start=1):
        yield _Part(("linkages", k - 1, "id"), each.id, f"L{k}")
        yield _Part(("linkages", k - 1, "rank"), each.rank, k)
    for k, dyad in enumerate(result.dyads):
        yield _Part(("dyads", k, "id"), dyad.id, f"D{k + 1}")
        miss = float(np.abs(_dyad(dyad).residual(task.poses)).max())
        slack = CLOSENESS
        if dyad.kind != "PP":  # whose error is an angle
            slack = CLOSENESS * size + ROUNDING * _reach([_dyad(dyad)])
        yield _Part(("dyads", k, "max_error"), dyad.max_error, miss, slack)
        yield from _line_parts(dyad, ("dyads", k), task.poses, slack)
    usable = any(each.usable for each in result.linkages)
    code, keys = result.outcome.code, ("outcome", "code")
    known = [each.usable for each in result.linkages]
    if result.six_bars is not None:
        known += [each.usable for each in result.six_bars.found if each.given]
    if (not result.linkages and code in (*WORKING, *NOT_USABLE)) or (not known and code in JUDGED):
        yield _Part(keys, code, "no linkage")
    elif code in JUDGED:  # of the linkage that was given, which is the first
        given = known[0]
        if given is not (code == "R330"):
            yield _Part(keys, code, f"{'a' if given else 'no'} usable linkage as given")
    elif result.linkages and code == "R303":
        yield _Part(keys, code, "linkages")
    elif usable is not (code in WORKING) and code in (*WORKING, *NOT_USABLE, *NONE, "R351", "R352"):
        yield _Part(keys, code, "a usable linkage" if usable else "no usable linkage")


def _verdict_parts(written: WrittenLinkage, index: int, own: Judged) -> _Parts:
    """Whether it is usable, and by which driver."""
    yield _Part(("linkages", index, "usable"), written.usable, own.usable)
    driver = own.driver if own.usable else None
    yield _Part(("linkages", index, "driver"), written.driver, driver)


def _error_parts(written: WrittenLinkage, index: int, own: Judged, slack: float) -> _Parts:
    """The errors at the poses; null where the file has no places."""
    for key, stated, values, tolerance in (
        ("position_error", written.position_error, own.error.position, slack),
        ("angle_error_deg", written.angle_error_deg, np.degrees(own.error.angle), CLOSENESS),
    ):
        most, rms = values.max(), np.sqrt((values**2).mean())
        for name, said, value in (("max", stated.max, most), ("rms", stated.rms, rms)):
            given = None if written.coupler is None else _number(value)
            yield _Part(("linkages", index, key, name), said, given, tolerance)


def _share_parts(
    written: WrittenLinkage, index: int, own: Judged, task: Task, size: float
) -> _Parts:
    """What each pose uses of its tolerances; nothing where the task has none."""
    keys, stated = ("linkages", index, "within_tolerance"), written.within_tolerance
    if task.tolerances is None or written.coupler is None:
        if task.tolerances is None and stated is not None:
            yield _Part(keys, "there", "left out: the poses have no tolerances")
        return
    shares = shares_used(own.error.places, task, size)
    count = len(stated or ())
    yield _Part(keys, count, len(shares))
    for k, (given, used) in enumerate(zip(stated or (), shares.tolist(), strict=False)):
        for name, share in zip(COMPONENTS, used, strict=True):
            slack = SHARE_CLOSENESS * max(1.0, share)
            if task.tolerances.exact[k, COMPONENTS.index(name)]:
                slack = max(slack, 1.0)  # of the rounding that an exact component is measured by
            yield _Part((*keys, k, name), getattr(given, name), _number(share), slack)


def _dyad_parts(
    written: WrittenLinkage, index: int, linkage: Linkage, evaluation: Evaluation, slack: float
) -> _Parts:
    """Its dyads' errors, and whose regions of uncertainty there are."""
    start = ("linkages", index)
    for k, (dyad, own) in enumerate(zip(written.dyads, _sides(linkage), strict=True)):
        found = evaluation.dyad(dyad.id, own)
        for key in ("rms_error", "max_error"):
            yield _Part((*start, "dyads", k, key), getattr(dyad, key), getattr(found, key), slack)
        if written.pivot_uncertainty is not None:
            named = written.pivot_uncertainty.dyads[k].dyad
            yield _Part((*start, "pivot_uncertainty", "dyads", k, "dyad"), named, dyad.id)


def _line_parts(written: WrittenDyad, keys: _Keys, places: Displacement, slack: float) -> _Parts:
    """The point and the direction of a slider's line, which its normal and offset give."""
    line, dyad = getattr(written, "line", None), _dyad(written)
    if line is None or not isinstance(dyad, PR | RP):
        return
    if line.point is not None:
        for k, value in enumerate(dyad.middle_of_travel(places).tolist()):
            yield _Part((*keys, "line", "point", k), line.point[k], value, slack)
    if line.direction_deg is not None:
        turned = (line.direction_deg - direction_deg(dyad) + 90) % 180 - 90  # both ends are one
        given = line.direction_deg - turned
        yield _Part((*keys, "line", "direction_deg"), line.direction_deg, given, CLOSENESS)


def _type_parts(written: WrittenLinkage, index: int, own: Judged, slack: float) -> _Parts:
    """Its type and its links."""
    start, led = ("linkages", index), own.led
    yield _Part((*start, "type"), written.type, led.type)
    if written.possible_types is not None:
        yield _Part((*start, "possible_types", 0), written.possible_types[0], led.type)
    if led.links is None or written.links is None:
        words = {True: "left out", False: "four lengths"}
        yield _Part((*start, "links"), words[written.links is None], words[led.links is None])
        return
    for name, length in led.links._asdict().items():
        yield _Part((*start, "links", name), getattr(written.links, name), float(length), slack)


def _motion_parts(written: WrittenLinkage, index: int, own: Judged) -> _Parts:
    """Its defects and its least transmission angles, with either driver too."""
    defects = own.verdict.defects + own.driven.defects
    yield from _driven_parts(written, ("linkages", index), own.driven, defects)
    both = (("first", own.verdict.first), ("second", own.verdict.second))
    for name, driven in both:
        drive, keys = getattr(written.drives, name), ("linkages", index, "drives", name)
        yield from _driven_parts(drive, keys, driven, driven.defects)
        yield _Part((*keys, "turns_fully"), drive.turns_fully, driven.turns_fully)


def _quality_parts(written: WrittenLinkage, index: int, own: Judged) -> _Parts:
    """Its figures of quality, where the file has them."""
    stated, quality = written.quality, own.quality
    if stated is None or quality is None:
        return
    keys, slides = ("linkages", index, "quality"), isinstance(own.led.first, PR)
    turn, reserve = quality.driver_turn, quality.reserve
    if not slides:
        turn, reserve = np.degrees(turn), np.degrees(reserve)
    figures = (
        ("transmission_deg", np.degrees(quality.transmission)),
        ("extent", quality.extent),
        ("sensitivity", quality.sensitivity),
        ("driver_travel" if slides else "driver_turn_deg", turn),
    )
    for name, value in figures:
        given = _number(float(value))
        tolerance = ANGLE_CLOSENESS + QUALITY_CLOSENESS * abs(given or 0.0)
        yield _Part((*keys, name), getattr(stated, name), given, tolerance)
    pairs = (
        ("mechanical_advantage", quality.advantage),
        ("reserve" if slides else "reserve_deg", reserve),
    )
    for name, values in pairs:
        said = getattr(stated, name)
        if said is None:
            yield _Part((*keys, name), "left out", "two numbers")
            continue
        for k, value in enumerate(values):
            given = _number(value)
            tolerance = QUALITY_CLOSENESS * (1 + abs(given or 0.0))
            yield _Part((*keys, name, k), said[k], given, tolerance)


def _clearance_parts(
    written: WrittenLinkage, index: int, own: Judged, clearance: Clearance | None, task: Task
) -> _Parts:
    """Its least clearance, and the distance of the two parts named at the place told.

    Where distances are alike, rounding chooses the place: it is not computed again.
    """
    stated, keys = written.clearance, ("linkages", index, "clearance")
    if stated is None or clearance is None or task.surroundings is None:
        words = {True: "left out", False: "a least clearance"}
        yield _Part(keys, words[stated is None], words[clearance is None])
        return
    from burmester.clearance.least_clearance import distance_of_pair

    slack = PLACE_ERROR * characteristic_length(task)
    slack += ROUNDING * _reach(_sides(own.linkage))
    least = (*keys, "least")
    yield _Part(least, stated.least, clearance.least, stated.error + clearance.error + slack)
    at = stated.place
    place = Displacement(np.array([at.x, at.y]), np.radians(at.angle_deg))
    pair = stated.part, stated.obstacle
    there = distance_of_pair(own.led, task.body, task.surroundings, pair, place)
    yield _Part(least, stated.least, _number(there), slack)
    known = max(stated.poses) <= task.poses.shape[0]
    yield _Part((*keys, "poses"), stated.poses, stated.poses if known else "poses of the task")
    bound = CLEARANCE_ERROR * max(clearance.error, slack)
    error = min(stated.error, bound)
    yield _Part((*keys, "error"), stated.error, error, slack)


def _driven_parts(
    written: WrittenLinkage | WrittenDrive, keys: _Keys, driven: Driven, defects: Sequence[Defect]
) -> _Parts:
    stated = [f"{each.kind} at {each.poses}" for each in written.defects]
    given = [f"{each.kind} at {[pose + 1 for pose in each.poses]}" for each in defects]
    yield _Part((*keys, "defects"), ", ".join(stated), ", ".join(given))
    angles, keys = written.min_transmission_angle_deg, (*keys, "min_transmission_angle_deg")
    for key, said, least in (
        ("poses", angles.poses, driven.least_at_poses),
        ("range", angles.range, driven.least_over_range),
    ):
        yield _Part((*keys, key), said, _number(math.degrees(least)), ANGLE_CLOSENESS)


# --- the linkage that the file describes


def _linkage(written: WrittenLinkage, index: int) -> Linkage:
    """The linkage of two different dyads; raises E152."""
    first, second = written.dyads
    linkage = Linkage(_dyad(first), _dyad(second))
    one, two = LinkageBatch.of([linkage]).dimensions[0]
    if first.id == second.id or (first.kind == second.kind and (one == two).all()):
        raise InputError(
            "E152",
            f"linkage {written.id} has the same dyad twice",
            why=f"{path_of('linkages', index, 'dyads', 1)} is {second.id}, as the first one is",
            help=AGAIN,
        )
    return linkage


def _error(written: WrittenLinkage, linkage: Linkage, task: Task, index: int) -> PoseError:
    """Its error at the places that the file gives, or at the nearest ones; raises E152."""
    size, count = characteristic_length(task), len(task.poses.angle)
    if written.coupler is None:
        return counted_error(PoseError.of(linkage, task.poses, size).places, task)
    what = f"linkage {written.id} does not do what the file says of it"
    _require_parts([_Part(("linkages", index, "coupler"), len(written.coupler), count)], what)
    rows = np.array([(each.x, each.y, each.angle_deg) for each in written.coupler])
    places = Displacement(rows[:, :2], np.radians(rows[:, 2]))
    off = max(float(np.abs(each.residual(places)).max()) for each in _sides(linkage))
    if not off <= PLACE_ERROR * size + ROUNDING * _reach(_sides(linkage)):
        where = path_of("linkages", index, "coupler")
        why = f"at the places in {where} its links are off by {off:.2g}"
        raise InputError("E152", what, why=why, help=AGAIN)
    return counted_error(places, task)


def _sides(linkage: Linkage) -> tuple[Dyad, Dyad]:
    return linkage.first, linkage.second


def _reach(dyads: Iterable[Dyad]) -> float:
    """The greatest of their dimensions."""
    numbers = (getattr(each, field.name) for each in dyads for field in fields(each))
    return max(float(np.abs(each).max()) for each in numbers)


def _dyad(written: WrittenDyad) -> Dyad:
    """A dyad as `linkage_data.dyad_data` tells it."""
    if written.kind == "PP":
        return PP(np.radians(written.angle_deg))
    if written.kind == "RR":
        return RR(
            np.array(written.fixed_pivot), np.array(written.moving_pivot), np.array(written.radius)
        )
    line = np.radians(written.line.normal_deg), np.array(written.line.offset)
    if written.kind == "PR":
        return PR(*line, np.array(written.moving_pivot))
    return RP(np.array(written.fixed_pivot), *line)
