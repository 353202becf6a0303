"""The cases carried in the package: published tasks, with their source and known answers."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from burmester.errors import InputError

if TYPE_CHECKING:
    from importlib.resources.abc import Traversable

__all__ = ["load", "names", "read_bytes"]


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
    known = names()
    if name not in known:  # also keeps "../" out of the path
        raise InputError(
            "E101",
            f"there is no case {name!r}",
            where=f"case:{name}",
            help=f"take one of these: {', '.join(f'case:{known_name}' for known_name in known)}",
        )
    return (_folder() / f"{name}.json").read_bytes()


def _folder() -> Traversable:
    from importlib import resources  # 10 ms that a pose file does without

    return resources.files("burmester") / "cases"
