"""The bytes of a pose file, and the text in them."""

from __future__ import annotations

import os
import re
import sys
from typing import BinaryIO

from burmester.errors import Advice, InputError
from burmester.io import cases
from burmester.io.reading.link import is_link, read_link
from burmester.io.reading.pose_table import HEADER, no_poses, shown

PARQUET, ARCHIVE = b"PAR1", b"PK\x03\x04"  # how their files begin; a workbook is an archive
MAX_BYTES = 50_000_000  # of a file: some two million poses, or what is no pose file
MAX_LINES = 1_100_000  # of a text: `check` takes 0.5 kB of memory a line, and 12 s for all
MAX_TREE_CHARACTERS = 20_000_000  # of JSON and TOML
MAX_VALUES = 1_500_000  # in JSON and TOML: 350,000 poses in lists, of 1 kB of memory each
TREE_BYTES = 40  # of memory for a character of them, with locations and printed digits

_WINDOWS_SIGNS = "°º²³µ§±×·–—‘’“”„…«»€\u00a0"  # beside letters, in tables of Western Europe
ARCHIVE_HELP = (
    "save the sheet as CSV, or copy its cells and paste them: "
    f"`burmester synthesize - --columns {HEADER}`"
)
_PASTE_HELP = f"copy its table and paste it: `burmester synthesize - --columns {HEADER}`"
_MATLAB_HELP = f"write the matrix as CSV, writematrix(P, 'poses.csv'), and pass --columns {HEADER}"
_PICTURE_HELP = "trace the curve in it as SVG and read that, or measure poses and write them as CSV"
_BINARY_FORMATS: dict[bytes, tuple[str, str]] = {  # first bytes of a file: its format, and the help
    b"\xd0\xcf\x11\xe0": ("an .xls spreadsheet, or another old Office file", ARCHIVE_HELP),
    b"\x1f\x8b": ("packed with gzip", "unpack it with gunzip, and read what comes out"),
    b"%PDF": ("a PDF", _PASTE_HELP),
    b"MATLAB 5.0 MAT-file": ("a MATLAB file (.mat)", _MATLAB_HELP),
    b"MATLAB 7.3 MAT-file": ("a MATLAB file (.mat)", _MATLAB_HELP),
    b"\x89HDF": ("an HDF5 file, as newer .mat files are", _MATLAB_HELP),
    b"\x93NUMPY": ("a NumPy array (.npy)", "write it as text: numpy.savetxt(..., delimiter=',')"),
    b"\x89PNG": ("a picture (PNG)", _PICTURE_HELP),
    b"\xff\xd8\xff": ("a picture (JPEG)", _PICTURE_HELP),
    b"GIF89a": ("a picture (GIF)", _PICTURE_HELP),
}
_BY_ENDING = {  # what does not begin as it should, or in an older form that begins as anything
    ".mat": b"MATLAB 5.0 MAT-file",
    ".png": b"\x89PNG",
    ".jpg": b"\xff\xd8\xff",
    ".jpeg": b"\xff\xd8\xff",
}


def read_source(source: str) -> bytes:
    """The bytes of a file, of standard input ("-"), a link or a carried case; E101, E117."""
    if source == "-" and sys.stdin is None:
        help = "give the name of a file, or send one through a pipe"
        raise InputError("E101", "standard input is closed", help=help)
    if is_link(source):
        return read_link(source).data
    if source.startswith("case:"):
        return cases.read_bytes(source.removeprefix("case:"))
    try:
        if source == "-":
            return _bounded(sys.stdin.buffer)
        with open(source, "rb") as file:
            return _bounded(file)
    except (OSError, ValueError) as error:  # ValueError: a null character in the path
        why = getattr(error, "strerror", None) or str(error)
        help = _help_for(source, error)
        raise InputError("E101", "the poses cannot be read", why=why, help=help) from None


def _bounded(file: BinaryIO) -> bytes:
    """All bytes of a file, or E101 without reading on: some have no end."""
    data = file.read(MAX_BYTES + 1)
    if len(data) > MAX_BYTES:
        raise too_large(f"it has more than {MAX_BYTES / 1e6:.0f} MB")
    return data


def require_moderate(text: str, *, tree: bool) -> None:
    """Refuse a text whose rows, or whose tree, would take more than a gigabyte; raises E101."""
    size, lines = len(text) / 1e6, text.count("\n")
    if tree and len(text) > MAX_TREE_CHARACTERS:
        why = f"its {size:.0f} MB would need {size * TREE_BYTES / 1e3:.2g} GB of memory as a tree"
        raise too_large(f"{why}; {MAX_TREE_CHARACTERS / 1e6:.0f} MB are the most")
    if tree and (values := sum(map(text.count, ",[{="))) > MAX_VALUES:
        raise too_large(f"it has some {values} values, and {MAX_VALUES} are the most")
    if lines > MAX_LINES:
        raise too_large(f"it has {lines} lines, and {MAX_LINES} are the most")


def too_large(why: str) -> InputError:
    """E101 for a file that is not read to its end."""
    help = "take one pose in ten, say: so many hardly tell more"
    return InputError("E101", "the file is too large", why=why, help=help)


def decode_text(data: bytes, name: str = "") -> tuple[str, tuple[Advice, ...]]:
    """Text with line feeds between its lines, and a note where its encoding was assumed.

    Read is UTF-8, UTF-16 with a byte order mark, and what spreadsheets call ANSI: Windows-1252,
    where all that is no ASCII is letters and a few signs of Western Europe.  Raises E101 and E102.
    name: of the file, which says what it is where its bytes are no text and do not.
    """
    for start in _BINARY_FORMATS:
        if data.startswith(start):
            raise _no_text(start)
    wide = data[:2] in (b"\xff\xfe", b"\xfe\xff")
    notes: tuple[Advice, ...] = ()
    try:
        text = data.decode("utf-16" if wide else "utf-8-sig")
        why = "there are null characters in it" if "\0" in text else ""
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        why = f"byte {error.start + 1}, in line {line}, is not UTF-{16 if wide else 8}"
        if not wide and (ansi := _windows_text(data)) is not None:
            text, why, notes = ansi, "", (_windows_note(ansi, why),)
    if why and (meant := _BY_ENDING.get(os.path.splitext(name)[1].lower())):
        raise _no_text(meant)
    if why:
        raise InputError("E101", "the poses are not text", why=why, help="save the file as UTF-8")
    if not text.strip():
        raise no_poses("the file is empty")
    # splitlines() would also break a name at U+2028 and shift the line numbers
    return text.replace("\r\n", "\n").replace("\r", "\n").rstrip("\n"), notes


def _no_text(start: bytes) -> InputError:
    what, help = _BINARY_FORMATS[start]
    return InputError("E101", "the poses are not text", why=f"the file is {what}", help=help)


def _windows_text(data: bytes) -> str | None:
    """The text in Windows-1252; None where another encoding or no text at all is as likely."""
    try:
        text = data.decode("cp1252")
    except UnicodeDecodeError:
        return None
    foreign = {c for c in set(text) if not c.isascii()}
    controls = {c for c in set(text) if c.isascii() and not c.isprintable()} - set("\t\r\n\f")
    letters = all(c.isalpha() or c in _WINDOWS_SIGNS for c in foreign)
    return text if letters and not controls else None


def _windows_note(text: str, why: str) -> Advice:
    """W213, for a text that was taken for Windows-1252."""
    word = next(part for part in re.split("[ \t\r\n,;]", text) if not part.isascii())
    return Advice(
        "W213",
        f"the file is read as Windows-1252 (ANSI), as in {shown(word)}",
        "save the file as UTF-8, and look at its names where that reads wrong",
        f"{why}; numbers are the same in both",
    )


def _help_for(source: str, error: Exception) -> str:
    """The help for a file that cannot be read: the file that is probably meant."""
    from difflib import get_close_matches

    if source in cases.names():
        return f"write case:{source}"
    folder, name = os.path.split(source)
    if isinstance(error, PermissionError) and not os.path.isdir(source):
        return "change its permissions, or read a copy that is yours"
    try:
        if os.path.isdir(source):
            tables = sorted(f for f in os.listdir(source) if f.lower().endswith(".csv"))
            near = [os.path.join(source, file) for file in tables[:1]]
        else:
            files = {file.lower(): file for file in os.listdir(folder or ".")}
            near = get_close_matches(name.lower(), files, 1, 0.6)
            near = [os.path.join(folder, files[file]) for file in near]
    except (OSError, ValueError):
        near = []
    return f"read {near[0]} if that is meant, or check the path" if near else "check the path"
