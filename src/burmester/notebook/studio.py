"""The widget as Python holds it: a task, its result and the chosen linkage, live both ways."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import resources
from typing import Any

import anywidget
import traitlets
from numpy.typing import ArrayLike

from burmester.api.linkage import ResultLinkage
from burmester.api.result import Result
from burmester.api.synthesize import synthesize, task_of
from burmester.geometry.displacement import Displacement
from burmester.io import templates
from burmester.live.document import document_of, read_file
from burmester.notebook.pages import Pages
from burmester.synthesis.result import Synthesis
from burmester.tasks.motion_task import AngleUnit, Task
from burmester.tasks.option_table import Norm, Preference
from burmester.values import require_instance

OPENS_ON = "chest-lid"  # the template that is shown where no task is given


class Studio(anywidget.AnyWidget):
    """The studio in a cell: drag poses, pick a linkage, play; Python follows, and leads.

    `task`, `result` and `selected` change with what is done in the page, and the page with what
    they are set to.  While a hand drags, `task` follows; `result` and `selected` do when it rests.
    All of it works without a page, too.

    Parameters
    ----------
    task : Task, Displacement or (N, 3) array_like, optional
        What `burmester.synthesize` takes; a constructed lid if not given.
    angle_unit, length_unit, norm, length_per_radian, manufacturing_tolerance, prefer, time_limit
        As in `burmester.synthesize`; they hold for every task that the widget solves.

    Attributes
    ----------
    task : Task
        To set it finds the linkages of another task at once; it takes what `Studio` takes.  A task
        that cannot be solved raises its InputError, and all stays as it was.
    result : Result
        What `burmester.synthesize` says of the task when the hand rests.  To set it shows a result
        that is there already.
    selected : str or None
        The id of the linkage that is shown, such as "L1"; a rank such as 0 may be set as well.

    Raises
    ------
    InputError
        What `burmester.synthesize` raises; E151 where there is no such linkage.

    Examples
    --------
    >>> import burmester
    >>> from burmester.notebook import Studio
    >>> widget = Studio(burmester.read_task("case:motiongen-shoulder"))
    >>> widget.selected, len(widget.result)
    ('L1', 6)
    >>> widget.selected = "L2"
    >>> widget.linkage.type
    'crank-rocker'
    """

    _esm = (resources.files("burmester.web") / "assets" / "notebook.mjs").read_text("utf-8")

    # Raised by a page at each answer and choice: marimo runs cells again where a value changes.
    turn = traitlets.Int(0).tag(sync=True)
    # The selected linkage as a drawing, saved with the notebook: shown where no kernel answers.
    still = traitlets.Unicode("").tag(sync=True)
    task: Any = traitlets.TraitType(None)  # `Any` would let None in without asking the validators
    result: Any = traitlets.TraitType(None)
    selected: Any = traitlets.TraitType(None)

    def __init__(
        self,
        task: Task | Displacement | ArrayLike | None = None,
        *,
        angle_unit: AngleUnit | None = None,
        length_unit: str | None = None,
        norm: Norm = "rms",
        length_per_radian: float | None = None,
        manufacturing_tolerance: float | None = None,
        prefer: Preference = "transmission",
        time_limit: float | None = None,
    ) -> None:
        self._how: dict[str, Any] = {
            "norm": norm,
            "length_per_radian": length_per_radian,
            "manufacturing_tolerance": manufacturing_tolerance,
            "prefer": prefer,
            "time_limit": time_limit,
        }
        if task is None:
            task = read_file(f"{OPENS_ON}.toml", templates.text(OPENS_ON).encode())
        first = self.solved(task_of(task, angle_unit, length_unit))
        self._is_known = threading.local()
        self._pages = Pages(self)
        super().__init__()
        self._pages.begin(first, document_of(first.task))
        with self._known():
            self.result, self.task = first, first.task
            self.selected = first[0].id if len(first) else None
        self._draw()
        self.on_msg(lambda _, message, __: self._pages.hear(message))

    @property
    def linkage(self) -> ResultLinkage | None:
        """The linkage that is selected."""
        result: Result = self.result
        return None if self.selected is None else result[self.selected]

    def solved(self, task: Task, **more: Any) -> Result:
        """The result of a task, with the options of the widget."""
        return synthesize(task, **self._how, **more)

    # Set by Python

    @traitlets.validate("task")
    def _take_task(self, proposal: Any) -> Any:
        if self._knows or proposal.value is self.task:
            return proposal.value
        result = self.solved(task_of(proposal.value, None, None))
        self._is_known.next = result
        return result.task

    @traitlets.observe("task")
    def _show_task(self, change: Any) -> None:
        if not self._knows:
            self._show(self._is_known.next)

    @traitlets.validate("result")
    def _take_result(self, proposal: Any) -> Any:
        if self._knows:
            return proposal.value
        given = proposal.value
        if getattr(given, "six_bars", None) is not None:  # the page is of four-bars
            given = given.six_bars
        require_instance(given, Synthesis, "result", "give what burmester.synthesize returned")
        return given if isinstance(given, Result) else Result.of(given)

    @traitlets.observe("result")
    def _show_result(self, change: Any) -> None:
        if not self._knows:
            self._show(change.new)

    @traitlets.validate("selected")
    def _take_selected(self, proposal: Any) -> Any:
        if self._knows:
            return proposal.value
        require_instance(
            proposal.value, (str, int), "selected", 'give the id of a linkage, such as "L1"'
        )
        return self.result[proposal.value].id

    @traitlets.observe("selected")
    def _show_selected(self, change: Any) -> None:
        if not self._knows:
            self._pages.choose(change.new)
            self._draw()

    def _show(self, result: Result) -> None:
        """Another task with its result, set by Python, on every page."""
        was = self._pages.show(result, document_of(result.task))
        self.follow_answer(result, was)

    # Done in a page

    def follow_answer(
        self, result: Result, was: dict[str, dict[str, Any]], *, is_newest: bool = True
    ) -> None:
        """Another result; was: for its linkages the ids before, where they are the same ones.

        is_newest: whether it is of the task as it is now; a hand may have moved on.
        """
        same = (each for each, before in was.items() if before["id"] == self.selected)
        selected = next(same, result[0].id if len(result) else None)
        with self._known(), self.hold_trait_notifications():
            self.result, self.selected = result, selected
            if is_newest:
                self.task = result.task
        self._draw()

    def follow_hand(self, task: Task) -> None:
        """The task while a hand drags."""
        with self._known():
            self.task = task

    def follow_choice(self, id: str) -> None:
        with self._known():
            self.selected = id
        self._draw()

    @property
    def _knows(self) -> bool:
        """Whether what is being set comes from here, and need not be looked at."""
        return getattr(self._is_known, "here", False)

    @contextmanager
    def _known(self) -> Iterator[None]:
        before, self._is_known.here = self._knows, True
        try:
            yield
        finally:
            self._is_known.here = before

    # Shown where no page is

    def __repr__(self) -> str:
        return f"Studio: {len(self.task.poses.angle)} poses, " + (
            "no linkage" if self.linkage is None else f"selected {self.linkage!r}"
        )

    def _draw(self) -> None:
        shown = self.result if self.linkage is None else self.linkage
        self.still = shown._repr_html_()

    def _repr_mimebundle_(self, **kwargs: Any) -> Any:
        """The widget, and for who shows no widgets the selected linkage as a drawing."""
        whole = super()._repr_mimebundle_(**kwargs)
        bundle, *metadata = whole if isinstance(whole, tuple) else (whole,)
        bundle = {**(bundle or {}), "text/plain": repr(self), "text/html": self.still}
        return (bundle, *metadata) if metadata else bundle
