"""What helps, as arguments with their values, and in the words of those who are told.

A text of `Help` speaks to the command line.  Its parts are kept, so that Python and the studio say
the same in their own words: `--within 8`, `within=8`, "a position error of at most 8".
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Self, TypeAlias, final

from burmester.wording import listed


@final
@dataclass(frozen=True, slots=True)
class Cure:
    """An argument that helps, with its value.

    argument: of Python.  value: None where none is proposed.
    option: of the command; by default named as the argument.  text: the value as the option takes
    it.  words: both on a page.  assumed: what holds where nothing is given,
    in words, and its value.
    """

    argument: str
    value: Any = None
    option: str = ""
    text: str = ""
    words: str = ""
    assumed: tuple[str, Any] = ("", None)

    @property
    def is_name(self) -> bool:
        """Whether the command and a page say its name alone."""
        return self.value is None or self.value is True


def for_command(cures: Sequence[Cure]) -> str:
    """Cures on the command line: "--within 8 --driver any"."""
    return " ".join(map(_option, cures))


def _option(cure: Cure) -> str:
    option = cure.option or f"--{cure.argument.replace('_', '-')}"
    return option if cure.is_name else f"{option} {cure.text or _plain(cure.value)}"


def for_python(cures: Sequence[Cure]) -> str:
    """Cures as arguments in Python: 'within=8, driver="any"'."""
    return ", ".join(map(_argument, cures))


def _argument(cure: Cure) -> str:
    if cure.value is None:
        return cure.argument
    if isinstance(cure.value, str | int | float | tuple | frozenset):
        return f"{cure.argument}={_literal(cure.value)}"
    return f"{cure.argument} {cure.value}"


def for_page(cures: Sequence[Cure]) -> str:
    """Cures on a page, which has no options: "a position error of at most 8 and any driver"."""
    return listed([each.words or _named(each) for each in cures])


def _named(cure: Cure) -> str:
    name = cure.argument.replace("_", " ")
    if cure.is_name:
        return name
    several = isinstance(cure.value, tuple | frozenset)
    return f"{name} {cure.text if several else _plain(cure.value)}"


def _plain(value: object) -> str:
    return f"{value:.12g}" if isinstance(value, float) else str(value)


def _literal(value: object) -> str:
    if isinstance(value, tuple):
        return f"({', '.join(map(_literal, value))})"
    if isinstance(value, frozenset):
        return f"{{{', '.join(sorted(map(_literal, value)))}}}"
    return f'"{value}"' if isinstance(value, str) else _plain(value)


Face: TypeAlias = Callable[[Sequence[Cure]], str]
Part: TypeAlias = str | Cure | Sequence[Cure]


@final
class Help(str):
    """What to do, for the command line; it knows its cures, and says them in other words.

    Cures that belong together are one part.

    Examples
    --------
    >>> from burmester.cures import Cure, Help, for_python
    >>> text = Help("give ", Cure("hole", 2.5), ", or leave ", Cure("pin"), " out")
    >>> text
    'give --hole 2.5, or leave --pin out'
    >>> text.said(for_python)
    'give hole=2.5, or leave pin out'
    """

    __slots__ = ("parts",)
    parts: tuple[str | tuple[Cure, ...], ...]

    def __new__(cls, *parts: Part) -> Self:
        flat = tuple(each for part in parts for each in _flat(part))
        self = super().__new__(cls, _said(flat, for_command))
        self.parts = flat
        return self

    def __getnewargs__(self) -> tuple[Any, ...]:
        return self.parts

    @property
    def cures(self) -> list[Cure]:
        """All cures in it."""
        return [cure for part in self.parts if not isinstance(part, str) for cure in part]

    def said(self, face: Face) -> str:
        """The same in the words of a face."""
        return _said(self.parts, face)

    @classmethod
    def of(cls, text: str, *cures: Part) -> Self:
        """A text with a place {} for each cure."""
        first, *rest = text.split("{}")
        return cls(first, *(part for pair in zip(cures, rest, strict=True) for part in pair))

    @classmethod
    def joined(cls, glue: str, texts: Iterable[Part]) -> Self:
        """Texts with a glue between them."""
        return cls(*[part for text in texts for part in (glue, text)][1:])

    @classmethod
    def listed(cls, texts: Sequence[Part], last: str = "and") -> Self:
        """Texts in one phrase, as `wording.listed` has them."""
        *most, end = texts
        return cls(cls.joined(", ", most), f" {last} ", end) if most else cls(end)


def _flat(part: Part) -> tuple[str | tuple[Cure, ...], ...]:
    if isinstance(part, Help):
        return part.parts
    if isinstance(part, str):
        return (part,)
    return ((part,) if isinstance(part, Cure) else tuple(part),)


def _said(parts: Iterable[str | tuple[Cure, ...]], face: Face) -> str:
    return "".join(each if isinstance(each, str) else face(each) for each in parts)


def said(text: str, face: Face) -> str:
    """A text in the words of a face, where it has cures."""
    return text.said(face) if isinstance(text, Help) else text
