"""Six-bars of a result, read back and judged anew from their dimensions.

E150 a six-bar that cannot be used
"""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

from burmester.errors import InputError
from burmester.io.linkage_values import assumed_of
from burmester.io.six_bar_file import six_bar_of
from burmester.sixbar.found import FoundSixBar
from burmester.sixbar.six_bars import SixBarOptions, SixBars
from burmester.synthesis.six_bar_judgement import judged_at_poses
from burmester.tasks.problem import SynthesisProblem
from burmester.values import shown

__all__ = ["six_bars_again"]

HELP = "take the file as `burmester synthesize POSES --six-bars -o RESULT` wrote it"
ID = re.compile("S[1-9][0-9]{0,6}")


def six_bars_again(
    tree: dict[str, Any], problem: SynthesisProblem, refused: dict[str, InputError]
) -> tuple[SixBars, list[tuple[FoundSixBar, dict[str, Any]]]]:
    """The six-bars of a result, judged anew, and each with what the file says of it.

    refused: those that cannot be used are added, by id, with the reason.  Raises E150.
    """
    every = tree.get("found")
    if not isinstance(every, list):
        raise _unlike("$.six_bars.found", f"it is {shown(every)}, not a list")
    out = list[tuple[FoundSixBar, dict[str, Any]]]()
    for k, each in enumerate(every):
        id = each.get("id") if isinstance(each, dict) else None
        known = {found.id for found, _ in out} | refused.keys()
        if not isinstance(id, str) or not ID.fullmatch(id) or id in known:
            why = f"its id is {shown(id)}, and each has an id of its own, such as S1"
            raise _unlike(f"$.six_bars.found[{k}]", why)
        try:
            linkage = six_bar_of(each)
            found = judged_at_poses(linkage, problem, each.get("driver"))
        except InputError as error:
            why = f"{error.message}{(error.why and f': {error.why}') or ''}"
            refused[id] = _unlike(f"$.six_bars.found[{k}]", why)
            continue
        chain = each.get("chain")
        found = replace(found, id=id, chain=chain if isinstance(chain, int) else found.chain)
        out.append((found, each))
    if every and not out:
        raise next(iter(refused.values()))
    counts = (tree.get(key) for key in ("chains", "designs", "working", "free_poses"))
    chains, designs, working, free = (_count(each) for each in counts)
    six_bars = SixBars(
        tuple(found for found, _ in out),
        chains,
        designs,
        working,
        _options(tree.get("options")),
        assumed_of(tree),
        free,
        given=any(each.get("given") is True for _, each in out),
    )
    return six_bars, out


def _options(given: Any) -> SixBarOptions:
    """How six-bars were looked for, as far as the file says it."""
    try:
        return SixBarOptions(**given)
    except (InputError, TypeError):
        return SixBarOptions()


def _count(given: Any) -> int:
    """A whole number of the file, 0 for what is none."""
    whole = isinstance(given, int) and not isinstance(given, bool)
    return given if whole and 0 <= given < 2**63 else 0


def _unlike(where: str, why: str) -> InputError:
    return InputError("E150", f"{where} of this result cannot be used", why=why, help=HELP)
