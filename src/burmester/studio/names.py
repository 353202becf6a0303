"""Names of files that the studio makes: letters, digits and hyphens, whatever was asked for."""

from __future__ import annotations

import re
from typing import Final

__all__ = ["plain_name"]

MOST_LETTERS: Final = 60


def plain_name(given: object) -> str:
    """A name that is one everywhere, and leads nowhere.

    >>> plain_name("../Lid hinge 2"), plain_name(None)
    ('Lid-hinge-2', 'task')
    """
    text = given if isinstance(given, str) else ""
    name = re.sub(r"[^A-Za-z0-9_]+", "-", text[: 10 * MOST_LETTERS]).strip("-")
    return name[:MOST_LETTERS].strip("-") or "task"
