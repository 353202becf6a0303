"""Fingerprints of documents: their text without its numbers as a hash, and sums of the numbers.

Numbers are compared to a millionth, as other processors round the last digits otherwise.  Each
block of BLOCK numbers has one sum, with weights between 1 and 2, so that none can stand in for
another.
"""

import hashlib
import io
import json
import re
import struct
import zipfile
from typing import NamedTuple

import numpy as np
from PIL import Image
from pypdf import PdfReader

BLOCK = 64
RELATIVE, ABSOLUTE, GREATEST = 1e-6, 1e-8, 1e15
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:[eE][+-]?\d+)?")
# What may be otherwise in two runs: the version, dates, and how long something took.
MOVING = re.compile(
    r'burmester[ -]\d+\.\d+\.\d+\S*|\d{4}-\d\d-\d\d\S*|"seconds": ?[\d.e+-]+|[\d.e+-]+ m?s\b'
)
PAGE_DATA = re.compile(r'<script type="application/json"[^>]*>(.*?)</script>', re.DOTALL)
ACROSS = 8  # pixels of a frame, shrunk


class Fingerprint(NamedTuple):
    """The hash of a document's text, how many numbers it has, and their sums by blocks."""

    words: str
    count: int
    sums: tuple[float, ...]


def as_text(name: str, content: bytes) -> str:
    """A document as text, by the ending of its name; pages as the data that they show."""
    readers = {"html": _page, "pdf": _sheets, "stl": _triangles, "step": _points, "gif": _frames}
    readers["zip"] = _parts
    return readers.get(name.rpartition(".")[2], bytes.decode)(content)


def _page(content: bytes) -> str:
    found = PAGE_DATA.findall(content.decode())
    return "\n".join(json.dumps(json.loads(each), indent=1) for each in found)


def _sheets(content: bytes) -> str:
    pages = PdfReader(io.BytesIO(content)).pages
    return "\n".join(page.get_contents().get_data().decode("latin-1") for page in pages)


def _triangles(content: bytes) -> str:
    count = struct.unpack("<I", content[80:84])[0]
    rows = np.frombuffer(content[84:], np.dtype([("v", "<f4", 12), ("_", "<u2")]), count)["v"]
    return "\n".join(" ".join(f"{x:.6g}" for x in row) for row in rows.tolist())


def _points(content: bytes) -> str:
    # Rounding says which points are one, and so their order.
    points = re.findall(r"CARTESIAN_POINT\('',\(([^)]*)\)", content.decode())
    rounded = {tuple(round(float(x), 5) + 0.0 for x in each.split(",")) for each in points}
    return "\n".join(map(str, sorted(rounded)))


def _parts(content: bytes) -> str:
    with zipfile.ZipFile(io.BytesIO(content)) as parts:
        return "\n".join(as_text(each, parts.read(each)) for each in sorted(parts.namelist()))


def _frames(content: bytes) -> str:
    lines = []
    with Image.open(io.BytesIO(content)) as film:
        lines.append(f"{film.size} {film.n_frames}")
        for number in (0, film.n_frames // 2):
            film.seek(number)
            small = film.convert("L").resize((ACROSS, ACROSS), Image.Resampling.BOX)
            lines.append(" ".join(str(each // 8) for each in small.tobytes()))
    return "\n".join(lines)


def of_text(text: str) -> Fingerprint:
    """The fingerprint of a document."""
    text = MOVING.sub("", text)
    numbers = _numbers(text)
    words = hashlib.sha256(NUMBER.sub("#", text).encode()).hexdigest()[:16]
    sums = (_blocks(numbers) @ _weights()).tolist()
    return Fingerprint(words, len(numbers), tuple(float(f"{each:.8g}") for each in sums))


def difference(text: str, known: Fingerprint) -> str | None:
    """What is otherwise in a text than its fingerprint says; None where nothing is."""
    own = of_text(text)
    if own.words != known.words or own.count != known.count:
        return f"other words, or {own.count} numbers in place of {known.count}"
    numbers = _numbers(MOVING.sub("", text))
    size = np.abs(_blocks(numbers)) @ _weights()
    far = np.abs(np.array(own.sums) - known.sums) > RELATIVE * size + ABSOLUTE
    if not far.any():
        return None
    first = int(far.argmax()) * BLOCK
    some = ", ".join(f"{each:.7g}" for each in numbers[first : first + BLOCK])
    return f"{far.sum()} of {len(far)} blocks of numbers differ; the first is now {some}"


def _numbers(text: str) -> np.ndarray:
    every = np.array([float(each) for each in NUMBER.findall(text)])
    return np.clip(every, -GREATEST, GREATEST)


def _blocks(numbers: np.ndarray) -> np.ndarray:
    return np.pad(numbers, (0, -len(numbers) % BLOCK)).reshape(-1, BLOCK)


def _weights() -> np.ndarray:
    return 1 + np.sqrt(np.arange(1, BLOCK + 1)) % 1
