"""Draw docs/floors.svg: the rooms of ARCHITECTURE.md on the floors of pyproject.toml.

Run it from the project's root: .venv/bin/python docs/floors.py
"""

import re
import textwrap
import tomllib
from pathlib import Path

WIDTH, MARGIN, FLOOR, GAP = 820, 16, 38, 5  # pixels
ROOF, SIDE = 46, 150  # pixels: the height of the roof, the width of the column beside the house
BOLD, PLAIN = 9.4, 0.52  # a letter's width: pixels in a room's name, per font size in what it is
LINE = 14  # pixels between lines of what a room is, where it does not fit beside the name
PARTS = (  # topmost room, name, what holds there, fill, ink
    ("cli", "faces and media", "screens, files, drawings", "#dbe7fb", "#1d4f9e"),
    ("synthesis", "science", "no screen, no file, no plot", "#e0f0e4", "#22633a"),
    ("values", "ground", "no mechanism", "#f1e8d3", "#6b5213"),
)


def floors(pyproject):
    """The floors from the top, each a list of its rooms."""
    contracts = tomllib.loads(pyproject)["tool"]["importlinter"]["contracts"]
    layers = next(each for each in contracts if each["type"] == "layers")["layers"]
    return [[room.strip() for room in layer.split("|")] for layer in layers]


def nouns(architecture):
    """What each room is: the first sentence of its line."""
    rooms = architecture.partition("\n## The rooms\n")[2].partition("\n## ")[0]
    lines = re.findall(r"^- `(\w+)`: (.+)$", rooms, re.MULTILINE)
    return {room: says.partition(". ")[0].removesuffix(".") for room, says in lines}


def lines(name, what, wide, size):
    """What a room is, in lines below its name; none where it fits beside the name."""
    if 24 + BOLD * len(name) + 10 + PLAIN * size * len(what) <= wide:
        return []
    return textwrap.wrap(what, int((wide - 20) / (PLAIN * 11)))


def room_svg(name, what, below, box, *, ink, size):
    """A room's words; its box is x, y, width and height in pixels."""
    x, y, _, high = box
    base = y + 20 if below else y + high / 2 + 5
    named = f'<tspan font-weight="600">{name}</tspan>'
    beside = "" if below else f'<tspan dx="10" fill="#3d4650" font-size="{size}">{what}</tspan>'
    more = "".join(
        f'<tspan x="{x + 12:.1f}" dy="{LINE}" fill="#3d4650" font-size="11">{line}</tspan>'
        for line in below
    )
    return f'<text x="{x + 12:.1f}" y="{base:.0f}" fill="{ink}">{named}{beside}{more}</text>'


def drawn(pyproject, architecture):
    """The picture as SVG."""
    storeys, says = floors(pyproject), nouns(architecture)
    house = WIDTH - 2 * MARGIN - SIDE
    rows, top = [], MARGIN + ROOF + GAP
    for rooms in storeys:
        wide = (house - GAP * (len(rooms) - 1)) / len(rooms)
        size = 13 if len(rooms) < 3 else 11
        below = {room: lines(room, says[room], wide, size) for room in rooms}
        most = max(map(len, below.values()))
        high = max(FLOOR, 20 + LINE * most + 10) if most else FLOOR
        rows.append((top, high, wide, size, below))
        top += high + GAP
    height = top - GAP + MARGIN
    starts = [next(k for k, rooms in enumerate(storeys) if part[0] in rooms) for part in PARTS]
    parts = [
        f'<path d="M{MARGIN} {MARGIN + ROOF}h{house}L{MARGIN + house / 2} {MARGIN}z" '
        f'fill="{PARTS[0][4]}" stroke="{PARTS[0][4]}" stroke-width="4" stroke-linejoin="round"/>',
        f'<text x="{MARGIN + house / 2}" y="{MARGIN + ROOF - 10}" fill="#ffffff" font-size="15" '
        'font-weight="600" text-anchor="middle">burmester</text>',
    ]
    for number, (y, high, wide, size, below) in enumerate(rows):
        fill, ink = PARTS[sum(start <= number for start in starts) - 1][3:]
        for place, (room, under) in enumerate(below.items()):
            x = MARGIN + place * (wide + GAP)
            parts.append(
                f'<rect x="{x:.1f}" y="{y}" width="{wide:.1f}" height="{high}" rx="4" '
                f'fill="{fill}"/>\n'
                + room_svg(room, says[room], under, (x, y, wide, high), ink=ink, size=size)
            )
    x = MARGIN + house + 12
    for (_, name, rule, _, ink), start, end in zip(
        PARTS, starts, [*starts[1:], len(storeys)], strict=True
    ):
        top, bottom = rows[start][0], rows[end - 1][0] + rows[end - 1][1]
        middle = (top + bottom) / 2
        parts.append(
            f'<path d="M{x} {top + 2}v{bottom - top - 4}" stroke="{ink}" stroke-width="2.5" '
            f'stroke-linecap="round"/>\n<text x="{x + 11}" y="{middle - 2}" fill="{ink}" '
            f'font-size="14" font-weight="600">{name}</text>\n'
            f'<text x="{x + 11}" y="{middle + 14}" fill="#3d4650" font-size="10">{rule}</text>'
        )
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" width="{WIDTH}" '
        f'height="{height}" role="img" font-family="system-ui, sans-serif" font-size="15">\n'
        "<title>The rooms of burmester on their floors</title>\n"
        f'<rect width="{WIDTH}" height="{height}" rx="10" fill="#ffffff"/>\n'
        + "\n".join(parts)
        + "\n</svg>\n"
    )


def main():
    picture = drawn(Path("pyproject.toml").read_text(), Path("ARCHITECTURE.md").read_text())
    Path("docs/floors.svg").write_text(picture)


if __name__ == "__main__":
    main()
