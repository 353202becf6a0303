"""CSV of a six-bar's motion, and JSON of the six-bar, each read back.

They are checked by the bars alone: every row keeps the distances between joints of one link, and
the body where its two joints are.

E160 the file does not contain the six-bar
"""

from __future__ import annotations

import csv
import json
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from burmester.export.numbers import number
from burmester.export.options import Options
from burmester.export.reference import require_equal
from burmester.geometry.displacement import Displacement
from burmester.io.linkage_data import six_bar_data
from burmester.io.pose_data import poses_data
from burmester.numerics.arrays import FloatArray

if TYPE_CHECKING:
    from burmester.sixbar.found import FoundSixBar

__all__ = ["check_csv", "check_json", "write_csv", "write_json"]

SCHEMA: Final = "burmester.six-bar/1"
MOTION_ROWS: Final = 361  # along the motion, beside those of the poses
CLOSE: Final = 1e-9  # of the greatest length; a table keeps bars and poses this well


def write_csv(chosen: FoundSixBar, path: Path, options: Options) -> None:
    """A row for each step over the range of the poses, and one for each pose."""
    found = chosen
    marked = [(value, 0) for value in found.along(MOTION_ROWS).tolist()]
    marked = [each for each in marked if np.abs(found.drive - each[0]).min() > 1e-9]
    marked += [(value, k + 1) for k, value in enumerate(found.drive.tolist())]
    backwards = bool(found.drive[-1] < found.drive[0])
    marked.sort(key=lambda each: each[0], reverse=backwards)
    drives = np.array([value for value, _ in marked])
    joints, places = found.joints(drives), poses_data(found.body(drives))
    with open(path, "w", encoding="utf-8", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(
            ["drive_deg", "x", "y", "angle_deg"]
            + [f"{name}_{axis}" for name in joints for axis in "xy"]
            + ["pose"]
        )
        for k, (value, pose) in enumerate(marked):
            at = [float(each) for own in joints.values() for each in own[k]]
            row = [math.degrees(value), *places[k].values(), *at]
            table.writerow([*map(number, row), pose or ""])


def check_csv(chosen: FoundSixBar, path: Path, options: Options) -> None:
    """Bars, body and driver of each row, and the poses."""
    with open(path, encoding="utf-8", newline="") as file:
        _, *rows = list(csv.reader(file))
    numbers = np.array([[float(cell) for cell in row[:-1]] for row in rows])
    joints = chosen.skeleton.joints
    places = np.moveaxis(numbers[:, 4:].reshape(-1, len(joints), 2), 1, 0)
    at = dict(zip(joints, places, strict=True))
    body = Displacement(numbers[:, 1:3], np.radians(numbers[:, 3]))
    _require_linkage(chosen, at, body, np.radians(numbers[:, 0]))
    poses = sorted((int(row[-1]) - 1, k) for k, row in enumerate(rows) if row[-1])
    require_equal("the poses", [pose for pose, _ in poses], np.arange(len(chosen.drive)), 0)
    _require_places(chosen, body[[k for _, k in poses]])


def write_json(chosen: FoundSixBar, path: Path, options: Options) -> None:
    """The six-bar as a result holds it, with the poses of its task and its own places there."""
    data: dict[str, Any] = {"schema": SCHEMA, "length_unit": chosen.task.length_unit}
    data |= six_bar_data(chosen)
    data["poses"] = poses_data(chosen.task.poses)
    data["places"] = poses_data(chosen.body(chosen.drive))
    path.write_text(json.dumps(data, indent=2, allow_nan=False) + "\n", encoding="utf-8")


def check_json(chosen: FoundSixBar, path: Path, options: Options) -> None:
    """Joints, drives and poses."""
    data = json.loads(path.read_text(encoding="utf-8"))
    names = chosen.skeleton.joints
    at = {name: np.array([each[name] for each in data["joints"]]) for name in names}
    poses, places = (_read_poses(data[name]) for name in ("poses", "places"))
    _require_linkage(chosen, at, places, np.radians(data["drive_deg"]))
    _require_places(chosen, places)
    _require_same(chosen, "the poses", poses, chosen.task.poses)
    wanted = chosen.lengths
    lengths = [data["lengths"][bar] for bar in wanted]
    require_equal("the lengths", lengths, [*wanted.values()], CLOSE * _size(chosen))


def _require_linkage(
    chosen: FoundSixBar, at: dict[str, FloatArray], body: Displacement, drives: FloatArray
) -> None:
    """Compare rows of joints, of the body and of the driver with the linkage's dimensions."""
    found, off = chosen, CLOSE * _size(chosen)
    skeleton, frames = found.skeleton, found.frames
    for bar, length in found.lengths.items():
        apart = np.linalg.norm(at[bar[1]] - at[bar[0]], axis=-1)
        require_equal(f"the length of {bar}", apart, np.full(len(apart), length), off)
    for name, own in frames[skeleton.ground].items():
        wanted = np.broadcast_to(own, at[name].shape)
        require_equal(f"joint {name}", at[name], wanted, 100 * off)
    for name, own in frames[found.carries].items():
        require_equal(f"joint {name}", at[name], body.act(own), 100 * off)
    pivot, end = tuple(skeleton.arm(found.driver_pivot))
    arm = (at[end] - at[pivot]) @ np.array([1, 1j])
    turned = np.abs(arm / np.abs(arm) - np.exp(1j * drives)).max()
    require_equal("the driver", turned, 0, 1e-8)


def _read_poses(rows: list[dict[str, float]]) -> Displacement:
    numbers = [[each["x"], each["y"], math.radians(each["angle_deg"])] for each in rows]
    return Displacement.from_poses(np.array(numbers))


def _require_places(chosen: FoundSixBar, places: Displacement) -> None:
    """Compare where the body is with where it was found: at the poses, where it meets them."""
    _require_same(chosen, "the places", places, chosen.error.places)


def _require_same(chosen: FoundSixBar, what: str, got: Displacement, wanted: Displacement) -> None:
    require_equal(what, got.translation, wanted.translation, 1e-6 * _size(chosen))
    turned = np.abs(np.exp(1j * got.angle) - np.exp(1j * wanted.angle)).max()
    require_equal(f"the angles of {what}", turned, 0, 1e-6)


def _size(chosen: FoundSixBar) -> float:
    return max(chosen.lengths.values())
