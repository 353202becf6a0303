"""A synthesis as plain data: the object that `burmester synthesize --json` prints.

The contract is `synthesis.schema.json` beside this file.  Numbers keep all their digits;
a number that does not exist (the error of a linkage that reaches no pose) is null.
"""

from __future__ import annotations

import json
import math
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from burmester.describe.cognates import cognates_of
from burmester.describe.quality_words import moved_pivots
from burmester.dyads.critical_points import COUNT, CriticalDyads
from burmester.dyads.five_poses import FivePoseDyads
from burmester.dyads.local_minima import BestDyads
from burmester.dyads.pencil import Pencil
from burmester.dyads.selection import Fit
from burmester.errors import BurmesterError
from burmester.geometry.regions import Line, Point, Region, Segment
from burmester.io.linkage_data import dimensions_data, dyad_data, linkage_data, number, six_bar_data
from burmester.io.pose_data import crank_data, degrees_of, poses_data, tolerances_data
from burmester.io.reading.specification import requirements_data, surroundings_data
from burmester.io.reading.trees.loads_tree import loads_data
from burmester.linkages.nearby_linkages import Move, greatest_move, moves
from burmester.synthesis.result import JUDGED, Synthesis
from burmester.tasks.limits import KINDS, Limits
from burmester.tasks.motion_class import MotionClass
from burmester.tasks.motion_task import Task
from burmester.tasks.rails import Rail
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.verdicts.tracing import Tracing, price_list

if TYPE_CHECKING:  # few results hold any of these
    from burmester.certificates.certificate import Certificate
    from burmester.families.family import Family
    from burmester.sixbar.six_bars import SixBars
    from burmester.synthesis.function_generation import AnySynthesis

SCHEMA = "burmester.synthesis/1"
# What a result says of its search alone, and nothing gives again when it is read.
SEARCH_KEYS = ("singular_values", "critical_points", "search")


def synthesis_data(synthesis: AnySynthesis) -> dict[str, Any]:
    """A synthesis of any kind as an object ready for JSON."""
    if not isinstance(synthesis, Synthesis):
        from burmester.io.function_result import function_data

        return function_data(synthesis)
    task, outcome, motion = synthesis.task, synthesis.outcome, synthesis.motion
    tolerance = synthesis.options.manufacturing_tolerance
    # Those of the fit where it has some, else those that classify the motion.
    values = [fit.singular_values for fit in synthesis.fits if not isinstance(fit, BestDyads)]
    values += [] if motion is None else [motion.singular_values]
    return {
        "schema": SCHEMA,
        "outcome": {**outcome.to_dict(), **_causes(synthesis)},
        "method": synthesis.method,
        "options": {
            name: list(each) if isinstance(each, tuple) else each
            for name, each in asdict(synthesis.options).items()
            if name != "time_limit"  # how long it might take is no part of the answer
        },
        "task": task_data(task),
        "motion": None if motion is None else motion_data(motion),
        "dyads": [dyad_data(dyad, synthesis.task.poses) for dyad in synthesis.dyads],
        "linkages": [
            {
                **linkage_data(each, tolerance),
                **_cognates(synthesis, each),
                **_tracing(synthesis, each),
                **_beside_given(synthesis, each),
            }
            for each in synthesis.linkages
        ],
        "warnings": [each.to_dict() for each in synthesis.warnings],
        "characteristic_length": synthesis.length,
        "length_per_radian": synthesis.length_per_radian,
        "singular_values": values[0].tolist() if values else None,
        **_critical_points(synthesis),
        "search": [*map(_search, synthesis.fits), *_counted(synthesis)],
        "family": None if synthesis.family is None else _family(synthesis.family),
        **_prices(synthesis),
        "certificate": None
        if synthesis.certificate is None
        else _certificate(synthesis.certificate),
        "six_bars": None if synthesis.six_bars is None else _six_bars(synthesis.six_bars),
        **{key: synthesis.search[key] for key in SEARCH_KEYS if key in synthesis.search},
    }


def _prices(synthesis: Synthesis) -> dict[str, Any]:
    """What better motion costs along a path, the nearest linkage first."""
    if synthesis.task.path is None:
        return {}
    return {
        "prices": [
            {
                "linkage": each.found.id,
                "miss": each.miss,
                "times": each.times,
                "transmission_deg": number(each.transmission_deg),
                "link_ratio": number(each.link_ratio),
            }
            for each in price_list(synthesis.linkages, synthesis.task)
        ]
    }


def _causes(synthesis: Synthesis) -> dict[str, Any]:
    """The limits that are to blame where no linkage is sound, the least loosening first."""
    if not synthesis.causes:
        return {key: synthesis.search[key] for key in ("causes",) if key in synthesis.search}
    listed = {each.id for each in synthesis.linkages}
    return {
        "causes": [
            {
                "limit": each.limit.kind,
                "number": each.limit.number + 1,
                "message": each.message,
                "option": each.option,
                "near_miss": each.found.id if each.found.id in listed else None,
            }
            for each in synthesis.causes
        ]
    }


def _cognates(synthesis: Synthesis, found: FoundLinkage) -> dict[str, Any]:
    """The other linkages with the same coupler curve, where points are traced."""
    told = [
        {
            "type": each.type,
            "dyads": [dimensions_data(each.first), dimensions_data(each.second)],
        }
        for each in cognates_of(found, synthesis.task)
        if each.links is not None
    ]
    return {"cognates": told} if told else {}


def _tracing(synthesis: Synthesis, found: FoundLinkage) -> dict[str, Any]:
    """How near points and curve are both ways, where points are traced in their order."""
    traced = Tracing.of(found, synthesis.task)
    if traced is None:
        return {}
    (rms, most), (path_rms, path_most) = traced.to_curve, traced.to_path
    return {
        "tracing": {
            "points_to_curve": {"rms": rms, "max": most},
            "curve_to_path": {"rms": path_rms, "max": path_most},
            "chamfer": traced.chamfer,
            "dtw": traced.dtw,
        }
    }


def _beside_given(synthesis: Synthesis, found: FoundLinkage) -> dict[str, Any]:
    """Whether a linkage is the one that was given, or how far that one's pivots move to it."""
    if synthesis.outcome.code not in JUDGED:
        return {}
    given = synthesis.linkages[0]
    if found is given:
        return {"given": True}
    return {
        "given": False,
        "moved": {
            "message": moved_pivots(synthesis, given, found),
            "greatest": greatest_move(given, found),
            "dyads": [_stated(each) for each in moves(given, found)],
        },
    }


def _stated(move: Move) -> dict[str, Any]:
    """The move of one dyad; what it does not have is left out."""
    data = move._asdict()
    if (turn := data.pop("turn")) is not None:
        data["turn_deg"] = math.degrees(turn)
    return {key: each for key, each in data.items() if each is not None}


def task_data(task: Task) -> dict[str, Any]:
    """The task as a file may hold it."""
    poses: list[dict[str, Any]] = [dict(pose) for pose in poses_data(task.poses)]
    columns = {"weight": task.weights, "name": task.names, "exact": task.exact}
    for key, values in columns.items():
        if values is not None:
            plain_values = values if isinstance(values, tuple) else values.tolist()
            for pose, value in zip(poses, plain_values, strict=True):
                pose[key] = value
    if task.tolerances is not None:
        for pose, stated in zip(poses, tolerances_data(task.tolerances), strict=True):
            pose.update(stated)
    data: dict[str, Any] = {"poses": poses, "length_unit": task.length_unit}
    if task.timing is not None:
        data |= crank_data(poses, task.timing)
    if task.path is not None:
        data["path"] = {"closed": task.path.closed}
        if (angles := task.path.crank_angles) is not None:
            data["path"]["crank_deg"] = [degrees_of(each) for each in angles.tolist()]
    if task.limits:
        data["limits"] = [limits_data(each) for each in task.limits]
    data |= _around(task)
    if task.requirements.has_any:
        data["requirements"] = requirements_data(task.requirements)
    data["pose_sigma"] = pose_sigma_data(task)
    return data


def pose_sigma_data(task: Task) -> dict[str, float]:
    """The standard deviations of the poses of a task, as files hold them."""
    position, angle = (given / math.sqrt(3) for given in task.resolution)
    return {"position": position, "angle_deg": math.degrees(angle)}


def _around(task: Task) -> dict[str, Any]:
    """The body of a task, what it must not touch, and what loads it."""
    data: dict[str, Any] = {}
    if task.body is not None:
        data["body"] = task.body.vertices.tolist()
    if task.surroundings is not None:
        data |= surroundings_data(task.surroundings)
    if task.loads is not None:
        data |= loads_data(task.loads)
    return data


def limits_data(limits: Limits) -> dict[str, Any]:
    """Limits as files hold them."""
    data = dict[str, Any]()
    for name in ("fixed_pivot", "moving_pivot"):
        if (region := getattr(limits, name)) is not None:
            data[name] = region_data(region)
    for name in ("rail", "slot"):
        if (rail := getattr(limits, name)) is not None:
            data[name] = _rail(rail)
    bounds = {"least": limits.length[0], "most": limits.length[1]}
    if limits.has_length:
        data["length"] = {end: value for end, value in bounds.items() if 0 < value < math.inf}
    data["kinds"] = [kind for kind in KINDS if kind in limits.kinds]
    return data


def region_data(region: Region) -> dict[str, Any]:
    """A region by its shape."""
    if isinstance(region, Point):
        return {"point": region.at.tolist()}
    if isinstance(region, Line | Segment):
        ends = [region.start.tolist(), region.end.tolist()]
        return {type(region).__name__.lower(): ends}
    return {"polygon": region.vertices.tolist()}


def _rail(rail: Rail) -> dict[str, Any]:
    """A rail or slot as files hold it."""
    data: dict[str, Any] = {}
    if rail.direction_deg is not None:
        data["direction_deg"] = rail.direction_deg
        if rail.tolerance_deg:
            data["tolerance_deg"] = rail.tolerance_deg
    for name in ("through", "travel"):
        if (region := getattr(rail, name)) is not None:
            data[name] = region_data(region)
    return data


def motion_data(motion: MotionClass) -> dict[str, Any]:
    """What the poses are, whatever the method."""
    return {
        "code": motion.kind.code,
        "name": motion.kind.name,
        "message": motion.kind.message,
        "distinct_poses": motion.distinct,
        "rotation_deg": math.degrees(motion.rotation),
        "nullity": motion.nullity,
    }


def _critical_points(synthesis: Synthesis) -> dict[str, Any]:
    """How many of the critical points of a task without limits were distinguished."""
    for fit in synthesis.fits:
        if isinstance(fit, BestDyads) and isinstance(fit.search, CriticalDyads):
            return {"critical_points": {"found": int(fit.search.found), "expected": COUNT}}
    return {}


def _counted(synthesis: Synthesis) -> list[dict[str, Any]]:
    """The solutions through poses and points that were looked for, found, real and lost."""
    if (points := synthesis.points) is None:
        return []
    names = ("classes", "found", "real", "lost")
    return [{"kind": "poses and points", **{name: getattr(points, name) for name in names}}]


def _search(fit: Fit) -> dict[str, Any]:
    """What was searched, and how much of it is accounted for."""
    if isinstance(fit, Pencil):
        return {"kind": "pencil"}
    if isinstance(fit, FivePoseDyads):
        return {"kind": "five poses", "roots": len(fit.real), "real": int(fit.real.sum())}
    search = fit.search
    if isinstance(search, CriticalDyads):
        found = {"found": int(search.found), "at_infinity": int(search.at_infinity)}
        found["not_accounted"] = COUNT - found["found"] - found["at_infinity"]
        health = {"expected": COUNT, "health": number(float(search.health))}
        ways = {"unfinished": fit.unfinished}
        return {"kind": "critical points", **found, **health, **ways}
    names = ("systems", "found", "lost", "unsettled")
    return {"kind": "faces", **{name: getattr(search, name) for name in names}}


def _family(family: Family) -> dict[str, Any]:
    """How linkages were chosen where the poses leave infinitely many."""
    return {
        "rule": family.rule,
        "assumed": [{"message": each.message, "option": each.option} for each in family.bounds],
        "given_up": family.given_up,
        "dyads": family.dyads,
        "pairs": family.pairs,
    }


NO_TIGHTER = 1 + 2.0**-50  # times a bound in degrees; more than both factors are rounded


def _certificate(certificate: Certificate) -> dict[str, Any]:
    return {
        "complete": certificate.complete,
        "proved": list(certificate.proved),
        "numerical": list(certificate.numerical),
        "dyads": [
            {
                "id": f"D{dyad.index + 1}",
                "proved": dyad.proved,
                "radius": number(dyad.radius),
                "angle_radius_deg": number(math.degrees(dyad.angle_radius) * NO_TIGHTER),
                "minimum": dyad.minimum,
            }
            for dyad in certificate.dyads
        ],
    }


def _six_bars(result: SixBars) -> dict[str, Any]:
    """What a search for six-bars has found, or the one that was given."""
    from burmester.sixbar.six_bars import RULE

    if result.given:
        counts = {"chains": result.chains, "designs": result.designs, "working": result.working}
        return {**counts, "found": [{**six_bar_data(each), "given": True} for each in result.found]}
    return {
        "rule": RULE,
        "assumed": [{"message": words, "option": option} for words, option in result.assumed],
        "chains": result.chains,
        "designs": result.designs,
        "working": result.working,
        "seed": int(result.options.seed),
        "options": {
            name: each if isinstance(each, str) else int(each)
            for name, each in asdict(result.options).items()
        },
        "free_poses": result.free_poses,
        "found": [six_bar_data(each) for each in result.found],
    }


def failure(error: BurmesterError) -> dict[str, Any]:
    """The same object for input that could not be used."""
    return {
        "schema": SCHEMA,
        "outcome": error.to_dict(),
        "task": None,
        "dyads": [],
        "linkages": [],
        "warnings": [],
    }


def json_line(data: dict[str, Any], encoding: str = "utf-8") -> str:
    """A line of JSON with all digits; what the encoding does not have is escaped."""
    line = json.dumps(data, ensure_ascii=False, allow_nan=False) + "\n"
    try:
        line.encode(encoding)
    except UnicodeEncodeError:  # half a character too, of a name or a path
        line = json.dumps(data, allow_nan=False) + "\n"
    return line
