"""A linkage that exists, from a file: of a result, of an export to JSON, or of pivots.

A result of `synthesize` or `judge` holds linkages with their ids.  An export to JSON, and a file
that a person writes, hold the joints of a six-bar (`six_bar_file`) or two `dyads`, in JSON or TOML:

fixed_pivot = [X, Y]     in F; missing in a dyad with a slider on the ground (PR)
moving_pivot = [x, y]    in M; missing in a dyad with a slot in the body (RP)
length = L               of the link between them (RR); it follows from the poses where it is left
                         out.  An export calls it radius.
line = {point = [X, Y], direction_deg = A}    of a slider in F, of a slot in M; an export gives
                         normal_deg and offset instead

Other keys of a file are not looked at (the poses of an export, say), other keys of a dyad refused.

E101 not readable       E109 neither JSON nor TOML     E151 no linkage of this id
E150 a result that cannot be used                      E156 another kind of file
"""

from __future__ import annotations

import json
import os
import tomllib
from typing import TYPE_CHECKING, Any

from burmester.errors import InputError
from burmester.fourbar.linkage import Linkage
from burmester.io.linkage_values import dyad_of, fault
from burmester.io.reading.file_content import read_source, require_moderate
from burmester.io.reading.pose_table import held_float
from burmester.io.result import SCHEMA
from burmester.io.saved import read_result
from burmester.io.six_bar_file import is_six_bar, six_bar_of
from burmester.printable import printable
from burmester.synthesis.given_linkage import GivenDyad
from burmester.values import shown
from burmester.wording import in_unit

if TYPE_CHECKING:
    from burmester.sixbar.kinds import SixBar

KEYS = {"id", "kind", "fixed_pivot", "moving_pivot", "length", "radius", "line"}
NO_LINKAGE = "this file holds no linkage"
HELP = (
    "give a result of `burmester synthesize POSES -o result.json`, an export to JSON, or a file "
    "with two [[dyads]], each with fixed_pivot = [X, Y] and moving_pivot = [x, y], or with the "
    "joints of a six-bar"
)


def read_linkage(
    source: str | os.PathLike[str],
    id: str | None = None,
    unit: str | None = None,
    data: bytes | None = None,
) -> Linkage | SixBar | tuple[GivenDyad, GivenDyad]:
    """The linkage of a result, or that in another file, or on standard input ("-").

    A six-bar is a linkage of its class, such as `WattLinkage`; of a file of dyads they are given as
    they stand.

    id: of a linkage of a result, the first if None; unit: of the lengths of the task, which a file
    that states one has to share; data: the bytes of the file, where they are known.
    """
    path = os.fspath(source)
    label = "<stdin>" if path == "-" else printable(path)
    try:
        data = read_source(path) if data is None else data
    except InputError as error:
        error.message = error.message.replace("the poses", "the linkage")
        error.where = error.where or label
        raise
    tree = _tree(data, label)
    try:
        if tree.get("schema") == SCHEMA:
            chosen = read_result(path, data).exported(id, "--id")
            _require_unit(chosen.unit, unit)
            return chosen.linkage
        _require_unit(tree.get("length_unit"), unit)
        if id is not None and str(tree.get("id", id)).lower() != id.lower():
            message = f"there is no linkage {printable(id)} in this file"
            why, help = f"it has {shown(tree['id'])} only", "leave --id out"
            raise InputError("E151", message, why=why, help=help)
        return six_bar_of(tree) if is_six_bar(tree) else _of_dyads(tree)
    except InputError as error:
        error.where = error.where or label
        raise


def _tree(data: bytes, label: str) -> dict[str, Any]:
    """The object in a file; raises E109 and E156."""
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        why = f"byte {error.start + 1} is not UTF-8"
        raise InputError("E156", NO_LINKAGE, where=label, why=why, help=HELP) from None
    language = "JSON" if text.lstrip()[:1] in ("{", "[") and not _is_table(text) else "TOML"
    try:
        require_moderate(text, tree=language == "TOML")
        loads = json.loads if language == "JSON" else tomllib.loads
        tree = loads(text.replace("\r\n", "\n"), parse_float=held_float)
    except InputError as error:
        error.where = label
        raise
    except (ValueError, RecursionError) as error:
        code, message, why = "E109", f"this is not {language}", printable(str(error))
        if not label.lower().endswith((".json", ".toml")):
            code, message, why = "E156", NO_LINKAGE, "it is neither JSON nor TOML"
        raise InputError(code, message, where=label, why=why, help=HELP) from None
    if not isinstance(tree, dict):
        why = f"it is {shown(tree)}, not an object with dyads"
        raise InputError("E156", NO_LINKAGE, where=label, why=why, help=HELP)
    return tree


def _is_table(text: str) -> bool:
    """Whether a text that begins with a bracket is TOML: [table] or [[tables]]."""
    return text.lstrip().partition("\n")[0].strip().strip("[]").strip().replace("_", "").isalpha()


def _require_unit(stated: object, unit: str | None) -> None:
    if unit and isinstance(stated, str) and stated and stated != unit:
        raise InputError(
            "E156",
            f"the linkage is{in_unit(printable(stated)[:40])}, and the poses are{in_unit(unit)}",
            help=f"give both in one unit, such as {unit}",
        )


def _of_dyads(tree: dict[str, Any]) -> tuple[GivenDyad, GivenDyad]:
    """The linkage of a file with two dyads."""
    dyads = tree.get("dyads")
    if not isinstance(dyads, list) or not all(isinstance(each, dict) for each in dyads):
        keys = ", ".join(sorted(map(shown, tree))[:5])
        why = f"it has {keys or 'nothing'}, and no list of dyads"
        raise InputError("E156", NO_LINKAGE, why=why, help=HELP)
    if len(dyads) != 2:
        why = f"it has {len(dyads)} dyads, and a linkage has two"
        raise InputError("E156", NO_LINKAGE, why=why, help=HELP)
    return _dyad(dyads[0], "dyads[0]"), _dyad(dyads[1], "dyads[1]")


def _dyad(tree: dict[str, Any], path: str) -> GivenDyad:
    """A dyad from its object, which has nothing else."""
    for key in tree:
        if key not in KEYS:
            raise fault(f"{path}.{printable(str(key))[:40]} is not known", HELP)
    return dyad_of(tree, path, HELP)
