"""CSV of the coupler's places along the motion, and JSON of the linkage; the task's own unit.

CSV: a row for each step along the motion from the first pose to the last, and one for each pose.
Its numbers are rounded to the digits that carry: what lies far below the tolerance is left out.
JSON: an object as `linkage.SCHEMA` describes it, the driver first.

E160 the file does not contain the linkage    E163 a linkage that has no motion through its poses
"""

from __future__ import annotations

import csv
import json
import math
from pathlib import Path
from typing import Any, Final

import numpy as np

from burmester.export.coupler_motion import CouplerMotion
from burmester.export.numbers import decimals_within, rounded
from burmester.export.options import Options, stated_unit
from burmester.export.reference import (
    PRECISION,
    Reference,
    as_rows,
    require_equal,
    require_places,
)
from burmester.fourbar.dyad import PP, PR, RP, RR, Dyad
from burmester.geometry.displacement import Displacement
from burmester.io.pose_data import poses_data
from burmester.refinement.tolerance_boxes import poses_counted
from burmester.verdicts.found_linkage import FoundLinkage

__all__ = ["SCHEMA", "check_csv", "check_json", "write_csv", "write_json"]

SCHEMA: Final = "burmester.linkage/1"
MOTION_ROWS = 361  # rows along the motion, beside those of the poses
ROUNDING = 0.01  # of the tolerance at which a table is compared: the error of its numbers, at most


def write_csv(chosen: FoundLinkage, path: Path, options: Options) -> None:
    """Write the table; raises E163."""
    motion = CouplerMotion.of(chosen, 2)
    shares = np.linspace(0, 1, MOTION_ROWS)
    poses = {int(k): float(motion.pose_shares[k]) for k in motion.reached}
    met = np.array(list(poses.values()))
    # Where a pose and a step are one place, the pose's row stands for both.
    shares = shares[np.abs(shares[:, None] - met).min(axis=1) > 0.01 / MOTION_ROWS]
    marked = [(share, 0) for share in shares.tolist()]
    marked += [(share, number + 1) for number, share in poses.items()]
    marked.sort()
    motion = CouplerMotion.of(chosen, np.array([share for share, _ in marked]))
    turns = motion.circuit.loop.turns
    drive = np.degrees(motion.driver_coordinate) if turns else motion.driver_coordinate
    unit = stated_unit(chosen, options)
    in_unit = f"_{unit}" if unit else ""
    # An angle moves what is a span away by the span.
    error = ROUNDING * PRECISION
    lengths = decimals_within(error * Reference.of(chosen, options, None).span)
    angles = decimals_within(math.degrees(error))
    with open(path, "w", encoding="utf-8", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(
            [
                "drive_deg" if turns else f"drive{in_unit}",
                f"x{in_unit}",
                f"y{in_unit}",
                "angle_deg",
                "pose",
            ]
        )
        rows = zip(
            drive.tolist(), poses_data(motion.places), [number for _, number in marked], strict=True
        )
        for value, place, number in rows:
            x, y, angle = place.values()
            table.writerow(
                [
                    rounded(value, angles if turns else lengths),
                    rounded(x, lengths),
                    rounded(y, lengths),
                    rounded(angle, angles),
                    number or "",
                ]
            )


def check_csv(chosen: FoundLinkage, path: Path, options: Options) -> None:
    """Read the table back and compare: every place is one of the linkage, and the poses' too."""
    reference = Reference.of(chosen, options, None)
    with open(path, encoding="utf-8", newline="") as file:
        head, *rows = list(csv.reader(file))
    numbers = np.array([[float(cell) for cell in row[:4]] for row in rows])
    places = Displacement(numbers[:, 1:3], np.radians(numbers[:, 3]))
    tolerance = PRECISION * reference.span
    require_equal("the links at the places", reference.closure_error(places), 0, tolerance)
    at = [(k, int(row[4]) - 1) for k, row in enumerate(rows) if row[4]]
    here, wanted = places[[k for k, _ in at]], reference.places[[pose for _, pose in at]]
    # Along a circuit a place is computed from the drive; beside dead points digits are lost, and at
    # a change point, where no linkage is usable, half of them.
    off = 1e-6 if chosen.usable else 1e-4
    span = reference.span
    require_equal("the places for the poses", here.translation, wanted.translation, off * span)
    require_equal("the angles for the poses", as_rows(here)[:, 2:], as_rows(wanted)[:, 2:], off)
    if chosen.usable:
        require_equal(
            "the poses", sorted(pose for _, pose in at), np.arange(len(reference.places.angle)), 0
        )
    # The driver, from the places.
    fixed, moving, line = reference.fixed[0], reference.moving[0], reference.line[0]
    drives = numbers[:, 0]
    if head[0] == "drive_deg" and line is None:
        assert fixed is not None
        assert moving is not None
        arm = places.act(moving) - fixed
        own = np.arctan2(arm[:, 1], arm[:, 0])
    elif head[0] == "drive_deg":
        assert line is not None
        own = places.angle + line[0]
    else:
        assert line is not None
        assert moving is not None
        along = np.array([-math.sin(line[0]), math.cos(line[0])])
        require_equal("the drive", drives, places.act(moving) @ along, off * span)
        return
    turned = np.exp(1j * (np.radians(drives) - own))
    require_equal("the drive", np.abs(turned - 1).max(), 0, off)


def write_json(chosen: FoundLinkage, path: Path, options: Options) -> None:
    """Write the linkage; raises E163."""
    require_places(chosen)
    linkage = chosen.driver_first
    data: dict[str, Any] = {
        "schema": SCHEMA,
        "id": chosen.id,
        "type": chosen.type,
        "usable": chosen.usable,
        "length_unit": stated_unit(chosen, options),
        "driver": "first",
        "dyads": [
            {"id": name, **_dyad(dyad)}
            for name, dyad in zip(chosen.ids, (linkage.first, linkage.second), strict=True)
        ],
    }
    if (links := linkage.links) is not None:
        data["links"] = {name: float(length) for name, length in links._asdict().items()}
    data["poses"] = poses_data(poses_counted(chosen.error.places, chosen.task))
    data["coupler"] = poses_data(chosen.error.places)
    data["position_error"] = {"max": float(chosen.error.position.max())}
    data["angle_error_deg"] = {"max": math.degrees(float(chosen.error.angle.max()))}
    path.write_text(json.dumps(data, indent=2, allow_nan=False) + "\n", encoding="utf-8")


def check_json(chosen: FoundLinkage, path: Path, options: Options) -> None:
    """Read the linkage back and compare all its numbers."""
    reference = Reference.of(chosen, options, None)
    data = json.loads(path.read_text(encoding="utf-8"))
    tolerance = PRECISION * reference.span
    for k, dyad in enumerate(data["dyads"]):
        require_equal(f"the kind of dyad {k + 1}", dyad["kind"] == reference.kinds[k], True, 0)
        for key, wanted in (
            ("fixed_pivot", reference.fixed[k]),
            ("moving_pivot", reference.moving[k]),
            ("radius", reference.radius[k]),
        ):
            if wanted is not None:
                require_equal(f"{key} of dyad {k + 1}", dyad[key], wanted, tolerance)
        if (line := reference.line[k]) is not None:
            require_equal("a normal", math.radians(dyad["line"]["normal_deg"]), line[0], 1e-12)
            require_equal("an offset", dyad["line"]["offset"], line[1], tolerance)
    for key, places in (("coupler", reference.places), ("poses", reference.poses)):
        rows = [[each["x"], each["y"]] for each in data[key]]
        require_equal(f"the places of {key}", rows, places.translation, tolerance)
        angles = [math.radians(each["angle_deg"]) for each in data[key]]
        require_equal(f"the angles of {key}", angles, places.angle, 1e-12)
    if "links" in data:
        pivots = [np.asarray(each) for each in (*reference.fixed, *reference.moving)]
        ground, coupler = (np.linalg.norm(pivots[k + 1] - pivots[k]) for k in (0, 2))
        lengths = np.array(
            [ground, reference.radius[0], coupler, reference.radius[1]], dtype=np.float64
        )
        require_equal("the links", list(data["links"].values()), lengths, tolerance)
    gap = reference.places.translation - reference.poses.translation
    worst = float(np.hypot(gap[:, 0], gap[:, 1]).max())
    require_equal("the error", data["position_error"]["max"], worst, 10 * tolerance)


def _dyad(dyad: Dyad) -> dict[str, Any]:
    data: dict[str, Any] = {"kind": type(dyad).__name__}
    if isinstance(dyad, PP):
        return data | {"angle_deg": math.degrees(float(dyad.angle))}
    if isinstance(dyad, RR | RP):
        data["fixed_pivot"] = dyad.fixed_pivot.tolist()
    if isinstance(dyad, PR | RP):
        normal = math.degrees(float(dyad.normal_angle))
        data["line"] = {"normal_deg": normal, "offset": float(dyad.offset)}
    if isinstance(dyad, RR | PR):
        data["moving_pivot"] = dyad.moving_pivot.tolist()
    if isinstance(dyad, RR):
        data["radius"] = float(dyad.radius)
    return data
