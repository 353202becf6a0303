"""Poses of plain numbers in a JSON or TOML file, without pydantic, which takes long to load.

Whatever else stands there goes to `pose_model`, which knows every key and every fault.
"""

from __future__ import annotations

from decimal import Decimal
from typing import Any, NamedTuple

from burmester.io.reading.pose_table import NUMERIC

__all__ = ["POINT_KEYS", "XY_ANGLE_KEYS", "plain_poses"]

POINT_KEYS = {"p": ("px", "py"), "q": ("qx", "qy")}
XY_ANGLE_KEYS = frozenset({"x", "y", "angle", "angle_deg", "angle_rad"})

_ANGLES = frozenset({"angle", "angle_deg", "angle_rad"})
_PLAIN_KEYS = frozenset({*XY_ANGLE_KEYS, "weight", "name", "exact"})


class _Pose(NamedTuple):
    """What a pose of `pose_model` states, where all of it is plain."""

    x: Decimal
    y: Decimal
    angle: Decimal | None = None
    angle_deg: Decimal | None = None
    angle_rad: Decimal | None = None
    weight: Decimal | None = None
    name: str | None = None
    exact: bool | None = None
    tolerance: None = None
    free: None = None
    crank_deg: None = None
    crank_rad: None = None


class _Whole(NamedTuple):
    """What stands beside the poses."""

    angle_unit: str | None
    length_unit: str | None
    pose_sigma: None = None


def plain_poses(tree: Any) -> tuple[_Whole, list[_Pose]] | None:
    """The values beside the poses, and the poses; None where one of them is not plain.

    Plain are three finite numbers, in a list or by their keys with one key for the angle, and
    beside them a weight, a name in ASCII and whether the pose is exact.
    """
    given = tree.get("poses") if isinstance(tree, dict) else None
    if not isinstance(given, list) or tree.get("pose_sigma") is not None:
        return None
    unit, length = tree.get("angle_unit"), tree.get("length_unit")
    if unit not in (None, "deg", "rad") or not (length is None or _is_plain_text(length)):
        return None
    poses = []
    for each in given:
        if (pose := _plain_pose(each)) is None:
            return None
        poses.append(pose)
    return _Whole(unit, length and length.strip()), poses


def _plain_pose(given: Any) -> _Pose | None:
    if isinstance(given, list) and len(given) == 3:
        given = dict(zip(NUMERIC, given, strict=False))
    if not isinstance(given, dict) or not given.keys() <= _PLAIN_KEYS:
        return None
    if not {"x", "y"} <= given.keys() or len(_ANGLES & given.keys()) != 1:
        return None
    stated: dict[str, Any] = {}
    for key, value in given.items():
        if key == "name":
            plain, value = _is_plain_text(value), str(value).strip()  # noqa: PLW2901
        elif key == "exact":
            plain = isinstance(value, bool)
        else:  # JSON has Decimal here, and TOML int as well
            plain = type(value) is int or (isinstance(value, Decimal) and value.is_finite())
            value = Decimal(value) if plain else value  # noqa: PLW2901
        if not plain:
            return None
        stated[key] = value
    return _Pose(**stated)


def _is_plain_text(value: Any) -> bool:
    return isinstance(value, str) and value.isascii()
