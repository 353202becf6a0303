"""What a worker does: read a task, go the whole road with it, follow its answers, hand them over.

One road holds the answers of one task: those of the last synthesis, and where they have been
followed to since.
"""

from __future__ import annotations

import base64
import binascii
import json
from collections.abc import Callable
from pathlib import PurePath
from typing import Any, Protocol, TypeAlias

from burmester.errors import BurmesterError, InputError
from burmester.following.follow import follow
from burmester.following.followed import Followed
from burmester.io import templates
from burmester.io.result import json_line, message_data, synthesis_data
from burmester.io.reading.poses import read_task
from burmester.progress import shown
from burmester.studio.document import document_of, options_of, read_file, task_of
from burmester.studio.exports import formats
from burmester.studio.frames import followed_frame
from burmester.studio.parcel import as_json
from burmester.synthesis.motion_generation import synthesize
from burmester.synthesis.result import Synthesis
from burmester.web.branches import branches_of
from burmester.web.data import report_data, scene_of

__all__ = ["Road"]

Answer: TypeAlias = tuple[dict[str, Any], bytes]


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

    def do(self, head: dict[str, Any], body: bytes, job: Job) -> Answer:
        """Do what a parcel says; the answer is a parcel, too."""
        if head["do"] == "open":
            return self.open(head, body)
        given = json.loads(body)
        return _DEEDS[head["do"]](self, head, given, job)

    def open(self, head: dict[str, Any], data: bytes) -> Answer:
        """The task that the studio opens on: a file of this machine, or a template."""
        if (path := head["path"]) is None:
            name = head["template"]
            task = read_file(f"{name}.toml", templates.text(name).encode())
        else:
            name = PurePath(path.removeprefix("case:")).stem if path != "-" else "task"
            task = read_task(path, data=data if path == "-" else None)
        start = {"document": document_of(task), "options": {}, "name": name, "exports": formats()}
        return _json(start)

    def template(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """A template as a document."""
        name = given["name"]
        task = read_file(f"{name}.toml", templates.text(name).encode())
        return _json({"document": document_of(task), "options": {}, "name": name})

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

    def solve(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """The whole road: the result as a file holds it first, then what the page draws."""
        task = task_of(given.get("document"))
        options = options_of(given.get("options"), head.get("time_limit"))
        with shown(job.listen):
            synthesis = synthesize(task, options)
        self._synthesis = self._answers = synthesis
        job.send({"kind": "result"}, json_line(synthesis_data(synthesis)).encode())
        return {"kind": "solved"}, as_json(report_data(synthesis))

    def follow(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """The last answers, followed to the task that the page shows now."""
        if self._answers is None:
            return _not_followed("there is nothing to follow yet")
        task = task_of(given.get("document"))
        try:
            followed = follow(self._answers, task)
        except InputError as error:
            if error.code != "E157":
                raise
            return _not_followed(f"{error.message}: {error.why}")
        self._answers = followed
        wanted = given.get("shown") or []
        frames = min(max(int(given.get("frames") or 61), 11), 361)
        assert self._synthesis is not None
        scene = scene_of(self._synthesis)
        motion = {
            each.id: branches_of(each, task.poses, scene, frames)
            for each in followed.linkages
            if each.id in wanted
        }
        return {"kind": "frame"}, followed_frame(given["n"], followed, motion)


_DEEDS: dict[str, Callable[[Road, dict[str, Any], Any, Job], Answer]] = {
    "template": Road.template,
    "read": Road.read,
    "check": Road.check,
    "solve": Road.solve,
    "follow": Road.follow,
}


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
