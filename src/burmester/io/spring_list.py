"""Lists of springs: the one that ships, and those of users as CSV.

A list has a column `name`, a column `kind`, and the numbers of its kinds by the names that springs
have in a task file; lengths in the task's unit.  The list that ships has usual sizes of gas
springs by the diameters of rod and tube.  Its strokes, lengths, forces and frictions are typical,
not those of a maker: take the numbers of what you buy.

E101 the list cannot be read    E177 a spring that is none
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Iterator
from importlib import resources

import numpy as np

from burmester.errors import InputError
from burmester.loads.balance import Offer, filled
from burmester.tasks.length_units import MILLIMETRES
from burmester.tasks.load_table import NEEDED, POSSIBLE
from burmester.tasks.loads import malformed
from burmester.wording import listed

DIAMETER = "diameter"  # the column of how wide springs are


def usual_springs(unit: str) -> list[Offer]:
    """The springs that ship, alone and in pairs; unit: of lengths.

    Gas springs are filled to forces in steps of 50 N.
    """
    scale = 1 / MILLIMETRES[unit]
    coils = [
        Offer(
            row["name"],
            row["kind"],  # type: ignore[arg-type]
            {"rate_N_per_mm": float(row["rate_N_per_mm"])}
            | ({"initial_N": float(row["initial_N"])} if row["initial_N"] else {})
            | {
                name: float(row[f"{name}_mm"]) * scale
                for name in ("free_length", "least_length", "greatest_length")
                if row[f"{name}_mm"]
            },
            diameter=(float(row["wire_mm"]) + float(row["coil_mm"])) * scale,
        )
        for row in _shipped("coil_springs.csv")
    ]
    gas = [
        offer
        for row in _shipped("gas_springs.csv")
        for offer in filled(
            Offer(
                row["name"],
                "gas",
                {
                    "stroke": float(row["stroke_mm"]) * scale,
                    "length": float(row["length_mm"]) * scale,
                    "friction_N": float(row["friction_N"]),
                },
                diameter=float(row["diameter_mm"]) * scale,
            ),
            *(float(row[key]) for key in ("least_N", "greatest_N", "rise")),
        )
    ]
    return [*gas, *coils, *in_pairs([*gas, *coils])]


def in_pairs(offers: Iterable[Offer]) -> list[Offer]:
    """The springs of a list, two in place of each single one."""
    twice = [
        offer if offer.many > 1 else offer._replace(name=f"two {offer.name}", many=2)
        for offer in offers
    ]
    return [*{offer.name: offer for offer in twice}.values()]


def _shipped(name: str) -> Iterator[dict[str, str]]:
    file = resources.files("burmester") / "loads" / name
    return csv.DictReader(_uncommented(file.read_text(encoding="utf-8").splitlines(keepends=True)))


def _uncommented(lines: Iterable[str]) -> Iterator[str]:
    return (line for line in lines if not line.startswith("#"))


def springs_of_file(path: str) -> list[Offer]:
    """The springs of a CSV file; raises E101 and E177."""
    try:
        with open(path, "rb") as file:
            return springs_in(file.read(), path)
    except OSError as error:
        raise _unreadable(path, error) from None


def springs_in(data: bytes, path: str) -> list[Offer]:
    """The springs in the bytes of a CSV file; raises E101 and E177."""
    try:
        lines = io.StringIO(data.decode("utf-8-sig"), newline="")
        rows = list(csv.DictReader(_uncommented(lines)))
    except (UnicodeDecodeError, csv.Error) as error:
        raise _unreadable(path, error) from None
    return list(_offers(path, rows))


def _unreadable(path: str, error: Exception) -> InputError:

    why = getattr(error, "strerror", None) or str(error)
    help = "name a CSV file in UTF-8 with the columns name, kind and the numbers of its springs"
    return InputError("E101", f"{path} cannot be read", why=why, help=help)


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
        numbers = {}
        for name in (*NEEDED[kind], *POSSIBLE[kind], DIAMETER):  # type: ignore[index]
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
        many, diameter = int(row.get("count") or 1), numbers.pop(DIAMETER, 0.0)
        offer = Offer(name, kind, numbers, many, diameter)  # type: ignore[arg-type]
        offer.between(np.zeros(2), np.zeros(2))  # what is no spring is refused here
        yield offer
