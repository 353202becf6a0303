"""What came of a task, as a person holds it: to look at, to choose from, to save and hand over."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self, SupportsIndex, final, overload

from burmester.api.linkage import ResultLinkage
from burmester.api.moving_picture import MovingPicture
from burmester.api.python_words import in_python_words
from burmester.api.table import as_html, as_text
from burmester.describe.sentences import best_sentences
from burmester.errors import InputError
from burmester.io import files
from burmester.io.result import json_line, synthesis_data
from burmester.synthesis.result import Synthesis

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["Result"]

LINES = 12  # of a `repr`, at most
SENTENCES = 5  # of these, above the table; `outcome` and `warnings` have them all


@final
@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Result(Synthesis):
    """A `Synthesis` that can be looked at, saved and handed over.

    Iterate over its linkages, ask for one by its id (`result["L2"]`) or by rank (`result[0]`).
    Beside what is listed here it has all of `Synthesis`: task, outcome, dyads, warnings, fits,
    certificate, motion, method, options.

    Examples
    --------
    >>> import burmester
    >>> result = burmester.synthesize(burmester.read_task("case:motiongen-shoulder"))
    >>> len(result), len(result.usable), result["L2"].type
    (6, 3, 'crank-rocker')
    """

    linkages: tuple[ResultLinkage, ...] = ()

    @classmethod
    def of(cls, synthesis: Synthesis) -> Self:
        """A synthesis whose linkages can be drawn and handed over."""
        values = {each.name: getattr(synthesis, each.name) for each in fields(Synthesis)}
        linkages = tuple(map(ResultLinkage.of, synthesis.linkages))
        return cls(**{**values, "linkages": linkages})

    def __iter__(self) -> Iterator[ResultLinkage]:
        return iter(self.linkages)

    def __len__(self) -> int:
        return len(self.linkages)

    def __bool__(self) -> bool:
        return True

    @overload
    def __getitem__(self, which: SupportsIndex | str) -> ResultLinkage: ...

    @overload
    def __getitem__(self, which: slice) -> tuple[ResultLinkage, ...]: ...

    def __getitem__(
        self, which: SupportsIndex | str | slice
    ) -> ResultLinkage | tuple[ResultLinkage, ...]:
        """A linkage by its id ("L2") or by its place in the ranking (from 0); raises E151."""
        outcome, linkages = self.outcome, self.linkages
        if isinstance(which, slice):
            return linkages[which]
        known = [each.id for each in linkages]
        if isinstance(which, str):
            if which.upper() in known:
                return linkages[known.index(which.upper())]
        elif -len(linkages) <= which.__index__() < len(linkages):
            return linkages[which]
        raise InputError(
            "E151",
            f"there is no linkage {which} in this result",
            why=f"it has {', '.join(known)}" if known else outcome.message,
            help=f"choose one of them, such as {known[0]}"
            if known
            else outcome.help or "give other poses",
        )

    @property
    def usable(self) -> tuple[ResultLinkage, ...]:
        """The linkages that work, the best one first."""
        return tuple(each for each in self.linkages if each.usable)

    @property
    def best(self) -> ResultLinkage | None:
        """The best linkage that works; None where none does."""
        return next(iter(self.usable), None)

    def export(
        self,
        path: str | os.PathLike[str],
        linkage: int | str | None = None,
        *,
        to: str | None = None,
        force: bool = False,
        **dimensions: Any,
    ) -> Path:
        """Write one linkage for another program: the first by rank, or the one that is named.

        The rest is as in `ResultLinkage.export`.  Raises E151, too.
        """
        chosen = self[0 if linkage is None else linkage]
        return chosen.export(path, to=to, force=force, **dimensions)

    def plot(self, linkage: int | str | None = None, ax: Axes | None = None) -> Figure:
        """Draw one linkage at its poses by Matplotlib: the first by rank, or the one named."""
        return self[0 if linkage is None else linkage].plot(ax)

    def animate(self, linkage: int | str | None = None, **how: Any) -> MovingPicture:
        """One linkage on its way through the poses: the first by rank, or the one named."""
        return self[0 if linkage is None else linkage].animate(**how)

    def _text(self, answer: Sequence[str] = (), warnings: Sequence[str] = ()) -> str:
        """The result in `LINES` lines at most: the answer, what came of the task, warnings."""
        outcome, linkages = self.outcome, self.linkages
        lines = [*answer, outcome.message, *warnings][:SENTENCES]
        lines += as_text(linkages, LINES - len(lines) - 1)
        return "\n".join(lines)

    def _html(self, answer: Sequence[str] = (), warnings: Sequence[str] = ()) -> str:
        outcome, linkages = self.outcome, self.linkages
        said: list[str] = [outcome.message, *warnings]
        sentences: list[str] = [*answer, *(f"{each}." for each in said)]
        first: str = "".join(f"<p>{escape(each)}</p>" for each in sentences)
        if not linkages:
            return f"<div>{first}</div>"
        table: str = as_html(linkages)
        return f"<div>{first}{table}{linkages[0]._repr_html_()}</div>"

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, str]:
        """In a notebook: text, HTML without scripts, and the first linkage as a drawing."""
        linkages = self.linkages
        drawing = {"image/svg+xml": linkages[0]._drawing()} if linkages else {}
        return {"text/plain": repr(self), "text/html": self._repr_html_(), **drawing}

    def to_json(self) -> str:
        """All of it as one JSON object, as `burmester synthesize --json` prints it."""
        return json_line(synthesis_data(self))

    def save(self, path: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Write it as JSON, for `burmester.read_result` and `burmester export`.

        Raises InputError E140 (the file exists, and force is not set) and E141 (it cannot be
        written).
        """
        with in_python_words():
            files.write(path, self.to_json(), force=force)
        return Path(path)

    def report(
        self, path: str | os.PathLike[str], *, title: str | None = None, force: bool = False
    ) -> Path:
        """Write the page on which the linkages move, one HTML file that needs no network.

        title: the heading, the file's name if not given.  Raises InputError E140 and E141.
        """
        from burmester.report import page  # noqa: PLC0415

        with in_python_words():
            files.require_writable(path, force=force)
            files.write(path, page(self, title or Path(path).stem), force=force)
        return Path(path)

    def __repr__(self) -> str:
        warnings = [f"{each.code}: {each.message}" for each in self.warnings]
        return self._text(best_sentences(self), warnings)

    def _repr_html_(self) -> str:
        return self._html(best_sentences(self), [each.message for each in self.warnings])
