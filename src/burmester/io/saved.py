"""What the commands printed with --json, read back: the task and its linkages, of any kind.

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
from typing import TYPE_CHECKING, Any, NamedTuple, get_args

import numpy as np

from burmester.dyads.selection import FoundDyad
from burmester.errors import Advice, Finding, InputError
from burmester.fourbar.dyad import PP, Dyad
from burmester.geometry.displacement import Displacement
from burmester.io.linkage_data import FUNCTION_SCHEMA
from burmester.io.linkage_values import assumed_of, dyad_of, fault, number, text_of
from burmester.io.reading.file_content import read_source
from burmester.io.reading.pose_table import held_float
from burmester.io.reading.poses import read_task
from burmester.io.result import SCHEMA, SEARCH_KEYS
from burmester.printable import printable
from burmester.refinement.tolerance_boxes import counted_error
from burmester.synthesis.given_linkage import OpenLink, require_linkage
from burmester.synthesis.judgement import judged_again
from burmester.synthesis.result import Candidate, Outcome, Synthesis, chosen
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
    from burmester.sixbar.found import FoundSixBar
    from burmester.sixbar.six_bars import SixBars
    from burmester.synthesis.function_generation import AnySynthesis, FunctionSynthesis

HELP = "make it with `burmester synthesize POSES -o result.json`"
JUDGED_OTHERWISE = "W244"
MOST_DIGITS = 20  # of a whole number; no longer one is written, and Python reads 4,300 at most
COUNTS = ("expected", "found", "real")
MOST_OTHERS = 5  # statements of one warning
LINKAGE_ID, DYAD_ID = re.compile("[LS][1-9][0-9]{0,6}"), re.compile("[A-Z]{1,3}[1-9][0-9]{0,6}")
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
    synthesis: AnySynthesis
    refused: Mapping[str, InputError]

    def choose(self, id: str | None = None, option: str = "--linkage") -> Any:
        """A linkage of any kind by its id, or the first; raises E150, E151."""
        if id is not None and (error := self.refused.get(id.upper())) is not None:
            raise error
        try:
            every = list[Any](self.synthesis.candidates)
            return chosen(every, id, self.synthesis.outcome, f"give {option}")
        except InputError as error:
            error.where = self.label
            raise

    def exported(self, id: str | None = None, option: str = "--linkage") -> Candidate:
        """The same as exports take it: of a function generator the coupler is the body."""
        return self.synthesis.exported(self.choose(id, option))


def read_result(source: str | os.PathLike[str], data: bytes | None = None) -> SavedResult:
    """The result in a file, or on standard input ("-"); data: its bytes, where they are known.

    Raises E101, E109 and E150, and what reading its task raises.
    """
    path = os.fspath(source)
    label = "<stdin>" if path == "-" else printable(path)
    data = read_source(path) if data is None else data
    refused: dict[str, InputError] = {}
    try:
        tree = _tree(data)
        schema = tree.get("schema")
        functions = isinstance(schema, str) and schema.startswith(FUNCTION_SCHEMA.partition("/")[0])
        synthesis = _functions(tree, refused) if functions else _synthesis(tree, data, refused)
    except InputError as error:
        error.where = (error.where or label).replace("<stdin>", label)
        raise
    for each in refused.values():
        each.where = label
    return SavedResult(label, synthesis, refused)


def _tree(data: bytes) -> dict[str, Any]:
    """The object in the bytes of a result; raises E103, E109 and E150."""
    try:
        tree = json.loads(
            data, parse_int=_whole_number, parse_float=_finite, parse_constant=_finite
        )
    except (ValueError, RecursionError) as error:
        raise InputError("E109", "this is not JSON", why=printable(str(error)), help=HELP) from None
    if not isinstance(tree, dict):
        raise _bad_result("this is no result of synthesize")
    return tree


def _whole_number(digits: str) -> int | float:
    """A whole number; one of more digits than any burmester writes is a float."""
    return int(digits) if len(digits) <= MOST_DIGITS else _finite(digits)


def _finite(digits: str) -> float:
    """A number; ValueError where it is none, or too large to be one, and E103 if too small."""
    if not math.isfinite(value := held_float(digits)):
        raise ValueError(f"{digits[:40]} is no finite number")
    return value


def _bad_result(message: str, why: str | None = None) -> InputError:
    return InputError("E150", message, why=why, help=HELP)


def _synthesis(tree: dict[str, Any], data: bytes, refused: dict[str, InputError]) -> Synthesis:
    """All that a file says of a task, with what its dimensions give; refused: see `SavedResult`."""
    if tree.get("schema") != SCHEMA:
        raise _bad_result(f"this is no result of synthesize: its schema is not {SCHEMA}")
    if tree.get("task") is None:
        raise _bad_result("this result has no task: the poses could not be used")
    if "poses" in tree:
        raise _bad_result("$.poses stands beside the task of this result")
    task = read_task("-", data=data)
    motion = None
    if task.path is None and task.poses.shape[0] > 1:
        motion = classify_motion(task)
    problem = SynthesisProblem.of(task, motion, _options(tree))
    outcome, warnings = _outcome(tree), _warnings(tree)
    if isinstance(tree.get("six_bars"), dict):
        six_bars, others = _six_bars(tree["six_bars"], problem, refused)
        others += _claims(outcome, any(each.usable for each in six_bars.found))
        warnings += _judged_otherwise(others, refused)
        return Synthesis(problem, outcome, warnings=tuple(warnings), six_bars=six_bars)
    every = enumerate(_list(tree, "dyads"))
    dyads = tuple(_dyad(each, f"dyads[{k}]").at(task.poses) for k, each in every)
    linkages, others = _linkages(tree, problem.merged(), refused)
    others += _claims(outcome, any(each.usable for each in linkages))
    return Synthesis(
        problem,
        outcome,
        dyads,
        linkages,
        (*warnings, *_judged_otherwise(others, refused)),
        certificate=_certificate(tree.get("certificate"), dyads),
        family=_family(tree.get("family")) if linkages else None,
        # For the file that it may be written to again.
        search={key: tree[key] for key in SEARCH_KEYS if key in tree}
        | {key: each for key, each in tree["outcome"].items() if key == "causes"},
    )


def _functions(tree: dict[str, Any], refused: dict[str, InputError]) -> FunctionSynthesis:
    """The same of a function task."""
    from burmester.functions.found_generator import found_generators
    from burmester.io.function_result import generator_of
    from burmester.io.reading.functions.function_file import task_of
    from burmester.io.reading.pose_table import Source
    from burmester.io.reading.trees.locations import Document
    from burmester.io.reading.trees.node import Node
    from burmester.synthesis.function_generation import FunctionMethod, FunctionSynthesis

    if tree.get("schema") != FUNCTION_SCHEMA:
        raise _bad_result(f"this is no result of function: its schema is not {FUNCTION_SCHEMA}")
    stated = tree.get("task")
    if not isinstance(stated, dict) or not isinstance(tree.get("linkages"), list):
        raise _bad_result("this result has no task, or no linkages")
    method: Any = tree.get("method")
    if method not in get_args(FunctionMethod):
        raise _bad_result("$.method of this result cannot be used", f"it is {shown(method)}")
    task = task_of(Node(Document(Source("the result", ""), "JSON", ("task",)), (), stated))
    found: list[FoundGenerator] = []
    others = list[str]()
    for id, each in _by_id(tree, "linkages"):
        try:
            one = generator_of(each, task)
        except ValueError as error:
            refused[id] = _bad_result(str(error))
            continue
        (judged,) = found_generators(one, task, exact=method in ("exact", "phases"))
        found.append(replace(judged, id=id, rank=len(found) + 1))
        others += _changed_verdict(found[-1], each)
    if refused and not found:
        raise next(iter(refused.values()))
    search = tree.get("search")
    counts = (search.get(key) if isinstance(search, dict) else None for key in COUNTS)
    return FunctionSynthesis(
        task,
        method,
        _outcome(tree),
        tuple(found),
        (*_warnings(tree), *_judged_otherwise(others, refused)),
        *(each if isinstance(each, int) else None for each in counts),
    )


def _six_bars(
    tree: dict[str, Any], problem: SynthesisProblem, refused: dict[str, InputError]
) -> tuple[SixBars, list[str]]:
    """The six-bars of a result, judged anew, and where the file says otherwise."""
    from burmester.io.six_bar_file import six_bar_of
    from burmester.sixbar.six_bars import SixBarOptions, SixBars
    from burmester.synthesis.six_bars import judged_at_poses

    every = _by_id(tree, "found", "six_bars.")
    out: list[FoundSixBar] = []
    others = list[str]()
    for k, (id, each) in enumerate(every):
        try:
            found = judged_at_poses(six_bar_of(each), problem, each.get("driver"))
        except InputError as error:
            why = f"{error.message}{(error.why and f': {error.why}') or ''}"
            refused[id] = _bad_result(f"$.six_bars.found[{k}] of this result cannot be used", why)
            continue
        chain = each.get("chain")
        out.append(replace(found, id=id, chain=chain if isinstance(chain, int) else found.chain))
        others += _differences(out[-1], each, problem)
    if every and not out:
        raise next(iter(refused.values()))
    counts = (tree.get(key) for key in ("chains", "designs", "working", "free_poses"))
    chains, designs, working, free = (_count(each) for each in counts)
    try:
        options = SixBarOptions(**tree.get("options"))  # type: ignore[arg-type]
    except (InputError, TypeError):
        options = SixBarOptions()
    given = any(each.get("given") is True for _, each in every)
    assumed = assumed_of(tree)
    found_all = SixBars(tuple(out), chains, designs, working, options, assumed, free, given=given)
    return found_all, others


def _count(given: Any) -> int:
    """A whole number of the file, 0 for what is none."""
    whole = isinstance(given, int) and not isinstance(given, bool)
    return given if whole and 0 <= given < 2**63 else 0


def _list(tree: Mapping[str, Any], key: str, within: str = "") -> list[Any]:
    """A list of the file; none where there is none; raises E150."""
    given = tree.get(key, [])
    if not isinstance(given, list):
        why = f"it is {shown(given)}, not a list"
        raise _bad_result(f"$.{within}{key} of this result cannot be used", why)
    return given


def _message(given: Any, code: re.Pattern[str]) -> tuple[str, str, str | None, str | None] | None:
    """The code, message, help and reason of an outcome or a warning; None of anything else."""
    if not isinstance(given, dict) or not code.fullmatch(str(given.get("code"))):
        return None
    message, help, why = (text_of(given.get(key)) for key in ("message", "help", "why"))
    return None if message is None else (given["code"], message, help, why)


def _outcome(tree: dict[str, Any]) -> Outcome:
    if (parts := _message(tree.get("outcome"), OUTCOME_CODE)) is None:
        raise _bad_result("$.outcome of this result cannot be used")
    return Outcome(*parts)


def _warnings(tree: dict[str, Any]) -> list[Advice]:
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
        raise _bad_result("$.options of this result cannot be used", f"it is {shown(given)}")
    known = {each.name for each in fields(SynthesisOptions)}
    given = {name: value for name, value in given.items() if name in known}
    if "length_per_radian" not in given:
        given["length_per_radian"] = tree.get("length_per_radian") or None
    try:
        return SynthesisOptions(**given)
    except InputError as error:
        raise _bad_result("$.options of this result cannot be used", error.message) from None


def _dyad(given: Any, where: str) -> FoundDyad:
    """A dyad of the file, its errors left open; raises E150."""
    try:
        if not isinstance(given, dict):
            raise fault(f"{where} is {shown(given)}, not an object", HELP)
        if given.get("kind") == "PP":
            angle = math.radians(number(given.get("angle_deg"), f"{where}.angle_deg"))
            dyad: Dyad | OpenLink = PP(np.asarray(angle))
        else:
            dyad = dyad_of(given, where, HELP)
        if isinstance(dyad, OpenLink):
            raise fault(f"{where}.radius is missing", HELP)
    except InputError as error:
        raise _bad_result(f"$.{error.message}", error.why) from None
    id = given.get("id")
    if not isinstance(id, str) or not DYAD_ID.fullmatch(id):
        raise _bad_result(f"$.{where}.id is {shown(id)}, and burmester writes ids such as D1")
    limits = given.get("limits", 0)
    minimum = given.get("minimum", True)
    return FoundDyad(id, dyad, 0.0, 0.0, minimum is True, limits if limits in (1, 2) else 0)


def _linkages(
    tree: dict[str, Any], problem: SynthesisProblem, refused: dict[str, InputError]
) -> tuple[tuple[FoundLinkage, ...], list[str]]:
    """The linkages of the file that can be used, judged anew, and where it says otherwise."""
    pairs, stated = list[Pair](), list[tuple[str, dict[str, Any]]]()
    for k, (id, each) in enumerate(_by_id(tree, "linkages")):
        try:
            pairs.append(_pair(each, k, problem.given))
            stated.append((id, each))
        except InputError as error:
            refused[id] = error
    searched = [each.get("sought") is True for _, each in stated]
    out, others = list[FoundLinkage](), list[str]()
    for (id, each), found in zip(stated, judged_again(problem, pairs, searched), strict=True):
        if found is None:
            refused[id] = _bad_result(f"linkage {id} has a link without length")
            continue
        found = _as_made(replace(found, id=id), each, problem.given)  # noqa: PLW2901
        out.append(replace(found, rank=len(out) + 1))
        others += _differences(found, each, problem)
    if refused and not out:
        raise next(iter(refused.values()))
    return tuple(out), others


def _by_id(tree: dict[str, Any], key: str, within: str = "") -> list[tuple[str, dict[str, Any]]]:
    """The linkages of a file as it has them, each with its id; raises E150."""
    out: dict[str, dict[str, Any]] = {}
    for k, each in enumerate(_list(tree, key, within)):
        id = each.get("id") if isinstance(each, dict) else None
        if not isinstance(id, str) or not LINKAGE_ID.fullmatch(id) or id in out:
            why = f"it is {shown(id)}, and each linkage has an id of its own, such as L1"
            raise _bad_result(f"$.{within}{key}[{k}].id of this result cannot be used", why)
        out[id] = each
    return list(out.items())


def _pair(given: dict[str, Any], number: int, task: Task) -> Pair:
    """The dyads of a linkage, which make one; raises E150."""
    where, dyads = f"linkages[{number}].dyads", given.get("dyads")
    if not isinstance(dyads, list) or len(dyads) != 2:
        raise _bad_result(f"$.{where} is {shown(dyads)}, not two dyads")
    first, second = (_dyad(each, f"{where}[{k}]") for k, each in enumerate(dyads))
    if first.id == second.id:
        raise _bad_result(f"$.{where} has {first.id} twice")
    try:
        require_linkage((first.dyad, second.dyad), task)
    except InputError as error:
        raise _bad_result(f"$.{where}: {error.message}", error.why) from None
    return first, second


def _as_made(found: FoundLinkage, given: dict[str, Any], task: Task) -> FoundLinkage:
    """What a file says of how a linkage was made: whether it was rounded, and how it was before."""
    for each in given["unmet"] if isinstance(given.get("unmet"), list) else ():
        if isinstance(each, dict) and each.get("kind") == "rounding":
            lost = Finding("rounding", text_of(each.get("message")) or "")
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


def _changed_verdict(found: Candidate | FoundGenerator, given: dict[str, Any]) -> list[str]:
    """What the file says otherwise of a linkage: whether it is usable."""
    stated = given.get("usable")
    if not isinstance(stated, bool) or stated is found.usable:
        return []
    if found.usable:
        return [f"{found.id} is usable, and the file says that it is not"]
    reason = found.faults[0].message
    return [f"{found.id} is not usable ({reason}), and the file says that it is"]


def _differences(found: Candidate, given: dict[str, Any], problem: SynthesisProblem) -> list[str]:
    """The same, and how near it comes; of one that is not usable how near its first dyad comes."""
    if differs := _changed_verdict(found, given):
        return differs
    errors = given.get("position_error")
    stated = _number(errors.get("max") if isinstance(errors, dict) else None)
    every = [(found.id, float(found.error.position.max()), stated)]
    if not found.usable:  # its places depend on rounding, its dyads do not
        dyads = found.dyads if isinstance(found, FoundLinkage) else ()
        rows = {each["id"]: each for each in given["dyads"]} if dyads else {}
        every = [
            (f"{each.id} of {found.id}", each.max_error, _number(rows[each.id].get("max_error")))
            for each in dyads
        ]
    for name, own, other in every:
        rounding = SAME_ERROR * problem.length + SAME_SHARE * min(own, other)
        if not abs(own - other) <= rounding:
            near, far = (
                length_of(each, problem.given) if math.isfinite(each) else "nothing"
                for each in (own, other)
            )
            return [f"{name} misses a pose by {near}, and the file says {far}"]
    return []


def _number(given: Any) -> float:
    """A number of the file, infinite where there is none."""
    return float(given) if isinstance(given, int | float) else math.inf


def _claims(outcome: Outcome, works: bool) -> list[str]:
    """What the outcome of a file says otherwise: whether anything works."""
    if outcome.code not in (WORKING, NOT_WORKING)[works]:
        return []
    one, other = ("a linkage works", "none does")[:: 1 if works else -1]
    return [f"{one}, and the outcome of the file, {outcome.code}, says that {other}"]


def _judged_otherwise(others: Sequence[str], refused: Mapping[str, InputError]) -> list[Advice]:
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
        radius, angle = (_number(each.get(key)) for key in ("radius", "angle_radius_deg"))
        proved, minimum = (each.get(key) is True for key in ("proved", "minimum"))
        kind = type(dyads[index].dyad).__name__
        own = CertifiedDyad(index, kind, proved, radius, math.radians(angle), minimum)
        certified.append(own)
    return Certificate(
        given.get("complete") is True,
        _texts(given.get("proved")),
        _texts(given.get("numerical")),
        tuple(certified),
    )


def _family(given: Any) -> Family | None:
    """How linkages were chosen where the poses leave infinitely many, in the file's own words."""
    if not isinstance(given, dict):
        return None
    from burmester.families.family import Family
    from burmester.verdicts.assumptions import Bound

    return Family(
        text_of(given.get("rule")) or "",
        tuple(Bound(*each) for each in assumed_of(given)),
        given.get("given_up") is True,
        *(_count(given.get(key)) for key in ("dyads", "pairs")),
    )
