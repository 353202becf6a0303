"""A synthesis as plain data: the object that `burmester synthesize --json` prints.

The contract is `synthesis.schema.json` beside this file.  Numbers keep all their digits;
a number that does not exist (the error of a linkage that reaches no pose) is null.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from burmester.candidates import FoundDyad
from burmester.critical import COUNT
from burmester.displacement import Displacement
from burmester.dyad import PP, PR, RP, RR
from burmester.errors import BurmesterError
from burmester.optimal import BestDyads
from burmester.synthesis import FoundLinkage, Synthesis

__all__ = ["failure", "plain"]

SCHEMA = "burmester.synthesis/1"


def plain(synthesis: Synthesis) -> dict[str, Any]:
    """The synthesis as an object ready for JSON."""
    task, fit = synthesis.task, synthesis.fit
    more: dict[str, Any] = {}
    if isinstance(fit, BestDyads):
        more["critical_points"] = {"found": int(fit.critical.found), "expected": COUNT}
    return {
        "schema": SCHEMA,
        "outcome": {"code": synthesis.outcome.code, "message": synthesis.outcome.message},
        "method": synthesis.method,
        "task": {"poses": _poses(task.poses), "length_unit": task.length_unit},
        "dyads": [_dyad(dyad) for dyad in synthesis.dyads],
        "linkages": [_linkage(linkage) for linkage in synthesis.linkages],
        "warnings": [
            {"code": warning.code, "message": warning.message, "help": warning.help}
            for warning in synthesis.warnings
        ],
        "characteristic_length": synthesis.length,
        "singular_values": None if fit is None else fit.singular_values.tolist(),
        **more,
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
