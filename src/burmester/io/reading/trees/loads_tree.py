"""Loads in the tree of a task: the tables `loads`, `springs` and `drive`.

[loads]
body = { mass_kg = 4, center = [210, 9] }
hand = { at = [420, 0] }

[[springs]]
kind = "gas"
ground_point = [20, -150]
body_point = [100, 0]
force_N = 100
compressed_force_N = 130
stroke = 100
length = 245

[drive]
duration_s = 2
"""

from __future__ import annotations

import csv
import os
from collections.abc import Iterator
from functools import partial
from typing import Any, Final

from burmester.errors import InputError
from burmester.io.files import open_plain
from burmester.io.reading.outlines.outline_file import FROM_PAGE, folder_of
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
    one_or_more,
    table_schema,
    words,
)
from burmester.io.reading.trees.node import listed as listed_of
from burmester.tasks.load_table import DENSITIES, NEEDED, POSSIBLE, PROFILES, SIGNED
from burmester.tasks.loads import (
    BODY,
    GROUND,
    MOST_TIMES,
    ROOM_CELSIUS,
    Drive,
    End,
    Force,
    Loads,
    Mass,
    Plates,
    Spring,
    malformed,
)
from burmester.wording import listed

_LOADS_HELP = (
    "loads has gravity, body with mass_kg and center, links, force, torque_Nm, hand with at, and "
    "temperature_C; or some of them"
)
_LINKS_HELP = (
    'links has the mass of each link in kg, such as driver = 0.3; or plate = "steel 3", the '
    "material and the thickness, and width"
)
_SPRING_HELP = (
    f"a spring has kind, one of {listed([*NEEDED])}; ground_point and body_point, or from and to "
    "with link and point each; the numbers of its kind, and count"
)


MAX_BYTES = 1_000_000
HELP = "give the columns time_s, and pose (names or numbers) or driver_deg (degrees)"


def _gravity(node: Node) -> Any:
    if node.value in ("down", "none"):
        return node.value
    if isinstance(node.value, str):
        raise node.fault("E177", f"is {node.shown}")
    return node.pair()


_WHOLE: Final[Schema] = {"type": "integer", "minimum": 1}
_MASS: Final[Fields] = {
    "mass_kg": Field(Node.number, schema=NOT_NEGATIVE),
    "center": Field(Node.pair),
    "inertia_kgm2": Field(Node.number, schema=NOT_NEGATIVE),
}


def _mass(node: Node) -> Mass:
    given = node.table(_MASS)
    if "mass_kg" not in given:
        raise node.missing("mass_kg")
    return node.build(Mass, **given)


_PLATES: Final[Fields] = {
    "plate": Field(
        Node.text, "", {"type": "string", "pattern": f"^\\s*(?:{'|'.join(DENSITIES)}) "}
    ),
    "width": Field(Node.number, schema=ABOVE_ZERO),
}


def _links(node: Node) -> Any:
    node = node._replace(help=_LINKS_HELP)
    if not isinstance(node.value, dict) or "plate" not in node.value:
        names = node.value if isinstance(node.value, dict) else ()
        return node.table(dict.fromkeys(names, Field(Node.number)))
    given = node.table(_PLATES)
    material, _, thickness = given["plate"].partition(" ")
    thick = _float(thickness)
    if thick is None:
        known = listed([*DENSITIES])
        help = f'write the material and the thickness: {known}; such as plate = "steel 3"'
        raise node.at("plate").fault("E177", f"is {node.at('plate').shown}", help)
    if "width" not in given:
        raise node.missing("width")
    density = _float(material)  # in place of a name
    return node.build(Plates, material if density is None else density, thick, given["width"])


def _float(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def _force(node: Node) -> Force:
    given = node.table(_FORCE)
    for key in ("at", "force_N"):
        if key not in given:
            raise node.missing(key)
    return node.build(Force, force=given.pop("force_N"), **given)


def _whole(node: Node) -> int:
    value = node.number()
    if value != int(value) or value < 1:
        raise node.wrong("not a number of 1, 2, 3 and so on")
    return int(value)


def _hand(node: Node) -> list[float]:
    given = node.table(_HAND)
    if "at" not in given:
        raise node.missing("at")
    at: list[float] = given["at"]
    return at


_FORCE: Final[Fields] = {
    "at": Field(Node.pair),
    "force_N": Field(Node.pair),
    "frame": Field(Node.text, "", words(("F", "M"))),
    "from_pose": Field(_whole, "", _WHOLE),
    "to_pose": Field(_whole, "", _WHOLE),
}
_MASSES: Final[Schema] = {
    "type": "object",
    "properties": {"plate": False},
    "additionalProperties": NOT_NEGATIVE,
}
_HAND: Final[Fields] = {"at": Field(Node.pair)}
_FORCE_HELP = "a force has at and force_N with two numbers each; and frame, from_pose, to_pose"
_LOADS: Final[Fields] = {
    "gravity": Field(
        _gravity,
        'gravity is "down", "none", or two numbers in m/s²',
        {"anyOf": [words(("down", "none")), PAIR]},
    ),
    "body": Field(
        _mass,
        "body has mass_kg; and center, two numbers in M, and inertia_kgm2",
        table_schema(_MASS, required=["mass_kg"]),
    ),
    "links": Field(
        _links, _LINKS_HELP, {"anyOf": [table_schema(_PLATES, required=[*_PLATES]), _MASSES]}
    ),
    "force": Field(
        lambda node: tuple(map(_force, node.one_or_more())),
        _FORCE_HELP,
        one_or_more(table_schema(_FORCE, required=["at", "force_N"])),
    ),
    "torque_Nm": Field(Node.number),
    "hand": Field(
        _hand,
        "hand has at, the point of the body where it is: [x, y] in M",
        table_schema(_HAND, required=["at"]),
    ),
    "temperature_C": Field(Node.number, schema=NUMBER | {"minimum": -273}),
}
_NAMES = {"torque_Nm": "torque", "temperature_C": "celsius", "force": "forces"}


_END: Final[Fields] = {"link": Field(Node.text), "point": Field(Node.pair)}


def _end(node: Node) -> End:
    given = node.table(_END)
    x, y = given.get("point", (0.0, 0.0))
    return End(given.get("link", GROUND), (x, y))


def _end_of(link: str, node: Node) -> End:
    x, y = node.pair()
    return End(link, (x, y))


_END_HELP = 'an end has link, such as "driver", and point, [x, y] in the frame of the link'
_SPRING: Final[Fields] = {
    "kind": Field(Node.text, "", words(NEEDED)),
    "ground_point": Field(partial(_end_of, GROUND), "", PAIR),
    "body_point": Field(partial(_end_of, BODY), "", PAIR),
    "from": Field(_end, _END_HELP, table_schema(_END)),
    "to": Field(_end, _END_HELP, table_schema(_END)),
    "count": Field(_whole, "", _WHOLE | {"maximum": 1000}),
    **{
        name: Field(Node.number, schema=NUMBER if name in SIGNED else NOT_NEGATIVE)
        for names in (*NEEDED.values(), *POSSIBLE.values())
        for name in names
    },
}


def _spring(node: Node) -> Spring:
    given = node.table(_SPRING)
    if "kind" not in given:
        raise node.missing("kind")
    kind, ends = given.pop("kind"), []
    for key, other in (("ground_point", "from"), ("body_point", "to")):
        if key in given and other in given:
            raise node.fault("E108", f"has {key} and {other}", f"delete {other}", key=other)
        ends.append(given.pop(key, given.pop(other, None)))
    if kind in ("torsion", "counterweight") and ends[0] is None:
        ends[0] = End(GROUND, (0.0, 0.0))
    for end, key in zip(ends, ("ground_point", "body_point"), strict=True):
        if end is None:
            raise node.missing(key)
    return node.build(Spring, kind, tuple(ends), count=given.pop("count", 1), numbers=given)


def _times(node: Node) -> Any:
    """Rows of a time and a place, or of a CSV file that is named."""
    if isinstance(node.value, str):
        if node.document.source.label.startswith(FROM_PAGE):
            help = 'write the rows themselves, such as [[0, "closed"], [2, "open"]]'
            raise node.fault("E177", "names a file, and a page names none of this machine", help)
        folder = folder_of(node.document.source.label)
        return node.build(times_of_file, os.path.join(folder, node.text()))
    return [_row(each) for each in node.items(2, MOST_TIMES, "rows")]


def _row(node: Node) -> tuple[float, str | float]:
    time, place = node.items(2, 2, "values")
    return time.number(), place.text() if isinstance(place.value, str) else place.number()


_DRIVE_HELP = (
    'drive has duration_s, and profile: "constant", "3-4-5" or "trapezoid"; or times, such as '
    '[[0, "closed"], [2, "open"]], or a CSV file with time_s and pose or driver_deg'
)
_TIME_ROW: Final[Schema] = {
    "type": "array",
    "items": [NUMBER, {"type": ["string", "number"]}],
    "minItems": 2,
    "maxItems": 2,
}
_DRIVE: Final[Fields] = {
    "duration_s": Field(Node.number, schema=ABOVE_ZERO),
    "profile": Field(Node.text, "", words(PROFILES)),
    "times": Field(_times, "", {"anyOf": [TEXT, listed_of(_TIME_ROW, 2, MOST_TIMES)]}),
}
LOAD_SCHEMAS: Final[dict[str, Schema]] = {
    "loads": table_schema(_LOADS, description=_LOADS_HELP),
    "springs": one_or_more(table_schema(_SPRING)) | {"description": _SPRING_HELP},
    "drive": table_schema(
        _DRIVE,
        description="How the driver moves in time.",
        oneOf=[
            {"required": ["duration_s"], "properties": {"times": False}},
            {"required": ["times"], "properties": {"duration_s": False, "profile": False}},
        ],
    ),
}


def read_loads(loads: Node | None, springs: Node | None, drive: Node | None) -> Loads:
    """The loads in these tables of a task; raises E103 to E107, E108 and E177."""
    given: dict[str, Any] = {}
    if loads is not None:
        given = loads._replace(help=_LOADS_HELP).table(_LOADS)
    if springs is not None:
        of_springs = springs._replace(help=_SPRING_HELP).one_or_more()
        given["springs"] = tuple(map(_spring, of_springs))
    if drive is not None:
        node = drive._replace(help=_DRIVE_HELP)
        stated = node.table(_DRIVE)
        for key in ("duration_s", "profile"):
            if "times" in stated and key in stated:
                raise node.fault("E108", f"has times and {key}", f"delete {key}", key=key)
        if "times" in stated:
            given["drive"] = node.build(Drive.through, stated["times"])
        elif "duration_s" not in stated:
            raise node.missing("duration_s")
        else:
            given["drive"] = node.build(Drive, **stated)
    if where := dict(_named(loads, springs)):
        given["where"] = where
    place = next(each for each in (loads, springs, drive) if each is not None)
    return place.build(Loads, **{_NAMES.get(key, key): value for key, value in given.items()})


def _named(loads: Node | None, springs: Node | None) -> Iterator[tuple[str, str]]:
    """The names of links in tables that have been read, each with its place."""
    if springs is not None:
        for spring in springs.one_or_more():
            for key in ("from", "to"):
                if spring.value.get(key) is not None and "link" in spring.value[key]:
                    link = spring.at(key).at("link")
                    yield link.text(), link.place
    if loads is not None and isinstance(links := loads.value.get("links"), dict):
        for name in links:
            yield name, loads.document.where(*loads.path, "links", name, key=True)


def loads_data(loads: Loads) -> dict[str, Any]:
    """Loads as a file may hold them: the keys `loads`, `springs` and `drive`."""
    data: dict[str, Any] = {"gravity": loads.gravity.tolist()}
    if (body := loads.body) is not None:
        data["body"] = {"mass_kg": body.mass_kg}
        if body.center is not None:
            data["body"]["center"] = body.center.tolist()
        if body.inertia_kgm2 is not None:
            data["body"]["inertia_kgm2"] = body.inertia_kgm2
    if isinstance(loads.links, Plates):
        plate = f"{loads.links.material} {loads.links.thickness!r}"
        data["links"] = {"plate": plate, "width": loads.links.width}
    elif loads.links:
        data["links"] = dict(loads.links)
    if loads.forces:
        data["force"] = [_force_data(each) for each in loads.forces]
    if loads.torque:
        data["torque_Nm"] = loads.torque
    if loads.hand is not None:
        data["hand"] = {"at": loads.hand.tolist()}
    if loads.celsius != ROOM_CELSIUS:
        data["temperature_C"] = loads.celsius
    out: dict[str, Any] = {"loads": data}
    if loads.springs:
        out["springs"] = [_spring_data(each) for each in loads.springs]
    if (drive := loads.drive) is not None:
        out["drive"] = {"duration_s": drive.duration_s, "profile": drive.profile}
        if drive.times:
            out["drive"] = {"times": [list(row) for row in drive.times]}
    return out


def _force_data(force: Force) -> dict[str, Any]:
    data: dict[str, Any] = {"at": force.at.tolist(), "force_N": force.force.tolist()}
    if force.frame != "F":
        data["frame"] = force.frame
    for key in ("from_pose", "to_pose"):
        if (pose := getattr(force, key)) is not None:
            data[key] = pose
    return data


def _spring_data(spring: Spring) -> dict[str, Any]:
    one, two = spring.ends
    data: dict[str, Any] = {"kind": spring.kind}
    if (one.link, two.link) == (GROUND, BODY):
        data |= {"ground_point": list(one.point), "body_point": list(two.point)}
    else:
        ends = {"from": one, "to": two}
        data |= {key: {"link": end.link, "point": list(end.point)} for key, end in ends.items()}
    return data | dict(spring.numbers) | {"count": spring.count}


def times_of_file(path: str) -> list[tuple[float, str | float]]:
    """The rows of a CSV file for `Drive.through`; raises E101 and E177."""
    try:
        with open_plain(path, "rb") as data:
            text = data.read(MAX_BYTES).decode("utf-8-sig")
        head, *rows = [row for row in csv.reader(text.splitlines()) if any(row)] or [[]]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        why = getattr(error, "strerror", None) or str(error)
        raise InputError("E101", f"{path} cannot be read", why=why, help=HELP) from None
    names = [each.strip() for each in head]
    place = next((each for each in ("pose", "driver_deg") if each in names), None)
    if "time_s" not in names or place is None:
        raise malformed(f"{path} is no table of times", f"its columns are {names}", HELP)
    at = names.index("time_s"), names.index(place)
    out = list[tuple[float, str | float]]()
    for number, row in enumerate(rows, start=2):
        try:
            time, there = (row[k].strip() for k in at)
            out.append((float(time), there if place == "pose" else float(there)))
        except (ValueError, IndexError):
            message = f"{path}, row {number}: {','.join(row)!r} is no time with its {place}"
            raise malformed(message, help=HELP) from None
    return out
