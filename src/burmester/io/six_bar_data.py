"""Six-bars as plain data, and that data read back."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np

from burmester.io.linkage_data import defect_data, errors_data, shares_data, unmet_data
from burmester.numerics.arrays import FloatArray
from burmester.sixbar.six_bars import RULE, SixBars

if TYPE_CHECKING:
    from burmester.sixbar.found import FoundSixBar

__all__ = ["six_bar_data", "six_bars_data"]


def six_bars_data(result: SixBars) -> dict[str, Any]:
    """What a search for six-bars has found, or the one that was given."""
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
            link.replace(" ", "_"): {name: _pair(at) for name, at in frames[link].items()}
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
        "position_error": errors_data(found.error.position),
        "angle_error_deg": errors_data(np.degrees(found.error.angle)),
        "shortcomings": list(found.shortcomings),
        "defects": [defect_data(each) for each in found.defects],
        "unmet": unmet_data(found.violations),
        "joints": [
            {name: _pair(places[k]) for name, places in joints.items()}
            for k in range(len(found.drive))
        ],
    }
    if found.within_tolerance is not None:
        data["within_tolerance"] = shares_data(found.within_tolerance)
    return data


def _pair(point: FloatArray) -> list[float]:
    return [float(each) for each in point]
