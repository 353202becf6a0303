"""Tables of times as CSV: the columns `time_s`, and `pose` or `driver_deg`.

E101 the table cannot be read    E177 a row that is none
"""

from __future__ import annotations

import csv

from burmester.errors import InputError
from burmester.io.files import open_plain
from burmester.tasks.loads import malformed

MAX_BYTES = 1_000_000
HELP = "give the columns time_s, and pose (names or numbers) or driver_deg (degrees)"


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
