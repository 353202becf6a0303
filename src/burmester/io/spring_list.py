"""Lists of springs: the one that ships, and those of users as CSV.

A list has a column `name`, a column `kind`, and the numbers of its kinds by the names that springs
have in a task file; lengths in the task's unit.  The list that ships has usual sizes of gas
springs by the diameters of rod and tube.  Its strokes, lengths, forces and frictions are typical,
not those of a maker: take the numbers of what you buy.

E101 the list cannot be read    E177 a spring that is none
"""

from __future__ import annotations

import csv
from collections.abc import Iterator
from importlib import resources

import numpy as np

from burmester.errors import InputError
from burmester.loads.balance import Offer, filled
from burmester.tasks.length_units import MILLIMETRES
from burmester.tasks.loads import NEEDED, POSSIBLE, malformed
from burmester.wording import listed

WORDS = ("name", "kind", "count")


def usual_springs(unit: str) -> list[Offer]:
    """The gas springs that ship, each size filled to forces in steps of 50 N; unit: of lengths."""
    file = resources.files("burmester") / "loads" / "gas_springs.csv"
    scale, out = 1 / MILLIMETRES[unit], list[Offer]()
    for row in csv.DictReader(file.read_text(encoding="utf-8").splitlines()):
        numbers = {
            "stroke": float(row["stroke_mm"]) * scale,
            "length": float(row["length_mm"]) * scale,
            "friction_N": float(row["friction_N"]),
        }
        least, greatest, rise = (float(row[key]) for key in ("least_N", "greatest_N", "rise"))
        for many in (1, 2):
            name = f"{row['name']}" if many == 1 else f"two {row['name']}"
            out += filled(Offer(name, "gas", numbers, many), least, greatest, rise)
    return out


def springs_of_file(path: str) -> list[Offer]:
    """The springs of a CSV file; raises E101 and E177."""
    try:
        with open(path, encoding="utf-8-sig", newline="") as file:
            rows = list(csv.DictReader(file))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        why = getattr(error, "strerror", None) or str(error)
        help = "name a CSV file in UTF-8 with the columns name, kind and the numbers of its springs"
        raise InputError("E101", f"{path} cannot be read", why=why, help=help) from None
    return list(_offers(path, rows))


def _offers(path: str, rows: list[dict[str, str]]) -> Iterator[Offer]:
    if not rows:
        raise malformed(f"{path} lists no springs", help="give one spring a row")
    for number, row in enumerate(rows, start=2):
        kind = (row.get("kind") or "").strip()
        if kind not in NEEDED or kind in ("torsion", "counterweight"):
            known = [each for each in NEEDED if each not in ("torsion", "counterweight")]
            help = f"the column kind has one of {listed(known)}"
            raise malformed(
                f"{path}, line {number}: there is no spring of kind {kind!r}", help=help
            )
        own = (*NEEDED[kind], *POSSIBLE[kind])  # type: ignore[index]
        numbers = {}
        for name in own:
            text = (row.get(name) or "").strip()
            if not text:
                continue
            try:
                numbers[name] = float(text)
            except ValueError:
                help = "write numbers with a point for the decimals"
                message = f"{path}, line {number}: {name} is {text!r}, no number"
                raise malformed(message, help=help) from None
        name = (row.get("name") or "").strip() or f"line {number}"
        offer = Offer(name, kind, numbers, int(row.get("count") or 1))  # type: ignore[arg-type]
        offer.between(np.zeros(2), np.zeros(2))  # what is no spring is refused here
        yield offer
