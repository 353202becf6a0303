"""From poses to six-bars in one call."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, final

from numpy.typing import ArrayLike

from burmester.api.python_words import in_python_words
from burmester.api.synthesize import require_callable, task_of
from burmester.api.table import plain_html
from burmester.describe import six_bar_words
from burmester.errors import Advice, InputError
from burmester.export import Options, export
from burmester.geometry.displacement import Displacement
from burmester.io import files
from burmester.io.result import json_line, synthesis_data
from burmester.progress import Listener, shown
from burmester.sixbar.found import FoundSixBar
from burmester.sixbar.six_bars import CHAINS, SixBarOptions
from burmester.synthesis import six_bars as road
from burmester.synthesis.result import Outcome, Synthesis
from burmester.tasks.motion_task import AngleUnit, Task
from burmester.tasks.options import SynthesisOptions
from burmester.web.still import six_bar_still
from burmester.wording import with_article

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["SixBarResult", "synthesize_six_bars"]


@final
@dataclass(frozen=True, slots=True, eq=False)
class SixBarResult:
    """The six-bars of a task: a sequence of `FoundSixBar`, the best one first.

    Or the one six-bar that `judge` was given.

    Attributes
    ----------
    synthesis : Synthesis
        All that came of the task.
    """

    synthesis: Synthesis

    @property
    def six_bars(self) -> tuple[FoundSixBar, ...]:
        """All of them work, but for one that was given; sound ones come first."""
        found = self.synthesis.six_bars
        return () if found is None else found.found

    @property
    def best(self) -> FoundSixBar | None:
        """The one to build, or the one that was given; None where none was found."""
        return next(iter(self.six_bars), None)

    @property
    def task(self) -> Task:
        """The task as it was given."""
        return self.synthesis.task

    @property
    def outcome(self) -> Outcome:
        """What came of it: a code, a sentence, and what to do where nothing came."""
        return self.synthesis.outcome

    @property
    def warnings(self) -> tuple[Advice, ...]:
        """What was assumed, and what a user should know."""
        return self.synthesis.warnings

    def __iter__(self) -> Iterator[FoundSixBar]:
        return iter(self.six_bars)

    def __len__(self) -> int:
        return len(self.six_bars)

    def __bool__(self) -> bool:
        return True

    def __getitem__(self, which: int | str) -> FoundSixBar:
        """A six-bar by its id ("S2") or by its place in the ranking (from 0); raises E151."""
        known = [each.id for each in self.six_bars]
        if isinstance(which, str) and which.upper() in known:
            return self.six_bars[known.index(which.upper())]
        if isinstance(which, int) and -len(known) <= which < len(known):
            return self.six_bars[which]
        raise InputError(
            "E151",
            f"there is no six-bar {which} in this result",
            why=f"it has {', '.join(known)}" if known else self.outcome.message,
            help=f"choose one of them, such as {known[0]}"
            if known
            else self.outcome.help or "give other poses",
        )

    def plot(self, six_bar: int | str = 0) -> Figure:
        """Draw a six-bar at its poses by Matplotlib; raises E130, E151."""
        from burmester import plot  # noqa: PLC0415  it loads Matplotlib

        return plot.six_bar_figure(self[six_bar], self.task)

    def export(
        self,
        path: str | os.PathLike[str],
        six_bar: int | str = 0,
        *,
        to: str | None = None,
        force: bool = False,
        **options: Any,
    ) -> Path:
        """Write a six-bar for another program, and read the file back; see `burmester.export`.

        options: those of `burmester.export.Options`, such as hole=4 or seconds=4.  Raises E130,
        E140, E141, E151, E161, E162, E163, E198.
        """
        with in_python_words():
            [written] = export(self[six_bar], to, path, Options(**options), force)
        return written

    def to_json(self) -> str:
        """All of it as one JSON object, as `burmester synthesize --six-bars --json` prints it."""
        return json_line(synthesis_data(self.synthesis))

    def save(self, path: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Write the result to a JSON file, which `burmester export` takes; raises E140, E141."""
        with in_python_words():
            files.write(path, self.to_json(), force=force)
        return Path(path)

    def report(
        self, path: str | os.PathLike[str], *, title: str | None = None, force: bool = False
    ) -> Path:
        """Write the page on which the six-bars move, one HTML file that needs no network.

        title: the heading, the file's name if not given.  Raises InputError E140 and E141.
        """
        from burmester.report import page  # noqa: PLC0415

        with in_python_words():
            files.require_writable(path, force=force)
            files.write(path, page(self.synthesis, title or Path(path).stem), force=force)
        return Path(path)

    def __repr__(self) -> str:
        lines = [self.outcome.message]
        if self.best is not None:
            lines.insert(0, six_bar_words.headline(self.best))
            lines += ["  ".join(six_bar_words.row(self.synthesis, each)) for each in self]
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        """In a notebook: what to build, drawn, and all of them in a table."""
        best, said = self.best, [f"{self.outcome.message}."]
        if best is None:
            return f"<div><p>{escape(said[0])}</p></div>"
        said[:0] = [f"{six_bar_words.headline(best)}."]
        text = "".join(f"<p>{escape(each)}</p>" for each in said)
        rows = [six_bar_words.row(self.synthesis, each) for each in self]
        drawing = six_bar_still(best, self.task, f"{best.id}, {with_article(best.type)}")
        return f"<div>{text}{plain_html(six_bar_words.HEADS, rows, range(2, 7))}{drawing}</div>"


def synthesize_six_bars(
    poses: Task | Displacement | ArrayLike,
    *,
    angle_unit: AngleUnit | None = None,
    length_unit: str | None = None,
    chains: int = CHAINS,
    seed: int = 0,
    most: int = 8,
    kind: str = "all",
    time_limit: float | None = None,
    progress: Listener | None = None,
) -> SixBarResult:
    """Six-bars that carry a body through two to five poses, by random search.

    Of Watt's first kind, and of Stephenson's first and third.

    Parameters
    ----------
    poses : Task, Displacement, (N, 3) or (N, 3, 3) array_like
        The motion.  Rows are x, y and angle of the body's frame M, seen in F.  Regions of pivots,
        lengths of cranks, the least transmission angle, the link ratio, a driver that turns fully
        and the order of the poses are parts of a `Task`.
    angle_unit : {"deg", "rad"}
        The unit of the angles of rows; it is never guessed.
    length_unit : str, optional
        The unit of x and y, such as "mm".
    chains : int
        How many 3R chains are drawn at random and made six-bars of each kind.
    seed : int
        Of the random numbers; the same one gives the same answer.
    most : int
        How many six-bars the answer has at most.
    kind : {"all", "Watt I", "Stephenson I", "Stephenson III"}
        Whether six-bars of one kind only are looked for.
    time_limit : float, optional
        Seconds after which no further chains are looked at.
    progress : callable, optional
        Called with a `Progress` at every step.

    Returns
    -------
    SixBarResult
        The six-bars by rank; each has its lengths, `joints` and `body` for any angle of the driver.

    Raises
    ------
    InputError
        E195 (poses that do not fit), E196 (limits or requirements that six-bars do not keep), E197
        (options that make no sense), and what rows of poses raise.

    Examples
    --------
    >>> import burmester
    >>> rows = [(0, 0, 0), (1, 0.3, 8), (2.1, 0.5, 17), (3, 0.9, 25), (4.2, 1.1, 36)]
    >>> result = burmester.synthesize_six_bars(rows, angle_unit="deg", chains=500)
    >>> best = result.best
    >>> bool(best.error.position.max() < 1e-9)
    True
    >>> best.body(best.drive).translation.round(6).tolist()[4]
    [4.2, 1.1]
    """
    require_callable(progress)
    task = task_of(poses, angle_unit, length_unit)
    options = SixBarOptions(chains, seed, most, kind)
    with shown(progress):
        how = SynthesisOptions(time_limit=time_limit)
        return SixBarResult(road.synthesize_six_bars(task, options, how))
