"""Task files to start from: one with every key, and constructed tasks from many trades."""

from __future__ import annotations

import re
from importlib import resources

from burmester.errors import InputError

BLANK = "task"  # the file with every key; not counted among the examples


def names() -> tuple[str, ...]:
    """The names of all examples, sorted."""
    files = (resources.files("burmester") / "templates").iterdir()
    found = {f.name.removesuffix(".toml") for f in files if f.name.endswith(".toml")}
    return tuple(sorted(found - {BLANK}))


def of_poses() -> tuple[str, ...]:
    """The names of those whose tasks are poses: no functions, and no curves to trace."""
    return _without(r"\[function\]|path = ")


def _without(lines: str) -> tuple[str, ...]:
    """The names of templates without a line that begins so."""
    other = re.compile(f"(?m)^(?:{lines})")
    return tuple(name for name in names() if not other.search(text(name)))


def text(name: str = BLANK) -> str:
    """A template as it stands in its file (TOML), by default the one with every key.

    Raises InputError E100 (no such template), with the nearest names first, those too whose
    summaries have the words of the name.
    """
    known = names()
    if name not in (*known, BLANK):  # also keeps "../" out of the path
        from difflib import SequenceMatcher

        words = set(re.findall(r"[a-z]+", name.lower()))

        def likeness(other: str) -> float:
            said = re.findall(r"[a-z]+", summary(other).lower())
            alike = SequenceMatcher(None, name.lower(), other).ratio()
            return alike + len(words & set(said)) / max(len(words), 1)

        nearest = sorted(known, key=likeness, reverse=True)
        raise InputError(
            "E100",
            f"there is no template {name!r}",
            help=f"take one of these: {', '.join(nearest)}",
        )
    file = resources.files("burmester") / "templates" / f"{name}.toml"
    return file.read_text(encoding="utf-8")


def summary(name: str) -> str:
    """What a template is about, in the words of its first line."""
    return text(name).partition("\n")[0].removeprefix("# ")
