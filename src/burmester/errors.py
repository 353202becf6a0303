"""What burmester raises, as a tree.

    BurmesterError
    └── InputError      something the caller gave cannot be used (exit code 2)

Every error says what happened, where, why and what to do.  The command line, the JSON
object and Python callers get the same five fields.
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import Any, final

from burmester.cures import Face, for_command, said


class BurmesterError(Exception):
    """An error that a user can act on.

    Attributes
    ----------
    code : str
        Stable, and may be relied on; `burmester explain CODE` has its page.
    message : str
        What happened.
    where : str or None
        A file with line and column, and the line itself.
    why : str or None
        The reason, with numbers.
    help : str or None
        What to do: it works when it is followed to the letter.

    Examples
    --------
    >>> import burmester
    >>> try:
    ...     burmester.read_task("case:no-such-case")
    ... except burmester.BurmesterError as error:
    ...     print(error.code, error.exit_code)
    E101 2
    """

    exit_code = 3

    def __init__(
        self,
        code: str,
        message: str,
        *,
        where: str | None = None,
        why: str | None = None,
        help: str | None = None,
    ) -> None:
        super().__init__(message)
        self.code = code
        self.message = message
        self.where = where
        self.why = why
        self.help = help

    def to_dict(self, face: Face = for_command) -> dict[str, str | None]:
        """The five fields as JSON has them, or as another face says what helps."""
        return _fields(self, ("code", "message", "where", "why", "help"), face)

    def __str__(self) -> str:
        lines = [f"error[{self.code}]: {self.message}"]
        if self.where:
            lines.append(f"  --> {self.where}")
        if self.why:
            lines.append(f"  why: {self.why}")
        if self.help:
            lines.append(f"  help: {self.help}")
        return "\n".join(lines)


class InputError(BurmesterError):
    """Bad input or usage: nothing was computed and nothing was written.

    Examples
    --------
    >>> import burmester
    >>> burmester.synthesize([(0, 0, 0), (1, 1, 20), (3, 2, 40)])
    Traceback (most recent call last):
        ...
    burmester.errors.InputError: error[E110]: the angle unit is not stated
      why: the unit of angles is never guessed
      help: say angle_unit="deg" or angle_unit="rad"
    """

    exit_code = 2


@final
@dataclass(frozen=True, slots=True)
class Advice:
    """A stable code with its sentence, and what to do: a warning, or the outcome of a task.

    why: with numbers.
    """

    code: str
    message: str
    help: str | None = None
    why: str | None = None

    def to_dict(self, face: Face = for_command) -> dict[str, str | None]:
        """The four fields as JSON has them, or as another face says what helps."""
        return _fields(self, ("code", "message", "why", "help"), face)


@final
@dataclass(frozen=True, slots=True)
class Finding:
    """What is wrong with a linkage: a defect of its motion, or what it does not keep of a task.

    kind: "assembly", "circuit", "branch", "order", "degenerate" or "stray" of a defect; else the
        kind of a limit or a requirement.
    message: in words that follow "it".
    poses: the numbers, from 0, of the poses concerned: those missed (assembly), on the circuit with
        fewer poses (circuit), on both sides of a dead point (branch), out of order (order), on
        both sides of gaps in which the path is left (stray); none where the dimensions themselves
        are at fault (degenerate).
    certain: False where rounding or a nearby dead point leaves the verdict open.
    """

    kind: str
    message: str
    poses: tuple[int, ...] = ()
    certain: bool = True

    @property
    def code(self) -> str:
        """Its kind as a code."""
        return self.kind.replace(" ", "-")


def _fields(of: object, names: tuple[str, ...], face: Face) -> dict[str, str | None]:
    values = {name: getattr(of, name) for name in names}
    return {name: value and said(value, face) for name, value in values.items()}


def library(name: str, purpose: str, extra: str) -> Any:
    """A library that comes with an extra; raises E130 where it cannot be imported."""
    try:
        return import_module(name)
    except ImportError:
        raise InputError(
            "E130",
            f"{purpose} needs {name}",
            why="it cannot be imported",
            help=f'pip install "burmester[{extra}]"',
        ) from None
