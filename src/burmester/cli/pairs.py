"""Functions in the commands of poses: files of pairs of angles go on to `burmester function`.

So do options of functions, for one release more.

E194 --output with a number, which may be an angle or a file      W245 the new command
"""

from __future__ import annotations

import os
from typing import Any, Final

import click

from burmester.cli.function import contradiction
from burmester.cli.output import CONTENT, NOTES

TAKE_PAIRS: Final = ("check", "synthesize", "report", "judge")
OF_FUNCTIONS: Final = (
    "--function", "--x", "--input", "--opposite", "--pairs", "--spacing", "--minimax",
    "--input-phase", "--output-phase", "--ground", "--plot", "--links", "--side",
)  # fmt: skip


def words_of_function(
    context: click.Context, command: click.Command, words: list[str]
) -> list[str] | None:
    """What `burmester function` is told in place of a command of poses; None where it is poses."""
    name = command.name or ""
    if name not in TAKE_PAIRS or "--help" in words or "-h" in words:
        return None
    plain = [p for word in words for p in (word.split("=", 1) if word[:2] == "--" else [word])]
    old = any(word in OF_FUNCTIONS for word in plain)
    poses = None if old else _pairs(context, command, words)
    if not old and poses is None:
        return None
    expression = "--function" in plain[:-1]
    file = "--report" if name == "report" else "-o"
    plain = [file if w == "-o" or (w == "--output" and not expression) else w for w in plain]
    if name == "judge" and "--links" not in plain and "--linkage" not in plain:
        raise contradiction(
            "there is no linkage to judge",
            "give its lengths, such as --links 1,0.5,1.2,0.9, or --linkage FILE",
        )
    if name == "check":
        plain.append("--check")
    if name == "report" and file not in plain:
        stem = (
            "poses" if poses == "-" else os.path.splitext(os.path.basename(poses or "function"))[0]
        )
        plain += [file, f"{stem}.html"]
    if expression:
        at = plain.index("--function")
        plain = [*plain[:at], *plain[at + 2 :], "--", plain[at + 1]]
    if old:
        _warn(context, name, plain)
    return plain


def _pairs(context: click.Context, command: click.Command, words: list[str]) -> str | None:
    """The file of pairs of angles among words; None where there is none."""
    from burmester.cli.progress_line import working
    from burmester.errors import InputError
    from burmester.io.reading.file_content import read_source
    from burmester.io.reading.functions.function_kind import is_function

    try:
        given, *_ = command.make_parser(click.Context(command, parent=context)).parse_args(
            list(words)
        )
    except click.UsageError:
        return None  # it is parsed again, and refused there
    poses = given.get("poses")
    _refuse_angle(given.get("output"))
    if not isinstance(poses, str) or poses.startswith("case:") or given.get("dyad"):
        return None
    try:
        with working("reading the poses"):
            content = read_source(poses)
    except InputError:
        return None  # it is read again as poses, and refused there
    if poses == "-":
        context.meta[CONTENT] = content
    sheet = given.get("sheet")
    return poses if is_function(content, poses, sheet if isinstance(sheet, str) else None) else None


def _refuse_angle(output: Any) -> None:
    """Refuse --output 60 without a function, which may be an angle or a file: E194."""
    try:
        float(output)
    except (TypeError, ValueError):
        return
    raise contradiction(
        f"--output {output} may be an angle or a file",
        f"for a function say `burmester function EXPRESSION --x FROM:TO --input DEG --output "
        f"{output}`; for a file of that name say -o {output}",
        "the output link of a function turns by degrees, and no function is given",
    )


def _warn(context: click.Context, name: str, words: list[str]) -> None:
    from burmester.errors import Advice
    from burmester.io.files import quoted

    words = [word for word in words if word != "--json"]
    if words[-2:-1] == ["--"] and words[-1][:1] != "-":
        words = [words[-1], *words[:-2]]
    command = " ".join(map(quoted, ("burmester", "function", *words)))
    context.meta[NOTES] = (
        Advice(
            "W245",
            f"functions leave `burmester {name}` with the next release",
            f"write `{command}`",
            "they have a command of their own",
        ),
    )
