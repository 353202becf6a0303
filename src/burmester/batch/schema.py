"""The table that a batch makes: a row a task, with its dyads and linkages as lists.

Tasks of pairs of angles have their linkages as `generators`, and six-bars stand in `six_bars`.

The schema has a version, which every part and the manifest name.  Columns may be added, none goes
away and none changes its meaning under the same version.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final, TypeAlias

import pyarrow as pa

from burmester.stacked import StackedAnswers

VERSION: Final = "burmester.batch/1"

Columns: TypeAlias = Mapping[str, Any]


def _struct(columns: Columns) -> Any:
    return pa.struct(
        [(name, NUMBER if isinstance(each, str) else each) for name, each in columns.items()]
    )


def _points(**keys: str) -> dict[str, str]:
    return {
        f"{name}_{axis}": f"{key}.{k}" for name, key in keys.items() for k, axis in enumerate("xy")
    }


# "refused": the task cannot be computed with; "failed": burmester could not compute it.
OUTCOMES: Final = (*StackedAnswers.OUTCOMES, "failed")

TEXT: Final = pa.string()
NUMBER: Final = pa.float64()

# What results hold by their columns: each a type, or where its number stands in JSON, keys after
# dots.  A column that has its type comes from the key of its own name, or is made of several.
DYAD_COLUMNS: Final[Columns] = {
    "kind": TEXT,
    "status": TEXT,
    **_points(fixed="fixed_pivot", moving="moving_pivot"),
    "length": "radius",
    **_points(point="line.point"),
    "direction_deg": "line.direction_deg",
    "normal_deg": "line.normal_deg",
    "offset": "line.offset",
    "angle_deg": NUMBER,
    "rms": "rms_error",
    "worst": "max_error",
}
DYAD: Final = _struct(DYAD_COLUMNS)
LINKAGE_COLUMNS: Final[Columns] = {
    "first": pa.int32(),
    "second": pa.int32(),
    "verdict": TEXT,
    "type": TEXT,
    "rms": "position_error.rms",
    "worst": "position_error.max",
    "angle_rms_deg": "angle_error_deg.rms",
    "angle_worst_deg": "angle_error_deg.max",
    "combined": "combined_error",
    "transmission_deg": "quality.transmission_deg",
    "extent": "quality.extent",
    "sensitivity": "quality.sensitivity",
    "dyads": pa.list_(DYAD),
    "path_rms": "tracing.curve_to_path.rms",
    "path_worst": "tracing.curve_to_path.max",
    "chamfer": "tracing.chamfer",
    "dtw": "tracing.dtw",
}
LINKAGE: Final = _struct(LINKAGE_COLUMNS)
GENERATOR_COLUMNS: Final[Columns] = {
    "verdict": TEXT,
    "type": TEXT,
    "ground": "links.ground",
    "input_link": "links.input",
    "coupler": "links.coupler",
    "output_link": "links.output",
    "input_phase_deg": NUMBER,
    "output_phase_deg": NUMBER,
    "side": pa.int32(),
    "max_error_deg": "structural_error_deg.max",
    "rms_error_deg": "structural_error_deg.rms",
    "transmission_deg": "min_transmission_angle_deg",
    "link_ratio": NUMBER,
    "extent": NUMBER,
}
GENERATOR: Final = _struct(GENERATOR_COLUMNS)
WATT_COLUMNS: Final[Columns] = {  # of the class Watt I alone
    **_points(fixed_first="ground.A", fixed_second="ground.B", coupler_joint="coupler.D"),
    **_points(crank_joint="second_crank.G", body_joint="body.E", link_joint="body.H"),
    "first_crank": "lengths.AC",
    "coupler_arm": "coupler.E.0",
    "second_crank": "second_crank.D.0",
    "floating_link": "lengths.GH",
}
_JOINT: Final = pa.struct([("link", TEXT), ("joint", TEXT), ("x", NUMBER), ("y", NUMBER)])
SIX_BAR_COLUMNS: Final[Columns] = {
    "verdict": TEXT,
    "driver": TEXT,
    "type": TEXT,
    "carries": TEXT,
    "joints": pa.list_(_JOINT),  # of links with more than a length, in the frames of links
    "lengths": pa.map_(TEXT, NUMBER),
    **WATT_COLUMNS,
    "drive_deg": pa.list_(NUMBER),
    "turns_fully": pa.bool_(),
    "reserve_below_deg": "reserve_deg.0",
    "reserve_above_deg": "reserve_deg.1",
    "transmission_deg": "min_transmission_angle_deg",
    "link_ratio": NUMBER,
    "extent": NUMBER,
}
SIX_BAR: Final = _struct(SIX_BAR_COLUMNS)
POSE: Final = pa.struct([("x", NUMBER), ("y", NUMBER), ("angle_deg", NUMBER)])
SCHEMA: Final = pa.schema(
    [
        ("task", TEXT),
        ("poses", pa.int32()),
        ("outcome", TEXT),
        ("code", TEXT),
        ("reason", TEXT),
        ("dyads", pa.list_(DYAD)),
        ("linkages", pa.list_(LINKAGE)),
        ("warnings", pa.list_(TEXT)),
        ("pairs", pa.int32()),
        ("generators", pa.list_(GENERATOR)),
        ("six_bars", pa.list_(SIX_BAR)),
    ]
)
# The answer of a task, by its place in its part.
ANSWER: Final = pa.schema(
    [
        ("index", pa.int64()),
        *(each for each in SCHEMA if each.name not in ("task", "poses", "pairs")),
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
