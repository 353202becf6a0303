"""Numbers as a person writes them."""

from __future__ import annotations

from typing import Any


def plain(value: Any) -> Any:
    """Plain data with 12 for 12.0."""
    if isinstance(value, float) and value.is_integer() and abs(value) < 1e15:
        return int(value)
    if isinstance(value, list):
        return [plain(each) for each in value]
    if isinstance(value, dict):
        return {key: plain(each) for key, each in value.items()}
    return value
