"""What came of a task, as a person holds it: to look at, to choose from, to save and hand over."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self, SupportsIndex, TypeVar, cast, final, overload

from burmester.api.linkage import MovingPicture, ResultLinkage, ResultSixBar, as_type
from burmester.api.python_words import in_python_words
from burmester.api.table import HEADS, NUMBERS, as_text, cells, plain_html
from burmester.describe import six_bar_words
from burmester.describe.sentences import best_sentences
from burmester.io import files
from burmester.io.result import json_line, synthesis_data
from burmester.synthesis.result import Answer, Kind, Synthesis, chosen

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from burmester.synthesis.function_generation import AnySynthesis

LINES = 12  # of a `repr`, at most
SENTENCES = 5  # of these, above the table; `outcome` and `warnings` have them all


class AnyResult(Answer[Kind]):
    """What every result can do, whatever it is a result of."""

    __slots__ = ()

    if TYPE_CHECKING:

        @property
        def candidates(self) -> tuple[Kind, ...]: ...

    @property
    def usable(self) -> tuple[Kind, ...]:
        """Those that work, the best one first."""
        return tuple(each for each in self.candidates if each.usable)

    @property
    def synthesis(self) -> Self:
        """The same, as a search returns it."""
        return self

    @property
    def best(self) -> Kind | None:
        """The best one that works; None where none does."""
        return next(iter(self.usable), None)

    def __iter__(self) -> Iterator[Kind]:
        return iter(self.candidates)

    def __len__(self) -> int:
        return len(self.candidates)

    def __bool__(self) -> bool:
        return True

    @overload
    def __getitem__(self, which: SupportsIndex | str) -> Kind: ...

    @overload
    def __getitem__(self, which: slice) -> tuple[Kind, ...]: ...

    def __getitem__(self, which: SupportsIndex | str | slice) -> Kind | tuple[Kind, ...]:
        """One by its id ("L2") or by its place in the ranking (from 0); raises E151."""
        if isinstance(which, slice):
            return self.candidates[which]
        place = which if isinstance(which, str) else which.__index__()
        return chosen(self.candidates, place, self.outcome)

    def _columns(self) -> tuple[Sequence[str], list[tuple[str, ...]], range]:
        """All linkages: heads, rows, and which columns are numbers."""
        raise NotImplementedError

    def _sentences(self) -> list[str]:
        """What to build, and why it is not another one."""
        raise NotImplementedError

    def __repr__(self) -> str:
        warnings = [f"{each.code}: {each.message}" for each in self.warnings]
        lines = [*self._sentences(), self.outcome.message, *warnings][:SENTENCES]
        return "\n".join([*lines, *as_text(*self._columns(), LINES - len(lines) - 1)])

    def to_dict(self) -> dict[str, Any]:
        """The object of `burmester synthesize --json`."""
        return synthesis_data(cast("AnySynthesis", self))

    def to_json(self) -> str:
        """All of it as one JSON object, as `burmester synthesize --json` prints it."""
        return json_line(self.to_dict())

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
            text = page(cast("AnySynthesis", self), title or Path(path).stem)
            files.write(path, text, force=force)
        return Path(path)


if TYPE_CHECKING:
    from typing_extensions import TypeVar as TypeVarWithDefault

    Linkages = TypeVarWithDefault(
        "Linkages", bound=ResultLinkage | ResultSixBar, default=ResultLinkage
    )
else:
    Linkages = TypeVar("Linkages")


@final
@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Result(AnyResult[Linkages], Synthesis):  # type: ignore[misc]  # usable: of either kind
    """A `Synthesis` that can be looked at, saved and handed over.

    Iterate over its linkages, four-bars or six-bars, ask for one by its id (`result["L2"]`) or by
    rank (`result[0]`).
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
    def of(cls, synthesis: Synthesis) -> Result[Any]:
        """A synthesis whose linkages can be drawn and handed over."""
        six_bars = synthesis.six_bars
        if six_bars is not None:
            found = tuple(as_type(ResultSixBar, each) for each in six_bars.found)
            six_bars = replace(six_bars, found=found)
        linkages = tuple(as_type(ResultLinkage, each) for each in synthesis.linkages)
        return as_type(cls, synthesis, linkages=linkages, six_bars=six_bars)

    @property
    def best(self) -> Linkages | None:
        """The linkage to build, the one six-bar that was given; None where none works."""
        given = self.six_bars is not None and self.six_bars.given
        return next(iter(self.candidates if given else self.usable), None)

    def export(
        self,
        path: str | os.PathLike[str],
        linkage: int | str = 0,
        *,
        to: str | None = None,
        force: bool = False,
        **dimensions: Any,
    ) -> Path:
        """Write one linkage for another program: the first by rank, or the one that is named.

        The rest is as in `ResultLinkage.export`.  Raises E151, too.
        """
        return self[linkage].export(path, to=to, force=force, **dimensions)

    def link(self, address: str = "") -> str:
        """The task as a link, which the studio and every command read in place of a file.

        address: of a studio that others reach; without it the code alone, `t1=...`.
        Raises E117 where the task is too large for a link.
        """
        from burmester.io.reading.link import LinkedTask, write_link  # noqa: PLC0415
        from burmester.live.document import document_of  # noqa: PLC0415

        code = write_link(LinkedTask(document_of(self.task)))
        return f"{address}#{code}" if address else code

    def plot(self, linkage: int | str = 0, ax: Axes | None = None) -> Figure:
        """Draw one linkage at its poses by Matplotlib: the first by rank, or the one named."""
        return self[linkage].plot(ax)

    def animate(self, linkage: int | str = 0, **how: Any) -> MovingPicture:
        """One linkage on its way through the poses: the first by rank, or the one named."""
        return self[linkage].animate(**how)

    def _columns(self) -> tuple[Sequence[str], list[tuple[str, ...]], range]:
        if self.six_bars is None:
            return HEADS, [cells(each) for each in self.linkages], NUMBERS
        rows = [six_bar_words.row(self, each) for each in self.six_bars.found]
        return six_bar_words.HEADS, rows, range(2, 7)

    def _sentences(self) -> list[str]:
        return best_sentences(self)

    def _repr_html_(self) -> str:
        """In a notebook: what to build, all linkages in a table, and the first one drawn."""
        every, messages = self.candidates, [self.outcome, *self.warnings]
        sentences = [*best_sentences(self), *(f"{each.message}." for each in messages)]
        text = "".join(f"<p>{escape(each)}</p>" for each in sentences)
        faint = {k for k, each in enumerate(every) if not each.usable}
        table = plain_html(*self._columns(), faint) + every[0]._repr_html_() if every else ""
        return f"<div>{text}{table}</div>"

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, str]:
        """In a notebook: text, HTML without scripts, and the first linkage as a drawing."""
        drawing = {"image/svg+xml": self[0]._drawing()} if len(self) else {}
        return {"text/plain": repr(self), "text/html": self._repr_html_(), **drawing}
