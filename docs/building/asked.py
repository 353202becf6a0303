"""The page of all that can be asked, made of the tables by which files and options are read."""

import math

from burmester.io.reading.trees.node import BOUNDS
from burmester.io.task_schema import task_schema
from burmester.requirements.requirement import Number
from burmester.requirements.table import ASKED, NOT_ASKED
from burmester.tasks.option_table import LIMIT_OPTIONS, OPTIONS

UNITS = {"angle": "degrees", "length": "length", "number": "number"}
FORMS = {"flag": "true or false", "area": "box or polygon", "names": "names"}
SAID = {"least": "from {:g}", "above": "above {:g}", "below": "below {:g}"}


def asked_page(cell):
    """The page; cell: a text in a cell of a table."""
    keys = task_schema()["properties"]
    limits = properties(keys["limits"])
    parts = [
        "# What can be asked",
        "Everything that a task and a search can state, from the tables by which it is read. "
        "`burmester new --schema` prints the same for an editor. "
        "[Limits and requirements](../limits-and-requirements.md) tells what they are for.",
        "## Requirements",
        "The key stands in the table `requirements` of a file. It is also the argument of "
        "`burmester.Requirements`. A value out of its bounds is refused ([E134](#E134)). So is one "
        "that the limits rule out ([E132](#E132)). If no linkage keeps them, the answer says which "
        "one and by how much ([R301](#R301)). `unmet` of the JSON names its kind.",
        table(
            ("key, argument", "option", "value", "if not asked", "meaning", "kind"),
            [requirement(each, cell) for each in ASKED],
        ),
        "*Sound* is what the standard of linkages to build asks for. *Few poses* is the bound "
        "within which the best of infinitely many is looked for ([W215](#W215)). "
        "The standard has more bounds, for which nobody asks. Their lengths are in spans of the "
        "motion.",
        table(
            ("bound", "kind", "standard"),
            [
                (f"`{each.name}`", each.kind, f"{each.standard:g}{' spans' * each.scaled}")
                for each in NOT_ASKED
            ],
        ),
        "## Limits",
        "The key stands in the table `limits`, or in each of two tables `[[limits]]`. It is also "
        "the argument of `burmester.Limits`. A malformed limit is refused ([E131](#E131)). So are "
        "limits that contradict each other ([E132](#E132)).",
        table(
            ("key, argument", "option", "meaning", "in a file"),
            [
                (
                    f"`{each.name}`",
                    f"`{each.option} {each.metavar}`",
                    cell(each.help),
                    cell(limits[each.name]["$comment"]),
                )
                for each in LIMIT_OPTIONS
            ],
        ),
        "## Options of a search",
        "The argument is one of `burmester.synthesize`. A value that makes no sense is refused "
        "([E134](#E134)).",
        table(
            ("argument", "option", "values", "meaning"),
            [
                (
                    f"`{each.name}{'=False' * each.negated}`",
                    f"`{' '.join(filter(None, (each.option, each.metavar)))}`",
                    ", ".join(f"`{word}`" for word in each.known) or each.form,
                    cell(each.help),
                )
                for each in OPTIONS
            ],
        ),
        "## Keys of a task",
        "The keys at the top of a file. Other keys may stand there, such as a title. "
        "A misspelt one is refused ([E107](#E107)).",
        rows_of(keys, cell),
    ]
    for key, schema in keys.items():
        if key not in ("requirements", "limits") and (inside := properties(schema)):
            parts += [f"## {key}", rows_of(inside, cell)]
    return "\n\n".join(parts) + "\n"


def properties(schema):
    """The keys of a table, alone or in a list; none of another value."""
    found = [each.get("properties", {}) for each in (schema, *schema.get("anyOf", ()))]
    return next(filter(None, found), {})


def rows_of(keys, cell):
    """Keys with the kinds of their values, and what stands there."""
    return table(
        ("key", "value", "what stands there"),
        [
            (f"`{key}`", value(schema), cell(schema.get("description", "")))
            for key, schema in keys.items()
        ],
    )


def table(heads, rows):
    """A table of Markdown."""
    lines = [heads, ["---"] * len(heads), *rows]
    return "\n".join(f"| {' | '.join(each)} |" for each in lines)


def requirement(each, cell):
    """The row of a requirement."""
    said = FORMS.get(each.form) or ", ".join(f"`{word}`" for word in each.choices)
    if isinstance(each.checked, Number):
        bounds = [SAID[name].format(bound) for name, bound in each.checked.bounds.items()]
        said = f"{UNITS[each.checked.measure]}, {' to '.join(bounds)}"
    if each.known:
        said += ": " + ", ".join(f"`{word}`" for word in each.known)
    option = f"`{each.option} {each.metavar}`" if each.metavar else f"`{each.option}`"
    meaning = each.help.replace("; see NAME below", "")  # which the command lists there
    return f"`{each.name}`", option, said, usual(each), cell(meaning), each.kind


def usual(each):
    """What holds where a requirement is not asked."""
    said = [f"`{each.default}`"] if each.default not in (None, 0, False, math.inf) else []
    said += [f"sound: {each.standard:g}"] if each.standard is not None else []
    said += [f"few poses: {each.assumed[0]:g}, else {each.assumed[1]:g}"] if each.assumed else []
    return "; ".join(said) or "free"


def value(schema):
    """The kind of a value in words, with its bounds."""
    if "enum" in schema:
        return ", ".join(f"`{word}`" for word in schema["enum"])
    if "anyOf" in schema and "type" not in schema:
        return " or ".join(dict.fromkeys(map(value, schema["anyOf"])))
    words = {"object": "table", "array": "list", "string": "text", "boolean": "true or false"}
    kinds = schema.get("type", "any")
    each = [kinds] if isinstance(kinds, str) else [kind for kind in kinds if kind != "null"]
    bounds = [SAID[name].format(schema[key]) for name, key in BOUNDS.items() if key in schema]
    return f"{' or '.join(words.get(kind, kind) for kind in each)} {' to '.join(bounds)}".strip()
