"""What `burmester synthesize --json` printed, read back: the task and its linkages.

A result is input like any other.  Its task and the dimensions of its linkages are read, and the
linkages judged anew: no number and no verdict of the file is taken on trust, and where a verdict
differs a warning says which.  A linkage that cannot be used does not keep the others from being
read.  Of the search, which is not done again, the file's own words are kept.

E101 not readable                        E150 JSON, but not of `synthesize`
E109 not JSON                            E151 no such linkage, or none at all
W244 linkages that are judged otherwise than their file says
"""

from __future__ import annotations

import json
import math
import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np

from burmester.dyads.selection import FoundDyad
from burmester.errors import Advice, InputError
from burmester.fourbar.dyad import PP, Dyad
from burmester.fourbar.linkage_batch import LinkageBatch
from burmester.geometry.displacement import Displacement
from burmester.io.linkage_values import assumed_of, dyad_of, number, text_of
from burmester.io.reading.file_content import read_source
from burmester.io.reading.pose_table import held_float
from burmester.io.reading.poses import read_task
from burmester.io.result import SCHEMA, SEARCH_KEYS
from burmester.printable import printable
from burmester.refinement.tolerance_boxes import counted_error
from burmester.requirements.table import Violation
from burmester.sixbar.found import FoundSixBar
from burmester.synthesis.given_linkage import OpenLink, require_linkage
from burmester.synthesis.judgement import judged_again
from burmester.synthesis.result import Candidate, Outcome, Synthesis
from burmester.tasks.motion_class import classify_motion
from burmester.tasks.motion_task import Task
from burmester.tasks.notation import length_of
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.problem import SynthesisProblem
from burmester.values import shown
from burmester.verdicts.found_linkage import FoundLinkage, Pair
from burmester.wording import listed

if TYPE_CHECKING:
    from burmester.certificates.certificate import Certificate
    from burmester.families.family import Family
    from burmester.functions.found_generator import FoundGenerator

__all__ = [
    "JUDGED_OTHERWISE",
    "SavedResult",
    "judged_otherwise",
    "linkages_by_id",
    "named",
    "outcome_of",
    "read_result",
    "result_tree",
    "unlike",
    "warnings_of",
]

HELP = "make it with `burmester synthesize POSES -o result.json`"
JUDGED_OTHERWISE = "W244"
MOST_DIGITS = 20  # of a whole number; no longer one is written, and Python reads 4,300 at most
MOST_OTHERS = 5  # statements of one warning
LINKAGE_ID, DYAD_ID = re.compile("L[1-9][0-9]{0,6}"), re.compile("[A-Z]{1,3}[1-9][0-9]{0,6}")
WARNING_CODE, OUTCOME_CODE = re.compile("W[0-9]{3}"), re.compile("[ER][0-9]{3}")
# Errors that differ by less are the same: places are found by iteration, and beside a dead point
# rounding moves them.
SAME_ERROR = 1e-6  # of the task's size
SAME_SHARE = 1e-2  # of the error itself
WORKING = ("R300", "R305", "R307", "R308", "R330", "R340", "R350", "R370")
NOT_WORKING = ("R301", "R302", "R304", "R306", "R309", "R331", "R341", "R351", "R352", "R371")
PLACE = ("x", "y", "angle_deg")


class SavedResult(NamedTuple):
    """A result that was read: where it came from, and all that its task and dimensions give.

    refused: the linkages of the file that cannot be used, by id, and why.
    """

    label: str
    synthesis: Synthesis
    refused: Mapping[str, InputError]

    def choose(self, id: str | None = None) -> Candidate:
        """A linkage by its id, or the first, four-bar or six-bar; raises E150, E151."""
        if not (every := self.synthesis.candidates):
            raise InputError(
                "E151",
                "there is no linkage in this result",
                where=self.label,
                help="give poses that have one; "
                f"`burmester explain {self.synthesis.outcome.code}` says more",
            )
        return named(every, id, self.label, self.refused)


_Named = TypeVar("_Named", Candidate, "FoundGenerator")


def named(
    every: Sequence[_Named],
    id: str | None,
    label: str,
    refused: Mapping[str, InputError],
) -> _Named:
    """The one with an id, or the first; raises E151, or why that one was refused."""
    if id is not None and (error := refused.get(id.upper())) is not None:
        raise error
    for each in every:
        if id is None or each.id.lower() == id.lower():
            return each
    raise InputError(
        "E151",
        f"there is no linkage {id} in this result",
        where=label,
        why=f"it has {', '.join(each.id for each in every)}",
        help=f"give --linkage {every[0].id}",
    )


def read_result(source: str | os.PathLike[str], data: bytes | None = None) -> SavedResult:
    """The result in a file, or on standard input ("-"); data: its bytes, where they are known.

    Raises E101, E109 and E150, and what reading the poses of its task raises.
    """
    path = os.fspath(source)
    label = "<stdin>" if path == "-" else printable(path)
    data = read_source(path) if data is None else data
    tree = result_tree(data, label)
    try:
        if tree.get("schema") != SCHEMA:
            raise unlike(f"this is no result of synthesize: its schema is not {SCHEMA}")
        if tree.get("task") is None:
            raise unlike("this result has no task: the poses could not be used")
        if "poses" in tree:
            raise unlike("$.poses stands beside the task of this result")
        task = read_task("-", data=data)
        refused: dict[str, InputError] = {}
        synthesis = _synthesis(tree, task, refused)
    except InputError as error:
        error.where = (error.where or label).replace("<stdin>", label)
        raise
    for each in refused.values():
        each.where = label
    return SavedResult(label, synthesis, refused)


def result_tree(data: bytes, label: str) -> dict[str, Any]:
    """The object in the bytes of a result; raises E103, E109 and E150."""
    try:
        tree = json.loads(
            data, parse_int=_whole_number, parse_float=_finite, parse_constant=_finite
        )
    except InputError as error:
        error.where = label
        raise
    except (ValueError, RecursionError) as error:
        why = printable(str(error))
        raise InputError("E109", "this is not JSON", where=label, why=why, help=HELP) from None
    if not isinstance(tree, dict):
        raise InputError("E150", "this is no result of synthesize", where=label, help=HELP)
    return tree


def _whole_number(digits: str) -> int | float:
    """A whole number; one of more digits than any burmester writes is a float."""
    return int(digits) if len(digits) <= MOST_DIGITS else _finite(digits)


def _finite(digits: str) -> float:
    """A number; ValueError where it is none, or too large to be one, and E103 if too small."""
    if not math.isfinite(value := held_float(digits)):
        raise ValueError(f"{digits[:40]} is no finite number")
    return value


def unlike(message: str, why: str | None = None) -> InputError:
    return InputError("E150", message, why=why, help=HELP)


def _synthesis(tree: dict[str, Any], task: Task, refused: dict[str, InputError]) -> Synthesis:
    """All that a file says of a task, with what its dimensions give; refused: see `SavedResult`."""
    motion = None
    if task.path is None and task.poses.shape[0] > 1:
        motion = classify_motion(task)
    problem = SynthesisProblem.of(task, motion, _options(tree))
    outcome, warnings = outcome_of(tree), warnings_of(tree)
    if isinstance(tree.get("six_bars"), dict):
        from burmester.io.saved_six_bars import six_bars_again

        six_bars, judged = six_bars_again(tree["six_bars"], problem, refused)
        others = [text for each in judged for text in _differences(*each, problem)]
        others += _claims(outcome, any(each.usable for each in six_bars.found))
        warnings += judged_otherwise(others, refused)
        return Synthesis(problem, outcome, warnings=tuple(warnings), six_bars=six_bars)
    dyads = _dyads(tree, task)
    linkages, others = _linkages(tree, problem.merged(), refused)
    others += _claims(outcome, any(each.usable for each in linkages))
    return Synthesis(
        problem,
        outcome,
        dyads,
        linkages,
        (*warnings, *judged_otherwise(others, refused)),
        certificate=_certificate(tree.get("certificate"), dyads),
        family=_family(tree.get("family"), linkages, problem),
        search=_search(tree),
    )


def _search(tree: dict[str, Any]) -> dict[str, Any]:
    """What the file says of the search, for the file that it may be written to again."""
    kept = {key: tree[key] for key in SEARCH_KEYS if key in tree}
    return kept | {key: each for key, each in tree["outcome"].items() if key == "causes"}


def _list(tree: Mapping[str, Any], key: str) -> list[Any]:
    """A list of the file; none where there is none; raises E150."""
    given = tree.get(key, [])
    if not isinstance(given, list):
        raise unlike(f"$.{key} of this result cannot be used", f"it is {shown(given)}, not a list")
    return given


def _message(given: Any, code: re.Pattern[str]) -> tuple[str, str, str | None, str | None] | None:
    """The code, message, help and reason of an outcome or a warning; None of anything else."""
    if not isinstance(given, dict) or not code.fullmatch(str(given.get("code"))):
        return None
    message, help, why = (text_of(given.get(key)) for key in ("message", "help", "why"))
    return None if message is None else (given["code"], message, help, why)


def outcome_of(tree: dict[str, Any]) -> Outcome:
    if (parts := _message(tree.get("outcome"), OUTCOME_CODE)) is None:
        raise unlike("$.outcome of this result cannot be used")
    return Outcome(*parts)


def warnings_of(tree: dict[str, Any]) -> list[Advice]:
    every = [_message(each, WARNING_CODE) for each in _list(tree, "warnings")]
    return [
        Advice(code, text, help or "", why)
        for code, text, help, why in filter(None, every)
        if code != JUDGED_OTHERWISE  # it is said anew
    ]


def _options(tree: dict[str, Any]) -> SynthesisOptions:
    """How the task was solved; of a file of before these were written, as far as it says."""
    given = tree.get("options", {})
    if not isinstance(given, dict):
        raise unlike("$.options of this result cannot be used", f"it is {shown(given)}")
    known = {each.name for each in fields(SynthesisOptions)}
    given = {name: value for name, value in given.items() if name in known}
    if "length_per_radian" not in given:
        given["length_per_radian"] = tree.get("length_per_radian") or None
    try:
        return SynthesisOptions(**given)
    except InputError as error:
        raise unlike("$.options of this result cannot be used", error.message) from None


def _dyad(given: Any, where: str) -> FoundDyad:
    """A dyad of the file, its errors left open; raises E150."""
    try:
        dyad = _dimensions(given, where)
    except InputError as error:
        raise unlike(f"$.{error.message}", error.why) from None
    id = given.get("id")
    if not isinstance(id, str) or not DYAD_ID.fullmatch(id):
        raise unlike(f"$.{where}.id is {shown(id)}, and burmester writes ids such as D1")
    limits = given.get("limits", 0)
    minimum = given.get("minimum", True)
    return FoundDyad(id, dyad, 0.0, 0.0, minimum is True, limits if limits in (1, 2) else 0)


def _dimensions(given: Any, where: str) -> Dyad:
    if not isinstance(given, dict):
        raise unlike(f"{where} is {shown(given)}, not an object")
    if given.get("kind") == "PP":
        angle = number(given.get("angle_deg"), f"{where}.angle_deg")
        return PP(np.asarray(math.radians(angle)))
    dyad = dyad_of(given, where, HELP)
    if isinstance(dyad, OpenLink):
        raise unlike(f"{where}.radius is missing")
    return dyad


def _dyads(tree: dict[str, Any], task: Task) -> tuple[FoundDyad, ...]:
    """The dyads of the file, with their errors at the poses; raises E150."""
    out = []
    for k, given in enumerate(_list(tree, "dyads")):
        found = _dyad(given, f"dyads[{k}]")
        miss = np.abs(found.dyad.residual(task.poses))
        rms, most = float(np.sqrt((miss**2).mean())), float(miss.max())
        out.append(replace(found, rms_error=rms, max_error=most))
    return tuple(out)


def _linkages(
    tree: dict[str, Any], problem: SynthesisProblem, refused: dict[str, InputError]
) -> tuple[tuple[FoundLinkage, ...], list[str]]:
    """The linkages of the file that can be used, judged anew, and where it says otherwise."""
    pairs, stated = list[Pair](), list[tuple[str, dict[str, Any]]]()
    for k, (id, each) in enumerate(linkages_by_id(tree)):
        try:
            pairs.append(_pair(each, k, problem.given))
            stated.append((id, each))
        except InputError as error:
            refused[id] = error
    searched = [each.get("sought") is True for _, each in stated]
    out, others = list[FoundLinkage](), list[str]()
    for (id, each), found in zip(stated, judged_again(problem, pairs, searched), strict=True):
        if found is None:
            refused[id] = unlike(f"linkage {id} has a link without length")
            continue
        found = _as_made(replace(found, id=id), each, problem.given)  # noqa: PLW2901
        out.append(replace(found, rank=len(out) + 1))
        others += _differences(found, each, problem)
    if refused and not out:
        raise next(iter(refused.values()))
    return tuple(out), others


def linkages_by_id(tree: dict[str, Any]) -> list[tuple[str, dict[str, Any]]]:
    """The linkages of a file as it has them, each with its id; raises E150."""
    out: dict[str, dict[str, Any]] = {}
    for k, each in enumerate(_list(tree, "linkages")):
        id = each.get("id") if isinstance(each, dict) else None
        if not isinstance(id, str) or not LINKAGE_ID.fullmatch(id) or id in out:
            why = f"it is {shown(id)}, and each linkage has an id of its own, such as L1"
            raise unlike(f"$.linkages[{k}].id of this result cannot be used", why)
        out[id] = each
    return list(out.items())


def _pair(given: dict[str, Any], number: int, task: Task) -> Pair:
    """The dyads of a linkage, which make one; raises E150."""
    where, dyads = f"linkages[{number}].dyads", given.get("dyads")
    if not isinstance(dyads, list) or len(dyads) != 2:
        raise unlike(f"$.{where} is {shown(dyads)}, not two dyads")
    first, second = (_dyad(each, f"{where}[{k}]") for k, each in enumerate(dyads))
    if first.id == second.id:
        raise unlike(f"$.{where} has {first.id} twice")
    try:
        require_linkage((first.dyad, second.dyad), task)
    except InputError as error:
        raise unlike(f"$.{where}: {error.message}", error.why) from None
    return first, second


def _as_made(found: FoundLinkage, given: dict[str, Any], task: Task) -> FoundLinkage:
    """What a file says of how a linkage was made: whether it was rounded, and how it was before."""
    for each in given["unmet"] if isinstance(given.get("unmet"), list) else ():
        if isinstance(each, dict) and each.get("kind") == "rounding":
            lost = Violation("rounding", text_of(each.get("message")) or "")
            found = replace(found, usable=False, violations=(*found.violations, lost))
    rounded = given.get("rounded")
    rows = rounded.get("coupler_before") if isinstance(rounded, dict) else None
    if isinstance(rows, list) and len(rows) == len(task.poses.angle):
        try:
            places = [[number(row[key], key) for key in PLACE] for row in rows]
        except (InputError, KeyError, TypeError):
            return found
        x, y, angle = np.array(places).T
        before = Displacement(np.stack([x, y], axis=-1), np.radians(angle))
        found = replace(found, error_before_rounding=counted_error(before, task), other_types=())
    return found


def _differences(
    found: FoundLinkage | FoundSixBar, given: dict[str, Any], problem: SynthesisProblem
) -> list[str]:
    """What the file says otherwise of a linkage: whether it is usable, or how near it comes."""
    task, stated = problem.given, given.get("usable")
    if isinstance(stated, bool) and stated is not found.usable:
        if found.usable:
            return [f"{found.id} is usable, and the file says that it is not"]
        reasons = [each.message for each in found.defects]
        reasons += [each.message for each in found.violations]
        return [f"{found.id} is not usable ({reasons[0]}), and the file says that it is"]
    if not found.usable:  # its places depend on rounding, its dyads do not
        return [] if isinstance(found, FoundSixBar) else _dyad_differences(found, given, problem)
    errors, own = given.get("position_error"), float(found.error.position.max())
    said = _number(errors.get("max") if isinstance(errors, dict) else None)
    if _alike(said, own, problem):
        return []
    return [
        f"{found.id} misses a pose by {_told(own, task)}, and the file says {_told(said, task)}"
    ]


def _dyad_differences(
    found: FoundLinkage, given: dict[str, Any], problem: SynthesisProblem
) -> list[str]:
    """The first dyad of a linkage whose dimensions miss the poses otherwise than the file says."""
    said = {each["id"]: _number(each.get("max_error")) for each in given["dyads"]}
    for each in found.dyads:
        if not _alike(said[each.id], each.max_error, problem):
            own, other = (_told(e, problem.given) for e in (each.max_error, said[each.id]))
            return [f"{each.id} of {found.id} misses a pose by {own}, and the file says {other}"]
    return []


def _number(given: Any) -> float:
    """A number of the file, infinite where there is none."""
    return float(given) if isinstance(given, int | float) else math.inf


def _alike(one: float, other: float, problem: SynthesisProblem) -> bool:
    """Whether two errors are the same up to rounding."""
    return abs(one - other) <= SAME_ERROR * problem.length + SAME_SHARE * min(one, other)


def _told(error: float, task: Task) -> str:
    return length_of(error, task) if math.isfinite(error) else "nothing"


def _claims(outcome: Outcome, works: bool) -> list[str]:
    """What the outcome of a file says otherwise: whether anything works."""
    if outcome.code not in (WORKING, NOT_WORKING)[works]:
        return []
    one, other = ("a linkage works", "none does")[:: 1 if works else -1]
    return [f"{one}, and the outcome of the file, {outcome.code}, says that {other}"]


def judged_otherwise(others: Sequence[str], refused: Mapping[str, InputError]) -> list[Advice]:
    """W244, where a file says something else than its task and its dimensions give."""
    others = [*(f"{id} cannot be used" for id in refused), *others]
    if not others:
        return []
    if len(others) > MOST_OTHERS:
        others[MOST_OTHERS:] = [f"{len(others) - MOST_OTHERS} more"]
    return [
        Advice(
            JUDGED_OTHERWISE,
            f"judged anew, {listed(others)}",
            "where the file was edited, that is what its dimensions do; else make it anew with "
            "`burmester synthesize POSES -o result.json`",
            "of a result the task and the dimensions are read, and nothing else is taken on trust",
        )
    ]


def _texts(given: Any) -> tuple[str, ...]:
    """The texts of a list of the file."""
    return tuple(filter(None, map(text_of, given if isinstance(given, list) else ())))


def _certificate(given: Any, dyads: Sequence[FoundDyad]) -> Certificate | None:
    """What is proved, in the file's own words."""
    if not isinstance(given, dict):
        return None
    from burmester.certificates.certificate import Certificate, CertifiedDyad

    every, by_id = given.get("dyads"), {each.id: k for k, each in enumerate(dyads)}
    certified = []
    for each in every if isinstance(every, list) else ():
        index = by_id.get(str(each.get("id"))) if isinstance(each, dict) else None
        if index is None:
            continue
        bounds = [each.get(key) for key in ("radius", "angle_radius_deg")]
        radius, angle = (
            float(bound) if isinstance(bound, int | float) else math.inf for bound in bounds
        )
        kind, flags = type(dyads[index].dyad).__name__, (each.get("proved"), each.get("minimum"))
        proved, minimum = (flag is True for flag in flags)
        own = CertifiedDyad(index, kind, proved, radius, math.radians(angle), minimum)
        certified.append(own)
    return Certificate(
        given.get("complete") is True,
        _texts(given.get("proved")),
        _texts(given.get("numerical")),
        tuple(certified),
    )


def _family(
    given: Any, linkages: Sequence[FoundLinkage], problem: SynthesisProblem
) -> Family | None:
    """How linkages were chosen where the poses leave infinitely many, in the file's own words."""
    if not isinstance(given, dict) or not linkages:
        return None
    from burmester.families.family import Family
    from burmester.linkages.from_dyads import target_of
    from burmester.verdicts.assumptions import Bound

    target = target_of(problem)
    counts = (given.get(key) for key in ("dyads", "pairs"))
    dyads, pairs = (each if isinstance(each, int) else 0 for each in counts)
    return Family(
        text_of(given.get("rule")) or "",
        LinkageBatch.of([each.linkage for each in linkages]).to_canonical(target.frames),
        np.array([each.preferred_driver == "second" for each in linkages], dtype=np.intp),
        np.stack([target.rows_at(each.error.places) for each in linkages]),
        any(each.usable for each in linkages),
        tuple(Bound(*each) for each in assumed_of(given)),
        given.get("given_up") is True,
        dyads,
        pairs,
    )
