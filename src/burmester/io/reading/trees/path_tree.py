"""The key `path` of a JSON or TOML file: whether it is closed, and how the crank times it.

E186 a path that is malformed
"""

from __future__ import annotations

from typing import Any

import numpy as np

from burmester.errors import InputError
from burmester.io.reading.trees.locations import Document
from burmester.tasks.traced_path import TracedPath

__all__ = ["read_path"]

_KEYS = ("closed", "crank_deg")
_HELP = "write path = { closed = true }, or path = { crank_deg = [0, 20, 40, ...] } in TOML"


def read_path(tree: dict[str, Any], document: Document) -> TracedPath:
    """The path in a tree that has one; raises E186."""
    given = tree["path"]
    if not isinstance(given, dict) or set(given) - set(_KEYS):
        raise _malformed(document, "path is no table of closed and crank_deg")
    closed, angles = given.get("closed", False), given.get("crank_deg")
    if not isinstance(closed, bool):
        raise _malformed(document, "closed is neither true nor false")
    if angles is None:
        return TracedPath(closed)
    try:
        turned = np.radians(np.array([float(each) for each in angles]))
    except (TypeError, ValueError):
        raise _malformed(document, "crank_deg is not a list of numbers") from None
    try:
        return TracedPath(closed, turned)
    except InputError as error:
        error.where = document.where("path", key=True)
        raise


def _malformed(document: Document, message: str) -> InputError:
    return InputError("E186", message, where=document.where("path", key=True), help=_HELP)
