"""A STEP file whose bytes depend on what it says only.

Open CASCADE keeps the colours of solids by their addresses in memory, so that their order differs
from run to run; it counts the uses of parts over all files of a process; and a zero may be what
rounding leaves of one.  ISO 10303-21 leaves the order of entities and their lines to the writer.
"""

from __future__ import annotations

import re
from itertools import count
from pathlib import Path

NEXT_TO_NOTHING = 1e-12  # millimetres or a share of a unit vector; less is the rounding of a zero

# An entity, whose texts may hold any sign: "#12 = COLOUR_RGB('',0.5,0.5,0.5);"
_ENTITY = re.compile(r"#(\d+) = ((?:'(?:[^']|'')*'|[^';])*);\s*")
_PIECE = re.compile(r"'(?:[^']|'')*'|#(\d+)|(-?\d+\.\d*E-\d+)")
_COLOURS = "MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION("
_USE = re.compile(r"(?<=^NEXT_ASSEMBLY_USAGE_OCCURRENCE\(')\d+")  # the number of a part's use
_DATA, _END = "DATA;\n", "ENDSEC;\nEND-ISO-10303-21;"


def settle(path: Path) -> None:
    """Write the file again: colours sorted by their solids, uses counted, an entity a line."""
    text = path.read_text(encoding="ascii")
    begin, end = text.index(_DATA) + len(_DATA), text.rindex(_END)
    entities = {
        found[1]: _PIECE.sub(_without_dust, " ".join(found[2].split()))
        for found in _ENTITY.finditer(text, begin, end)
    }
    numbers, uses = [*entities], count(1)
    for number, entity in entities.items():
        entities[number] = _USE.sub(lambda _: str(next(uses)), entity)
    roots = [number for number in numbers if entities[number].startswith(_COLOURS)]
    before = numbers.index(roots[0]) if roots else len(numbers)
    order = {number: k for k, number in enumerate(numbers[:before], start=1)}
    told = {number: f"#{number}" for number in order}

    def expanded(number: str) -> str:
        """An entity with those that it refers to in it, down to what comes before the colours."""
        if number not in told:
            told[number] = _PIECE.sub(
                lambda found: expanded(found[1]) if found[1] else found[0], entities[number]
            )
        return told[number]

    def visit(number: str) -> None:
        if number not in order:
            order[number] = len(order) + 1
            for found in _PIECE.finditer(entities[number]):
                if found[1]:
                    visit(found[1])

    for number in sorted(roots, key=expanded):
        visit(number)
    lines = (f"#{new} = {_renumbered(entities[old], order)};\n" for old, new in order.items())
    path.write_text(text[:begin] + "".join(lines) + text[end:], encoding="ascii", newline="\n")


def _renumbered(entity: str, order: dict[str, int]) -> str:
    return _PIECE.sub(lambda found: f"#{order[found[1]]}" if found[1] else found[0], entity)


def _without_dust(found: re.Match[str]) -> str:
    """A piece of an entity, a number next to nothing as zero."""
    return "0." if found[2] and abs(float(found[2])) < NEXT_TO_NOTHING else found[0]
