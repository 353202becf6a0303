"""What is asked of a task and of its linkages, as options that several commands share.

A command takes groups of options (`takes`) and hands what was given on, to `task` or `synthesis`.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial, reduce
from typing import TYPE_CHECKING, Any, TypeAlias

import click

if TYPE_CHECKING:
    from burmester.synthesis.result import Synthesis
    from burmester.tasks.motion_task import Task

__all__ = [
    "FOUND",
    "MADE",
    "POSES_HELP",
    "READ",
    "WANTED",
    "Sectioned",
    "synthesis",
    "takes",
    "task",
]

Decorator: TypeAlias = Callable[[Any], Any]

POSES_HELP = """\b
POSES   a CSV, JSON or TOML file, "-" for standard input, or case:NAME for
        one of the tasks that burmester carries (see `burmester cases`). A CSV
        file starts with the line x,y,angle_deg (or angle_rad; x_mm,y_mm and
        the like name a unit); the columns weight, name and exact may follow.
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
for one dyad and the second for the other, and `any` leaves one free. A point
given once is for one dyad and leaves the other free, as two dyads cannot share
a pivot. Fixed pivots are in the frame of the ground, moving pivots in that of
the body, lengths in the unit of the poses."""


class _Option(click.Option):
    """An option that stands under a head of its own in the help."""

    def __init__(self, *args: Any, section: str, **settings: Any) -> None:
        super().__init__(*args, **settings)
        self.section = section


class Sectioned(click.Command):
    """A command whose help shows its options under heads."""

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the options, section by section."""
        records: dict[str, list[tuple[str, str]]] = {head: [] for head in HEADS}
        for option in self.get_params(ctx):
            record = option.get_help_record(ctx)
            if record and isinstance(option, click.Option):
                records[getattr(option, "section", HEADS[-1])].append(record)
        for head, rows in records.items():
            if rows:
                with formatter.section(head):
                    formatter.write_dl(rows)


HEADS = (
    "How the poses are read",
    "What is wanted",
    "How it is found",
    "What is made of it",
    "What is put out",
)
_read, _wanted, _found, _made = (
    partial(click.option, cls=_Option, section=head) for head in HEADS[:-1]
)

READ: tuple[Decorator, ...] = (
    _read(
        "--angle-unit",
        type=click.Choice(["deg", "rad"]),
        help="Unit of an angle column that does not name one.",
    ),
    _read(
        "--columns",
        metavar="NAME,...",
        help="The header that a CSV file lacks, such as x,y,angle_deg.",
    ),
    _read(
        "--drop",
        metavar="3,7",
        multiple=True,
        help="Poses to leave out, by number or by name; the rest is counted anew.",
    ),
    _read(
        "--pose-sigma",
        metavar="LENGTH,DEG",
        help="Standard deviation of the poses' positions and angles; else it is taken from the "
        "digits they are given with.",
    ),
)

WANTED: tuple[Decorator, ...] = (
    _wanted(
        "--fixed-pivot",
        metavar="REGION",
        multiple=True,
        help="Where a fixed pivot may be, on the ground.",
    ),
    _wanted(
        "--moving-pivot",
        metavar="REGION",
        multiple=True,
        help="Where a moving pivot may be, on the body.",
    ),
    _wanted(
        "--length",
        metavar="MIN:MAX",
        multiple=True,
        help="How long an RR dyad's link may be; either side may be empty.",
    ),
    _wanted(
        "--kinds",
        metavar="RR,PR,RP",
        multiple=True,
        help="Which dyads may be used: links RR, sliders PR, slots RP.",
    ),
    _wanted(
        "--exact",
        metavar="1,5",
        multiple=True,
        help="Poses to be met exactly, by number or by name.",
    ),
    _wanted(
        "--min-transmission",
        metavar="DEG",
        help="Least transmission angle over the range that the poses use.",
    ),
    _wanted(
        "--type",
        "types",
        metavar="NAME[,NAME]",
        multiple=True,
        help="Which types of linkage may be used; see below.",
    ),
    _wanted(
        "--driver",
        type=click.Choice(["any", "first", "second", "crank"]),
        help="Which dyad drives: the one of the first or of the second limits, or one that turns "
        "fully.",
    ),
    _wanted(
        "--footprint",
        metavar="REGION",
        help="A box or a polygon on the ground that holds all pivots, wherever the poses take "
        "them.",
    ),
    _wanted(
        "--link-ratio",
        metavar="R",
        help="The longest of the four links is at most R times the shortest.",
    ),
    _wanted(
        "--within", metavar="LENGTH", help="Greatest position error at a pose that is acceptable."
    ),
    _wanted(
        "--any-order",
        is_flag=True,
        help="The poses need not be met in the order they are given in.",
    ),
)

FOUND: tuple[Decorator, ...] = (
    _found(
        "--method",
        type=click.Choice(["auto", "pencil", "complete", "exact"]),
        metavar="METHOD",
        default="auto",
        show_default=True,
        help="pencil: the paper's two dyads for 6 poses or more; complete: every locally best dyad "
        "for 6 or more; exact: all dyads through 5; auto: complete for 6 or more, exact for 5.",
    ),
    _found(
        "--norm",
        type=click.Choice(["rms", "worst"]),
        default="rms",
        show_default=True,
        help="What is made small: least squares, or the smallest worst deviation.",
    ),
    _found(
        "--angle-weight",
        "length_per_radian",
        metavar="LENGTH",
        help="The length that weighs as much as one radian of angle error; by default the size of "
        "the motion.",
    ),
    _found("--certify", is_flag=True, help="Prove with interval arithmetic what can be proved."),
    _found(
        "--raw",
        is_flag=True,
        help="Fit the numbers as they come, as the paper does; the answer then depends on frames "
        "and units.",
    ),
)

MADE: tuple[Decorator, ...] = (
    _made(
        "--tolerance",
        "manufacturing_tolerance",
        metavar="LENGTH",
        help="How exactly pivots and lengths are made; tells the error that comes of it.",
    ),
    _made(
        "--round",
        "rounding_step",
        metavar="STEP",
        help="Round lengths and pivots to multiples of STEP, and judge the linkage again.",
    ),
    _made(
        "--stock",
        "stock_lengths",
        metavar="L1,L2,...",
        multiple=True,
        help="The link lengths that are to be had; the nearest ones are taken, and judged again.",
    ),
)


def takes(*groups: tuple[Decorator, ...]) -> Decorator:
    """A decorator that gives a command the argument POSES and groups of options."""
    options = [click.argument("poses"), *(option for group in groups for option in group)]
    return lambda command: reduce(lambda made, option: option(made), reversed(options), command)


def task(poses: str, **given: Any) -> Task:
    """The task that the options of READ, and of WANTED if there are any, make of POSES."""
    from burmester.io.reading import requirements_text as text
    from burmester.io.reading.limits_text import limits_from_options
    from burmester.io.reading.poses import read_task

    further: dict[str, Any] = {}
    if "length" in given:
        limits = (given[name] for name in ("fixed_pivot", "moving_pivot", "length", "kinds"))
        requirements = text.requirements_from_options(
            **{name: given[name] for name in _REQUIREMENTS}
        )
        specification = limits_from_options(*limits)._replace(requirements=requirements)
        further = {"specification": specification, "exact": given["exact"]}
    sigma = given["pose_sigma"]
    return read_task(
        poses,
        angle_unit=given["angle_unit"],
        pose_sigma=None if sigma is None else text.pose_sigma(sigma),
        **{name: given[name] for name in ("columns", "drop") if given[name]},
        **further,
    )


def synthesis(poses: str, **given: Any) -> Synthesis:
    """What the options of all groups make of POSES."""
    from burmester.io.reading import requirements_text as text
    from burmester.synthesis.motion_generation import synthesize
    from burmester.tasks.options import SynthesisOptions

    further: dict[str, Any] = {}
    for keyword, option in _LENGTHS.items():
        if given[keyword] is not None:
            further[keyword] = text.positive_length(option, given[keyword])
    if given["stock_lengths"]:
        further["stock_lengths"] = text.lengths("--stock", given["stock_lengths"])
    options = SynthesisOptions(
        given["method"],
        given["norm"],
        normalise=not given["raw"],
        certify=given["certify"],
        **further,
    )
    return synthesize(task(poses, **given), options)


_LENGTHS = {
    "length_per_radian": "--angle-weight",
    "manufacturing_tolerance": "--tolerance",
    "rounding_step": "--round",
}
_REQUIREMENTS = (
    "min_transmission",
    "types",
    "driver",
    "footprint",
    "link_ratio",
    "within",
    "any_order",
)
