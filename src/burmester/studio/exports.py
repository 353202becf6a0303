"""What leaves the studio: the formats of `burmester export`."""

from __future__ import annotations

from importlib.util import find_spec
from typing import Any

from burmester.export import FORMATS

__all__ = ["formats"]


def formats() -> list[dict[str, Any]]:
    """The formats whose libraries are installed, as the page offers them."""
    return [
        {"format": name, "title": each.what, "suffix": each.suffix}
        for name, each in FORMATS.items()
        if name != "flat" and all(find_spec(library) for library in each.libraries)
    ]
