"""Errors, warnings and outcomes as a terminal of any width shows them, all in one form.

    error[E103]: what happened
      --> file:line:column
       4 | the line
         |     ^^^ carets
      why: one sentence with numbers
      help: a command or an edit that works when followed literally

Text is wrapped under where it begins, and a command is not broken if it fits on a line of its
own.  The line of the file is never wrapped: where it is too wide, a window around the carets is
shown of it.  Nothing is coloured where the terminal has no colour, or NO_COLOR asks for none.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, TypeAlias

from rich.cells import cell_len, get_character_cell_size
from rich.text import Text

from burmester.printable import blanked, printable

if TYPE_CHECKING:
    from rich.console import Console, RenderableType

    from burmester.errors import Advice, BurmesterError
    from burmester.tasks.motion_kinds import MotionKind

    _Message: TypeAlias = BurmesterError | Advice | MotionKind

STYLES = {"error": "bold red", "warning": "bold yellow", "result": "bold"}
MIN_COLUMNS = 24  # columns of a text, however narrow the terminal
FULL_INDENT_COLUMNS = 56  # columns; in a narrower terminal text is indented by 4 columns only
ELLIPSIS = "..."
LOCATION_HEAD = "  --> "

# Words, with what stands in backticks or in quotes in one piece.
_WORD = re.compile(r'(?:`[^`\n]+`|"[^"\n]+"|\S)+')
_OPTION = re.compile(r"--[a-z][a-z-]*")
_GUTTER = re.compile(r"( *(\d*) \|)(?: (.*))?")
_CARETS = re.compile(r"( *)(\^+)(.*)")


def show(kind: str, content: _Message, console: Console) -> None:
    """An error, a warning or a result, with its location, its reason and its help."""
    lines = message(
        kind,
        content.code,
        content.message,
        where=getattr(content, "where", None),
        why=getattr(content, "why", None),
        help=content.help,
        width=console.width,
    )
    draw(lines, console)


def draw(lines: Sequence[Text], console: Console) -> None:
    """Print lines that are laid out already, without any style where there is no colour."""
    for line in lines:
        plain = Text(line.plain) if console.no_color else line
        console.print(plain, soft_wrap=True)


def print_trimmed(renderable: RenderableType, console: Console) -> None:
    """Print tables and texts without blanks at the ends of their lines."""
    for segments in console.render_lines(renderable, pad=False):
        line = Text()
        for text, style, control in segments:
            if not control:
                line.append(text, style)
        line.rstrip()
        draw([line], console)


def message(
    kind: str,
    code: str,
    text: str,
    *,
    where: str | None = None,
    why: str | None = None,
    help: str | None = None,
    width: int,
) -> list[Text]:
    """The lines of a message; kind: error, warning or result."""
    style = STYLES.get(kind, "bold")
    hang = None if width >= FULL_INDENT_COLUMNS else 4
    lines = wrapped(text, width, Text(f"{kind}[{code}]: ", style=style), hang)
    if where:
        lines += location_lines(where, width, style)
    for label, sentence in (("why", why), ("help", help)):
        if sentence:
            lines += note(label, sentence, width)
    return lines


def note(label: str, text: str, width: int) -> list[Text]:
    """The lines of "  why: ..." or "  help: ...", wrapped under where the text begins."""
    return wrapped(text, width, Text(f"  {label}: ", style="bold"))


def wrapped(text: str, width: int, head: Text | str = "", hang: int | None = None) -> list[Text]:
    """A text in lines of `width` columns, the first behind `head`, the others indented alike.

    hang: the indentation of the others, if not that of the text behind the head.
    """
    first = Text.assemble(head)
    indent = first.cell_len if hang is None else hang
    words = list(_units(printable(text, keep="\n\t"), max(width - indent, MIN_COLUMNS)))
    lines, line, used = [], first, first.cell_len
    empty = True
    for word in words:
        size = cell_len(word)
        if not empty and used + 1 + size > max(width, indent + MIN_COLUMNS):
            lines.append(line)
            line, used, empty = Text(" " * indent), indent, True
        line.append(word if empty else f" {word}")
        used += size + (not empty)
        empty = False
    return [*lines, line]


def _units(text: str, room: int) -> Iterator[str]:
    """Words and what is better not broken, an option with its value say, if `room` can hold it."""
    words = [found[0] for found in _WORD.finditer(text)]
    joined: list[str] = []
    for word in words:
        if joined and _OPTION.fullmatch(joined[-1].rpartition(" ")[2].lstrip("`(")):
            joined[-1] += f" {word}"
        else:
            joined.append(word)
    for unit in joined:
        if cell_len(unit) <= room:
            yield unit
        else:
            yield from unit.split()


# --- the location in the file


def location_lines(where: str, width: int, style: str) -> Iterator[Text]:
    """The lines of a location: its name, then lines of the file, each with carets below it.

    where: as `BurmesterError` has it; style: of the carets.
    """
    name, *rest = blanked(where).split("\n")
    yield from wrapped(name, width, Text(LOCATION_HEAD, style="bold"))
    k = 0
    while k < len(rest):
        line = _GUTTER.fullmatch(rest[k])
        if not line:
            yield from wrapped(rest[k].strip(), width, "      ")
            k += 1
            continue
        below = _GUTTER.fullmatch(rest[k + 1]) if k + 1 < len(rest) else None
        carets = _CARETS.fullmatch(below[3] or "") if below and not below[2] else None
        if below and carets:
            yield from _window(line, below, carets, width, style)
            k += 2
        else:
            text = _cells(line[3] or "", 0, max(width - len(line[1]) - 1, MIN_COLUMNS))
            yield _gutter(line) + Text(text.rstrip())
            k += 1


def _window(
    line: re.Match[str], below: re.Match[str], carets: re.Match[str], width: int, style: str
) -> Iterator[Text]:
    """A line of the file and its carets, or as much of both around the carets as there is room."""
    text, (blanks, marks, after) = line[3] or "", carets.groups()
    room = max(width - len(line[1]) - 1, MIN_COLUMNS)
    # Wide characters take two columns, and what stands below them as well.
    padded = text.ljust(len(blanks) + len(marks))
    at = cell_len(padded[: len(blanks)])
    count = max(1, cell_len(padded[len(blanks) : len(blanks) + len(marks)]))
    size, end = cell_len(text), at + count
    if max(size, end + cell_len(after)) > room:
        if cell_len(after) > room // 2:
            after = ""
        count = min(count, room - cell_len(after) - 2 * len(ELLIPSIS))
        end = at + count
        # The carets at two thirds of the window, so that what leads to them is seen.
        start = max(0, end + max(cell_len(after), room // 3) - room)
        start = max(0, min(start, max(size, end + cell_len(after)) - room))
        stop = start + room
        text = _cells(text, start, stop)
        if start > 0:
            text = ELLIPSIS + _cells(text, len(ELLIPSIS), room)
        if stop < size:
            text = _cells(text, 0, room - len(ELLIPSIS)) + ELLIPSIS
        at -= start
    yield _gutter(line) + Text(text.rstrip())
    yield _gutter(below) + Text.assemble(" " * at, ("^" * count, style), after.rstrip())


def _gutter(found: re.Match[str]) -> Text:
    return Text(f"{found[1]} ", style="bold")


def _cells(text: str, start: int, stop: int) -> str:
    """What of a text stands in these columns; half a wide character is a blank."""
    out, at = [], 0
    for char in text:
        size = get_character_cell_size(char)
        if start <= at and at + size <= stop:
            out.append(char)
        else:
            out.append(" " * (min(at + size, stop) - max(at, start)))
        at += size
    return "".join(out)
