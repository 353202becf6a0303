"""`burmester export`: one linkage of a result as a file for another program."""

from __future__ import annotations

from typing import Any

import click

from burmester.cli.options import Number
from burmester.cli.output import EXIT_FOUND, console

FORMATS = """\b
FORMAT  dxf, svg       plates with their holes for cutting, and the assembly
        pdf            the plates at 1:1 on A4 or Letter, to print
        step           solid parts, assembled
        stl            solid parts flat beside each other, for printing
        openscad       a model with its numbers on top, animated
        mjcf, urdf     for simulation (MuJoCo; robots)
        sdf            for simulation (Gazebo)
        gif, mp4       the motion
        csv, json      the coupler's places, or all joints; the linkage itself
        pylinkage      a Python script

Six-bars have all of these but pylinkage.

Every file is read back and compared with the linkage before it gets its name.
Lengths are in the unit of the poses."""


@click.command(epilog=FORMATS)
@click.argument("result")
@click.option("--linkage", metavar="ID", help="The linkage, such as L2; by default the best one.")
@click.option("--to", metavar="FORMAT", help="Format, if the name of FILE does not determine it.")
@click.option("-o", "--output", metavar="FILE", required=True, help="Name of the file.")
@click.option("--force", is_flag=True, help="Write FILE even if it exists.")
@click.option(
    "--length-unit",
    "--unit",
    "unit",
    metavar="UNIT",
    help="Unit of the lengths, if the poses state none or px; by default mm.",
)
@click.option("--hole", type=Number(), metavar="LENGTH", help="Diameter of holes.")
@click.option("--pin", type=Number(), metavar="LENGTH", help="Diameter of pins.")
@click.option("--width", type=Number(), metavar="LENGTH", help="Width of the links.")
@click.option("--thickness", type=Number(), metavar="LENGTH", help="Thickness of the plates.")
@click.option(
    "--gap", type=Number(), metavar="LENGTH", help="Gap between plates that lie on each other."
)
@click.option(
    "--pose", type=int, metavar="N", default=1, help="Pose at which the assembly is drawn."
)
@click.option(
    "--dimensions/--no-dimensions",
    default=True,
    help="Whether drawings have dimension lines, on a layer of their own.",
    show_default=True,
)
@click.option(
    "--assembled",
    is_flag=True,
    help="The parts of an stl in their places, not flat beside each other.",
)
@click.option(
    "--density",
    type=Number(),
    metavar="KG/M3",
    default=2700.0,
    help="Density of plates and pins in mjcf, urdf and sdf; steel has 7850.",
    show_default="2700, aluminium",
)
@click.option(
    "--up",
    metavar="AXIS",
    default="y",
    help="Direction that is up in mjcf, urdf and sdf: x, y, -x or -y; z where the linkage lies "
    "flat.",
    show_default=True,
)
@click.option(
    "--seconds", type=Number(), default=4.0, help="Duration of gif and mp4.", show_default=True
)
@click.option(
    "--fps",
    "frames_per_second",
    type=Number(),
    default=25.0,
    help="Frames per second of gif and mp4.",
    show_default=True,
)
@click.option(
    "--pixels", "width_px", type=int, default=800, help="Width of gif and mp4.", show_default=True
)
def export(
    result: str,
    *,
    linkage: str | None,
    to: str | None,
    output: str,
    force: bool,
    **options: Any,
) -> int:
    """Write one linkage of RESULT for another program.

    RESULT is the file of `burmester synthesize POSES -o RESULT`.
    """
    from burmester.cli.progress_line import working
    from burmester.export import Options, require_format
    from burmester.export import export as run
    from burmester.io.files import require_writable
    from burmester.io.message import show
    from burmester.io.saved import JUDGED_OTHERWISE, read_result
    from burmester.printable import printable

    name = require_format(output, to)
    require_writable(output, force=force, source=result)
    with working("reading the result"):
        read = read_result(result)
        chosen = read.exported(linkage)
    for each in read.synthesis.warnings:
        if each.code == JUDGED_OTHERWISE:  # the others were said when the result was made
            show("warning", each, console())
    with working("writing the file"):
        paths = run(chosen, name, output, Options(**options), force)
    for path in paths:
        click.echo(
            f"wrote {printable(str(path))}: {chosen.id}, {chosen.type}; read back and verified"
        )
    if not chosen.usable:
        command = "judge" if chosen.id.startswith("S") else "synthesize"
        click.echo(f"{chosen.id} is not usable: `burmester {command}` says why", err=True)
    return EXIT_FOUND
