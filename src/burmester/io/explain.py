"""The page of every code: what `burmester explain` prints, from `messages.md` beside this file.

Nothing here computes, so that an explanation comes at once.  A page is a head `## CODE title`
under the head `# ...` of its family, and below it paragraphs, lists with "- " and blocks
between lines of three backticks.  A block that is a message is drawn as wide as the terminal.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import TYPE_CHECKING, final

from rich.text import Text

from burmester.errors import InputError
from burmester.io.message import LOCATION_HEAD, STYLES, draw, location_lines, wrapped

if TYPE_CHECKING:
    from rich.console import Console
from burmester.wording import listed

MAX_TEXT_COLUMNS = 96  # columns of running text; longer lines are hard to read
MIN_COMMON_CHARACTERS = 2  # characters that a suggested code shares with the one given

_HEAD = re.compile(r"(?:(error|warning|result)\[[A-Z][0-9]{3}\]|  (?:why|help)): ")
_SHOWN = re.compile(r" *[0-9]* \| ")  # a line of the file, or the carets below it
_MARK = re.compile(r"\*\*(.+?)\*\*")


@final
@dataclass(frozen=True, slots=True)
class Page:
    """The explanation of a code; text: Markdown, as in `messages.md`."""

    code: str
    title: str
    family: str
    text: str

    def blocks(self) -> Iterator[tuple[str, str]]:
        """Its parts: ("text", paragraph), ("item", one of a list), ("block", lines as they are)."""
        for k, part in enumerate(self.text.split("\n```")):
            if k % 2:
                yield "block", part.strip("\n")
                continue
            for piece in re.split(r"\n\s*\n|\n(?=- )", part):
                line = " ".join(piece.split())
                if line:
                    item = line.startswith("- ")
                    yield ("item", line.removeprefix("- ")) if item else ("text", line)

    def example(self) -> str | None:
        """The first block, a message as it is printed."""
        return next((text for kind, text in self.blocks() if kind == "block"), None)


@cache
def pages() -> dict[str, Page]:
    """All pages by code, in the order of the file."""
    text = (resources.files("burmester") / "io" / "messages.md").read_text("utf-8")
    by_code, family = {}, ""
    for section in re.split(r"(?m)^(?=##? )", text):
        head, _, body = section.partition("\n")
        if head.startswith("## "):
            code, _, title = head.removeprefix("## ").partition(" ")
            by_code[code] = Page(code, title.strip(), family, body.strip("\n"))
        else:
            family = head.removeprefix("# ").strip()
    return by_code


def page(code: str) -> Page:
    """The page of a code, in small letters or as a message has it, "error[E103]" say.

    Raises InputError E100 where there is no such code; it names the nearest ones.
    """
    known = pages()
    inside = re.search(r"\[(\w+)\]", code)
    given = (inside[1] if inside else code).strip().upper()
    if given in known:
        return known[given]
    near = _nearest(given, known)
    guess = (
        f"try {listed([f'`burmester explain {each}`' for each in near], 'or')}, or " if near else ""
    )
    raise InputError(
        "E100",
        f"there is no code {code!r}",
        help=f"{guess}list all codes with `burmester explain`",
    )


def _nearest(given: str, known: Iterable[str]) -> list[str]:
    """At most three codes that may be meant, the likeliest first."""
    plain = given[:1] + given[1:].replace("O", "0").replace("I", "1").replace("L", "1")
    number = int("".join(filter(str.isdecimal, plain))[:3] or 0)

    def alike(code: str) -> int:
        """In how many places they agree, its letter left out if that is nearer."""
        return max(sum(map(str.__eq__, plain, each)) for each in (code, code[1:]))

    near = sorted(known, key=lambda code: (-alike(code), abs(int(code[1:]) - number), code))[:3]
    return (
        near[:1]
        if plain in near
        else [code for code in near if alike(code) >= MIN_COMMON_CHARACTERS]
    )


def show_page(page: Page, console: Console) -> None:
    """A page, its example as the message would be printed."""
    width = console.width
    lines = wrapped(page.title, min(width, MAX_TEXT_COLUMNS), Text(f"{page.code}  ", style="bold"))
    for line in lines:
        line.stylize("bold")
    before = ""
    for kind, text in page.blocks():
        if not (kind == before == "item"):
            lines.append(Text())
        if kind == "block":
            lines += [Text("  ") + line for line in _block(text, width - 2)]
        elif kind == "item":
            lines += _marked(text, min(width, MAX_TEXT_COLUMNS), "- ")
        else:
            lines += _marked(text, min(width, MAX_TEXT_COLUMNS))
        before = kind
    draw(lines, console)


def show_all(console: Console) -> None:
    """Every code with its title, family by family."""
    width, family = min(console.width, MAX_TEXT_COLUMNS), ""
    lines: list[Text] = []
    for each in pages().values():
        if each.family != family:
            family = each.family
            lines += [Text()] * bool(lines) + [Text(family, style="bold")]
        lines += wrapped(each.title, width, Text(f"  {each.code}  "))
    lines += [Text(), *wrapped("Details of a code: `burmester explain CODE`", width)]
    draw(lines, console)


def _block(text: str, width: int) -> Iterator[Text]:
    """A message as it would be printed, or any other lines."""
    lines = text.split("\n")
    for k, line in enumerate(lines):
        if found := _HEAD.match(line):
            head, sentence = found[0], line[found.end() :]
            yield from wrapped(sentence, width, Text(head, style=STYLES.get(str(found[1]), "bold")))
        elif line.startswith(LOCATION_HEAD):
            end = next((i for i in range(k + 1, len(lines)) if " | " not in lines[i]), len(lines))
            yield from location_lines(
                "\n".join(lines[k:end]).removeprefix(LOCATION_HEAD), width, STYLES["error"]
            )
        elif len(line) <= width and not _SHOWN.match(line):
            yield Text(line)
        elif not _SHOWN.match(line):
            text = line.lstrip()
            yield from wrapped(text, width, line[: len(line) - len(text)])


def _marked(text: str, width: int, head: str = "") -> Iterator[Text]:
    """A paragraph whose first words are in bold where they stand between asterisks."""
    bold = _MARK.match(text)
    lead = Text.assemble(head, (f"{bold[1]} ", "bold") if bold else "")
    yield from wrapped(text[bold.end() :] if bold else text, width, lead, len(head))
