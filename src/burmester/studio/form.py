"""The fields in which a page asks for limits, requirements and options, as plain data."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from burmester.requirements.loads import OF_LOADS, STAYS_AT
from burmester.requirements.requirement import Number, Requirement
from burmester.requirements.table import ASKED
from burmester.tasks.load_table import (
    DENSITIES,
    NEEDED,
    POSSIBLE,
    PROFILE_WORDS,
    SPRING_NUMBERS,
    SPRING_WORDS,
    SpringKind,
)
from burmester.tasks.option_table import LIMIT_OPTIONS, STUDIO_OPTIONS


def form_data() -> dict[str, Any]:
    """What can be asked: of each its key, label and form of value, with its bounds or choices.

    The first choice is the usual one.
    """
    return {
        "requirements": [
            _field(each.name, each.label or each.help, each.form, _choices(each))
            | _bounds(each.checked)
            | {"loads": each in OF_LOADS, "of": each.kind}
            for each in ASKED
            if each is not STAYS_AT  # whose names are those of the poses, which a page changes
        ],
        "options": [
            _field(key, each.label, each.form, [*zip(each.known, each.words, strict=True)])
            | {"made": each.manufacturing}
            for key, each in STUDIO_OPTIONS.items()
        ],
        "limits": [
            _field(each.name, each.label, each.kind, [*each.words.items()])
            for each in LIMIT_OPTIONS
            if each.label
        ],
        "loads": {
            "materials": [*DENSITIES],
            "profiles": [*PROFILE_WORDS.items()],
            "springs": [
                {"kind": kind, "label": label, "numbers": _spring_numbers(kind)}
                for kind, label in SPRING_WORDS.items()
            ],
        },
    }


def _spring_numbers(kind: SpringKind) -> list[dict[str, Any]]:
    return [
        {"key": key, "needed": key in NEEDED[kind], **SPRING_NUMBERS[key]._asdict()}
        for key in (*NEEDED[kind], *POSSIBLE[kind])
    ]


def _field(
    key: str, label: str, form: str | None, choices: Sequence[tuple[str, str]]
) -> dict[str, Any]:
    return {"key": key, "label": label, "form": form, "choices": choices}


def _choices(asked: Requirement) -> Sequence[tuple[str, str]]:
    return [*asked.choices.items()] or [(name, name) for name in asked.known]


def _bounds(checked: object) -> dict[str, Any]:
    """What a number counts, and its bounds; nothing for other values."""
    return {"kind": checked.measure, **checked.bounds} if isinstance(checked, Number) else {}
