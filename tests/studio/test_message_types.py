"""Messages between a page and the server are of the kinds that both sides name."""

import re
from importlib import resources
from typing import get_args

from burmester.studio.session import HAND, LOOK, SEARCH, Kind

TYPES = resources.files("burmester.web") / "widget" / "types.d.ts"


def named(interface, key):
    """The texts that a key of an interface may be."""
    text = TYPES.read_text(encoding="utf-8")
    body = text[text.index(f"interface {interface} ") :]
    return set(re.findall(r'"(\w+)"', body[body.index(f"  {key}:") : body.index(";\n  [")]))


def test_a_page_asks_what_the_server_does():
    assert named("Asked", "do") == {*HAND, *SEARCH, *LOOK}


def test_a_page_knows_what_the_server_tells():
    kinds = {kind for part in get_args(Kind) for kind in get_args(part) or [part]}
    assert named("Told", "kind") == kinds
