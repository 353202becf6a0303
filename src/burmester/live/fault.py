"""What went wrong as a message that a page shows."""

from __future__ import annotations

import sys
import traceback
from typing import Any

from burmester.errors import BurmesterError

__all__ = ["fault_data"]


def fault_data(error: Exception) -> dict[str, Any]:
    """An error as a message; one that is no `BurmesterError` is a fault of burmester itself."""
    if isinstance(error, BurmesterError):
        return {
            "code": error.code,
            "message": error.message,
            "where": error.where,
            "why": error.why,
            "help": error.help,
        }
    traceback.print_exception(error, file=sys.stderr)
    return {
        "code": "E900",
        "message": f"burmester itself failed: {type(error).__name__}: {error}",
        "where": None,
        "why": None,
        "help": "this is a bug; please report it with the task that led here",
    }
