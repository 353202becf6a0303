"""Function tasks on the command line: `synthesize`, `report`, `judge` and `export` ask here.

A task is a function's by --function, or by the columns or the table [function] of its file.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Final

import click

from burmester.cli.output import EXIT_FOUND, EXIT_NOTHING, console, print_json

if TYPE_CHECKING:
    from burmester.functions.function_task import FunctionTask
    from burmester.io.function_result import FunctionResult
    from burmester.synthesis.function_generation import FunctionSynthesis
    from burmester.verdicts.found_linkage import FoundLinkage

__all__ = [
    "check_function",
    "export_choice",
    "function_task",
    "hand_over_function",
    "judge_function",
    "page_of_function",
]

OWN: Final = (
    "function", "x", "input_range", "opposite", "pairs", "spacing", "minimax", "input_phase",
    "output_phase", "ground", "plot", "links", "side",
)  # fmt: skip
SHARED: Final = (
    "poses", "min_transmission", "link_ratio", "types", "as_json", "file", "output", "force",
    "everything", "title", "linkage", "id", "sheet",
)  # fmt: skip
FIGURES: Final = {".png": {}, ".svg": {"Date": None}, ".pdf": {"CreationDate": None}}


def function_task(poses: str | None, given: dict[str, Any]) -> FunctionTask | None:
    """The task of a function, if the options or the file state one; else None.

    What standard input held is put into `given` as "data".  Raises E190, E191, E192 and E194.
    """
    if given.get("function") is not None:
        if poses is not None:
            raise _contradiction(
                "a file and --function are given", "give one of the two", f"the file is {poses}"
            )
        _require_own()
        return _of_expression(given)
    if poses is None:
        raise click.UsageError("Missing argument 'POSES'.")
    data = _function_bytes(poses, given)
    if data is None:
        _require_none()
        return None
    _require_own()
    for name in ("x", "input_range", "opposite", "pairs", "spacing"):
        if given.get(name):
            raise _contradiction(
                f"{_option(name)} is given, and the file states the pairs",
                f"leave {_option(name)} out, or write it into the table [function] of a TOML file",
            )
    from burmester.io.reading.functions.function_file import read_function

    return read_function(data, poses, _settings(given), given.get("sheet"))


def _function_bytes(poses: str, given: dict[str, Any]) -> bytes | None:
    from burmester.cli.progress_line import working
    from burmester.errors import InputError
    from burmester.io.reading.file_content import read_source
    from burmester.io.reading.functions.function_kind import is_function

    if poses.startswith("case:"):
        return None
    try:
        with working("reading the poses"):
            data = read_source(poses)
    except InputError:
        return None  # it is read again as poses, and refused there
    if poses == "-":
        given["data"] = data
    return data if is_function(data, poses, given.get("sheet")) else None


def _of_expression(given: dict[str, Any]) -> FunctionTask:
    from burmester.io.reading.functions.function_options import task_of_function
    from burmester.io.reading.pose_table import Source

    for name in ("x", "input_range", "output"):
        if given.get(name) is None:
            raise _contradiction(
                f"{_option(name)} is missing",
                f'give {_option(name)}, as in `burmester synthesize --function "log10(x)" --x 1:2 '
                "--input 60 --output 60`",
            )
    text = given["function"]
    return task_of_function(
        text,
        _ends(given["x"]),
        _number("--input", given["input_range"]),
        _number("--output", given["output"]),
        pairs=given["pairs"],
        spacing=given["spacing"],
        opposite=given["opposite"],
        settings=_settings(given),
        source=Source("--function", text),
    )


def _settings(given: dict[str, Any]) -> Any:
    from burmester.io.reading.functions.function_options import FunctionSettings
    from burmester.io.reading.requirements_text import requirements_from_options

    def number(name: str) -> float | None:
        value = given.get(name)
        return None if value is None else _number(_option(name), value)

    ground = number("ground")
    types = requirements_from_options(types=given.get("types") or ())
    return FunctionSettings(
        number("input_phase"),
        number("output_phase"),
        1.0 if ground is None else ground,
        bool(given.get("minimax")),
        number("min_transmission"),
        number("link_ratio"),
        types[0].value if types else None,
    )


def _ends(text: str) -> tuple[float, float]:
    from burmester.io.reading.functions.expression import read_number
    from burmester.io.reading.pose_table import Source

    low, colon, high = text.partition(":")
    source = Source("--x", text)
    if not colon:
        raise _contradiction("--x has no range", "give both ends, such as --x 1:2")
    return read_number(source, 0, low), read_number(source, len(low) + 1, high)


def _number(option: str, text: str) -> float:
    from burmester.io.reading.functions.expression import read_number
    from burmester.io.reading.pose_table import Source

    return read_number(Source(option, text), 0, text)


def _option(name: str) -> str:
    return {"input_range": "--input", "file": "-o"}.get(name, f"--{name.replace('_', '-')}")


def _contradiction(message: str, help: str, why: str | None = None) -> Exception:
    from burmester.errors import InputError

    return InputError("E194", message, why=why, help=help)


def _stated() -> list[str]:
    """The names of options that were given on the command line."""
    context = click.get_current_context()
    source = click.core.ParameterSource.COMMANDLINE
    return [name for name in context.params if context.get_parameter_source(name) is source]


def _require_own() -> None:
    """Refuse options that are for poses: E194."""
    for name in _stated():
        if name not in (*OWN, *SHARED):
            option = next(
                (p.opts[-1] for p in click.get_current_context().command.params if p.name == name),
                _option(name),
            )
            raise _contradiction(
                f"{option} is for poses, and this is a function", f"leave {option} out"
            )


def _require_none() -> None:
    """Refuse options of functions where poses are given: E194."""
    for name in _stated():
        if name in OWN:
            raise _contradiction(
                f"{_option(name)} is for functions, and these are poses",
                f"leave {_option(name)} out, or give pairs of angles under the columns "
                "input_deg,output_deg",
            )


# --- what comes out


def hand_over_function(
    task: FunctionTask,
    file: str | None,
    *,
    poses: str | None,
    force: bool,
    as_json: bool,
    plot: str | None,
    everything: bool,
) -> int:
    """Solve a function task, and write, draw and show what comes of it; returns the exit code."""
    from burmester.cli.progress_line import working
    from burmester.io import files
    from burmester.io.function_result import function_data
    from burmester.io.result import json_line
    from burmester.printable import printable
    from burmester.synthesis.function_generation import generate_function

    for each in (file, plot):
        if each is not None:
            files.require_writable(each, force=force, source=poses or "")
    suffix = _figure_format(plot)
    with working("looking for function generators"):
        synthesis = generate_function(task)
    if file is not None:
        files.write(file, json_line(function_data(synthesis)), force=force)
        click.echo(f"wrote {printable(file)}", err=True)
    if plot is not None:
        files.write(plot, _figure(synthesis, suffix), force=force)
        click.echo(f"wrote {printable(plot)}", err=True)
    if as_json:
        print_json(function_data(synthesis))
    else:
        from burmester.io.function_table import show_function

        show_function(synthesis, console(), everything=everything)
    return EXIT_FOUND if synthesis.usable else EXIT_NOTHING


def _figure_format(path: str | None) -> str:
    from burmester.errors import InputError

    suffix = ".png" if path is None else os.path.splitext(path)[1].lower()
    if suffix not in FIGURES:
        raise InputError(
            "E161",
            f"the name {path} does not determine a format",
            why=f"a figure is written as {', '.join(each[1:] for each in FIGURES)}",
            help="give a name such as error.png",
        )
    return suffix


def _figure(synthesis: FunctionSynthesis, suffix: str) -> bytes:
    from io import BytesIO

    from burmester import plot

    content = BytesIO()
    with plot.house_style():
        drawing = plot.structural_error_figure(synthesis)
        drawing.savefig(content, format=suffix[1:], metadata=FIGURES[suffix])
    return content.getvalue()


def page_of_function(task: FunctionTask, title: str) -> tuple[str, str, bool]:
    """The page on which function generators move, its headline, and whether one works."""
    from burmester.report.page import function_page
    from burmester.synthesis.function_generation import generate_function

    synthesis = generate_function(task)
    good = bool(synthesis.usable)
    return function_page(synthesis, title), f"{synthesis.outcome.message}.", good


def check_function(task: FunctionTask, poses: str | None, *, as_json: bool) -> int:
    """Show a function task and what stands out in it; returns the exit code."""
    from burmester.functions.pair_checks import pair_findings
    from burmester.io.files import quoted
    from burmester.io.function_overview import function_check_data, show_function_check

    findings = pair_findings(task)
    if as_json:
        print_json(function_check_data(task, findings))
    else:
        show_function_check(task, findings, console())
        if not findings and poses is not None:
            click.echo(f"\nNothing stands out. Next: burmester synthesize {quoted(poses)}")
        elif not findings:
            click.echo("\nNothing stands out. Next: burmester synthesize with the same options")
    return EXIT_NOTHING if findings else EXIT_FOUND


def export_choice(result: FunctionResult, id: str | None) -> FoundLinkage:
    """A linkage of a function's result as exports take it: the coupler is the body."""
    from dataclasses import replace

    from burmester.synthesis.function_generation import coupler_synthesis

    chosen = result.choose(id)
    judged = coupler_synthesis(result.synthesis.task, chosen)
    return replace(judged.linkages[0], id=chosen.id, usable=chosen.usable)


def judge_function(
    task: FunctionTask,
    linkage: str | None,
    given: dict[str, Any],
    *,
    file: str | None,
    force: bool,
    as_json: bool,
) -> int:
    """Judge a linkage of a function's result, or one by its links; returns the exit code."""
    from dataclasses import replace

    from burmester.io import files
    from burmester.io.function_result import function_data, read_function_result
    from burmester.io.function_table import show_function
    from burmester.io.reading.file_content import read_source
    from burmester.io.result import json_line
    from burmester.synthesis.function_generation import judge_generator, judge_links

    if file is not None:
        files.require_writable(file, force=force, source=linkage or "")
    if given["links"] is not None:
        for name, value in {
            "linkage": linkage,
            "id": given["id"],
            "ground": given["ground"],
        }.items():
            if value is not None:
                help = f"leave --{name} out, or --links"
                raise _contradiction(f"--links and --{name} are given", help)
        ground, *links = _link_lengths(given["links"])
        side = {None: None, "left": 1.0, "right": -1.0}[given["side"]]
        synthesis = judge_links(replace(task, ground=ground), (links[0], links[1], links[2]), side)
    elif linkage is None:
        message = "there is no linkage to judge"
        help = "give its lengths, such as --links 1,0.5,1.2,0.9, or --linkage FILE"
        raise _contradiction(message, help)
    else:
        result = read_function_result(read_source(linkage), linkage)
        synthesis = judge_generator(task, result.choose(given["id"]).generator)
    if file is not None:
        files.write(file, json_line(function_data(synthesis)), force=force)
    if as_json:
        print_json(function_data(synthesis))
    else:
        show_function(synthesis, console(), everything=True)
    return EXIT_FOUND if synthesis.usable else EXIT_NOTHING


def _link_lengths(text: str) -> list[float]:
    """The four lengths of --links; raises E190 and E194."""
    from burmester.io.reading.functions.expression import read_number
    from burmester.io.reading.pose_table import Source

    source, at, lengths = Source("--links", text), 0, []
    parts = text.split(",")
    if len(parts) != 4:
        raise _contradiction(
            f"--links has {len(parts)} numbers, and a four-bar has four links",
            "give the ground link, the input link, the coupler and the output link, such as "
            "--links 1,0.5,1.2,0.9",
        )
    for part in parts:
        length = read_number(source, at, part)
        if not 0 < length < 1e9:
            raise _contradiction(
                f"--links has the length {part.strip()}", "give lengths above 0 and below 1e9"
            )
        lengths.append(length)
        at += len(part) + 1
    return lengths
