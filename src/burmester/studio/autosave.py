"""What was on the page last, kept on this machine: it is there again after whatever happens.

A file a tab, in the folder for such things of this system; the oldest beyond a few go.
"""

from __future__ import annotations

import hashlib
import os
import sys
import time
from contextlib import suppress
from pathlib import Path
from typing import Any, Final

from burmester.io.files import open_plain, write
from burmester.studio.message import as_json, from_json

MOST_FILES: Final = 20


def folder() -> Path:
    """Where they are kept."""
    home = Path.home()
    if sys.platform == "win32":
        base = Path(os.environ.get("LOCALAPPDATA") or home / "AppData" / "Local")
    elif sys.platform == "darwin":
        base = home / "Library" / "Application Support"
    else:
        base = Path(os.environ.get("XDG_STATE_HOME") or home / ".local" / "state")
    return base / "burmester" / "studio"


def save(given: dict[str, Any]) -> None:
    """Keep a document; raises InputError E141 where there is no place for it."""
    name = given.get("name")
    kept = {
        "name": name if isinstance(name, str) else "task",
        "when": time.time(),
        "document": given.get("document"),
        "options": given.get("options") or {},
        "settings": given.get("settings") or {},
        "picture": given.get("picture"),
    }
    place = folder()
    place.mkdir(mode=0o700, parents=True, exist_ok=True)
    # Names of tabs and tasks may be anything; a digest of them may not.
    digest = hashlib.sha256(f"{given.get('tab')}\n{name}".encode(errors="replace")).hexdigest()
    write(place / f"{digest[:16]}.json", as_json(kept), force=True)
    for each in _kept()[MOST_FILES:]:
        with suppress(OSError):
            each.unlink()


def last() -> dict[str, Any] | None:
    """What was kept last; where that is damaged, what was kept before it."""
    for file in _kept():
        with (
            suppress(OSError, ValueError, RecursionError, TypeError, LookupError),
            open_plain(file, "rb") as opened,
        ):
            kept: dict[str, Any] = from_json(opened.read())
            if isinstance(kept["document"]["poses"], list):
                return kept
    return None


def _kept() -> list[Path]:
    """The files, newest first; those that are still being written are none of them."""
    files = {}
    for each in folder().glob("[!.]*.json"):
        with suppress(OSError):  # another tab has taken it away
            files[each] = each.lstat().st_mtime
    return sorted(files, key=lambda each: files[each], reverse=True)
