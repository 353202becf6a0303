"""What is assumed of a task and advised about it, with what a page can do as data."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from burmester.cures import Cure, Help, for_page
from burmester.errors import Advice
from burmester.geometry.regions import Line, Point, Polygon, Segment
from burmester.io.result import region_data
from burmester.live.document import with_boxes
from burmester.live.plain import plain
from burmester.requirements.table import ASKED
from burmester.synthesis.result import Outcome, Synthesis
from burmester.tasks.option_table import STUDIO_OPTIONS

_REQUIREMENTS = {each.name: each for each in ASKED}
_OPTIONS = {each.name: key for key, each in STUDIO_OPTIONS.items()}


def advice_data(synthesis: Synthesis) -> list[dict[str, Any]]:
    """The outcome and the warnings in the words of pages, each with its "assumed" and "cures".

    "assumed": {"part", "key", "value", "words"} each, with the value that a page would state.
    "cures": lists of the same that belong together; none where a page has no field for it.
    """
    return [_advice(each) for each in (synthesis.outcome, *synthesis.warnings)]


def _advice(advice: Outcome | Advice) -> dict[str, Any]:
    help = advice.help
    groups = [e for e in help.parts if not isinstance(e, str)] if isinstance(help, Help) else []
    assumed = [
        {**_place(each.argument, _rounded(each.assumed[1])), "words": each.assumed[0]}
        for each in (cure for group in groups for cure in group)
        if each.assumed[0]
    ]
    cures = [
        [{**_place(each.argument, each.value), "words": for_page([each])} for each in group]
        for group in groups
        if all(_can_be_done(each) for each in group)
    ]
    return {**advice.to_dict(for_page), "assumed": assumed, "cures": cures}


def _can_be_done(cure: Cure) -> bool:
    return cure.value is not None and _place(cure.argument, cure.value)["part"] is not None


def _place(argument: str, value: Any) -> dict[str, Any]:
    """The part of a document, the key in it, and the value as it holds it; None: no such part."""
    part: str | None = None
    if argument in _REQUIREMENTS:
        part, value = "requirements", _REQUIREMENTS[argument].plain(value)
    elif argument in _OPTIONS:
        part, argument = "options", _OPTIONS[argument]
    elif argument in ("fixed_pivot", "moving_pivot", "length", "kinds"):
        part = "limits"
    elif argument in ("tolerances", "time_limit"):
        part = argument
    return {"part": part, "key": argument, "value": _as_stated(value)}


def _rounded(value: Any) -> Any:
    """A region that is assumed, to digits that a person would write; anything else as it is."""
    if not isinstance(value, Polygon):
        return value
    size = float(np.ptp(value.vertices, axis=0).max())
    return Polygon(np.round(value.vertices, 3 - math.ceil(math.log10(size))))


def _as_stated(value: Any) -> Any:
    """A value as a document has it; None for what it does not state, such as "any"."""
    if isinstance(value, Point | Line | Segment | Polygon):
        return plain(with_boxes(region_data(value)))
    if isinstance(value, frozenset):
        return sorted(value)
    if isinstance(value, tuple):
        return [_as_stated(each) for each in value]
    if isinstance(value, float):
        return plain(value) if math.isfinite(value) else None
    return None if value == "any" else value
