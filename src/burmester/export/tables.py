"""CSV of the places along the motion, and JSON of the linkage; the task's own unit.

CSV: a row for each step along the motion from the first pose to the last, and one for each pose;
joints that have names are told, too, and of a task with loads what the driver, the hand, pins and
springs bear, held still or at the time of a drive.  Numbers are rounded to the digits that carry:
what lies far below the tolerance is left out.
JSON: what `judge --linkage` reads: two dyads, the driver first, or the joints of all links.

E160 the file does not contain the linkage    E163 a linkage that has no motion through its poses
"""

from __future__ import annotations

import csv
import json
import math
from pathlib import Path
from typing import Any, Final

import numpy as np

from burmester.export.description import decimals_within, rounded
from burmester.export.options import (
    PRECISION,
    Options,
    Reference,
    as_rows,
    require_equal,
    require_places,
    stated_unit,
)
from burmester.geometry.displacement import Displacement
from burmester.io.linkage_data import dimensions_data, six_bar_data
from burmester.io.pose_data import poses_data
from burmester.loads.load_curves import load_curves
from burmester.loads.loaded_motion import LoadedLinkage
from burmester.mechanisms.bodies import GROUND, LinkPlaces
from burmester.numerics.arrays import FloatArray
from burmester.refinement.tolerance_boxes import poses_counted
from burmester.synthesis.result import Candidate
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.verdicts.motion import Motion

SCHEMA: Final = "burmester.linkage/1"
JOINTS_SCHEMA: Final = "burmester.six-bar/1"
MOTION_ROWS: Final = 361  # rows along the motion, beside those of the poses
ROUNDING: Final = 0.01  # of the tolerance at which a table is compared: error of its numbers
LOAD_ROUNDING: Final = 1e-7  # of the greatest number of a column of loads: error of its numbers


def write_csv(chosen: Candidate, path: Path, options: Options) -> None:
    """Write the table; raises E163."""
    motion = Motion.of(chosen, 2)
    shares = np.linspace(0, 1, MOTION_ROWS)
    reached = np.flatnonzero(np.isfinite(motion.pose_shares))
    met = motion.pose_shares[reached]
    # Where a pose and a step are one place, the pose's row stands for both.
    shares = shares[np.abs(shares[:, None] - met).min(axis=1) > 0.01 / MOTION_ROWS]
    marked = [(share, 0) for share in shares.tolist()]
    marked += zip(met.tolist(), (reached + 1).tolist(), strict=True)
    marked.sort()
    shares = np.array([share for share, _ in marked])
    motion = Motion.of(chosen, shares)
    reference = Reference.of(chosen, options, None)
    drive = np.degrees(motion.drive) if motion.in_turns else motion.drive
    bodies, named = reference.own.bodies_at(motion.drive, motion.places), _named(reference)
    joints = {name: bodies[link].act(hole) for name, (link, hole) in named.items()}
    unit = "" if named else stated_unit(chosen, options)
    in_unit = f"_{unit}" if unit else ""
    # An angle moves what is a span away by the span.
    error = ROUNDING * PRECISION
    lengths = decimals_within(error * reference.span)
    angles = decimals_within(math.degrees(error))
    head = ["drive_deg" if motion.in_turns else f"drive{in_unit}"]
    head += [f"x{in_unit}", f"y{in_unit}", "angle_deg"]
    head += [f"{name}_{axis}" for name in joints for axis in "xy"]
    loads = {} if chosen.loads is None else _load_columns(chosen, shares)
    with open(path, "w", encoding="utf-8", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow([*head, *loads, "pose"])
        for k, (place, (_, number)) in enumerate(
            zip(poses_data(motion.places), marked, strict=True)
        ):
            *at, angle = place.values()
            row = [rounded(float(drive[k]), angles if motion.in_turns else lengths)]
            row += [rounded(each, lengths) for each in at]
            row += [rounded(angle, angles)]
            row += [rounded(each, lengths) for own in joints.values() for each in own[k].tolist()]
            table.writerow([*row, *(each[k] for each in loads.values()), number or ""])


def _load_columns(chosen: Candidate, shares: FloatArray) -> dict[str, list[str]]:
    """What a linkage bears at shares (n,) of its motion, by columns whose names end in units."""
    curves, unit = load_curves(LoadedLinkage.of(chosen), shares), chosen.unit
    effort, driver = ("torque_Nm", "deg") if curves.turns else ("force_N", unit)
    columns = {f"driver_{effort}": curves.effort}
    if curves.hand is not None:
        columns["hand_force_N"] = curves.hand
    columns |= {f"pin_{name}_N": np.hypot(*force.T) for name, force in curves.pins.items()}
    for number, each in enumerate(curves.springs, start=1):
        turned = each.spring.kind == "torsion"
        columns[f"spring_{number}_{'deg' if turned else unit}"] = each.length
        columns[f"spring_{number}_{'Nm' if turned else 'N'}"] = each.force
    columns["energy_J"] = curves.energy
    if (moving := curves.moving) is not None:
        columns["time_s"] = moving.time
        columns[f"driver_{driver}_per_s"] = moving.driver_speed
        columns[f"speed_{unit}_per_s"] = moving.body_speed
        columns[f"driver_{effort.replace('_', '_in_time_')}"] = moving.effort
    return {name: _cells(values) for name, values in columns.items()}


def _cells(values: FloatArray) -> list[str]:
    """Numbers to the digits that carry; none at dead points."""
    decimals = decimals_within(LOAD_ROUNDING * float(np.nanmax(np.abs(values), initial=0.0)))
    return [rounded(each, decimals) if math.isfinite(each) else "" for each in values.tolist()]


def _named(reference: Reference) -> dict[str, tuple[str, FloatArray]]:
    """The joints that have names, in the frame of the link that holds them."""
    return {
        each.name: (each.holder, each.holes[each.holder]) for each in reference.joints if each.name
    }


def check_csv(chosen: Candidate, path: Path, options: Options) -> None:
    """Read the table back and compare: every place is one of the linkage, and the poses' too."""
    reference = Reference.of(chosen, options, None)
    span = reference.span
    with open(path, encoding="utf-8", newline="") as file:
        head, *rows = list(csv.reader(file))
    numbers = np.array(
        [[float(cell) for cell in row[: 4 + 2 * len(_named(reference))]] for row in rows]
    )
    places = Displacement(numbers[:, 1:3], np.radians(numbers[:, 3]))
    bodies = _bodies(reference, places, numbers[:, 4:])
    _require_linkage(reference, bodies, places)
    at = [(k, int(row[-1]) - 1) for k, row in enumerate(rows) if row[-1]]
    here, wanted = places[[k for k, _ in at]], reference.places[[pose for _, pose in at]]
    # Along a circuit a place is computed from the drive; beside dead points digits are lost, and at
    # a change point, where no linkage is usable, half of them.
    off = 1e-6 if chosen.usable else 1e-4
    require_equal("the places for the poses", here.translation, wanted.translation, off * span)
    require_equal("the angles for the poses", as_rows(here)[:, 2:], as_rows(wanted)[:, 2:], off)
    if chosen.usable:
        met = sorted(pose for _, pose in at)
        require_equal("the poses", met, np.arange(len(reference.places.angle)), 0)
    drive = numbers[:, 0]
    if head[0] == "drive_deg":
        turned = np.exp(1j * (np.radians(drive) - _driver_angle(reference, bodies)))
        require_equal("the drive", np.abs(turned - 1).max(), 0, off)
    else:
        slot = next(each.joint.slot for each in reference.tree if each.body == reference.driver)
        assert slot is not None
        require_equal("the drive", drive, slot.along(bodies), off * span)


def _driver_angle(reference: Reference, bodies: LinkPlaces) -> FloatArray:
    """The driver's angle (n,): from its pivot on the ground to its next joint, or of its slot."""
    driver = bodies[reference.driver]
    own = [
        (GROUND not in each.holes, each.holes[reference.driver])
        for each in reference.links.get(reference.driver, ())
    ]
    if not own:
        return driver.angle
    ends = [next(hole for moves, hole in own if moves is each) for each in (False, True)]
    arm = driver.rotate(ends[1] - ends[0])
    return np.asarray(np.arctan2(arm[..., 1], arm[..., 0]))


def _bodies(reference: Reference, places: Displacement, joints: FloatArray) -> LinkPlaces:
    """Where the bodies are by the columns of the joints (n, 2 j); without any, by the places."""
    if reference.found is None:
        return reference.own.bodies_at(places.angle, places)
    columns = np.moveaxis(joints.reshape(len(joints), -1, 2), 1, 0)
    at = dict(zip(_named(reference), columns, strict=True))
    there = reference.found.skeleton.places(reference.found.frames, at)
    return LinkPlaces(dict(zip(reference.links, there.values(), strict=True)))


def write_json(chosen: Candidate, path: Path, options: Options) -> None:
    """Write the linkage; raises E163."""
    data = _data(chosen, options)
    path.write_text(json.dumps(data, indent=2, allow_nan=False) + "\n", encoding="utf-8")


def check_json(chosen: Candidate, path: Path, options: Options) -> None:
    """Read the linkage back, compare all its numbers, and its places with its links."""
    data = json.loads(path.read_text(encoding="utf-8"))
    require_equal("the numbers", data == json.loads(json.dumps(_data(chosen, options))), True, 0)
    if isinstance(chosen, FoundLinkage) and "PP" in [each["kind"] for each in data["dyads"]]:
        return
    reference = Reference.of(chosen, options, None)
    rows = data["coupler" if "coupler" in data and "dyads" in data else "places"]
    numbers = [[each["x"], each["y"], math.radians(each["angle_deg"])] for each in rows]
    at = [list(each.values()) for each in data.get("joints", rows)]
    places = Displacement.from_poses(np.array(numbers))
    bodies = _bodies(reference, places, np.reshape(at, (len(rows), -1)))
    _require_linkage(reference, bodies, places)


def _require_linkage(reference: Reference, bodies: LinkPlaces, places: Displacement) -> None:
    """Raise E160 unless the bodies are joined, the one that is asked for at these places (n,)."""
    tolerance = PRECISION * reference.span
    require_equal("the links at the places", reference.closure_error(bodies), 0, tolerance)
    body = bodies[reference.body]
    require_equal("the body", body.translation, places.translation, 100 * tolerance)
    require_equal("its angles", as_rows(body)[:, 2:], as_rows(places)[:, 2:], 100 * PRECISION)


def _data(chosen: Candidate, options: Options) -> dict[str, Any]:
    if isinstance(chosen, FoundLinkage):
        return _dyads_data(chosen, options)
    return {
        "schema": JOINTS_SCHEMA,
        "length_unit": chosen.task.length_unit,
        **six_bar_data(chosen),
        "poses": poses_data(chosen.task.poses),
        "places": poses_data(chosen.body(chosen.drive)),
    }


def _dyads_data(chosen: FoundLinkage, options: Options) -> dict[str, Any]:
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
            {"id": name, **dimensions_data(dyad)}
            for name, dyad in zip(chosen.ids, (linkage.first, linkage.second), strict=True)
        ],
    }
    if (links := linkage.links) is not None:
        data["links"] = {name: float(length) for name, length in links._asdict().items()}
    data["poses"] = poses_data(poses_counted(chosen.error.places, chosen.task))
    data["coupler"] = poses_data(chosen.error.places)
    data["position_error"] = {"max": float(chosen.error.position.max())}
    data["angle_error_deg"] = {"max": math.degrees(float(chosen.error.angle.max()))}
    return data
