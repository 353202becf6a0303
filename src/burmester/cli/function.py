"""`burmester function`: from a function, or pairs of angles, to the four-bars that make it."""

from __future__ import annotations

import os
from functools import partial
from typing import TYPE_CHECKING, Any, Final

import click

from burmester.cli.options import Sectioned, SectionOption
from burmester.cli.output import (
    CONTENT,
    EXIT_FOUND,
    EXIT_NOTHING,
    NOTES,
    console,
    hand_over,
    print_json,
)

if TYPE_CHECKING:
    from burmester.errors import InputError
    from burmester.synthesis.function_generation import FunctionSynthesis
    from burmester.tasks.function_task import FunctionTask

TABLES: Final = (".csv", ".tsv", ".txt", ".xlsx", ".parquet", ".toml", ".json")  # no expressions
OF_EXPRESSIONS: Final = ("x", "input_deg", "output_deg", "opposite", "pairs", "spacing")
NUMBERS: Final = ("input_deg", "output_deg", "input_phase_deg", "output_phase_deg", "ground")
AS_GIVEN: Final = ("opposite", "pairs", "spacing", "minimax")
NOT_CHECKED: Final = ("links", "linkage", "plot", "report", "file")
EXAMPLE: Final = '`burmester function "log10(x)" --x 1:2 --input 60 --output 60`'
HELP: Final = """\b
EXPRESSION
        numbers, x, pi, e, + - * / **, brackets, and sin, cos, tan, asin,
        acos, atan (radians), sqrt, exp, log (natural), log10, abs
PAIRS   a CSV, .xlsx or Parquet file with the columns input_deg and output_deg
        (or input_rad, output_rad), and weight if wanted: what the two links
        turn to together, each from a zero of its own; a TOML or JSON file
        with a table [function]; "-" for standard input

\b
burmester function "log10(x)" --x 1:2 --input 60 --output 60
burmester function pairs.csv --check
burmester function pairs.csv --report page.html -o result.json
burmester function pairs.csv --links 1,2.2,0.7,2"""

_function, _kept, _linkage = (
    partial(click.option, cls=SectionOption, section=head)
    for head in ("Function", "Requirements", "A linkage that exists")
)


@click.command(cls=Sectioned, epilog=HELP)
@click.argument("source", metavar="EXPRESSION|PAIRS")
@_function("--x", metavar="FROM:TO", help="The range of x, such as 1:2 or 0:pi/2.")
@_function("--input", "input_deg", metavar="DEG", help="How far the input link turns over it.")
@_function("--output", "output_deg", metavar="DEG", help="How far the output link turns over it.")
@_function("--opposite", is_flag=True, help="The output link turns against the input link.")
@_function(
    "--pairs",
    metavar="N",
    type=int,
    help="Take N pairs of angles from the function: 3 to 5 are met exactly; by default 61, as "
    "nearly as possible.",
)
@_function(
    "--spacing",
    type=click.Choice(["chebyshev", "even"]),
    help="Where these pairs are; by default Chebyshev's spacing up to 5, even beyond.",
)
@_function("--sheet", metavar="NAME|NUMBER", help="The sheet of a workbook; by default the first.")
@_function("--minimax", is_flag=True, help="Make the greatest error least, not the sum of squares.")
@_function(
    "--input-phase",
    "input_phase_deg",
    metavar="DEG",
    help="Angle of the input link from the ground link where the input is 0; by default it is "
    "found.",
)
@_function("--output-phase", "output_phase_deg", metavar="DEG", help="The same of the output link.")
@_function("--ground", metavar="LENGTH", help="Length of the ground link; by default 1.")
@_kept("--min-transmission", metavar="DEG", help="Least transmission angle over the range.")
@_kept("--link-ratio", metavar="R", help="Longest link divided by the shortest, at most.")
@_kept(
    "--type",
    "types",
    metavar="NAME[,NAME]",
    multiple=True,
    help="Types of linkage allowed, such as double-rocker.",
)
@_linkage(
    "--links",
    metavar="GROUND,INPUT,COUPLER,OUTPUT",
    help="Judge the linkage with these lengths; phases that are not given are those that fit best.",
)
@_linkage(
    "--side",
    type=click.Choice(["left", "right"]),
    help="Where its output pin lies, seen from the input link's pin to the output's pivot; by "
    "default on the better side.",
)
@_linkage("--linkage", metavar="FILE", help="Judge a linkage of this result.")
@_linkage("--id", metavar="ID", help="Which one, such as L2; by default the first.")
@click.option("--check", is_flag=True, help="Show the pairs and what stands out; solve nothing.")
@click.option("--all", "everything", is_flag=True, help="List every linkage, with the reasons.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object and nothing else.")
@click.option("-o", "file", metavar="FILE", help="Write that object to FILE as well.")
@click.option("--plot", metavar="FILE", help="Draw the structural error (.png, .svg, .pdf).")
@click.option("--report", metavar="FILE", help="Write a page on which the linkages move (.html).")
@click.option("--title", metavar="TEXT", help="Title of that page.")
@click.option("--force", is_flag=True, help="Write files even if they exist.")
def function(
    source: str,
    *,
    check: bool,
    everything: bool,
    as_json: bool,
    file: str | None,
    plot: str | None,
    report: str | None,
    title: str | None,
    force: bool,
    **given: Any,
) -> int:
    """Find four-bars whose output link turns as a function of the input link.

    The function is an EXPRESSION in x, or PAIRS of angles in a file.  A linkage that exists is
    judged by --links or --linkage.

    Exit code 0: a linkage works; 1: none does, or --check finds something; 2: the input cannot be
    used.
    """
    from dataclasses import replace

    from burmester.cli.family_map import figure_format
    from burmester.cli.progress_line import working
    from burmester.io import files
    from burmester.printable import printable
    from burmester.report import page
    from burmester.synthesis.function_generation import generate_function

    task = _task(source, given)
    task = replace(task, notes=(*click.get_current_context().meta.get(NOTES, ()), *task.notes))
    if check:
        for name, value in {**given, "plot": plot, "report": report, "file": file}.items():
            if name in NOT_CHECKED and value is not None:
                raise contradiction(f"--check and {_option(name)} are given", "give one of the two")
        return _check(task, source, as_json=as_json)
    for each in (file, plot, report):
        if each is not None:
            files.require_writable(each, force=force, source="" if task.function else source)
    suffix = figure_format(plot or "error.png", "a figure")
    name = os.path.basename(source) if os.path.exists(source) else source
    with working("looking for function generators"):
        synthesis = _judged(task, given) or generate_function(task)
    hand_over(
        synthesis,
        file,
        (plot, lambda: _figure(synthesis, suffix)),
        (report, lambda: page(synthesis, printable(title or name))),
        force=force,
        as_json=as_json,
        everything=everything,
    )
    return EXIT_FOUND if synthesis.usable else EXIT_NOTHING


def contradiction(message: str, help: str, why: str | None = None) -> InputError:
    """E194: settings that are missing or exclude each other."""
    from burmester.errors import InputError

    return InputError("E194", message, why=why, help=help)


def _task(source: str, given: dict[str, Any]) -> FunctionTask:
    """The task; raises E101 to E109, E190, E191, E192 and E194."""
    from burmester.io.reading.functions.function_file import read_function
    from burmester.io.reading.functions.function_options import read_range, task_of_function
    from burmester.io.reading.pose_table import Source

    stated = [name for name in OF_EXPRESSIONS if given[name]]
    named = source == "-" or source.lower().endswith(TABLES)
    if named or ("x" not in stated and os.path.exists(source)):
        if stated:
            option = _option(stated[0])
            file = "; a file to write is named by -o" if stated[0] == "output_deg" else ""
            raise contradiction(
                f"{option} is given, and the file states the pairs",
                f"leave {option} out, or write it into the table [function] of a TOML file{file}",
            )
        return read_function(_content(source), source, _stated(given), given["sheet"])
    for name in OF_EXPRESSIONS[:3]:
        if given[name] is None:
            if not stated and not any(sign in source for sign in "x()*+ "):
                _content(source)  # which says that there is no such file
            option = _option(name)
            raise contradiction(f"{option} is missing", f"give {option}, as in {EXAMPLE}")
    x = read_range(Source("--x", given["x"]))
    if given["output_deg"].lower().endswith(TABLES):
        raise contradiction(
            "--output is the range of the output link, in degrees",
            f"give --output 60, say, and name the file by -o {given['output_deg']}",
        )
    return task_of_function({**_stated(given), "expression": source, "x": x})


def _content(source: str) -> bytes:
    """The bytes of a file of pairs; raises E101."""
    from burmester.errors import InputError
    from burmester.io.reading.file_content import read_source
    from burmester.printable import printable

    try:
        return click.get_current_context().meta.get(CONTENT) or read_source(source)
    except InputError as error:
        error.message = error.message.replace("poses", "pairs of angles")
        error.where = error.where or printable(source)
        raise


def _stated(given: dict[str, Any]) -> dict[str, Any]:
    """What options state, by the keys of a file."""
    from burmester.io.reading.functions.expression import read_number
    from burmester.io.reading.pose_table import Source
    from burmester.io.reading.specification_text import requirements_from_options

    numbers = {name: given[name] for name in NUMBERS if given[name] is not None}
    return {
        **{key: read_number(Source(_option(key), text), 0, text) for key, text in numbers.items()},
        **{name: given[name] for name in AS_GIVEN if given[name]},
        **{each.field: each.value for each in requirements_from_options(**given)},
    }


def _option(name: str) -> str:
    return next(each.opts[0] for each in function.params if each.name == name)


def _judged(task: FunctionTask, given: dict[str, Any]) -> FunctionSynthesis | None:
    """The judgement of a linkage that exists; None where none is given."""
    from dataclasses import replace

    from burmester.errors import InputError
    from burmester.io.reading.functions.function_options import read_links
    from burmester.io.saved import read_result
    from burmester.synthesis.function_generation import (
        FunctionSynthesis,
        judge_generator,
        judge_links,
    )

    links, linkage = given["links"], given["linkage"]
    if links is not None:
        for name in ("linkage", "id", "ground"):
            if given[name] is not None:
                raise contradiction(
                    f"--links and --{name} are given", f"leave --{name} out, or --links"
                )
        ground, a, r, b = read_links("--links", links)
        side = {None: None, "left": 1.0, "right": -1.0}[given["side"]]
        return judge_links(replace(task, ground=ground), (a, r, b), side)
    for name, needed in (("side", "--links"), ("id", "--linkage")):
        if given[name] is not None and (name == "side" or linkage is None):
            raise contradiction(
                f"--{name} is given, and no {needed}", f"leave --{name} out, or give {needed}"
            )
    if linkage is None:
        return None
    result = read_result(linkage)
    if not isinstance(result.synthesis, FunctionSynthesis):
        help = "take a result of `burmester function`, or give the lengths by --links"
        raise InputError("E150", "this is no result of function", where=result.label, help=help)
    return judge_generator(task, result.choose(given["id"]).generator)


def _check(task: FunctionTask, source: str, *, as_json: bool) -> int:
    """Show a function task and what stands out in it; returns the exit code."""
    from burmester.diagnosis.pair_checks import pair_findings
    from burmester.io.files import quoted
    from burmester.io.overview import function_check_data, show_function_check

    findings = pair_findings(task)
    if as_json:
        print_json(function_check_data(task, (*task.notes, *findings)))
    else:
        show_function_check(task, (*task.notes, *findings), console())
        if not findings:
            again = f"burmester function {quoted(source)}"
            more = " with the same options" if task.function else ""
            click.echo(f"\nNothing stands out. Next: {again}{more}")
    return EXIT_NOTHING if findings else EXIT_FOUND


def _figure(synthesis: FunctionSynthesis, suffix: str) -> bytes:
    from burmester import plot
    from burmester.cli.family_map import figure_bytes

    with plot.house_style():
        drawing = plot.structural_error_figure(synthesis)
    return figure_bytes(drawing, suffix)
