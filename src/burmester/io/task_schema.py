"""The JSON schema of a task file, for editors: of the fields by which files are read."""

from __future__ import annotations

from collections.abc import Iterable

from burmester.io.reading.functions.function_file import FUNCTION_SCHEMA
from burmester.io.reading.trees.loads_tree import LOAD_SCHEMAS
from burmester.io.reading.trees.node import Schema
from burmester.io.reading.trees.pose_tree import MISPLACED_KEYS, POSE_SCHEMAS
from burmester.io.reading.trees.specification_tree import LIMITS_SCHEMA, REQUIREMENTS_SCHEMA
from burmester.io.reading.trees.surroundings_tree import (
    BODY_SCHEMA,
    KEEP_OUT_SCHEMA,
    SURROUNDINGS_SCHEMA,
)
from burmester.tasks.option_table import TOP_KEYS


def task_schema() -> Schema:
    """What may stand in a task in TOML or JSON, and in a list of poses alone.

    Refused is what a reader refuses by its key, type or range; what belongs together is only
    checked by reading.  Keys at the top are free, but for those that are misspelt or misplaced.
    """
    keys = {
        **POSE_SCHEMAS,
        "body": BODY_SCHEMA,
        "keep_out": KEEP_OUT_SCHEMA,
        "surroundings": SURROUNDINGS_SCHEMA,
        "limits": LIMITS_SCHEMA,
        "requirements": REQUIREMENTS_SCHEMA,
        **LOAD_SCHEMAS,
        "function": FUNCTION_SCHEMA,
        "picture": {"description": "What lies behind the plane in the studio, which writes it."},
    }
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "A task of burmester, in TOML or JSON",
        "type": ["object", "array"],
        "items": keys["poses"]["items"],
        "properties": keys,
        "anyOf": [{"type": "array"}, {"required": ["poses"]}, {"required": ["function"]}],
        "propertyNames": {
            "anyOf": [
                {"enum": [*keys]},
                {"not": {"anyOf": [{"enum": [*MISPLACED_KEYS]}, {"pattern": _misspelt(TOP_KEYS)}]}},
            ]
        },
    }


def _misspelt(words: Iterable[str]) -> str:
    """The pattern of words with a letter too many, too few, changed, or exchanged with the next."""
    ways = set()
    for word in words:
        for k in range(len(word)):
            head, tail = word[:k], word[k + 1 :]
            ways |= {f"{head}.?.?{tail}", f"{head}{tail[:1]}{word[k]}{tail[1:]}"}
    return f"^(?:{'|'.join(sorted(ways))})$"
