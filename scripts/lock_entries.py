"""Print the entries of a lock that packages need: themselves, and all that stands under them.

    python scripts/lock_entries.py LOCK GROUP            for a group of pyproject.toml
    python scripts/lock_entries.py LOCK PACKAGE          for a package
    python scripts/lock_entries.py LOCK GROUP --names    the names of the group's packages alone

A lock written by uv says below every entry on whose behalf it stands there (`# via`).
"""

import re
import sys
from pathlib import Path


def entries_of(text):
    """(name, on whose behalf, text) of each entry; a name has several where versions differ."""
    head = re.compile(r"(?m)^(?=[a-z0-9])")
    for entry in head.split(text)[1:]:
        via = entry.partition("# via")[2]
        yield entry.partition("==")[0], set(re.findall(r"(?m)^[ #]*(\S.*)$", via)), entry


def roots_of(entries, wanted):
    """The names that a group asks for, or the one package itself."""
    group = re.compile(rf".* \(pyproject\.toml:{re.escape(wanted)}\)")
    asked = {name for name, via, _ in entries if any(map(group.fullmatch, via))}
    return asked or {name for name, _, _ in entries if name == wanted}


def needed_by(entries, roots):
    """All names that some of the roots need, with the roots."""
    names, more = set(), set(roots)
    while more:
        names |= more
        more = {name for name, via, _ in entries if via & more} - names
    return names


if __name__ == "__main__":
    lock, wanted, *option = sys.argv[1:]
    entries = list(entries_of(Path(lock).read_text("utf-8")))
    roots = roots_of(entries, wanted)
    if not roots:
        sys.exit(f"lock_entries: {lock} has neither a group nor a package {wanted!r}")
    if option == ["--names"]:
        print(*sorted(roots), sep="\n")
    else:
        names = needed_by(entries, roots)
        print(*(entry for name, _, entry in entries if name in names), sep="", end="")
