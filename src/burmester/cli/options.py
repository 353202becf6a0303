"""The options that several commands share: poses, specification, method, manufacturing.

A command is declared with groups of options (`with_options`); `read_poses` and `run_synthesis`
take their values.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial, reduce
from typing import TYPE_CHECKING, Any, TypeAlias

import click

from burmester.cli.output import CONTENT
from burmester.requirements.table import ASKED
from burmester.tasks.option_table import LIMIT_OPTIONS, OPTIONS

if TYPE_CHECKING:
    from burmester.fourbar.linkage import Linkage
    from burmester.requirements.requirement import Requirement
    from burmester.synthesis.given_linkage import GivenDyad
    from burmester.synthesis.result import Synthesis
    from burmester.tasks.motion_task import Task
    from burmester.tasks.option_table import Option
    from burmester.tasks.options import SynthesisOptions

Decorator: TypeAlias = Callable[[Any], Any]

POSES_HELP = """\b
POSES   a CSV, .xlsx, JSON, TOML or Parquet file, "-" for standard input, or
        case:NAME for one of the tasks in the package (see `burmester cases`),
        or a link to a task (t1=..., with its address or without).
        A table starts with the line x,y,angle_deg (or angle_rad; x_mm,y_mm
        and the like name a unit; so do X [mm], Winkel [°] and others); the
        columns weight, name and exact may follow.
        Recordings of markers (TRC, CSV, .xlsx) are read by --points.
        A blank angle is a point of the body. A path to trace is a table x,y
        of ten points or more, with crank_deg if the crank times it, or the
        curve in a drawing, FILE.svg or .dxf[:PART].
REGION  X,Y                    a point
        line:X,Y:X,Y           the endless line through two points
        segment:X,Y:X,Y        the piece between them
        box:X,Y:X,Y            from lower left to upper right
        polygon:X,Y:X,Y:X,Y    three corners or more, in order
        any                    no limit
NAME    crank-rocker, rocker-crank, double-crank, double-rocker (these four
        together: grashof), triple-rocker (or non-grashof), change-point,
        slider-crank, "inverted slider-crank", "double slider",
        "Oldham linkage", "Rapson slide"

A limit given once holds for both dyads of a linkage; given twice, the first is
for one dyad and the second for the other, and `any` leaves a dyad free. A point
given once is for one dyad and leaves the other free, because two dyads cannot
share a pivot. Fixed pivots are in the frame of the ground, moving pivots in that
of the body, lengths in the unit of the poses."""


class Number(click.FloatRange):
    """A number in digits that a double holds, within a range."""

    name = "number"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        """The double of a text; click takes 1_000, nan and 1e-400 as well."""
        if isinstance(value, str):
            from burmester.io.reading.pose_table import NUMBER, plain_number, shown, unheld

            plain, mark = plain_number(value.strip(), ",")
            if mark is None:
                why = f"{shown(value)} is no number such as 12.5 or 3e-4"
                self.fail(unheld(plain) if NUMBER.fullmatch(plain) else why, param, ctx)
        return float(super().convert(value, param, ctx))


class SectionOption(click.Option):
    """An option with the section of the help that lists it."""

    def __init__(self, *args: Any, section: str, **settings: Any) -> None:
        super().__init__(*args, **settings)
        self.section = section


class Sectioned(click.Command):
    """A command whose help lists its options by sections."""

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the options, section by section."""
        records: dict[str, list[tuple[str, str]]] = {}
        for option in self.get_params(ctx):
            record = option.get_help_record(ctx)
            if record and isinstance(option, click.Option):
                records.setdefault(getattr(option, "section", OUTPUT), []).append(record)
        records[OUTPUT] = records.pop(OUTPUT)  # last
        for head, rows in records.items():
            with formatter.section(head):
                formatter.write_dl(rows)


OUTPUT = "Output"  # the section of all options that name none
_linkage, _poses, _specification, _method, _manufacturing = (
    partial(click.option, cls=SectionOption, section=head)
    for head in ("Linkage", "Poses", "Limits and requirements", "Method", "Manufacturing")
)

LINKAGE: tuple[Decorator, ...] = (
    _linkage("--linkage", metavar="FILE", help="The file that holds the linkage."),
    _linkage(
        "--id",
        metavar="ID",
        help="The linkage of a result, such as L2 or S2; by default its first one.",
    ),
    _linkage("--dyad", metavar="DYAD", multiple=True, help="A dyad of the linkage; give two."),
    _linkage(
        "--length",
        metavar="LENGTH",
        multiple=True,
        help="Length of the link of each --dyad that is a link, in their order (any: it follows "
        "from the poses); MIN:MAX is a limit instead, as in `burmester synthesize`.",
    ),
    _linkage("--improve", is_flag=True, help="Look for the nearest better linkages as well."),
)

POSES: tuple[Decorator, ...] = (
    _poses(
        "--angle-unit",
        type=click.Choice(["deg", "rad"]),
        help="Unit of an angle column that does not name one.",
    ),
    _poses(
        "--convention",
        metavar="NAME,...",
        help="What the file does otherwise than burmester: clockwise (angles count clockwise), "
        "y-down (y points down), swap-xy (x and y are exchanged), radians or degrees (whatever its "
        "header says). Limits stay as given.",
    ),
    _poses(
        "--columns",
        metavar="NAME,...",
        help="The header that a CSV file or a sheet lacks, such as x,y,angle_deg; it replaces one "
        "that is there.",
    ),
    _poses(
        "--sheet",
        metavar="NAME|NUMBER",
        help="The sheet of an .xlsx workbook; by default the first one.",
    ),
    _poses(
        "--points",
        metavar="M1,M2,...",
        help="Markers on the body, of a motion capture: the first is its origin, its x axis points "
        "to the second; three or more are fitted as a rigid body.",
    ),
    _poses(
        "--plane",
        metavar="XY|YZ|XZ|fit",
        help="The axes of markers that become x and y, or the plane nearest to their motion (fit); "
        "by default the axis along which they hardly move is passed over.",
    ),
    _poses(
        "--drop",
        metavar="3,7",
        multiple=True,
        help="Poses to leave out, by number or by name; the others keep their numbers as names.",
    ),
    _poses("--every", metavar="N", type=click.IntRange(min=1), help="Take every Nth pose only."),
    _poses(
        "--from",
        "first",
        metavar="POSE",
        help="The first pose to take, by its number in the file, by name, or by time (1.5s; a "
        "column of times without a unit is in seconds).",
    ),
    _poses("--to", "last", metavar="POSE", help="The last pose to take, likewise."),
    _poses(
        "--closed",
        is_flag=True,
        help="Points x,y that are traced lead back to the first one, and the crank turns fully.",
    ),
    _poses(
        "--absolute-crank",
        is_flag=True,
        help="The crank angles of poses are directions on the ground, and not rotations from the "
        "first of them.",
    ),
    _poses(
        "--within-crank",
        "within_crank_deg",
        metavar="DEG",
        type=click.FloatRange(min=0, min_open=True),
        help="How far the crank may be from its angle at a pose; by default a twentieth of the "
        "range of its angles.",
    ),
    _poses(
        "--pose-tolerance",
        metavar="X,Y,DEG[,body]",
        help="How far from a pose the body may be: to both sides in x, y and angle, for all poses "
        "that state nothing else; 0 is exact, free means that it does not count; along the axes "
        "of the ground, or of the body.",
    ),
    _poses(
        "--pose-sigma",
        metavar="LENGTH,DEG",
        help="Standard deviation of the poses' positions and angles; by default it follows from "
        "the number of digits printed.",
    ),
)

_SETTINGS: dict[Any, dict[str, Any]] = {"names": {"multiple": True}, "flag": {"is_flag": True}}


def _requirement(each: Requirement) -> Decorator:
    """The option of a requirement."""
    settings = _SETTINGS.get(each.form, {})
    if each.choices:
        settings = {"type": click.Choice([*each.choices])}
    return _specification(
        each.option, each.argument, metavar=each.metavar, help=each.help, **settings
    )


_LIMITS: dict[str, Decorator] = {
    each.name: _specification(each.option, metavar=each.metavar, multiple=True, help=each.help)
    for each in LIMIT_OPTIONS
}
SPECIFICATION: tuple[Decorator, ...] = (
    *_LIMITS.values(),
    _specification(
        "--body",
        metavar="FILE[:PART]",
        help="The outline of the body in a DXF or SVG file, or in one layer (DXF) or id (SVG) of "
        "it; its origin and axes are those of the body's frame.",
    ),
    _specification(
        "--keep-out",
        metavar="FILE[:PART]",
        multiple=True,
        help="A region of the ground that body and links must not touch between the poses, "
        "likewise.",
    ),
    _specification(
        "--link-width",
        metavar="LENGTH",
        help="Width of the links, with round ends, for keep-out regions; by default 0.",
    ),
    _specification(
        "--exact",
        metavar="1,5",
        multiple=True,
        help="Poses to be met exactly, by number or by name.",
    ),
    *map(_requirement, ASKED),
)


def _synthesis(each: Option) -> Decorator:
    """The option of a synthesis."""
    settings: dict[str, Any] = {"is_flag": True} if each.form == "flag" else {}
    if each.known:
        settings = {"type": click.Choice(each.known), "default": each.known[0]}
        settings["show_default"] = True
    if each.form == "lengths":
        settings = {"multiple": True}
    declared = _manufacturing if each.manufacturing else _method
    return declared(each.option, each.name, metavar=each.metavar, help=each.help, **settings)


_SYNTHESIS = {each.name: _synthesis(each) for each in OPTIONS}
METHOD, MANUFACTURING = (
    tuple(_SYNTHESIS[each.name] for each in OPTIONS if each.manufacturing is manufacturing)
    for manufacturing in (False, True)
)
OF_JUDGEMENT = ("norm", "length_per_radian", "time_limit", "manufacturing_tolerance")

OF_SIX_BARS = {"chains": "--chains", "seed": "--seed", "kind": "--six-bar-kind"}
SIX_BARS: tuple[Decorator, ...] = (
    _method(
        "--six-bars",
        is_flag=True,
        help="Look for linkages of six bars instead (Watt I, Stephenson I and III), through two to "
        "five poses exactly, for tasks that no four-bar does.",
    ),
    _method(
        "--chains",
        metavar="N",
        type=click.IntRange(min=1),
        help="How many 3R chains are made six-bars of each kind, drawn at random; by default "
        "20,000.",
    ),
    _method(
        "--six-bar-kind",
        "kind",
        metavar="KIND",
        help='Six-bars of one kind only: "Watt I", "Stephenson I" or "Stephenson III"; by default '
        "all.",
    ),
    _method(
        "--seed",
        metavar="N",
        type=click.IntRange(min=0),
        help="Seed of these random chains; the same one gives the same answer. By default 0.",
    ),
)

# What a linkage that exists is judged by; its --length is that of its links.
JUDGEMENT = (
    LINKAGE,
    POSES,
    tuple(each for each in SPECIFICATION if each is not _LIMITS["length"]),
    tuple(_SYNTHESIS[name] for name in OF_JUDGEMENT),
)


def with_options(*groups: tuple[Decorator, ...]) -> Decorator:
    """A decorator that gives a command the argument POSES and groups of options."""
    options = [click.argument("poses"), *(option for group in groups for option in group)]
    return lambda command: reduce(lambda made, option: option(made), reversed(options), command)


def pose_arguments(given: dict[str, Any]) -> list[str]:
    """The options of POSES as they were given, for the next command."""
    words: list[str] = []
    for name, value in given.items():
        option = {"first": "--from", "last": "--to"}.get(name, f"--{name.replace('_', '-')}")
        if isinstance(value, bool):
            words += [option] if value else []
            continue
        values = value if isinstance(value, tuple) else () if value is None else (value,)
        words += [word for each in values for word in (option, str(each))]
    return words


def read_poses(poses: str, **given: Any) -> Task:
    """The task in the file POSES, by the options of POSES and, if given, of SPECIFICATION."""
    from burmester.io.reading import specification_text as text
    from burmester.io.reading.outline_options import OutlineOptions
    from burmester.io.reading.poses import read_task

    further: dict[str, Any] = {}
    if "length" in given:
        limits = {name: given[name] for name in _LIMITS}
        requirements = text.requirements_from_options(**given)
        specification = text.limits_from_options(**limits)._replace(requirements=requirements)
        outlines = OutlineOptions(given["body"], given["keep_out"], given["link_width"])
        further = {
            "specification": specification,
            "exact": given["exact"],
            "outlines": outlines,
        }
    sigma, tolerance = given["pose_sigma"], given["pose_tolerance"]
    return read_task(
        poses,
        angle_unit=given["angle_unit"],
        pose_sigma=None if sigma is None else text.pose_sigma(sigma),
        tolerance=None if tolerance is None else text.pose_tolerance(tolerance),
        data=click.get_current_context().meta.get(CONTENT),
        **{name: given[name] for name in _ROWS if given[name]},
        **further,
    )


def run_synthesis(poses: str, *, six_bars: bool, **given: Any) -> Synthesis:
    """The synthesis for the file POSES, of four-bars or six-bars, by the options of all groups.

    Raises E197 where an option has no meaning for what is looked for.
    """
    from burmester.cli.progress_line import working
    from burmester.errors import InputError
    from burmester.synthesis.motion_generation import synthesize

    numbers = {name: given[name] for name in OF_SIX_BARS if given[name] is not None}
    if six_bars:
        _refuse_options(_NOT_FOR_SIX_BARS, "--six-bars")
    for name in () if six_bars else numbers:
        raise InputError(
            "E197",
            f"{OF_SIX_BARS[name]} is for six-bars, and they are not looked for",
            help="give --six-bars as well, or leave it out",
        )
    settings = {"time_limit": given["time_limit"]} if six_bars else given
    options = synthesis_options(settings, poses)
    with working("reading the poses"):
        task = read_poses(poses, **given)
        if not six_bars:
            return synthesize(task, options)
        from burmester.sixbar.six_bars import SixBarOptions
        from burmester.synthesis.six_bars import synthesize_six_bars

        return synthesize_six_bars(task, SixBarOptions(**numbers), options)


def _refuse_options(names: tuple[str, ...], instead: str) -> None:
    """Refuse options that are typed and have no meaning for six-bars; raises E197."""
    from burmester.errors import InputError

    context = click.get_current_context()
    typed = click.core.ParameterSource.COMMANDLINE
    for option in context.command.params:
        if option.name in names and (context.get_parameter_source(option.name) is typed):
            raise InputError(
                "E197",
                f"{option.opts[0]} has no meaning for six-bars",
                help=f"leave {option.opts[0]} out, or {instead}",
            )


def run_judgement(
    poses: str, *, linkage: str | None, id: str | None, dyad: tuple[str, ...], **given: Any
) -> Synthesis:
    """The judgement of a linkage at the poses in the file POSES, by the options of JUDGEMENT."""
    from burmester.cli.progress_line import working
    from burmester.io.linkage_file import read_linkage
    from burmester.io.reading.dyads_text import (
        dyads_from_options,
        lengths_and_limits,
        require_one_source,
    )
    from burmester.mechanisms.contract import Mechanism
    from burmester.synthesis.judgement import judge_linkage

    require_one_source(poses, linkage, dyad, id)
    lengths, limits = lengths_and_limits(given.pop("length"), typed=bool(dyad))
    options = synthesis_options(given, poses)
    with working("reading the poses"):
        task = read_poses(poses, length=limits, **given)
        if linkage is None:
            one: Linkage | Sequence[GivenDyad] = dyads_from_options(dyad, lengths)
        else:
            given_one = read_linkage(linkage, id, task.length_unit)
            if isinstance(given_one, Mechanism):
                from burmester.synthesis.six_bars import judge_six_bar

                _refuse_options(("improve", "norm", "manufacturing_tolerance"), "take a four-bar")
                return judge_six_bar(task, given_one, options)
            one = given_one
        return judge_linkage(task, one, options, improve=given["improve"])


def synthesis_options(given: Mapping[str, Any], poses: str) -> SynthesisOptions:
    """How a task is solved, by the texts of options; a link states those that are not typed."""
    from burmester.io.reading.link import is_link, read_link
    from burmester.io.reading.option_text import option_value
    from burmester.tasks.options import SynthesisOptions

    stated = [each for each in OPTIONS if given.get(each.name) is not None]
    values: dict[str, Any] = {}
    if is_link(poses) and (of_link := read_link(poses).options):
        from burmester.live.document import options_of

        linked, source = options_of(of_link), click.get_current_context().get_parameter_source
        typed = click.core.ParameterSource.COMMANDLINE
        stated = [each for each in stated if source(each.name) is typed]
        values = {each.name: getattr(linked, each.name) for each in OPTIONS if each.name in given}
    values |= {each.name: option_value(each, given[each.name]) for each in stated}
    return SynthesisOptions(**values)


_NOT_FOR_SIX_BARS = (
    *(each.name for each in OPTIONS if each.name != "time_limit"),
    *("family_map", "require_determined", "everything", "dyads"),
)
_ROWS = (
    "columns", "sheet", "points", "plane", "drop", "every", "first", "last", "closed", "convention",
    "absolute_crank", "within_crank_deg",
)  # fmt: skip
