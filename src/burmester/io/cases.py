"""The cases carried in the package: published tasks, with their source and known answers."""

from __future__ import annotations

import json
from contextlib import suppress
from pkgutil import get_data
from typing import TYPE_CHECKING, Any

from burmester.errors import InputError

if TYPE_CHECKING:
    from importlib.resources.abc import Traversable


def names() -> tuple[str, ...]:
    """The names of all cases, sorted."""
    files = _folder().iterdir()
    return tuple(sorted(f.name.removesuffix(".json") for f in files if f.name.endswith(".json")))


def load(name: str) -> dict[str, Any]:
    """A whole case: its poses, its source and whatever is known about the answer.

    Raises InputError E101 (no such case).
    """
    case: dict[str, Any] = json.loads(read_bytes(name))
    return case


def read_bytes(name: str) -> bytes:
    """A case as it stands in its file (JSON in UTF-8).

    Raises InputError E101 (no such case).
    """
    found: bytes | None = None
    if name.replace("-", "").isalnum() and name == name.lower():  # keeps "../" out of the path
        with suppress(OSError):
            found = get_data("burmester", f"cases/{name}.json")
    if found is None:
        raise InputError(
            "E101",
            f"there is no case {name!r}",
            where=f"case:{name}",
            help=f"take one of these: {', '.join(f'case:{known}' for known in names())}",
        )
    return found


def _folder() -> Traversable:
    from importlib import resources  # 10 ms that a case does without as well

    return resources.files("burmester") / "cases"
