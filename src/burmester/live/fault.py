"""What went wrong as a message that a page shows."""

from __future__ import annotations

import sys
import traceback
from typing import Any

from burmester.cures import for_page
from burmester.errors import BurmesterError


def fault_data(error: Exception) -> dict[str, Any]:
    """An error as a message; one that is no `BurmesterError` is a fault of burmester itself."""
    if isinstance(error, BurmesterError):
        return error.to_dict(for_page)
    traceback.print_exception(error, file=sys.stderr)
    message = f"burmester itself failed: {type(error).__name__}: {error}"
    help = "this is a bug; please report it with the task that led here"
    return BurmesterError("E900", message, help=help).to_dict()
