"""Six-bars as rows of the table of a batch."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pyarrow as pa

from burmester.batch.answer_rows import answer_table
from burmester.batch.schema import DYAD, GENERATOR, LINKAGE, SIX_BAR

__all__ = ["six_bar_rows"]

WATT = "Watt I six-bar"


def six_bar_rows(found: Mapping[int, Mapping[str, Any]]) -> pa.Table:
    """What `burmester synthesize --six-bars --json` tells, by the places of tasks in a part."""
    every = list(found.values())
    six_bars = [list(map(_six_bar, data["six_bars"]["found"])) for data in every]
    return answer_table(
        np.array(list(found), dtype=np.intp),
        pa.array(["solved" if each else "none usable" for each in six_bars], pa.string()),
        pa.array([data["outcome"]["code"] for data in every], pa.string()),
        pa.nulls(len(every), pa.string()),
        pa.array([[]] * len(every), pa.list_(DYAD)),
        pa.nulls(len(every), pa.list_(LINKAGE)),
        pa.array([[w["code"] for w in data["warnings"]] for data in every], pa.list_(pa.string())),
        pa.nulls(len(every), pa.list_(GENERATOR)),
        pa.array(six_bars, pa.list_(SIX_BAR)),
    )


def _six_bar(data: Mapping[str, Any]) -> dict[str, Any]:
    keys = {link: link.replace(" ", "_") for link in data["joints_of_links"]}
    joints = [
        {"link": link, "joint": joint, "x": x, "y": y}
        for link, key in keys.items()
        for joint, (x, y) in data.get(key, {}).items()
    ]
    below, above = data["reserve_deg"]
    return {
        "verdict": "not sound" if data["shortcomings"] else "sound",
        "driver": data["driver"],
        "type": data["type"],
        "carries": data["carries"],
        "joints": joints,
        "lengths": list(data["lengths"].items()),
        **(_watt(data) if data["type"] == WATT else {}),
        "drive_deg": data["drive_deg"],
        "turns_fully": data["turns_fully"],
        "reserve_below_deg": below,
        "reserve_above_deg": above,
        "transmission_deg": data["min_transmission_angle_deg"],
        "link_ratio": data["link_ratio"],
        "extent": data["extent"],
    }


def _watt(data: Mapping[str, Any]) -> dict[str, Any]:
    """The columns that only this class has."""
    coupler, crank, lengths = data["coupler"], data["second_crank"], data["lengths"]
    points = {
        "fixed_first": data["ground"]["A"],
        "fixed_second": data["ground"]["B"],
        "coupler_joint": coupler["D"],
        "crank_joint": crank["G"],
        "body_joint": data["body"]["E"],
        "link_joint": data["body"]["H"],
    }
    return {
        **{f"{name}_{axis}": at[k] for name, at in points.items() for k, axis in enumerate("xy")},
        "first_crank": lengths["AC"],
        "coupler_arm": coupler["E"][0],
        "second_crank": crank["D"][0],
        "floating_link": lengths["GH"],
    }
