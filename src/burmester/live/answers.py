"""The answers of one task while a hand changes it: those of a synthesis, followed from there."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Any, Final

from burmester.errors import InputError
from burmester.following.follow import follow
from burmester.following.followed import Followed
from burmester.live.frames import Drawn, drawn_of, followed_frame
from burmester.live.identity import match_ids, snapshot
from burmester.synthesis.result import Synthesis
from burmester.tasks.motion_task import Task
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.web.branches import branches_of
from burmester.web.data import scene_of

FRAMES: Final = (61, 361)  # of a way of a followed linkage: as a rule, and at most
IN_TURN: Final = 2  # linkages that are judged at each step beside those that are shown


class LiveAnswers:
    """The last synthesis, and where its answers have been followed to.

    document: of a task that is followed or stood at, as `burmester.live.document` has it; only
    whether it is the same as the one before counts.
    """

    def __init__(self) -> None:
        self._synthesis: Synthesis | None = None
        self._answers: Synthesis | Followed | None = None
        self._drawn: dict[str, Drawn] = {}
        self._seen: tuple[Any, dict[str, FoundLinkage]] = None, {}  # drawn last, for a document
        self._turn = 0

    @property
    def synthesis(self) -> Synthesis | None:
        """The last synthesis."""
        return self._synthesis

    def begin_at(self, synthesis: Synthesis | None) -> None:
        """Follow from here; None: there is nothing to follow."""
        self._synthesis = self._answers = synthesis
        self._seen = None, {}
        if synthesis is not None:
            self._drawn = drawn_of(synthesis.problem, synthesis.linkages)

    def restore(self) -> None:
        """Back to the last synthesis, wherever its answers have been followed to."""
        if self._synthesis is not None:
            self.begin_at(self._synthesis)

    def follow(
        self,
        n: int,
        task: Task,
        document: Any,
        shown: Collection[str] = (),
        *,
        frames: int = FRAMES[0],
        every: bool = False,
        start: int | None = None,
    ) -> bytes | str:
        """The last answers, followed to a task, as a frame; or why they cannot be followed there.

        n: the number of the message that asks; start: of that whose answer they go on from.
        shown: the linkages whose ways are wanted, in so many frames; every: judge all linkages.
        """
        followed = self._followed(task, None if every else self._judged(shown))
        if isinstance(followed, str):
            return followed
        self._answers = followed
        assert self._synthesis is not None
        scene = scene_of(self._synthesis)
        motion = {
            each.id: branches_of(each, task.poses, scene, min(max(frames, FRAMES[0]), FRAMES[1]))
            for each in followed.linkages
            if each.id in shown
        }
        before = self._drawn
        answer, self._drawn = followed_frame(n, followed, motion, before, start=start)
        now = {key: each.found for key, each in self._drawn.items()}
        fresh = {
            key: each
            for key, each in now.items()
            if key not in before or before[key].found is not each
        }
        self._seen = document, fresh
        return answer

    def _judged(self, shown: Collection[str]) -> Collection[str]:
        """The linkages that are judged at this step of a hand: those shown, and a few in turn.

        To judge all takes a third of the time.
        """
        if self._answers is None:
            return shown
        ids = [each.id for each in self._answers.linkages if each.id not in shown]
        self._turn = (self._turn + IN_TURN) % max(1, len(ids))
        return {*shown, *(ids + ids)[self._turn : self._turn + IN_TURN]}

    def _followed(self, task: Task, judged: Collection[str] | None = None) -> Followed | str:
        """The last answers at a task; or why they cannot be followed there."""
        if self._answers is None:
            return "there is nothing to follow yet"
        try:
            return follow(self._answers, task, judged=judged)
        except InputError as error:
            if error.code != "E157":
                raise
            return f"{error.message}: {error.why}"

    def stand(self, task: Task, document: Any) -> list[dict[str, Any]]:
        """Where the linkages are at a task, for `match`; it changes nothing.

        What cannot be followed there stands where it stood last.
        """
        found: Synthesis | Followed | str | None = self._followed(task)
        if isinstance(found, str):
            found = self._answers
        seen = self._seen[1] if self._seen[0] == document else {}
        return [] if found is None else snapshot(found.linkages, seen)

    def match(self, before: Sequence[dict[str, Any]]) -> dict[str, dict[str, Any]]:
        """Which linkages of the last synthesis are those that stood elsewhere."""
        return {} if self._synthesis is None else match_ids(before, self._synthesis)
