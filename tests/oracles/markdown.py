"""Markdown as a reader of the documents meets it: fenced blocks and the prose around them."""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Self

FENCE = re.compile(r"^```(?:(\w*)|\{([\w-]+)\}.*?)\s*$")
COMMENT = re.compile(r"^<!-- (\$|file:|not run:) ?(.*?) ?-->$")


@dataclass(frozen=True)
class Block:
    """One fenced block.

    text ends with a newline; line: the first line inside, from 1; kind: the word behind the fence,
    without its braces;
    comment: the hidden line right before it, as a pair of its mark and the rest, or None.
    """

    text: str
    line: int
    kind: str
    comment: tuple[str, str] | None = None


@dataclass(frozen=True)
class Document:
    """A document's blocks in order, its hidden commands among them, and its prose without them.

    A line `<!-- $ COMMAND -->` is a console block of its own that no reader sees.
    """

    blocks: tuple[Block, ...]
    prose: str

    @classmethod
    def of(cls, path: Path) -> Self:
        """What stands in a file.  AssertionError for a fence that is not closed."""
        return cls.of_text(path.read_text(encoding="utf-8"))

    @classmethod
    def of_text(cls, text: str) -> Self:
        """What stands in a text."""
        blocks: list[Block] = []
        prose: list[str] = []
        inside: list[str] | None = None
        kind, start, comment = "", 0, None
        for number, line in enumerate(text.splitlines(), start=1):
            if inside is not None:
                if line.rstrip() == "```":
                    blocks.append(Block("".join(inside), start, kind, comment))
                    inside, comment = None, None
                else:
                    inside.append(line + "\n")
            elif fence := FENCE.match(line):
                inside, kind, start = [], fence[1] or fence[2] or "", number + 1
            elif hidden := COMMENT.match(line):
                if hidden[1] == "$":
                    blocks.append(Block(f"$ {hidden[2]}\n", number, "console"))
                else:
                    comment = (hidden[1].rstrip(":"), hidden[2])
            else:
                assert not line.startswith("```"), f"line {number}: {line}"
                comment = None
                prose.append(line)
        assert inside is None, f"the block of line {start} is not closed"
        return cls(tuple(blocks), "\n".join(prose))


@dataclass(frozen=True)
class Command:
    """A command of a console block: its text, the lines shown below it, and its line from 1."""

    text: str
    shown: tuple[str, ...]
    line: int


def commands(block: Block) -> list[Command]:
    """The commands of a console block; a backslash at the end of a line continues it."""
    made: list[Command] = []
    continued = False
    for number, line in enumerate(block.text.splitlines(), start=block.line):
        if line.startswith("$ "):
            made.append(Command(line[2:], (), number))
        elif continued:
            last = made.pop()
            made.append(Command(f"{last.text}\n{line.removeprefix('> ')}", (), last.line))
        else:
            assert made, f"line {number}: a console block begins with a command"
            last = made.pop()
            made.append(Command(last.text, (*last.shown, line.rstrip()), last.line))
        continued = not made[-1].shown and made[-1].text.endswith("\\")
    return made


def matches(shown: list[str], printed: list[str]) -> bool:
    """Whether lines are as shown; a line `...` stands for any number of lines."""
    if not shown:
        return not printed
    if shown[0] == "...":
        return any(matches(shown[1:], printed[i:]) for i in range(len(printed) + 1))
    return bool(printed) and shown[0] == printed[0] and matches(shown[1:], printed[1:])
