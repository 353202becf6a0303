"""The table that a batch makes: a row a task, with its dyads and linkages as lists.

Tasks of pairs of angles have their linkages as `generators`, and six-bars stand in `six_bars`.

The schema has a version, which every part and the manifest name.  Columns may be added, none goes
away and none changes its meaning under the same version.
"""

from __future__ import annotations

from typing import Any, Final

import pyarrow as pa

from burmester.stacked import StackedAnswers

__all__ = [
    "DYAD",
    "GENERATOR",
    "LINKAGE",
    "OUTCOMES",
    "POSE",
    "SCHEMA",
    "SIX_BAR",
    "VERSION",
    "schema",
]

VERSION: Final = "burmester.batch/1"

# "refused": the task cannot be computed with; "failed": burmester could not compute it.
OUTCOMES: Final = (*StackedAnswers.OUTCOMES, "failed")

_NUMBER = pa.float64()
DYAD: Final = pa.struct(
    [
        ("kind", pa.string()),
        ("status", pa.string()),
        *((name, _NUMBER) for name in ("fixed_x", "fixed_y", "moving_x", "moving_y", "length")),
        *((name, _NUMBER) for name in ("point_x", "point_y", "direction_deg")),
        *((name, _NUMBER) for name in ("normal_deg", "offset", "angle_deg", "rms", "worst")),
    ]
)
LINKAGE: Final = pa.struct(
    [
        ("first", pa.int32()),
        ("second", pa.int32()),
        ("verdict", pa.string()),
        ("type", pa.string()),
        *((name, _NUMBER) for name in ("rms", "worst", "angle_rms_deg", "angle_worst_deg")),
        *((name, _NUMBER) for name in ("combined", "transmission_deg", "extent", "sensitivity")),
        ("dyads", pa.list_(DYAD)),
        *((name, _NUMBER) for name in ("path_rms", "path_worst", "chamfer", "dtw")),
    ]
)
GENERATOR: Final = pa.struct(
    [
        ("verdict", pa.string()),
        ("type", pa.string()),
        *((name, _NUMBER) for name in ("ground", "input_link", "coupler", "output_link")),
        *((name, _NUMBER) for name in ("input_phase_deg", "output_phase_deg")),
        ("side", pa.int32()),
        *((name, _NUMBER) for name in ("max_error_deg", "rms_error_deg")),
        *((name, _NUMBER) for name in ("transmission_deg", "link_ratio", "extent")),
    ]
)
_POINTS: Final = ("fixed_first", "fixed_second", "coupler_joint", "crank_joint")
_JOINT: Final = pa.struct(
    [("link", pa.string()), ("joint", pa.string()), ("x", _NUMBER), ("y", _NUMBER)]
)
SIX_BAR: Final = pa.struct(
    [
        ("verdict", pa.string()),
        *((name, pa.string()) for name in ("driver", "type", "carries")),
        ("joints", pa.list_(_JOINT)),  # of links with more than a length, in the frames of links
        ("lengths", pa.map_(pa.string(), _NUMBER)),
        # Of the class Watt I alone.
        *((f"{name}_{axis}", _NUMBER) for name in _POINTS for axis in "xy"),
        *((f"{name}_{axis}", _NUMBER) for name in ("body_joint", "link_joint") for axis in "xy"),
        *((name, _NUMBER) for name in ("first_crank", "coupler_arm", "second_crank")),
        ("floating_link", _NUMBER),
        ("drive_deg", pa.list_(_NUMBER)),
        ("turns_fully", pa.bool_()),
        *((name, _NUMBER) for name in ("reserve_below_deg", "reserve_above_deg")),
        *((name, _NUMBER) for name in ("transmission_deg", "link_ratio", "extent")),
    ]
)
POSE: Final = pa.struct([("x", _NUMBER), ("y", _NUMBER), ("angle_deg", _NUMBER)])
SCHEMA: Final = pa.schema(
    [
        ("task", pa.string()),
        ("poses", pa.int32()),
        ("outcome", pa.string()),
        ("code", pa.string()),
        ("reason", pa.string()),
        ("dyads", pa.list_(DYAD)),
        ("linkages", pa.list_(LINKAGE)),
        ("warnings", pa.list_(pa.string())),
        ("pairs", pa.int32()),
        ("generators", pa.list_(GENERATOR)),
        ("six_bars", pa.list_(SIX_BAR)),
    ]
)


def schema(*, numbered: bool, drawn: pa.Schema | None = None) -> Any:
    """The schema of a batch whose tasks are named by numbers or by texts.

    drawn: the columns of what was drawn, where the tasks are draws.
    """
    own = SCHEMA.set(0, pa.field("task", pa.int64())) if numbered else SCHEMA
    for field in () if drawn is None else drawn:
        own = own.append(field)
    return own
