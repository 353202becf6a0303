"""Poses in the tree of a JSON or TOML file, and the keys beside them.

At the top of a task other keys may stand (title, author, notes ...) and are not looked at, unless
they are known ones misspelt, belong elsewhere, or are tables of TOML.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from decimal import Decimal
from typing import Any

import numpy as np

from burmester.errors import InputError
from burmester.io.reading.pose_table import POINTS, CrankOptions, PoseTable, Rows
from burmester.io.reading.specification import LIMIT_KEYS, TABLES, TOP_KEYS, Specification
from burmester.io.reading.stated_requirements import REQUIREMENT_KEYS
from burmester.io.reading.stated_surroundings import StatedSurroundings
from burmester.io.reading.stated_tolerances import TOLERANCE_ROLES, DefaultTolerance
from burmester.io.reading.trees.locations import Document, close_match
from burmester.io.reading.trees.path_tree import read_crank, read_path
from burmester.io.reading.trees.plain_poses import POINT_KEYS, XY_ANGLE_KEYS, plain_poses
from burmester.tasks.pose_tolerances import COMPONENTS
from burmester.wording import listed

__all__ = ["read_tree"]

_ANGLE_KEYS = {"angle": None, "angle_deg": "deg", "angle_rad": "rad"}
_TRACKED_KEYS = frozenset({*POINT_KEYS, *POINTS})

_MISPLACED = {  # keys that may stand beside the poses by mistake: the help
    **dict.fromkeys(("weight", "weights"), "write each weight into its pose, as weight"),
    **dict.fromkeys(("names",), "write each name into its pose, as name"),
    **dict.fromkeys(
        ("x", "y", "angle", "angles", "angle_deg", "angle_rad", *POINT_KEYS, *POINTS),
        "write the numbers into the poses, one by one",
    ),
    **dict.fromkeys(("unit", "units"), "write angle_unit for angles, length_unit for lengths"),
    **dict.fromkeys(("free",), 'write it into the poses, or tolerance = { angle = "free" } here'),
    **dict.fromkeys(("tolerances", "tol"), "write tolerance"),
    **dict.fromkeys(("crank_deg", "crank_rad"), "write the crank angle of each pose into it"),
    **dict.fromkeys(("sigma",), "write pose_sigma with position and angle_deg"),
    **dict.fromkeys(
        ("link_width", "margin", "body_in_plane"), "write it into the table surroundings"
    ),
}


def read_tree(tree: Any, document: Document, example: str) -> PoseTable:
    """The table in a parsed tree, whose numbers are Decimal (or int, in TOML).

    example: a sound file in few words.  Raises E103 to E110, and what limits and requirements do.
    """
    if isinstance(tree, list):
        tree, document = {"poses": tree}, document._replace(bare=True)
    elif isinstance(tree, dict) and "poses" not in tree and isinstance(tree.get("task"), dict):
        tree, document = tree["task"], document._replace(root=("task",))
    specification = _specification(tree, document) if isinstance(tree, dict) else Specification()
    tracked = _tracked(document, tree)
    whole, poses = plain_poses(tree) or _validated(document, tree, example, tracked)
    unit: str | None = None
    if tracked:
        columns, where = _points(document, poses), ""
    else:
        angles, unit = _angles(document, whole, poses)
        columns = {axis: [_written(getattr(pose, axis)) for pose in poses] for axis in ("x", "y")}
        columns["angle"] = [_written(angle) for angle in angles]
        where = _where_unit(document, whole, poses)
    if any(pose.weight is not None for pose in poses):  # a pose without one counts once
        columns["weight"] = ["1" if pose.weight is None else str(pose.weight) for pose in poses]
    numeric = list(columns)
    if any(pose.name is not None for pose in poses):
        columns["name"] = [pose.name or "" for pose in poses]
    if any(pose.exact for pose in poses):
        columns["exact"] = ["x" if pose.exact else "" for pose in poses]
    columns |= _tolerances(document, poses, unit)
    crank, crank_unit = _crank(document, poses)
    columns |= crank
    rows = Rows.read(columns)
    for i, j in np.argwhere(~np.isfinite(rows.values)):  # 1e400 is a finite Decimal
        if columns[numeric[j]][i] == "nan":  # it is free
            continue
        number = columns[numeric[j]][i]
        from burmester.io.reading.trees.pose_model import pose_fault

        fault = {"type": "finite_number", "loc": ("poses", int(i), numeric[j]), "input": number}
        raise pose_fault(document, tree, example, tracked, fault)

    def locate_row(row: int | None) -> str:
        if row is None:
            return document.where("poses", key=True)
        return document.where("poses", row)

    given = whole.pose_sigma
    body, surroundings, drawn = None, StatedSurroundings(), document.source.notes
    length_unit = whole.length_unit or None
    if tree.get("body") is not None:
        from burmester.io.reading.trees.body_tree import read_body

        body, notes = read_body(tree, document, length_unit)
        drawn += notes
    if not {"keep_out", "surroundings"}.isdisjoint(tree):
        from burmester.io.reading.trees.surroundings_tree import read_surroundings

        surroundings, notes = read_surroundings(tree, document, length_unit)
        drawn += notes
    return PoseTable(
        rows,
        length_unit=length_unit,
        angle_unit=unit,
        where=where,
        say_unit=f"write {example}",
        specification=specification,
        body=body,
        surroundings=surroundings,
        tolerance=_default_tolerance(tree, document, unit),
        pose_sigma=given and (given.position, math.radians(given.angle_deg)),
        locate_row=locate_row,
        notes=drawn,
        path=read_path(tree, document) if tree.get("path") is not None else None,
        crank_unit=crank_unit,
        crank=read_crank(tree, document) if tree.get("crank") is not None else CrankOptions(),
    )


def _validated(
    document: Document, tree: Any, example: str, tracked: bool
) -> tuple[Any, Sequence[Any]]:
    """What stands beside the poses, and the poses, whatever they state; raises E103 to E110."""
    from burmester.io.reading.trees.pose_model import validated

    return validated(document, tree, example, tracked)


def _written(number: Decimal | None) -> str:
    """A number as text; nan for a component that is free and has none."""
    return "nan" if number is None else str(number)


def _tolerances(document: Document, poses: Sequence[Any], unit: str | None) -> dict[str, list[str]]:
    """The columns of what the poses state of their tolerances; none where no pose does."""
    if all(pose.tolerance is None and pose.free is None for pose in poses):
        return {}
    columns: dict[str, list[str]] = {"free": [], "tol_axes": []}
    for i, pose in enumerate(poses):
        free, path = pose.free_components(), ("poses", i, "tolerance")
        columns["free"].append(" ".join(free))
        columns["tol_axes"].append((pose.tolerance and pose.tolerance.axes) or "")
        bounds = (math.nan,) * 3
        if pose.tolerance is not None:
            pose.tolerance.require_one_angle(document, *path)
            bounds = pose.tolerance.bounds(unit)
        for component, role, bound in zip(COMPONENTS, TOLERANCE_ROLES, bounds, strict=True):
            if component in (pose.free or ()) and math.isfinite(bound):
                raise InputError(
                    "E136",
                    f"{document.named(*path)}: a tolerance of {bound:g} for {component}, which "
                    "free names",
                    where=document.where(*path),
                    why="a component within a tolerance is not free",
                    help=f"take {component} out of free, or out of the tolerance",
                )
            columns.setdefault(role, []).append(repr(bound))
    return columns


def _crank(document: Document, poses: Sequence[Any]) -> tuple[dict[str, list[str]], str | None]:
    """The column of crank angles and its unit; none where no pose has one.  Raises E108."""
    keys = [
        key for key in ("crank_deg", "crank_rad") if any(getattr(p, key) is not None for p in poses)
    ]
    if not keys:
        return {}, None
    if len(keys) > 1:
        pose = next(k for k, each in enumerate(poses) if each.crank_rad is not None)
        raise InputError(
            "E108",
            "the crank angles are stated in different units",
            where=document.where("poses", pose, "crank_rad", key=True),
            help="state one unit: crank_deg in every pose, or crank_rad in every pose",
        )
    unit = keys[0].removeprefix("crank_")
    return {"crank": [_written(getattr(pose, keys[0])) for pose in poses]}, unit


def _default_tolerance(tree: Any, document: Document, unit: str | None) -> DefaultTolerance | None:
    """The tolerance of all poses that state none."""
    if not isinstance(tree, dict) or "tolerance" not in tree:
        return None
    from burmester.io.reading.trees.tolerance_model import read_tolerance

    return read_tolerance(tree, document, unit)


def _specification(tree: dict[str, Any], document: Document) -> Specification:
    """The limits and requirements beside the poses."""
    _require_known(document, tree)
    specification = Specification()
    if not tree.keys().isdisjoint(LIMIT_KEYS):
        from burmester.io.reading.trees.limits_tree import read_limits

        specification = read_limits(tree, document)
    if not tree.keys().isdisjoint(REQUIREMENT_KEYS):
        from burmester.io.reading.trees.requirements_tree import read_requirements

        specification = specification._replace(requirements=read_requirements(tree, document))
    return specification


def _require_known(document: Document, tree: dict[str, Any]) -> None:
    """Refuse what stands beside the poses and is misspelt, or belongs elsewhere."""
    for key, value in tree.items():
        if key in (*TOP_KEYS, *LIMIT_KEYS, *REQUIREMENT_KEYS, *document.others):
            continue
        if key in _MISPLACED:
            message = f"{document.named(key)} stands beside the poses, where it has no effect"
            help = f"{_MISPLACED[key]}, or delete it"
        elif near := close_match(key, TOP_KEYS):
            message, help = f"{document.named(key)} is not known", f"write {near} in its place"
        elif document.language == "TOML" and dict in (type(value), *map(type, _items(value))):
            message = f"the table {document.named(key)} is not known"
            near = close_match(key, TABLES, 0.5)
            help = f"write {near} if that is meant, or delete it; tables are {listed(TABLES)}"
            help = help if near else f"delete it; the tables of a task are {listed(TABLES)}"
        else:
            continue
        raise InputError("E107", message, where=document.where(key, key=True), help=help)


def _items(value: Any) -> list[Any]:
    return value if isinstance(value, list) else []


def _tracked(document: Document, tree: Any) -> bool:
    """Whether the poses are two points each; raises E108 where some are and some are not."""
    poses = tree.get("poses") if isinstance(tree, dict) else None
    form: tuple[str, int] | None = None
    for i, pose in enumerate(poses if isinstance(poses, list) else ()):
        if isinstance(pose, dict):
            points, xy_angle = (
                not _TRACKED_KEYS.isdisjoint(pose),
                not XY_ANGLE_KEYS.isdisjoint(pose),
            )
            if points and xy_angle:
                of_points, of_angle = (
                    min(keys & pose.keys()) for keys in (_TRACKED_KEYS, XY_ANGLE_KEYS)
                )
                message = f"pose {i + 1} has {of_points} and {of_angle}"
                raise _two_forms(document, message, i, of_angle)
            given = "points" if points else "angle" if xy_angle else ""
        else:
            given = "angle" if isinstance(pose, list) and len(pose) == 3 else ""
        if given and form and form[0] != given:
            first, last = ("two points", "x, y and an angle")[:: 1 if given == "angle" else -1]
            message = f"pose {form[1] + 1} is {first}, pose {i + 1} is {last}"
            raise _two_forms(document, message, i)
        form = form or ((given, i) if given else None)
    return form is not None and form[0] == "points"


def _two_forms(document: Document, message: str, pose: int, key: str | None = None) -> InputError:
    path: tuple[str | int, ...] = ("poses", pose, *([key] if key else []))
    where = document.where(*path, key=key is not None)
    why = "a pose is given by x, y and an angle, or by two points p and q of the body"
    return InputError("E108", message, where=where, why=why, help="give all poses in one way")


def _points(document: Document, poses: Sequence[Any]) -> dict[str, list[str]]:
    """The columns px, py, qx and qy; raises E105 and E108 where a point is not given once."""
    columns: dict[str, list[str]] = {role: [] for role in POINTS}
    for i, pose in enumerate(poses):
        for point, roles in POINT_KEYS.items():
            pair = getattr(pose, point)
            single = {role: getattr(pose, role) for role in roles}
            given = [role for role, value in single.items() if value is not None]
            if pair is not None and given:
                message = f"pose {i + 1} has {point} and {given[0]}"
                where = document.where("poses", i, given[0], key=True)
                raise InputError(
                    "E108", message, where=where, help=f"delete {given[0]}, or {point}"
                )
            if pair is None and len(given) < 2:
                lacking = next((role for role in roles if given and role not in given), point)
                message = f"{document.named('poses', i, lacking)} is missing"
                x, y = roles
                help = f"give {x} and {y}, or {point} with two numbers in brackets"
                where = document.where("poses", i)
                raise InputError("E105", message, where=where, help=help)
            for role, value in zip(roles, pair or single.values(), strict=True):
                columns[role].append(str(value))
    return columns


def _where_unit(document: Document, whole: Any, poses: Sequence[Any]) -> str:
    """Where the angles' unit is stated, or should be."""
    if whole.angle_unit:
        return document.where("angle_unit")
    for key in ("angle_deg", "angle_rad"):
        if poses and getattr(poses[0], key) is not None:
            return document.where("poses", 0, key, key=True)
    return document.where("poses", key=True)


def _angles(
    document: Document, whole: Any, poses: Sequence[Any]
) -> tuple[list[Decimal | None], str | None]:
    """The angles and their unit, if every pose has one angle and all are in one unit.

    None for an angle that is free.
    """
    units = {whole.angle_unit} - {None}
    angles: list[Decimal | None] = []
    for i, pose in enumerate(poses):
        given = [key for key in _ANGLE_KEYS if getattr(pose, key) is not None]
        if not given and "angle" in pose.free_components():
            angles.append(None)
            continue
        if len(given) != 1:
            code = "E108" if given else "E105"
            message = f"pose {i + 1} has {' and '.join(given) or 'no angle'}"
            help = "give every pose one angle, as angle_deg or as angle_rad"
            if not given:
                help += ', or free = ["angle"] where it does not count'
            where = document.where("poses", i)
            if given:
                where = document.where("poses", i, given[1], key=True)
            raise InputError(code, message, where=where, help=help)
        angles.append(getattr(pose, given[0]))
        units.add(_ANGLE_KEYS[given[0]] or whole.angle_unit)
        if len(units) > 1:
            message = "the angles are stated in different units"
            why = None
            if whole.angle_unit:
                why = f'angle_unit is "{whole.angle_unit}", pose {i + 1} has {given[0]}'
            elif i:
                why = f"pose {i + 1} has {given[0]}, the pose before has not"
            help = "state one unit: angle_deg in every pose, or angle_rad in every pose"
            keyed = {"key": True} if isinstance(_ANGLE_KEYS[given[0]], str) else {}
            where = document.where("poses", i, *([given[0]] if keyed else []), **keyed)
            raise InputError("E110", message, where=where, why=why, help=help)
    return angles, next(iter(units), None)
