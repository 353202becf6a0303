"""Texts of others on a screen: nothing in them is obeyed, and nothing in them is hidden.

A name of a file or of a pose may hold anything: escape codes of terminals, marks that turn the
direction of writing round, halves of characters, bytes of no encoding.
"""

from __future__ import annotations

from unicodedata import category

_UNSHOWN = ("Cc", "Cf", "Cs", "Zl", "Zp")  # controls, half characters, foreign line ends
_SHORT = {"\n": r"\n", "\r": r"\r", "\t": r"\t"}
_BYTES = range(0xDC80, 0xDD00)  # what Python makes of bytes of a path that are no text


def printable(text: str, keep: str = "") -> str:
    r"""A text in which what a screen would obey or not show is escaped as in Python: `\x1b`.

    A second time changes nothing.  keep: characters left as they are, "\n" say.
    """
    if text.isprintable():
        return text
    return "".join(
        c if c.isprintable() or c in keep or category(c) == "Zs" else _escaped(c) for c in text
    )


def blanked(text: str) -> str:
    """The same with a blank for each, line ends left, so that carets below still point right."""
    if text.isprintable():
        return text
    return "".join(" " if category(c) in _UNSHOWN and c != "\n" else c for c in text)


def _escaped(char: str) -> str:
    number = ord(char)
    if number in _BYTES:
        number -= 0xDC00
    digits = f"\\x{number:02x}" if number < 0x100 else f"\\u{number:04x}"
    return _SHORT.get(char, digits if number < 0x10000 else f"\\U{number:08x}")
