"""What a worker does: read a task, search it through, follow its answers, hand them over.

It holds the answers of one task: those of the last synthesis, and where they have been
followed to since.
"""

from __future__ import annotations

import base64
import binascii
import json
from collections.abc import Callable
from dataclasses import replace
from time import process_time
from typing import Any, Final, Protocol, TypeAlias

from burmester.cures import for_page
from burmester.diagnosis.pair_checks import pair_findings
from burmester.errors import BurmesterError, InputError
from burmester.io.linkage_file import read_linkage
from burmester.io.reading.functions.function_options import read_links
from burmester.io.reading.outlines.outline_file import OutlineFile, read_curves, read_outline
from burmester.io.result import json_line, synthesis_data
from burmester.io.saved import read_result
from burmester.io.spring_list import in_pairs, springs_in, usual_springs
from burmester.live.advice import advice_data
from burmester.live.answers import FRAMES, LiveAnswers
from burmester.live.document import (
    TaskReader,
    function_document,
    function_of,
    options_of,
    picture_in,
    read_document,
    task_file,
    task_of,
)
from burmester.live.plain import plain
from burmester.progress import shown, timed_by
from burmester.studio.cognates import cognate_reports
from burmester.studio.commands import plain_name
from burmester.studio.curves import curves
from burmester.studio.exports import dyads_of, exported, formats, links_data, report_page
from burmester.studio.message import as_json
from burmester.studio.opening import template
from burmester.studio.placed import placed
from burmester.synthesis.balanced import BalanceRegions, springs_for, with_moved_pivots
from burmester.synthesis.function_generation import generate_function, judge_links
from burmester.synthesis.judgement import judge_linkage
from burmester.synthesis.motion_generation import synthesize
from burmester.synthesis.result import Synthesis
from burmester.synthesis.six_bars import six_bars_of_chains
from burmester.verdicts.found_linkage import FoundLinkage
from burmester.web.data import report_data
from burmester.web.function_data import function_report
from burmester.web.six_bar_data import six_bar_report

Answer: TypeAlias = tuple[dict[str, Any], bytes]

NEVER: Final = "this synthesis cannot be followed"
BESIDE: Final = ("six_bars", "function")  # kinds that are looked for besides four-bars for poses
KNOWN: Final = object()  # the key of what the server kept: result and report of the task


class Job(Protocol):
    """What is asked for: where pieces of the answer go."""

    def send(self, head: dict[str, Any], body: bytes = b"") -> None:
        """Send a piece of the answer."""

    def listen(self, said: object) -> None:
        """Take what is said of the progress."""


class SessionWorker:
    """The answers of one task, and everything that is done with a task."""

    def __init__(self) -> None:
        self._live = LiveAnswers()
        self._reader = TaskReader()

    def do(self, head: dict[str, Any], body: bytes, job: Job) -> Answer:
        """Do what a message says; the answer is a message, too."""
        sizes = head.get("known")
        start = sum(sizes) if sizes else 0
        given = json.loads(body[start:])
        if sizes:
            given[KNOWN] = body[: sizes[0]], body[sizes[0] : start]
        if head["do"] not in HANDLERS:
            raise KeyError(head["do"])
        handler: Callable[[dict[str, Any], Any, Job], Answer] = getattr(self, head["do"])
        return handler(head, given, job)

    def formats(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """The formats of exports."""
        return _json(formats())

    def template(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """A template as a document."""
        return _json(template(given["name"]))

    def read(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """A file that the page sent as a document, and how it was read."""
        data, name = _content(given)
        columns = given.get("columns")
        document, notes = read_document(
            name,
            data,
            angle_unit=given.get("angle_unit"),
            columns=columns if isinstance(columns, str) else None,
            closed=given.get("closed") is True,
        )
        said = [each.to_dict(for_page) for each in notes]
        picture = None
        if name.lower().endswith((".toml", ".json")):
            picture = picture_in(name, data)
        return _json({"document": document, "notes": said, "picture": picture})

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
        return _json({"outline": plain(outline.vertices.tolist()), "notes": [note.to_dict()]})

    def drawing(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """The curves of a drawing that the page sent, to lie behind the plane."""
        data, name = _content(given)
        unit = given.get("length_unit")
        curves = read_curves(OutlineFile(name), unit if isinstance(unit, str) else None, data)
        return _json({"curves": [plain(each.tolist()) for each in curves]})

    def task(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """The task as a file."""
        options_of(given.get("options"))
        name = f"{plain_name(given.get('name'))}.toml"
        text = task_file(given.get("document"), given.get("picture"))
        return {"kind": "file", "name": name}, text.encode()

    def export(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """A linkage of the result in another format."""
        with shown(job.listen):
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
        data = known[1] if known else as_json(report_data(self._solved(head, given), for_page))
        return {"kind": "file", "name": f"{name}.html"}, report_page(data, name)

    def _result(self, head: dict[str, Any], given: Any) -> bytes:
        """The result that the server knows, or the one that is found again.

        Where two dyads are given, what `burmester judge` says of them.
        """
        if (dyads := given.get("dyads")) is not None:
            options = options_of(given.get("options"), head.get("time_limit"))
            judged = judge_linkage(task_of(given.get("document")), dyads_of(dyads), options)
            return json_line(synthesis_data(judged)).encode()
        if known := given.get(KNOWN):
            return bytes(known[0])
        return json_line(synthesis_data(self._solved(head, given))).encode()

    @staticmethod
    def _solved(head: dict[str, Any], given: Any) -> Synthesis:
        if given.get("kind") in BESIDE:
            message = "what was found for this task is not kept any more"
            raise InputError("E151", message, help="look for it once more")
        options = options_of(given.get("options"), head.get("time_limit"))
        return synthesize(task_of(given.get("document")), options)

    def improve(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """One linkage of the result judged by itself, and the nearest better ones."""
        linkage = given.get("linkage")
        saved = read_result("-", data=self._result(head, given))
        chosen = saved.choose(linkage if isinstance(linkage, str) else None)
        assert isinstance(chosen, FoundLinkage)  # the page has no others
        options = options_of(given.get("options"), head.get("time_limit"))
        task = task_of(given.get("document"))
        return _json(
            report_data(judge_linkage(task, chosen.driver_first, options, improve=True), for_page)
        )

    def springs(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """The springs of usual sizes, in a unit of length."""
        single = (each for each in usual_springs(given.get("length_unit")) if each.many == 1)
        return _json([{"name": e.name, "kind": e.kind, **e.numbers} for e in single])

    def linkage(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """The two links of a linkage in a file that the page sent."""
        data, name = _content(given)
        unit = given.get("length_unit")
        found = read_linkage(name, unit=unit if isinstance(unit, str) else None, data=data)
        return _json({"dyads": plain(links_data(found, name))})

    def balance(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """Springs for one linkage of the result, the best first: usual ones, or of a list (CSV).

        "pairs": two of each; "ground", "on_body": boxes in texts; "with_linkage": pivots move, too.
        """
        from burmester.io.balance_table import balance_data, corners_of  # noqa: PLC0415  loads rich

        linkage = given.get("linkage")
        with shown(job.listen):
            saved = read_result("-", data=self._result(head, given))
            assert isinstance(saved.synthesis, Synthesis)
            found = saved.choose(linkage if isinstance(linkage, str) else None)
            listed = _text(given, "springs")
            offers = usual_springs(found.task.length_unit) if listed is None else (
                springs_in(listed.encode("utf-8", "replace"), "the list")
            )  # fmt: skip
            if given.get("pairs") is True:
                offers = in_pairs(offers)
            regions = BalanceRegions(
                corners_of("The box on the ground", _text(given, "ground")),
                corners_of("The box on the body", _text(given, "on_body")),
            )
            springs = springs_for(found, offers, regions)
            if given.get("with_linkage") is True and springs and isinstance(found, FoundLinkage):
                springs += with_moved_pivots(springs[0], saved.synthesis.problem, offers, regions)
                springs.sort(key=lambda each: each.order)
        return _json(balance_data(saved.synthesis, springs))

    def six_bars(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """Six-bars for the poses: the result as a file holds it first, then what the page draws."""
        task, chains = task_of(given.get("document")), given.get("chains")
        with shown(job.listen):
            options = options_of(given.get("options"), head["look_limit"])
            found = six_bars_of_chains(task, chains if type(chains) is int else None, options)
        job.send({"kind": "result"}, json_line(synthesis_data(found)).encode())
        return _json(six_bar_report(found))

    def function(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """Linkages for a function of angles, or one that exists; first the result, as above."""
        task, asked = function_of(given.get("document")), given.get("options") or {}
        with shown(job.listen):
            if isinstance(links := asked.get("links"), str):
                ground, *others = read_links("links", links)
                side = {"left": 1.0, "right": -1.0}.get(str(asked.get("side")))
                a, r, b = others
                found = judge_links(replace(task, ground=ground), (a, r, b), side)
            else:
                found = generate_function(task)
        job.send({"kind": "result"}, json_line(synthesis_data(found)).encode())
        report = function_report(found)
        report["warnings"] += [each.to_dict(for_page) for each in pair_findings(task)]
        return _json({**report, "task": function_document(found.task)})

    def solve(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """The whole search: the result as a file holds it first, then what the page draws."""
        self._live.begin_at(None)
        task = task_of(given.get("document"))
        options = options_of(given.get("options"), head.get("time_limit"))
        with shown(job.listen), timed_by(process_time):  # others may use this machine, too
            synthesis = synthesize(task, options)
        self._live.begin_at(synthesis)
        job.send({"kind": "result"}, json_line(synthesis_data(synthesis)).encode())
        head = {"kind": "solved", "advice": advice_data(synthesis)}
        return head, as_json(report_data(synthesis, for_page))

    def again(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """Back to the last synthesis, wherever its answers have been followed to."""
        self._live.restore()
        return _json({})

    def follow(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """The last answers, followed to the task that the page shows now."""
        document = given.get("document")
        wanted, frames = given.get("shown"), given.get("frames")
        answer = self._live.follow(
            given["n"],
            self._reader.task_of(document),
            document,
            {each for each in wanted if isinstance(each, str)} if isinstance(wanted, list) else (),
            frames=frames if type(frames) is int else FRAMES[0],
            every=given.get("every") is True,
            start=head.get("from"),
        )
        return _not_followed(answer) if isinstance(answer, str) else ({"kind": "frame"}, answer)

    def stand(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """Where the linkages are at a task, for `match`; it changes nothing."""
        document = given.get("document")
        return _json(self._live.stand(task_of(document), document))

    def match(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """Which linkages of this task are those that stood elsewhere."""
        return _json(self._live.match(given))

    def place(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """The dyads of pivots that a hand put somewhere, and what they make."""
        task, options = task_of(given.get("document")), options_of(given.get("options"))
        return {"kind": "placed"}, as_json(placed(task, given.get("pivots"), options, FRAMES[0]))

    def cognates(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """The cognates of a linkage of the last synthesis."""
        found = cognate_reports(self._live.synthesis, given.get("linkage"))
        return {"kind": "cognates"}, as_json(found)

    def curve(self, head: dict[str, Any], given: Any, job: Job) -> Answer:
        """Burmester's curves of four poses."""
        found = curves(task_of(given.get("document")), judged=given.get("judged") is not False)
        return {"kind": "curve"}, as_json(found)


# What is asked for by its name in a message.
HANDLERS: Final = frozenset(each for each in vars(SessionWorker) if each[0] != "_") - {"do"}


def _json(data: object) -> Answer:
    return {"kind": "json"}, as_json(data)


def _text(given: Any, key: str) -> str | None:
    return value if isinstance(value := given.get(key), str) else None


def _not_followed(why: str) -> Answer:
    message = InputError("E157", why).to_dict()
    whole = why.startswith(NEVER)  # not only now: nothing of this synthesis can be followed
    return {"kind": "refused"}, as_json({"messages": [message], "solve": True, "whole": whole})


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
