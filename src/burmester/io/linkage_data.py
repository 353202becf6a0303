"""A dyad, a linkage and a six-bar as plain data, for `result`: numbers with all their digits.

A number that does not exist (the error of a linkage that reaches no pose) is null.  Poses are
numbered from 1.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from burmester.describe.decimals import direction_deg
from burmester.dyads.selection import FoundDyad
from burmester.errors import Finding
from burmester.fourbar.defects import Driven
from burmester.fourbar.dyad import PP, PR, RP, RR, Dyad
from burmester.geometry.displacement import Displacement
from burmester.io.pose_data import poses_data
from burmester.numerics.arrays import FloatArray
from burmester.tasks.pose_tolerances import COMPONENTS
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.verdicts.tolerances import Spread
from burmester.verdicts.uncertainty import DyadUncertainty, PivotRegion

if TYPE_CHECKING:
    from burmester.clearance.least_clearance import Clearance
    from burmester.loads.load_figures import DriveFigures, Extremes, LoadFigures
    from burmester.sixbar.found import FoundSixBar

CONFIDENCE = 0.95
FUNCTION_SCHEMA = "burmester.function/1"


def number(value: float) -> float | None:
    """The number, or None where there is none."""
    return float(value) if math.isfinite(value) else None


def numbers(values: FloatArray) -> Any:
    """Nested lists of an array; None where there is no number."""
    return np.where(np.isfinite(values), values, None).tolist()  # type: ignore[call-overload]


def dyad_data(found: FoundDyad, places: Displacement) -> dict[str, Any]:
    """A dyad by its kind's own dimensions; places (N,): of the coupler, or poses."""
    dyad = found.dyad
    data: dict[str, Any] = {
        "id": found.id,
        "kind": type(dyad).__name__,
        "rms_error": number(found.rms_error),
        "max_error": number(found.max_error),
        "minimum": found.minimum,
    }
    if found.limits:
        data["limits"] = found.limits
    data |= dimensions_data(dyad)
    if isinstance(dyad, PR | RP):
        point = dyad.middle_of_travel(places).tolist()
        data["line"] |= {"point": point, "direction_deg": direction_deg(dyad)}
    return data


def dimensions_data(dyad: Dyad) -> dict[str, Any]:
    """The kind and the dimensions of a dyad, a line by its normal."""
    data: dict[str, Any] = {"kind": type(dyad).__name__}
    if isinstance(dyad, PP):
        return data | {"angle_deg": math.degrees(dyad.angle)}
    if isinstance(dyad, RR | RP):
        data["fixed_pivot"] = dyad.fixed_pivot.tolist()
    if isinstance(dyad, PR | RP):
        normal = math.degrees(dyad.normal_angle)
        data["line"] = {"normal_deg": normal, "offset": float(dyad.offset)}
    if isinstance(dyad, RR | PR):
        data["moving_pivot"] = dyad.moving_pivot.tolist()
    if isinstance(dyad, RR):
        data["radius"] = float(dyad.radius)
    return data


def linkage_data(found: FoundLinkage, tolerance: float | None = None) -> dict[str, Any]:
    """A linkage with its errors, verdicts and links; tolerance: of its manufacture, if given."""
    verdict = found.verdict
    data: dict[str, Any] = {
        "id": found.id,
        "rank": found.rank,
        "usable": found.usable,
        "driver": found.driver,
        "type": found.type,
        "possible_types": [found.type, *found.other_types],
        "dyads": [dyad_data(dyad, found.error.places) for dyad in found.dyads],
        "position_error": _errors(found.error.position),
        "angle_error_deg": _errors(np.degrees(found.error.angle)),
        "combined_error": number(found.combined_error),
        "shortcomings": list(found.shortcomings),
        "quality": _quality(found),
        "defects": [_defect(each) for each in found.defects],
        "unmet": _unmet(found.violations),
        "sought": found.from_search,
        "min_transmission_angle_deg": _transmission(found.driven),
        "drives": {
            "first": _drive(found.dyads[0].dyad, verdict.first),
            "second": _drive(found.dyads[1].dyad, verdict.second),
        },
        "pivot_uncertainty": _uncertainty(found),
    }
    if found.loads is not None:
        data |= load_figures_data(found.loads, found.task.names)
    if found.clearance is not None:
        data["clearance"] = _clearance(found.clearance, found.driver_first.first)
    if found.timing_error is not None:
        data["timing_error_deg"] = numbers(np.degrees(found.timing_error))
    if (links := found.driver_first.links) is not None:
        data["links"] = {name: float(length) for name, length in links._asdict().items()}
    if np.isfinite(found.error.angle).all():
        data["coupler"] = poses_data(found.error.places)
    if found.within_tolerance is not None:
        data["within_tolerance"] = _shares(found.within_tolerance)
    if found.spread is not None:
        data["tolerance"] = _spread(found.spread, tolerance)
    if (before := found.error_before_rounding) is not None:
        data["rounded"] = {
            "position_error_before": _errors(before.position),
            "angle_error_before_deg": _errors(np.degrees(before.angle)),
            "coupler_before": poses_data(before.places),
        }
    return data


def six_bar_data(found: FoundSixBar) -> dict[str, Any]:
    """One six-bar: its dimensions, what it does, and where its joints are at the poses."""
    skeleton, frames = found.skeleton, found.frames
    joints = found.joints(found.drive)
    data: dict[str, Any] = {
        "id": found.id,
        "type": skeleton.name,
        "usable": found.usable,
        "chain": found.chain,
        "driver": found.driver,
        "carries": found.carries,
        "joints_of_links": {name: list(joints) for name, joints in skeleton.links.items()},
        **{
            link.replace(" ", "_"): {name: at.tolist() for name, at in frames[link].items()}
            for link in skeleton.held(found.carries)
        },
        "lengths": found.lengths,
        "drive_deg": np.degrees(found.drive).tolist(),
        "turns_fully": found.turns_fully,
        "reserve_deg": [
            math.degrees(each) if math.isfinite(each) else None for each in found.room.tolist()
        ],
        "min_transmission_angle_deg": math.degrees(found.transmission),
        "link_ratio": found.link_ratio,
        "extent": found.extent,
        "position_error": _errors(found.error.position),
        "angle_error_deg": _errors(np.degrees(found.error.angle)),
        "shortcomings": list(found.shortcomings),
        "defects": [_defect(each) for each in found.defects],
        "unmet": _unmet(found.violations),
        "joints": [
            {name: places[k].tolist() for name, places in joints.items()}
            for k in range(len(found.drive))
        ],
    }
    if found.loads is not None:
        data |= load_figures_data(found.loads, found.task.names)
    if found.within_tolerance is not None:
        data["within_tolerance"] = _shares(found.within_tolerance)
    return data


def _shares(shares: FloatArray) -> list[dict[str, float | None]]:
    """The shares (N, 3) of tolerances that are used at poses."""
    return [
        {name: number(share) for name, share in zip(COMPONENTS, each, strict=True)}
        for each in shares.tolist()
    ]


def _unmet(violations: Sequence[Finding]) -> list[dict[str, str]]:
    """Requirements that are not met."""
    return [{"kind": each.kind, "message": each.message} for each in violations]


def _errors(values: FloatArray) -> dict[str, float | None]:
    """The errors (N,) at poses in two figures."""
    return {"rms": number(np.sqrt((values**2).mean())), "max": number(values.max())}


def _defect(defect: Finding) -> dict[str, Any]:
    """A defect, with the numbers of poses from 1."""
    return {
        "kind": defect.kind,
        "message": defect.message,
        "poses": [pose + 1 for pose in defect.poses],
        "certain": defect.certain,
    }


def _transmission(driven: Driven) -> dict[str, float | None]:
    return {
        "poses": number(math.degrees(driven.least_at_poses)),
        "range": number(math.degrees(driven.least_over_range)),
    }


def _quality(found: FoundLinkage) -> dict[str, Any] | None:
    """The figures of quality, angles in degrees, null where infinite; None without near places."""
    quality = found.quality
    if quality is None:
        return None
    slides = isinstance(found.driver_first.first, PR)
    turn, reserve = quality.driver_turn, quality.reserve
    if not slides:
        turn, reserve = np.degrees(turn), np.degrees(reserve)
    return {
        "transmission_deg": number(math.degrees(quality.transmission)),
        "extent": number(float(quality.extent)),
        "sensitivity": number(float(quality.sensitivity)),
        "driver_travel" if slides else "driver_turn_deg": number(float(turn)),
        "mechanical_advantage": [number(value) for value in quality.advantage],
        "reserve" if slides else "reserve_deg": [number(value) for value in reserve],
    }


def _drive(dyad: Dyad, driven: Driven) -> dict[str, Any]:
    """The verdicts with this dyad as driver; travel: the range of its input between the poses."""
    slides = isinstance(dyad, PR)
    travel = driven.input_range if slides else np.degrees(driven.input_range)
    return {
        "defects": [_defect(each) for each in driven.defects],
        "turns_fully": driven.turns_fully,
        "min_transmission_angle_deg": _transmission(driven),
        "circuit": driven.circuit if driven.circuit >= 0 else None,
        "travel" if slides else "travel_deg": [number(end) for end in travel],
    }


def _clearance(clearance: Clearance, driver: Dyad) -> dict[str, Any]:
    """The least clearance, what is nearest to what, and where."""
    slides = isinstance(driver, PR)
    at = clearance.input if slides else math.degrees(clearance.input)
    (place,) = poses_data(clearance.place[None])
    return {
        "least": number(clearance.least),
        "error": number(clearance.error),
        "part": clearance.part,
        "obstacle": clearance.obstacle,
        "poses": [pose + 1 for pose in clearance.poses],
        "input" if slides else "input_deg": number(at),
        "place": place,
        "points": clearance.points.tolist(),
    }


def _uncertainty(found: FoundLinkage) -> dict[str, Any] | None:
    """The 95 % regions of both dyads, if the errors of the poses say any."""
    if found.uncertainty is None:
        return None
    return {
        "confidence": CONFIDENCE,
        "determined": found.determined,
        "dyads": [
            _regions(dyad.id, each)
            for dyad, each in zip(found.dyads, found.uncertainty, strict=True)
        ],
    }


def _regions(name: str, regions: DyadUncertainty) -> dict[str, Any]:
    line, length = regions.line, regions.length
    data: dict[str, Any] = {
        "dyad": name,
        "fixed_pivot": _region(regions.fixed),
        "moving_pivot": _region(regions.moving),
        "line": None,
        "length": number(length) if length is not None and regions.length_determined else None,
    }
    if length is not None:
        data["length_determined"] = regions.length_determined
    if line is not None:
        data["line"] = {
            "normal_deg": number(math.degrees(line.angle)) if line.angle_determined else None,
            "offset_at_mid_travel": number(line.offset) if line.offset_determined else None,
            "determined": line.angle_determined and line.offset_determined,
        }
    return data


def _region(region: PivotRegion | None) -> dict[str, Any] | None:
    """An ellipse around the pivot, its direction in the pivot's own frame.

    Semi-axes that first order does not hold for are null; then the pivot is not determined along
    the direction.
    """
    if region is None:
        return None
    return {
        "determined": region.determined,
        "half_width": number(region.half_width) if region.determined else None,
        "major": number(region.major) if region.determined else None,
        "minor": number(region.minor) if region.determined_across else None,
        "direction_deg": number(math.degrees(region.direction)),
    }


def _spread(spread: Spread, tolerance: float | None) -> dict[str, Any]:
    """Position errors of linkages that are built within the tolerance.

    method: "first_order", where `bound` is a bound to first order; or "monte_carlo", where it is
    the greatest error that was found, and `lost` the share of linkages that cannot be assembled.
    """
    return {
        "tolerance": tolerance,
        "rms": number(float(spread.rms)),
        "max_95": number(float(spread.greatest_95)),
        "bound": number(float(spread.bound)),
        "deviation_at_poses": numbers(spread.deviation),
        "bound_at_poses": numbers(spread.worst),
        "method": "monte_carlo" if spread.monte_carlo else "first_order",
        "lost": number(float(spread.lost)) if spread.monte_carlo else None,
    }


def load_figures_data(figures: LoadFigures, names: tuple[str, ...] | None) -> dict[str, Any]:
    """Efforts in N m where the driver turns, else in N; lengths in the task's unit.

    names: of the poses; those without have numbers.
    """
    effort = "driver_torque_Nm" if figures.turns else "driver_force_N"
    coordinate = "driver_deg" if figures.turns else "driver_m"
    return {
        "loads": {
            effort: _extremes(figures.effort),
            "hand_force_N": None if figures.hand is None else _extremes(figures.hand),
            "hand_friction_N": None if figures.hand is None else figures.rub,
            "pin_force_N": figures.pins,
            "equilibria": [
                {
                    coordinate: each.driver,
                    "stable": each.stable,
                    "between_poses": list(each.between_poses),
                }
                for each in figures.rests
            ],
            "stays_at": [(names[k] if names else "") or str(k + 1) for k in figures.stays],
            "springs": [
                {
                    "kind": each.spring.kind,
                    "count": each.spring.count,
                    "ends": [
                        {"link": end.link, "point": list(end.point)} for end in each.spring.ends
                    ],
                    "length": dict(zip(("least", "greatest"), each.length, strict=True)),
                    "force_N": dict(zip(("least", "greatest"), each.tension, strict=True)),
                }
                for each in figures.springs
            ],
        },
        "drive": None if figures.drive is None else _in_time(figures.drive, effort),
    }


def _extremes(values: Extremes) -> dict[str, Any]:
    return {
        **{
            name: value if math.isfinite(value) else None
            for name, value in (("least", values.least), ("greatest", values.greatest))
        },
        "at_poses": [list(each) for each in values.at_poses],
    }


def _in_time(figures: DriveFigures, effort: str) -> dict[str, Any]:
    return {
        "duration_s": figures.drive.duration_s,
        "profile": figures.drive.profile,
        effort: _extremes(figures.effort),
        "body_speed": {"greatest": figures.speed},
        "body_acceleration": {"greatest": figures.acceleration},
    }
