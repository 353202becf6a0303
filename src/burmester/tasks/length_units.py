"""Units of lengths whose size is known."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

MILLIMETRES: Final[Mapping[str, float]] = {
    "um": 1e-3,
    "mm": 1.0,
    "cm": 10.0,
    "m": 1000.0,
    "in": 25.4,
    "ft": 304.8,
}
