"""The keys `path` and `crank` of a JSON or TOML file: how points are traced, and timed.

E186 one that is malformed
"""

from __future__ import annotations

import math
from decimal import Decimal
from typing import Any

import numpy as np

from burmester.errors import InputError
from burmester.io.reading.pose_table import CrankOptions
from burmester.io.reading.trees.locations import Document
from burmester.tasks.traced_path import TracedPath

__all__ = ["read_crank", "read_path"]

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


def read_crank(tree: dict[str, Any], document: Document) -> CrankOptions:
    """How the crank angles of poses are meant, in a tree that says so; raises E186."""
    given = tree["crank"]
    if not isinstance(given, dict) or set(given) - {"absolute", "within_deg"}:
        fault = "crank is no table of absolute and within_deg"
    elif not isinstance(given.get("absolute", False), bool):
        fault = "absolute is neither true nor false"
    elif type(within := given.get("within_deg", 1)) not in (int, Decimal) or not within > 0:
        fault = "within_deg is no angle above zero"
    else:
        most = math.radians(float(within)) if "within_deg" in given else None
        return CrankOptions(given.get("absolute", False), most)
    where = document.where("crank", key=True)
    help = "write crank = { absolute = true, within_deg = 0.5 }, or one of the two"
    raise InputError("E186", fault, where=where, help=help)


def _malformed(document: Document, message: str) -> InputError:
    return InputError("E186", message, where=document.where("path", key=True), help=_HELP)
