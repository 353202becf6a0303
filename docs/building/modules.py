"""The modules of each room, each with the first line of its docstring.

python -m docs.building.modules [ROOM]

prints them, as `scripts/map` does; the site has them as a page.
"""

import ast
import sys
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2] / "src" / "burmester"


def modules():
    """Of each room by its path, the modules and what they say of themselves; the ground is ""."""
    rooms = {}
    for file in sorted(SOURCE.rglob("*.py")):
        if not file.name.startswith("__"):
            room = file.parent.relative_to(SOURCE).as_posix().strip(".")
            rooms.setdefault(room, {})[file.stem] = first_line(file)
    return dict(sorted(rooms.items()))


def first_line(file):
    """The first line of a module's docstring."""
    text = ast.get_docstring(ast.parse(file.read_text(encoding="utf-8"))) or ""
    return text.partition("\n")[0]


def modules_page():
    """All of them, a section a room."""
    parts = [
        "# Modules",
        "What each says of itself. The rooms are in [Architecture](../project/architecture.md).",
    ]
    for room, names in modules().items():
        parts += [
            f"## {room or 'The ground'}",
            "\n".join(f"- `{k}`: {v}" for k, v in names.items()),
        ]
    return "\n\n".join(parts) + "\n"


def main(room=None):
    """Print the modules of a room and of those in it, or of all."""
    for name, names in modules().items():
        if room is None or name == room or name.startswith(f"{room}/"):
            print(*(f"{name}/{k}".lstrip("/") + f": {v}" for k, v in names.items()), sep="\n")


if __name__ == "__main__":
    main(*sys.argv[1:2])
