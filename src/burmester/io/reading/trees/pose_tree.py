"""A task in the tree of a JSON or TOML file: its poses, and the keys beside them.

At the top of a task other keys may stand (title, author, notes ...) and are not looked at, unless
they are known ones misspelt, belong elsewhere, or are tables of TOML.

A tolerance, of a pose or of all poses that state none, has numbers or "free":

    tolerance = { x = 0.1, y = "free", angle_deg = 0.5, axes = "body" }

`angle` is in the unit of the poses' angles.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from decimal import Decimal
from functools import partial
from typing import Any, Final

import numpy as np

from burmester.errors import InputError
from burmester.io.reading.pose_table import NUMERIC, POINTS, CrankOptions, PoseTable, Rows
from burmester.io.reading.specification import (
    LIMITS,
    REQUIREMENTS,
    Specification,
    StatedSurroundings,
)
from burmester.io.reading.stated_tolerances import FREE_WORDS, DefaultTolerance, StatedTolerances
from burmester.io.reading.trees.locations import Document, close_match
from burmester.io.reading.trees.node import (
    ABOVE_ZERO,
    NOT_NEGATIVE,
    NUMBER,
    PAIR,
    TEXT,
    Field,
    Fields,
    Node,
    Schema,
    any_case,
    table_schema,
    words,
)
from burmester.io.reading.trees.node import listed as listed_of
from burmester.tasks.option_table import TABLES, TOP_KEYS
from burmester.tasks.pose_tolerances import COMPONENTS
from burmester.tasks.traced_path import TracedPath
from burmester.wording import listed

ANGLE_KEYS: Final = {"angle": None, "angle_deg": "deg", "angle_rad": "rad"}


def _tolerance_bound(node: Node) -> float:
    """The nearest double of a number; infinite for "free"."""
    if isinstance(node.value, str):
        if node.value.strip().lower() in FREE_WORDS:
            return math.inf
        raise node.wrong("neither a number nor free")
    return node.number()


AXES: Final = ("fixed", "body")
# A number from 0, or a word; blanks and capital letters do not count.
_BOUND: Final = {"minimum": 0} | any_case(FREE_WORDS) | {"type": ["number", "string"]}
_TOLERANCE_FIELDS: Final[Fields] = {
    **{key: Field(_tolerance_bound, "", _BOUND) for key in ("x", "y", *ANGLE_KEYS)},
    "axes": Field(partial(Node.word, known=AXES), "", words(AXES)),
}


def _stated_tolerance(node: Node) -> dict[str, Any]:
    """The keys of a tolerance that are stated; raises E108 for an angle that is stated twice."""
    given = node.table(_TOLERANCE_FIELDS)
    twice = [key for key in ANGLE_KEYS if key in given]
    if len(twice) > 1:
        help = f"delete one of them, such as {twice[1]}"
        raise node.fault("E108", f"has {' and '.join(twice)}", help, key=twice[1])
    return given


TOLERANCE: Final = Field(
    _stated_tolerance,
    'a tolerance has x, y and angle_deg (or angle, angle_rad), each a number or "free", and axes, '
    '"fixed" or "body"',
    table_schema(_TOLERANCE_FIELDS),
)
FREE: Final = Field(
    lambda node: [each.word(COMPONENTS) for each in node.items()],
    'free is a list of some of "x", "y" and "angle"',
    listed_of(words(COMPONENTS)),
)


def bounds_of(given: dict[str, Any], unit: str | None) -> tuple[float, float, float]:
    """x, y and angle of a tolerance, the angle in `unit`; nan where nothing is stated."""
    angle = given.get("angle", math.nan)
    if "angle_deg" in given:
        angle = given["angle_deg"] if unit == "deg" else math.radians(given["angle_deg"])
    if "angle_rad" in given:
        angle = given["angle_rad"] if unit != "deg" else math.degrees(given["angle_rad"])
    return given.get("x", math.nan), given.get("y", math.nan), angle


def read_tolerance(node: Node, unit: str | None) -> DefaultTolerance:
    """The tolerance beside the poses; raises E103 to E108.  unit: of the poses' angles."""
    given = _stated_tolerance(node._replace(help=TOLERANCE.help))
    where = node.document.where(*node.path, key=True)
    return DefaultTolerance(bounds_of(given, unit), given.get("axes", "fixed"), unit, where)


Pose = dict[str, Any]  # what a pose states, numbers as printed

POINT_KEYS: Final = {"p": ("px", "py"), "q": ("qx", "qy")}
FAR: Final = 300  # digits before the point; a number of more may be no double
_NUMBER: Final = Field(Node.digits)
_COMMON: Final[Fields] = {
    "weight": Field(Node.digits, "", ABOVE_ZERO),
    "exact": Field(Node.flag, "write true or false"),
    "name": Field(Node.text, "write a text in quotes"),
    "tolerance": TOLERANCE,
    "free": FREE,
    "crank_deg": _NUMBER,
    "crank_rad": _NUMBER,
}
_POINT: Final = Field(lambda node: [each.digits() for each in node.items(2, 2)], "", PAIR)
_XY_ANGLE: Final[Fields] = dict.fromkeys(("x", "y", *ANGLE_KEYS), _NUMBER)
_POINTS: Final[Fields] = dict.fromkeys(POINTS, _NUMBER) | dict.fromkeys(POINT_KEYS, _POINT)
_ALSO = "weight, exact, name, tolerance and free"
_XY_ANGLE_HELP = f"a pose has x, y, angle_deg or angle_rad (or angle, with angle_unit), {_ALSO}"
_POINTS_HELP = f"a pose has px, py, qx and qy (or p and q with two numbers each), {_ALSO}"

# A pose in a list, or a table of one kind or the other.
_POSE: Final = table_schema(_COMMON | _XY_ANGLE | _POINTS) | {
    "type": ["array", "object"],
    "items": NUMBER,
    "minItems": 3,
    "maxItems": 3,
}
_UNDER_LIMITS, _UNDER_REQUIREMENTS = "write it under limits", "write it under requirements"
_MISPLACED: Final = {  # keys that may stand beside the poses by mistake: the help
    **dict.fromkeys(LIMITS, _UNDER_LIMITS),
    **dict.fromkeys(REQUIREMENTS, _UNDER_REQUIREMENTS),
    "limit": "write limits in its place",
    "requirement": "write requirements in its place",
    "exact": "write it into a pose",
    **dict.fromkeys(("weight", "weights"), "write each weight into its pose, as weight"),
    "names": "write each name into its pose, as name",
    **dict.fromkeys(
        ("angles", *_XY_ANGLE, *_POINTS), "write the numbers into the poses, one by one"
    ),
    **dict.fromkeys(("unit", "units"), "write angle_unit for angles, length_unit for lengths"),
    "free": 'write it into the poses, or tolerance = { angle = "free" } here',
    **dict.fromkeys(("tolerances", "tol"), "write tolerance"),
    **dict.fromkeys(("crank_deg", "crank_rad"), "write the crank angle of each pose into it"),
    "sigma": "write pose_sigma with position and angle_deg",
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
    whole = Node(document, (), tree, f"write {example}")
    if not isinstance(tree, dict):
        raise whole.fault("E104", f"does not fit: {whole.shown}")
    _require_known(whole)
    top = {key: whole.at(key) for key in TOP_KEYS if tree.get(key) is not None}

    def read(key: str, reader: Callable[[Node], Any], default: Any = None) -> Any:
        return reader(top[key]) if key in top else default

    specification = Specification()
    if "limits" in top or "requirements" in top:
        from burmester.io.reading.trees.specification_tree import read_limits, read_requirements

        specification = read("limits", read_limits, specification)._replace(
            requirements=read("requirements", read_requirements, ())
        )
    if "poses" not in top:
        raise whole.missing("poses")
    stated_unit = read("angle_unit", _angle_unit)
    rows, unit, crank_unit, where = _rows(top["poses"], stated_unit)
    length_unit = read("length_unit", Node.text) or None
    body, surroundings, drawn = None, StatedSurroundings(), document.source.notes
    if not {"body", "keep_out", "surroundings"}.isdisjoint(top):
        from burmester.io.reading.trees.surroundings_tree import read_body, read_surroundings

        body, notes = read("body", lambda node: read_body(node, length_unit), (None, ()))
        surroundings, others = read_surroundings(
            top.get("keep_out"), top.get("surroundings"), length_unit
        )
        drawn += notes + others

    loads, where_loads = None, ""
    loaded = [top.get(key) for key in ("loads", "springs", "drive")]
    if any(loaded):
        from burmester.io.reading.trees.loads_tree import read_loads

        loads = read_loads(*loaded)
        first = next(each for each in loaded if each)
        where_loads = document.where(*first.path, key=True)

    def locate_row(row: int | None) -> str:
        if row is None:
            return document.where("poses", key=True)
        return document.where("poses", row)

    return PoseTable(
        rows,
        length_unit=length_unit,
        angle_unit=unit,
        where=where,
        say_unit=whole.help,
        specification=specification,
        body=body,
        surroundings=surroundings,
        loads=loads,
        where_loads=where_loads,
        tolerance=read("tolerance", lambda node: read_tolerance(node, unit)),
        pose_sigma=read("pose_sigma", _pose_sigma),
        locate_row=locate_row,
        notes=drawn,
        path=read("path", _path),
        crank_unit=crank_unit,
        crank=read("crank", _crank, CrankOptions()),
    )


def _require_known(whole: Node) -> None:
    """Refuse what stands beside the poses and is misspelt, or belongs elsewhere."""
    for key, value in whole.value.items():
        if key in (*TOP_KEYS, *whole.document.others):
            continue
        inside = value if isinstance(value, list) else []
        message = "is not known"
        if key in _MISPLACED:
            message = "stands beside the poses, where it has no effect"
            help = f"{_MISPLACED[key]}, or delete it"
        elif near := close_match(key, TOP_KEYS):
            help = f"write {near} in its place"
        elif whole.document.language == "TOML" and dict in map(type, (value, *inside)):
            named, where = whole.document.named(key), whole.document.where(key, key=True)
            help = f"delete it; the tables of a task are {listed(TABLES)}"
            if near := close_match(key, TABLES, 0.5):
                help = f"write {near} if that is meant, or delete it; tables are {listed(TABLES)}"
            raise InputError("E107", f"the table {named} is not known", where=where, help=help)
        else:
            continue
        raise whole.at(key).fault("E107", message, help, key=True)


def _angle_unit(node: Node) -> str:
    if node.value not in ("deg", "rad"):
        message = f"is {node.shown}, not an angle unit"
        raise node.fault("E110", message, 'write "deg" or "rad"')
    return str(node.value)


_SIGMA_FIELDS: Final = dict.fromkeys(
    ("position", "angle_deg"), Field(Node.number, schema=NOT_NEGATIVE)
)


def _pose_sigma(node: Node) -> tuple[float, float]:
    """Standard deviations of positions and of angles, in radians; raises E103 to E107."""
    node = node._replace(help="give pose_sigma both, position and angle_deg, with 0 or more")
    given = node.table(_SIGMA_FIELDS)
    for key in ("position", "angle_deg"):
        if key not in given:
            raise node.missing(key)
        if given[key] < 0:
            raise node.at(key).fault("E104", "is below zero")
    return given["position"], math.radians(given["angle_deg"])


_PATH_FIELDS: Final[Fields] = {
    "closed": Field(Node.flag),
    "crank_deg": Field(
        lambda node: np.radians([each.number() for each in node.items()]), "", listed_of(NUMBER)
    ),
}
_CRANK_FIELDS: Final[Fields] = {
    "absolute": Field(Node.flag),
    "within_deg": Field(Node.number, schema=ABOVE_ZERO),
}


def _path(node: Node) -> TracedPath:
    """How points are traced; raises E186."""
    help = "write path = { closed = true }, or path = { crank_deg = [0, 20, 40, ...] } in TOML"
    given = _path_table(node._replace(help=help), _PATH_FIELDS)
    return node.build(TracedPath, given.get("closed", False), given.get("crank_deg"))


def _crank(node: Node) -> CrankOptions:
    """How the crank angles of poses are meant; raises E186."""
    help = "write crank = { absolute = true, within_deg = 0.5 }, or one of the two"
    node = node._replace(help=help)
    given = _path_table(node, _CRANK_FIELDS)
    within = given.get("within_deg")
    if within is not None and within <= 0:
        raise node.at("within_deg").fault("E186", "is no angle above zero")
    return CrankOptions(given.get("absolute", False), within and math.radians(within))


def _path_table(node: Node, fields: Fields) -> dict[str, Any]:
    try:
        return node.table(fields)
    except InputError as error:
        error.code = "E186"
        raise


# --- poses


def _rows(poses: Node, stated_unit: str | None) -> tuple[Rows, str | None, str | None, str]:
    """The rows, the units of their angles and of the crank's, and where the former is stated."""
    nodes = poses.items()
    tracked, unit = _tracked(nodes), None
    fields, help = (_POINTS, _POINTS_HELP) if tracked else (_XY_ANGLE, _XY_ANGLE_HELP)
    plain = (lambda value: None) if tracked else _plain
    read = partial(_pose, fields=_COMMON | fields)
    stated = [plain(node.value) or read(node._replace(help=help)) for node in nodes]
    columns: dict[str, list[str]]
    if tracked:
        columns, where = _points(nodes, stated), ""
    else:
        columns = {axis: [pose.get(axis, "nan") for pose in stated] for axis in ("x", "y")}
        columns["angle"], unit = _angles(nodes, stated, stated_unit)
        where = _where_unit(poses, stated, stated_unit)
    if any("weight" in pose for pose in stated):  # a pose without one counts once
        columns["weight"] = [pose.get("weight", "1") for pose in stated]
    if any("name" in pose for pose in stated):
        columns["name"] = [pose.get("name", "") for pose in stated]
    if any(pose.get("exact") for pose in stated):
        columns["exact"] = ["x" if pose.get("exact") else "" for pose in stated]
    crank, crank_unit = _crank_column(nodes, stated)
    rows = Rows.read(columns | crank)
    if tolerances := _tolerances(nodes, stated, unit):
        rows = rows._replace(tolerances=tolerances)
    return rows, unit, crank_unit, where


def _pose(node: Node, fields: Fields) -> Pose:
    """What a pose states, with x and y or as much as is not free; raises E103 to E107."""
    if isinstance(node.value, list):
        if (count := len(node.value)) != 3:
            help = "write [x, y, angle], with a point for the decimal mark of a number"
            why = "a comma separates the numbers and is no decimal mark" if count > 3 else None
            message = f"has {count} number{'s' * (count != 1)}, not 3"
            raise node.fault("E106", message, help, why=why)
        node = node._replace(value=dict(zip(NUMERIC, node.value, strict=False)))
    given = node.table(fields)
    for key in ("x", "y") if "x" in fields else ():
        if key not in given and key not in _free(given):
            if key in node.value:
                node.at(key).number()  # null is none
            help = f"write it into the pose; {node.help}. "
            help += f'A component that is free is named by free = ["{key}"]'
            raise node.missing(key, help)
    return given


def _plain(value: Any) -> Pose | None:
    """A pose of three finite numbers, as most of a long file are; or None."""
    if isinstance(value, list) and len(value) == len(NUMERIC[:3]):
        value = dict(zip(NUMERIC, value, strict=False))
    elif not (isinstance(value, dict) and "x" in value and "y" in value):
        return None
    for key, number in value.items():
        if key not in _XY_ANGLE or type(number) is not Decimal:
            return None
        if not (number.is_finite() and number.adjusted() < FAR):
            return None
    return {key: str(number) for key, number in value.items()}


def _free(pose: Pose) -> set[str]:
    """The components that `free` names, or whose tolerance says so."""
    bounds = zip(COMPONENTS, bounds_of(pose.get("tolerance", {}), None), strict=True)
    return {*pose.get("free", ()), *(each for each, bound in bounds if math.isinf(bound))}


def _tracked(nodes: Sequence[Node]) -> bool:
    """Whether the poses are two points each; raises E108 where some are and some are not."""
    first: tuple[bool, int] | None = None
    why = "a pose is given by x, y and an angle, or by two points p and q of the body"
    help = "give all poses in one way"
    for i, node in enumerate(nodes):
        keys = node.value if isinstance(node.value, dict) else ()
        of_points, of_angle = (not each.keys().isdisjoint(keys) for each in (_POINTS, _XY_ANGLE))
        message, at, key = "", node.path, False
        if of_points and of_angle:
            one, other = (next(k for k in each if k in keys) for each in (_POINTS, _XY_ANGLE))
            message, at, key = f"pose {i + 1} has {one} and {other}", (*node.path, other), True
        elif of_points or of_angle or (isinstance(node.value, list) and len(node.value) == 3):
            first = first or (of_points, i)
            if first[0] != of_points:
                forms = ("x, y and an angle", "two points")
                message = f"pose {first[1] + 1} is {forms[first[0]]}, pose {i + 1} is "
                message += forms[not first[0]]
        if message:
            where = node.document.where(*at, key=key)
            raise InputError("E108", message, where=where, why=why, help=help)
    return first is not None and first[0]


def _points(nodes: Sequence[Node], poses: Sequence[Pose]) -> dict[str, list[str]]:
    """The columns px, py, qx and qy; raises E105 and E108 where a point is not given once."""
    columns: dict[str, list[str]] = {role: [] for role in POINTS}
    for i, (node, pose) in enumerate(zip(nodes, poses, strict=True)):
        for point, roles in POINT_KEYS.items():
            given = [role for role in roles if role in pose]
            if point in pose and given:
                where = node.document.where(*node.path, given[0], key=True)
                message, help = f"pose {i + 1} has {point} and {given[0]}", f"delete {given[0]}"
                raise InputError("E108", message, where=where, help=f"{help}, or {point}")
            if point not in pose and len(given) < 2:
                lacking = next((role for role in roles if given and role not in given), point)
                help = f"give {roles[0]} and {roles[1]}, or {point} with two numbers in brackets"
                raise node.missing(lacking, help)
            pair = pose.get(point) or [pose[role] for role in roles]
            for role, value in zip(roles, pair, strict=True):
                columns[role].append(value)
    return columns


def _where_unit(poses: Node, stated: Sequence[Pose], unit: str | None) -> str:
    """Where the angles' unit is stated, or should be."""
    if unit:
        return poses.document.where("angle_unit")
    for key in ("angle_deg", "angle_rad"):
        if stated and key in stated[0]:
            return poses.document.where("poses", 0, key, key=True)
    return poses.document.where("poses", key=True)


def _angles(
    nodes: Sequence[Node], poses: Sequence[Pose], stated: str | None
) -> tuple[list[str], str | None]:
    """The angles, nan for free ones, and their unit, if every pose has one angle in one unit."""
    units = {stated} - {None}
    angles: list[str] = []
    for i, (node, pose) in enumerate(zip(nodes, poses, strict=True)):
        given = [key for key in ANGLE_KEYS if key in pose]
        if not given and "angle" in _free(pose):
            angles.append("nan")
            continue
        if len(given) != 1:
            message = f"pose {i + 1} has {' and '.join(given) or 'no angle'}"
            help = "give every pose one angle, as angle_deg or as angle_rad"
            if given:
                where = node.document.where(*node.path, given[1], key=True)
                raise InputError("E108", message, where=where, help=help)
            help += ', or free = ["angle"] where it does not count'
            raise InputError("E105", message, where=node.place, help=help)
        angles.append(pose[given[0]])
        units.add(ANGLE_KEYS[given[0]] or stated)
        if len(units) > 1:
            why = None
            if stated:
                why = f'angle_unit is "{stated}", pose {i + 1} has {given[0]}'
            elif i:
                why = f"pose {i + 1} has {given[0]}, the pose before has not"
            where = node.place
            if ANGLE_KEYS[given[0]]:
                where = node.document.where(*node.path, given[0], key=True)
            message = "the angles are stated in different units"
            help = "state one unit: angle_deg in every pose, or angle_rad in every pose"
            raise InputError("E110", message, where=where, why=why, help=help)
    return angles, next(iter(units), None)


def _tolerances(
    nodes: Sequence[Node], poses: Sequence[Pose], unit: str | None
) -> StatedTolerances | None:
    """What the poses state of their tolerances; None where no pose does.  Raises E136."""
    if not any("tolerance" in pose or "free" in pose for pose in poses):
        return None
    tolerances = [pose.get("tolerance", {}) for pose in poses]
    bounds = np.array([bounds_of(each, unit) for each in tolerances])
    for node, pose, row in zip(nodes, poses, bounds, strict=True):
        for name in pose.get("free", ()):
            if math.isfinite(bound := row[COMPONENTS.index(name)]):
                raise node.at("tolerance").located(
                    InputError(
                        "E136",
                        f"a tolerance of {bound:g} for {name}, which free names",
                        why="a component within a tolerance is not free",
                        help=f"take {name} out of free, or out of the tolerance",
                    )
                )
            row[COMPONENTS.index(name)] = math.inf
    return StatedTolerances(bounds, [each.get("axes", "") for each in tolerances], (True,) * 3)


def _crank_column(
    nodes: Sequence[Node], poses: Sequence[Pose]
) -> tuple[dict[str, list[str]], str | None]:
    """The column of crank angles and its unit; none where no pose has one.  Raises E108."""
    keys = [key for key in ("crank_deg", "crank_rad") if any(key in pose for pose in poses)]
    if not keys:
        return {}, None
    if len(keys) > 1:
        node = next(n for n, pose in zip(nodes, poses, strict=True) if "crank_rad" in pose)
        message = "the crank angles are stated in different units"
        help = "state one unit: crank_deg in every pose, or crank_rad in every pose"
        where = node.document.where(*node.path, "crank_rad", key=True)
        raise InputError("E108", message, where=where, help=help)
    column = [pose.get(keys[0], "nan") for pose in poses]
    return {"crank": column}, keys[0].removeprefix("crank_")


# What may stand at the keys of a task, but for those that other modules read.
POSE_SCHEMAS: Final[Mapping[str, Schema]] = {
    "poses": listed_of(_POSE)
    | {"description": f"Rows [x, y, angle]; or tables: {_XY_ANGLE_HELP}; or {_POINTS_HELP}."},
    "angle_unit": words(("deg", "rad")) | {"description": "The unit of the angles of poses."},
    "length_unit": TEXT
    | {"type": ["string", "null"], "description": "The unit of all lengths, such as mm."},
    "tolerance": table_schema(_TOLERANCE_FIELDS, description=TOLERANCE.help),
    "pose_sigma": table_schema(
        _SIGMA_FIELDS,
        required=[*_SIGMA_FIELDS],
        description="The standard deviations of the poses.",
    ),
    "path": table_schema(_PATH_FIELDS, description="The poses are points of a curve to trace."),
    "crank": table_schema(_CRANK_FIELDS, description="How crank angles of poses are meant."),
}
MISPLACED_KEYS: Final = tuple(_MISPLACED)
