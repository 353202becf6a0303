"""What a worker does: read a task, go the whole road with it, follow its answers, hand them over.

One road holds the answers of one task: those of the last synthesis, and where they have been
followed to since.
"""

from __future__ import annotations

import base64
import binascii
import json
from collections.abc import Callable, Collection
from typing import Any, Final, Protocol, TypeAlias

from burmester.errors import BurmesterError, InputError
from burmester.following.follow import follow
from burmester.following.followed import Followed
from burmester.io.reading.outlines.outline_file import OutlineFile, read_outline
from burmester.io.result import json_line, message_data, synthesis_data
from burmester.io.saved import read_result
from burmester.linkages.found_linkage import FoundLinkage
from burmester.progress import shown
from burmester.studio.curves import curves
from burmester.studio.document import (
    TaskReader,
    document_of,
    options_of,
    read_file,
    task_file,
    task_of,
)
from burmester.studio.exports import exported, formats, report_page
from burmester.studio.frames import Drawn, drawn_of, followed_frame
from burmester.studio.identity import matched, standing
from burmester.studio.names import plain_name
from burmester.studio.opening import template
from burmester.studio.parcel import as_json, plain
from burmester.studio.placed import placed
from burmester.synthesis.judgement import judge_linkage
from burmester.synthesis.motion_generation import synthesize
from burmester.synthesis.result import Synthesis
from burmester.tasks.motion_task import Task
from burmester.web.branches import branches_of
from burmester.web.data import report_data, scene_of

__all__ = ["Road"]

Answer: TypeAlias = tuple[dict[str, Any], bytes]

FRAMES: Final = (61, 361)  # of a way of a followed linkage: as a rule, and at most
IN_TURN: Final = 2  # linkages that are judged at each step beside those that are shown
KNOWN: Final = object()  # the key of what the server kept: result and report of the task


class Job(Protocol):
    """What is asked for: where pieces of the answer go."""

    def send(self, head: dict[str, Any], body: bytes = b"") -> None:
        """Send a piece of the answer."""

    def listen(self, said: object) -> None:
        """Take what is said of the progress."""


class Road:
    """The answers of one task, and everything that is done with a task."""

    def __init__(self) -> None:
        self._synthesis: Synthesis | None = None
        self._answers: Synthesis | Followed | None = None
        self._drawn: dict[str, Drawn] = {}
        self._seen: tuple[Any, dict[str, FoundLinkage]] = None, {}  # drawn last, for a document
        self._reader = TaskReader()
        self._turn = 0

    def do(self, head: dict[str, Any], body: bytes, job: Job) -> Answer:
        """Do what a parcel says; the answer is a parcel, too."""
        sizes = head.get("known")
        start = sum(sizes) if sizes else 0
        given = json.loads(body[start:])
        if sizes:
            given[KNOWN] = body[: sizes[0]], body[sizes[0] : start]
        return _DEEDS[head["do"]](self, head, given, job)

    def formats(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """The formats of exports."""
        return _json(formats())

    def template(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """A template as a document."""
        return _json(template(given["name"]))

    def read(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """A file that the page sent as a document, and how it was read."""
        data, name = _content(given)
        task = read_file(name, data, angle_unit=given.get("angle_unit"))
        notes = [message_data(each) for each in task.notes]
        return _json({"document": document_of(task), "notes": notes})

    def check(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """Nothing, if document and options can be read."""
        task_of(given.get("document"))
        options_of(given.get("options"))
        return _json({"messages": []})

    def outline(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """The outline in a drawing that the page sent."""
        data, name = _content(given)
        part, unit = given.get("part"), given.get("length_unit")
        file = OutlineFile(name, part if isinstance(part, str) else None)
        outline, note = read_outline(file, "", unit if isinstance(unit, str) else None, data)
        return _json({"outline": plain(outline.vertices.tolist()), "notes": [message_data(note)]})

    def task(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """The task as a file."""
        options_of(given.get("options"))
        name = f"{plain_name(given.get('name'))}.toml"
        return {"kind": "file", "name": name}, task_file(given.get("document")).encode()

    def export(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """A linkage of the result in another format."""
        data, name = exported(self._result(head, given), given)
        return {"kind": "file", "name": name}, data

    def result(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """The result as a file."""
        name = f"{plain_name(given.get('name'))}.json"
        return {"kind": "file", "name": name}, self._result(head, given)

    def report(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """The page of the result, as a file."""
        name = plain_name(given.get("name"))
        known = given.get(KNOWN)
        data = known[1] if known else as_json(report_data(self._solved(head, given)))
        return {"kind": "file", "name": f"{name}.html"}, report_page(data, name)

    def _result(self, head: dict[str, Any], given: Any) -> bytes:
        """The result that the server knows, or the one that is found again."""
        if known := given.get(KNOWN):
            return bytes(known[0])
        return json_line(synthesis_data(self._solved(head, given))).encode()

    @staticmethod
    def _solved(head: dict[str, Any], given: Any) -> Synthesis:
        options = options_of(given.get("options"), head.get("time_limit"))
        return synthesize(task_of(given.get("document")), options)

    def improve(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """One linkage of the result judged by itself, and the nearest better ones."""
        linkage = given.get("linkage")
        saved = read_result("-", data=self._result(head, given))
        chosen = saved.choose(linkage if isinstance(linkage, str) else None)
        options = options_of(given.get("options"), head.get("time_limit"))
        task = task_of(given.get("document"))
        return _json(report_data(judge_linkage(task, chosen.linkage, options, improve=True)))

    def solve(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """The whole road: the result as a file holds it first, then what the page draws."""
        self._synthesis = self._answers = None
        task = task_of(given.get("document"))
        options = options_of(given.get("options"), head.get("time_limit"))
        with shown(job.listen):
            synthesis = synthesize(task, options)
        self._begin_at(synthesis)
        job.send({"kind": "result"}, json_line(synthesis_data(synthesis)).encode())
        return {"kind": "solved"}, as_json(report_data(synthesis))

    def again(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """Back to the last synthesis, wherever its answers have been followed to."""
        if self._synthesis is not None:
            self._begin_at(self._synthesis)
        return _json({})

    def _begin_at(self, synthesis: Synthesis) -> None:
        """Follow from here."""
        self._synthesis = self._answers = synthesis
        self._seen = None, {}
        self._drawn = drawn_of(synthesis.problem, synthesis.linkages)

    def follow(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """The last answers, followed to the task that the page shows now."""
        task = self._reader.task_of(given.get("document"))
        wanted, asked = given.get("shown"), given.get("frames")
        shown = (
            {each for each in wanted if isinstance(each, str)} if isinstance(wanted, list) else ()
        )
        followed = self._followed(task, None if given.get("every") is True else self._judged(shown))
        if isinstance(followed, str):
            return _not_followed(followed)
        self._answers = followed
        frames = min(max(asked, FRAMES[0]), FRAMES[1]) if type(asked) is int else FRAMES[0]
        assert self._synthesis is not None
        scene = scene_of(self._synthesis)
        motion = {
            each.id: branches_of(each, task.poses, scene, frames)
            for each in followed.linkages
            if each.id in shown
        }
        before = self._drawn
        answer, self._drawn = followed_frame(
            given["n"], followed, motion, before, start=head.get("from")
        )
        now = {key: each.found for key, each in self._drawn.items()}
        fresh = {
            key: each
            for key, each in now.items()
            if key not in before or before[key].found is not each
        }
        self._seen = given.get("document"), fresh
        return {"kind": "frame"}, answer

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

    def stand(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """Where the linkages are at a task, for `match`; it changes nothing.

        What cannot be followed there stands where it stood last.
        """
        document = given.get("document")
        found: Synthesis | Followed | str | None = self._followed(task_of(document))
        if isinstance(found, str):
            found = self._answers
        seen = self._seen[1] if self._seen[0] == document else {}
        return _json([] if found is None else standing(found.linkages, seen))

    def match(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """Which linkages of this task are those that stood elsewhere."""
        if self._synthesis is None:
            return _json({})
        return _json(matched(given, self._synthesis))

    def place(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """The dyads of pivots that a hand put somewhere, and what they make."""
        task, options = task_of(given.get("document")), options_of(given.get("options"))
        return {"kind": "placed"}, as_json(placed(task, given.get("pivots"), options, FRAMES[0]))

    def curve(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """Burmester's curves of four poses."""
        found = curves(task_of(given.get("document")), judged=given.get("judged") is not False)
        return {"kind": "curve"}, as_json(found)


_DEEDS: dict[str, Callable[[Road, dict[str, Any], Any, Job], Answer]] = {
    name: getattr(Road, name)
    for name in (
        *(
            "formats",
            "template",
            "read",
            "outline",
            "check",
            "task",
            "export",
            "result",
            "report",
            "improve",
        ),
        *("solve", "again", "follow", "stand", "match", "place", "curve"),
    )
}


def _ids(given: Any) -> set[str]:
    """The names in a list that the page sent."""
    return {each for each in given if isinstance(each, str)} if isinstance(given, list) else set()


def _json(data: object) -> Answer:
    return {"kind": "json"}, as_json(data)


def _not_followed(why: str) -> Answer:
    message = {"code": "E157", "message": why, "where": None, "why": None, "help": None}
    return {"kind": "refused"}, as_json({"messages": [message], "solve": True})


def _content(given: Any) -> tuple[bytes, str]:
    """The bytes of a file that the page sent, and its name; or a text that was pasted."""
    text, coded = given.get("text"), given.get("base64")
    if isinstance(text, str):
        return text.encode("utf-8", "replace"), "pasted"
    try:
        data = base64.b64decode(coded, validate=True) if isinstance(coded, str) else None
    except (ValueError, binascii.Error):
        data = None
    if data is None:
        raise BurmesterError("E101", "the file did not arrive whole", help="open it once more")
    name = given.get("name")
    return data, name if isinstance(name, str) else "file"
