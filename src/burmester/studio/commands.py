"""What the page shows, as commands that do the same, and names of its files."""

from __future__ import annotations

import re
from typing import Any, Final

from burmester.tasks.option_table import STUDIO_OPTIONS

MOST_LETTERS: Final = 60  # of the name of a file

# Options of `burmester export` by their names in the page.
SETTINGS = {
    **{each: f"--{each}" for each in ("unit", "hole", "pin", "width", "thickness", "gap", "pose")},
    **{each: f"--{each}" for each in ("density", "up", "seconds")},
    "frames_per_second": "--fps",
    "width_px": "--pixels",
}
AXES = ("x", "y", "z", "-x", "-y", "-z")


def commands(given: dict[str, Any]) -> list[dict[str, str]]:
    """The commands for a task, by "name", "options", "linkage", "settings" of exports, and "dyads"
    where some are placed.

    They are for a shell, in the folder into which task and result were saved.
    """
    name = plain_name(given.get("name"))
    asked = given.get("options")
    how = "".join(_option(key, asked) for key in STUDIO_OPTIONS)
    best, chosen = given.get("linkage"), ""
    if isinstance(best, str) and best[:1] in ("L", "S") and best[1:].isdecimal():
        chosen = f" --linkage {best}"
    if six_bars := chosen.startswith(" --linkage S"):
        how = " --six-bars"
    dyads = _dyads(given.get("dyads"))
    made = f"{name}-by-hand" if dyads is not None else name  # the result that has the linkage
    file = f"{name}-{best if chosen else 'linkage'}"
    rows = [
        ("look the task over", f"burmester check {name}.toml"),
        ("find the linkages", f"burmester synthesize {name}.toml{how} -o {name}.json"),
        (
            "draw the plates of a linkage",
            f"burmester export {made}.json{chosen}{_settings(given.get('settings'))} -o {file}.dxf",
        ),
        ("write the report", f"burmester report {name}.toml{how}"),
        ("open the task here again", f"burmester studio {name}.toml"),
    ]
    if chosen and not six_bars:
        again = f"burmester judge {name}.toml --linkage {name}.json --id {best} --improve"
        rows.insert(2, ("look for better linkages near this one", again))
    if dyads is not None:
        judge = f"burmester judge {name}.toml{dyads} -o {made}.json"
        rows.insert(2, ("judge the linkage of the pivots", judge))
    return [{"title": title, "command": command} for title, command in rows]


def _option(key: str, asked: Any) -> str:
    """An option of `burmester synthesize`; nothing where none is asked that can stand there."""
    value = asked.get(key) if isinstance(asked, dict) else None
    if STUDIO_OPTIONS[key].form == "flag":
        return f" --{key}" if value is True else ""
    if STUDIO_OPTIONS[key].form == "lengths":
        listed = isinstance(value, str) and re.fullmatch(r"[0-9.,e+]+", value)
        return f" --{key} {value}" if listed else ""
    return f" --{key} {value}" if _is_plain(value) else ""


def _is_plain(value: object) -> bool:
    return _is_number(value) or (isinstance(value, str) and value.isascii() and value.isalpha())


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _settings(given: Any) -> str:
    """Options of an export; what cannot stand in a command is left out."""
    asked = given if isinstance(given, dict) else {}
    words = [
        f" {flag}={asked[name]}"
        for name, flag in SETTINGS.items()
        if _is_plain(asked.get(name)) or (name == "up" and asked.get(name) in AXES)
    ]
    words += [" --no-dimensions"] if asked.get("dimensions") is False else []
    words += [" --assembled"] if asked.get("assembled") is True else []
    return "".join(words)


def _dyads(given: Any) -> str | None:
    """Two links with their lengths, as options."""
    links = given if isinstance(given, list) and len(given) == 2 else []
    words = []
    for each in links:
        numbers = _numbers(each)
        if numbers is None or len(numbers) != 5:
            return None
        a, b, c, d, length = numbers
        words.append(f" --dyad={a},{b}:{c},{d} --length {length}")
    return "".join(words) if words else None


def _numbers(link: Any) -> list[str] | None:
    if not isinstance(link, dict):
        return None
    values = [link.get("radius")]
    for name in ("moving_pivot", "fixed_pivot"):
        pivot = link.get(name)
        values = [*pivot, *values] if isinstance(pivot, list) and len(pivot) == 2 else [None]
    return [repr(each) for each in values] if all(map(_is_number, values)) else None


def plain_name(given: object) -> str:
    """A name that is one everywhere, and leads nowhere.

    >>> plain_name("../Lid hinge 2"), plain_name(None)
    ('Lid-hinge-2', 'task')
    """
    text = given if isinstance(given, str) else ""
    name = re.sub(r"[^A-Za-z0-9_]+", "-", text[: 10 * MOST_LETTERS]).strip("-")
    return name[:MOST_LETTERS].strip("-") or "task"
