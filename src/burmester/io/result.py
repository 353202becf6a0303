"""A synthesis as plain data: the object that `burmester synthesize --json` prints.

The contract is `synthesis.schema.json` beside this file.  Numbers keep all their digits;
a number that does not exist (the error of a linkage that reaches no pose) is null.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from burmester.candidates import Fit, FoundDyad
from burmester.certificate import Certificate
from burmester.critical import COUNT, CriticalDyads
from burmester.displacement import Displacement
from burmester.dyad import PP, PR, RP, RR
from burmester.errors import BurmesterError
from burmester.exact import FivePoseDyads
from burmester.fingerprint import Fingerprint
from burmester.limits import KINDS, Limits, Line, Point, Polygon, Segment
from burmester.optimal import BestDyads
from burmester.pencil import Pencil
from burmester.synthesis import FoundLinkage, Synthesis
from burmester.task import Task

__all__ = ["failure", "plain"]

SCHEMA = "burmester.synthesis/1"


def plain(synthesis: Synthesis) -> dict[str, Any]:
    """The synthesis as an object ready for JSON."""
    task, outcome, motion = synthesis.task, synthesis.outcome, synthesis.motion
    return {
        "schema": SCHEMA,
        "outcome": {"code": outcome.code, "message": outcome.message, "help": outcome.help},
        "method": synthesis.method,
        "task": _task(task),
        "motion": None if motion is None else _motion(motion),
        "dyads": [_dyad(dyad) for dyad in synthesis.dyads],
        "linkages": [_linkage(linkage) for linkage in synthesis.linkages],
        "warnings": [
            {"code": warning.code, "message": warning.message, "help": warning.help}
            for warning in synthesis.warnings
        ],
        "characteristic_length": synthesis.length,
        "singular_values": _singular_values(synthesis),
        **_critical_points(synthesis),
        "search": [_search(fit) for fit in synthesis.fits],
        "certificate": None
        if synthesis.certificate is None
        else _certificate(synthesis.certificate),
    }


def _task(task: Task) -> dict[str, Any]:
    """The task as a file may hold it."""
    poses: list[dict[str, Any]] = [dict(pose) for pose in _poses(task.poses)]
    columns = {"weight": task.weights, "name": task.names, "exact": task.exact}
    for key, values in columns.items():
        if values is not None:
            plain_values = values if isinstance(values, tuple) else values.tolist()
            for pose, value in zip(poses, plain_values, strict=True):
                pose[key] = value
    data: dict[str, Any] = {"poses": poses, "length_unit": task.length_unit}
    if task.limits:
        data["limits"] = [_limits(each) for each in task.limits]
    return data


def _limits(limits: Limits) -> dict[str, Any]:
    data: dict[str, Any] = {}
    for name, region in (
        ("fixed_pivot", limits.fixed_pivot),
        ("moving_pivot", limits.moving_pivot),
    ):
        if isinstance(region, Point):
            data[name] = {"point": region.at.tolist()}
        elif isinstance(region, Line | Segment):
            ends = [region.start.tolist(), region.end.tolist()]
            data[name] = {type(region).__name__.lower(): ends}
        elif isinstance(region, Polygon):
            data[name] = {"polygon": region.vertices.tolist()}
    bounds = {"least": limits.length[0], "most": limits.length[1]}
    if limits.has_length:
        data["length"] = {end: value for end, value in bounds.items() if 0 < value < math.inf}
    data["kinds"] = [kind for kind in KINDS if kind in limits.kinds]
    return data


def _motion(motion: Fingerprint) -> dict[str, Any]:
    """What the poses are, whatever the method."""
    return {
        "code": motion.motion.code,
        "name": motion.motion.name,
        "message": motion.motion.message,
        "distinct_poses": motion.distinct,
        "rotation_deg": math.degrees(motion.rotation),
        "nullity": motion.nullity,
    }


def _singular_values(synthesis: Synthesis) -> list[float] | None:
    """Those of the fit where it has some, else those that told what the motion is."""
    for fit in synthesis.fits:
        if not isinstance(fit, BestDyads):
            return list(fit.singular_values.tolist())
    return None if synthesis.motion is None else list(synthesis.motion.singular_values.tolist())


def _critical_points(synthesis: Synthesis) -> dict[str, Any]:
    """How many of the critical points of a task without limits were told apart."""
    for fit in synthesis.fits:
        if isinstance(fit, BestDyads) and isinstance(fit.search, CriticalDyads):
            return {"critical_points": {"found": int(fit.search.found), "expected": COUNT}}
    return {}


def _search(fit: Fit) -> dict[str, Any]:
    """What was searched, and how much of it is accounted for."""
    if isinstance(fit, Pencil):
        return {"kind": "pencil"}
    if isinstance(fit, FivePoseDyads):
        return {"kind": "five poses", "roots": len(fit.real), "real": int(fit.real.sum())}
    search = fit.search
    if isinstance(search, CriticalDyads):
        found = {"found": int(search.found), "at_infinity": int(search.at_infinity)}
        health = {"expected": COUNT, "health": _number(float(search.health))}
        return {"kind": "critical points", **found, **health}
    names = ("systems", "found", "lost", "unsettled")
    return {"kind": "faces", **{name: getattr(search, name) for name in names}}


def _certificate(certificate: Certificate) -> dict[str, Any]:
    return {
        "complete": certificate.complete,
        "proved": list(certificate.proved),
        "numerical": list(certificate.numerical),
        "dyads": [
            {
                "id": f"D{dyad.index + 1}",
                "proved": dyad.proved,
                "radius": _number(dyad.radius),
                "angle_radius_deg": _number(math.degrees(dyad.angle_radius)),
                "minimum": dyad.minimum,
            }
            for dyad in certificate.dyads
        ],
    }


def failure(error: BurmesterError) -> dict[str, Any]:
    """The same object for input that could not be used."""
    return {
        "schema": SCHEMA,
        "outcome": {
            "code": error.code,
            "message": error.message,
            "where": error.where,
            "why": error.why,
            "help": error.help,
        },
        "task": None,
        "dyads": [],
        "linkages": [],
        "warnings": [],
    }


def _poses(poses: Displacement) -> list[dict[str, float]]:
    rows = zip(poses.translation.tolist(), np.degrees(poses.angle).tolist(), strict=True)
    return [{"x": x, "y": y, "angle_deg": angle} for (x, y), angle in rows]


def _dyad(found: FoundDyad) -> dict[str, Any]:
    dyad = found.dyad
    data: dict[str, Any] = {
        "id": found.id,
        "kind": type(dyad).__name__,
        "rms_error": _number(found.rms_error),
        "max_error": _number(found.max_error),
        "minimum": found.minimum,
    }
    if found.limits:
        data["limits"] = found.limits
    match dyad:
        case RR():
            data["fixed_pivot"] = dyad.fixed_pivot.tolist()
            data["moving_pivot"] = dyad.moving_pivot.tolist()
            data["radius"] = float(dyad.radius)
        case PR():
            data["line"] = _line(dyad)
            data["moving_pivot"] = dyad.moving_pivot.tolist()
        case RP():
            data["fixed_pivot"] = dyad.fixed_pivot.tolist()
            data["line"] = _line(dyad)
        case PP():
            data["angle_deg"] = math.degrees(dyad.angle)
    return data


def _line(dyad: PR | RP) -> dict[str, float]:
    return {"normal_deg": math.degrees(dyad.normal_angle), "offset": float(dyad.offset)}


def _linkage(found: FoundLinkage) -> dict[str, Any]:
    data: dict[str, Any] = {
        "id": found.id,
        "rank": found.rank,
        "dyads": [_dyad(dyad) for dyad in found.dyads],
        "type": found.linkage.type,
        "position_error": _errors(found.error.position),
        "angle_error_deg": _errors(np.degrees(found.error.angle)),
    }
    if (links := found.linkage.links) is not None:
        data["links"] = {name: float(length) for name, length in links._asdict().items()}
    if np.isfinite(found.error.angle).all():
        data["coupler"] = _poses(found.error.places)
    return data


def _errors(values: np.ndarray) -> dict[str, float | None]:
    return {"rms": _number(np.sqrt((values**2).mean())), "max": _number(values.max())}


def _number(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
