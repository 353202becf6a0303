"""`burmester synthesize`: what is wanted of it, as options."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import click

from burmester.cli.out import EXIT_FOUND, EXIT_NOTHING, console, print_json

if TYPE_CHECKING:
    from burmester.synthesis import Synthesis

__all__ = ["synthesize"]

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

WANTED, FOUND, MADE, OTHER = (
    "What is wanted",
    "How it is found",
    "What is made of it",
    "In and out",
)
ASKED = (
    "min_transmission",
    "types",
    "driver",
    "footprint",
    "link_ratio",
    "within",
    "any_order",
)
SECTIONS = dict.fromkeys(("fixed_pivot", "moving_pivot", "length", "kinds", "exact"), WANTED)
SECTIONS |= dict.fromkeys(ASKED, WANTED)
SECTIONS |= dict.fromkeys(("method", "norm", "pose_sigma", "angle_weight", "certify", "raw"), FOUND)
SECTIONS |= dict.fromkeys(("tolerance", "step", "stock", "accept_uncertain"), MADE)


class Sectioned(click.Command):
    """A command whose help shows its options under heads."""

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the options, section by section."""
        records: dict[str, list[tuple[str, str]]] = {
            head: [] for head in (WANTED, FOUND, MADE, OTHER)
        }
        for option in self.get_params(ctx):
            record = option.get_help_record(ctx)
            if record and isinstance(option, click.Option):
                records[SECTIONS.get(str(option.name), OTHER)].append(record)
        for head, rows in records.items():
            with formatter.section(head):
                formatter.write_dl(rows)


@click.command(cls=Sectioned, epilog=POSES_HELP)
@click.argument("poses")
@click.option(
    "--fixed-pivot",
    metavar="REGION",
    multiple=True,
    help="Where a fixed pivot may be, on the ground.",
)
@click.option(
    "--moving-pivot",
    metavar="REGION",
    multiple=True,
    help="Where a moving pivot may be, on the body.",
)
@click.option(
    "--length",
    metavar="MIN:MAX",
    multiple=True,
    help="How long an RR dyad's link may be; either side may be empty.",
)
@click.option(
    "--kinds",
    metavar="RR,PR,RP",
    multiple=True,
    help="Which dyads may be used: links RR, sliders PR, slots RP.",
)
@click.option(
    "--exact",
    metavar="1,5",
    multiple=True,
    help="Poses to be met exactly, by number or by name.",
)
@click.option(
    "--min-transmission",
    metavar="DEG",
    help="Least transmission angle over the range that the poses use.",
)
@click.option(
    "--type",
    "types",
    metavar="NAME[,NAME]",
    multiple=True,
    help="Which types of linkage may be used; see below.",
)
@click.option(
    "--driver",
    type=click.Choice(["any", "first", "second", "crank"]),
    help="Which dyad drives: the one of the first or of the second limits, or one that turns "
    "fully.",
)
@click.option(
    "--footprint",
    metavar="REGION",
    help="A box or a polygon on the ground that holds all pivots, wherever the poses take them.",
)
@click.option(
    "--link-ratio",
    metavar="R",
    help="The longest of the four links is at most R times the shortest.",
)
@click.option(
    "--within", metavar="LENGTH", help="Greatest position error at a pose that is acceptable."
)
@click.option(
    "--any-order", is_flag=True, help="The poses need not be met in the order they are given in."
)
@click.option(
    "--method",
    type=click.Choice(["auto", "pencil", "complete", "exact"]),
    metavar="METHOD",
    default="auto",
    show_default=True,
    help="pencil: the paper's two dyads for 6 poses or more; complete: every locally best dyad "
    "for 6 or more; exact: all dyads through 5; auto: complete for 6 or more, exact for 5.",
)
@click.option(
    "--norm",
    type=click.Choice(["rms", "worst"]),
    default="rms",
    show_default=True,
    help="What is made small: least squares, or the smallest worst deviation.",
)
@click.option(
    "--pose-sigma",
    metavar="LENGTH,DEG",
    help="Standard deviation of the poses' positions and angles; else it is taken from the digits "
    "they are given with.",
)
@click.option(
    "--angle-weight",
    metavar="LENGTH",
    help="The length that weighs as much as one radian of angle error; by default the size of "
    "the motion.",
)
@click.option("--certify", is_flag=True, help="Prove with interval arithmetic what can be proved.")
@click.option(
    "--raw",
    is_flag=True,
    help="Fit the numbers as they come, as the paper does; the answer then depends on frames "
    "and units.",
)
@click.option(
    "--tolerance",
    metavar="LENGTH",
    help="How exactly pivots and lengths are made; tells the error that comes of it.",
)
@click.option(
    "--round",
    "step",
    metavar="STEP",
    help="Round lengths and pivots to multiples of STEP, and judge the linkage again.",
)
@click.option(
    "--stock",
    metavar="L1,L2,...",
    multiple=True,
    help="The link lengths that are to be had; the nearest ones are taken, and judged again.",
)
@click.option(
    "--accept-uncertain",
    is_flag=True,
    help="Exit with 0 even if the poses hardly determine where the pivots are.",
)
@click.option(
    "--angle-unit",
    type=click.Choice(["deg", "rad"]),
    help="Unit of an angle column that does not name one.",
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object and nothing else.")
def synthesize(
    poses: str,
    *,
    fixed_pivot: tuple[str, ...],
    moving_pivot: tuple[str, ...],
    length: tuple[str, ...],
    kinds: tuple[str, ...],
    exact: tuple[str, ...],
    min_transmission: str | None,
    types: tuple[str, ...],
    driver: Literal["any", "first", "second", "crank"] | None,
    footprint: str | None,
    link_ratio: str | None,
    within: str | None,
    any_order: bool,
    method: Literal["auto", "pencil", "complete", "exact"],
    norm: Literal["rms", "worst"],
    pose_sigma: str | None,
    angle_weight: str | None,
    certify: bool,
    raw: bool,
    tolerance: str | None,
    step: str | None,
    stock: tuple[str, ...],
    accept_uncertain: bool,
    angle_unit: Literal["deg", "rad"] | None,
    as_json: bool,
) -> int:
    """Find four-bars that guide a body through POSES."""
    from burmester.io import requirements_text as text
    from burmester.io.limits_text import wanted
    from burmester.io.poses import read_task
    from burmester.synthesis import synthesize as run

    asked = text.asked(
        min_transmission=min_transmission,
        types=types,
        driver=driver,
        footprint=footprint,
        link_ratio=link_ratio,
        within=within,
        any_order=any_order,
    )
    further: dict[str, Any] = {}
    if angle_weight is not None:
        further["length"] = text.above_zero("--angle-weight", angle_weight)
    if tolerance is not None:
        further["tolerance"] = text.above_zero("--tolerance", tolerance)
    if step is not None:
        further["step"] = text.above_zero("--round", step)
    if stock:
        further["stock"] = text.lengths("--stock", stock)
    task = read_task(
        poses,
        angle_unit=angle_unit,
        wanted=wanted(fixed_pivot, moving_pivot, length, kinds)._replace(asked=asked),
        exact=exact,
        sigma=None if pose_sigma is None else text.pose_sigma(pose_sigma),
    )
    synthesis = run(task, method, normalise=not raw, norm=norm, certify=certify, **further)
    if as_json:
        from burmester.io.result import plain

        print_json(plain(synthesis))
    else:
        from burmester.io.terminal import show_synthesis

        show_synthesis(synthesis, console())
    return _exit_code(synthesis, accept_uncertain)


def _exit_code(synthesis: Synthesis, accept_uncertain: bool) -> int:
    """Whether a linkage was found that can be built: it works, and its pivots are determined."""
    found = synthesis.determined or (accept_uncertain and bool(synthesis.usable))
    return EXIT_FOUND if found else EXIT_NOTHING
