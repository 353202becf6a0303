"""A Python script that builds the linkage with pylinkage and takes it through its poses.

What pylinkage has: cranks and sliders that drive, and followers that are links or sliders on the
ground.  It has no slot on a moving body, so a linkage with an RP dyad is refused.

E160 the file does not contain the linkage        E163 a linkage that pylinkage has no parts for
"""

from __future__ import annotations

import ast
import math
from pathlib import Path
from typing import Any

import numpy as np

from burmester.cures import Cure, Help
from burmester.errors import InputError
from burmester.export.description import description, number, python_docstring
from burmester.export.models.bodies import JointMotion
from burmester.export.options import PRECISION, Options, Reference, require_equal
from burmester.fourbar.dyad import PR, RP, RR
from burmester.numerics.arrays import FloatArray
from burmester.verdicts.found_linkage import FoundLinkage

RAIL_MARGIN = 0.05  # of the travel: rail beyond each of its ends

IMPORTS = '''"""{about}

Run it to see where the joints and the body are at each pose; `build()` gives the linkage.
"""

import math

from pylinkage.actuators import {actuator}
from pylinkage.components import Ground, PointTracker
from pylinkage.dyads import {dyad}
from pylinkage.simulation import Linkage
'''
RUN = '''

def poses(steps=200):
    """The positions of all components at the poses, one after the other."""
    linkage = build()
    linkage.rebuild()
    place = DRIVES[START]
    # From where it is assembled to the first pose, then on from each to the next.
    stops = [*DRIVES[START:0:-1], *DRIVES]
    for number, stop in enumerate(stops):
        for positions in linkage.step(iterations=steps, dt=(stop - place) / steps):
            pass
        place = stop
        if number >= START:
            yield {component.name: at for component, at in zip(linkage.components, positions)}


if __name__ == "__main__":
    for number, positions in enumerate(poses(), start=1):
        (x, y), (x1, y1) = positions["body"], positions["body_x"]
        angle = math.degrees(math.atan2(y1 - y, x1 - x))
        print(f"pose {number}: body at ({x:.9g}, {y:.9g}), {angle:.9g} degrees")
        for name, (px, py) in positions.items():
            print(f"    {name}: ({px:.9g}, {py:.9g})")
'''


def write(chosen: FoundLinkage, path: Path, options: Options) -> None:
    """Write the script; raises E163."""
    reference, (driver, follower) = _reference(chosen, options)
    place = reference.places[options.pose - 1]
    one, two = driver.moving_pivot, follower.moving_pivot
    drive = JointMotion.of(chosen, reference).at_poses[:, 0]
    tips = place.act(np.stack([one, two]))
    actuator = "Crank" if isinstance(driver, RR) else "LinearActuator"
    dyad = "RRRDyad" if isinstance(follower, RR) else "RRPDyad"
    head = "\n".join(map(python_docstring, description(chosen, options, None)))
    arm = two - one
    length = math.hypot(*arm.tolist())
    angle = math.atan2(arm[1], arm[0])

    def tracked(point: Any) -> str:
        """A point of M by its distance and angle from the way between the two pivots."""
        to = np.asarray(point) - one
        return f"{number(math.hypot(*to.tolist()))}, {number(math.atan2(to[1], to[0]) - angle)}"

    lines = [
        IMPORTS.format(about=head, actuator=actuator, dyad=dyad),
        f"COUPLER = {number(length)}  # between its pivots",
    ]
    numbers, body, drives = _driver(driver, reference, drive)
    lines += numbers
    x, y = tips[1].tolist()
    lines.append(f"B0 = {_p((x, y))}  # the follower's pin at the start")
    numbers, more, grounds = _follower(follower, reference)
    lines += numbers
    body += more
    body += [
        'body = PointTracker(driver.output, follower, *BODY, name="body")',
        'body_x = PointTracker(driver.output, follower, *BODY_X, name="body_x")',
        f"parts = [{', '.join(grounds)}, driver, follower, body, body_x]",
        f"return Linkage(parts, name={chosen.id!r})",
    ]
    unit_x = np.array([length, 0.0])
    lines += [
        "# The body's origin and a point of its x axis: distance and angle from the driver's pin.",
        f"BODY = ({tracked((0.0, 0.0))})",
        f"BODY_X = ({tracked(unit_x)})",
        "# Where the driver is at the poses: "
        + ("radians." if isinstance(driver, RR) else "from the beginning of its rail."),
        f"DRIVES = {[float(each) for each in drives]!r}",
        f"START = {options.pose - 1}  # the pose at which it is assembled, from 0",
        "",
        "",
        "def build():",
        '    """The linkage, assembled."""',
        *[f"    {each}" for each in body],
    ]
    path.write_text("\n".join(lines) + "\n" + RUN, encoding="utf-8", newline="\n")


def _reference(chosen: FoundLinkage, options: Options) -> tuple[Reference, list[RR | PR]]:
    """The linkage in the task's unit, and its dyads; raises E163 where pylinkage has none."""
    both = chosen.driver_first
    dyads = [each for each in (both.first, both.second) if isinstance(each, RR | PR)]
    if len(dyads) < 2:
        slot = isinstance(both.first, RP) or isinstance(both.second, RP)
        raise InputError(
            "E163",
            f"linkage {chosen.id} cannot be built with pylinkage",
            why="it has no slot on a moving body (RP)"
            if slot
            else "it has no body that only translates (PP)",
            help=Help.of(
                "choose a linkage of RR and PR dyads, or {}, which has slots", Cure("to", "mjcf")
            )
            if slot
            else "choose another linkage",
        )
    return Reference.of(chosen, options, None), dyads


def _rail(dyad: PR) -> tuple[FloatArray, FloatArray]:
    """The foot of a slider's line, the point nearest to the origin, and its direction."""
    c, s = np.cos(dyad.normal_angle), np.sin(dyad.normal_angle)
    return dyad.offset * np.array([c, s]), np.array([-s, c])


def _driver(
    dyad: RR | PR, reference: Reference, drive: FloatArray
) -> tuple[list[str], list[str], FloatArray]:
    """The driver's numbers, what builds it, and where it is at the poses (N,)."""
    ground = 'a = Ground(*A, name="A")'
    if isinstance(dyad, RR):
        numbers = [
            f"A = {_p(dyad.fixed_pivot)}  # the driver's fixed pivot",
            f"CRANK = {number(float(dyad.radius))}",
        ]
        built = (
            "driver = Crank(a, CRANK, angular_velocity=1.0, initial_angle=DRIVES[START], "
            'name="driver")'
        )
        return numbers, [ground, built], drive
    # The rail begins a little before the first place, and ends a little behind the last.
    foot, along = _rail(dyad)
    room = RAIL_MARGIN * (float(np.ptp(drive)) or reference.span)
    low = float(drive.min()) - room
    drives = drive - low
    numbers = [
        f"A = {_p(foot + low * along)}  # where the driver's rail begins",
        f"DIRECTION = {number(math.atan2(along[1], along[0]))}",
        f"STROKE = {number(float(drives.max()) + room)}",
    ]
    built = (
        "driver = LinearActuator(a, DIRECTION, STROKE, speed=1.0, "
        'initial_extension=DRIVES[START], name="driver")'
    )
    return numbers, [ground, built], drives


def _follower(dyad: RR | PR, reference: Reference) -> tuple[list[str], list[str], list[str]]:
    """The follower's numbers, what builds it, and the names of all points of the ground."""
    if isinstance(dyad, RR):
        numbers = [
            f"B = {_p(dyad.fixed_pivot)}  # the follower's fixed pivot",
            f"ROCKER = {number(float(dyad.radius))}",
        ]
        built = [
            'b = Ground(*B, name="B")',
            "follower = RRRDyad(driver.output, b, COUPLER, ROCKER, x=B0[0], y=B0[1], "
            'name="follower")',
        ]
        return numbers, built, ["a", "b"]
    foot, along = _rail(dyad)
    s = reference.places.act(dyad.moving_pivot) @ along
    room = RAIL_MARGIN * (float(np.ptp(s)) or reference.span)
    ends = [foot + each * along for each in (s.min() - room, s.max() + room)]
    built = [
        'b1, b2 = Ground(*RAIL[0], name="B1"), Ground(*RAIL[1], name="B2")',
        'follower = RRPDyad(driver.output, b1, b2, COUPLER, x=B0[0], y=B0[1], name="follower")',
    ]
    return [f"RAIL = [{_p(ends[0])}, {_p(ends[1])}]  # of the follower"], built, ["a", "b1", "b2"]


def _p(point: Any) -> str:
    return f"({number(point[0])}, {number(point[1])})"


def check(chosen: FoundLinkage, path: Path, options: Options) -> None:
    """Read the script's numbers back as Python has them, and compare; raises E160."""
    reference, (driver, follower) = _reference(chosen, options)
    tolerance = PRECISION * reference.span
    tree = ast.parse(path.read_text(encoding="utf-8"))
    constants: dict[str, Any] = {}
    for node in tree.body:
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            constants[node.targets[0].id] = ast.literal_eval(node.value)
    drives, start = np.array(constants["DRIVES"]), constants["START"]
    require_equal("the pose at the start", start, options.pose - 1, 0)
    if isinstance(driver, RR):
        require_equal("the driver's fixed pivot", constants["A"], driver.fixed_pivot, tolerance)
        require_equal("the driver's length", constants["CRANK"], driver.radius, tolerance)
        way = np.stack([np.cos(drives), np.sin(drives)], axis=1) * constants["CRANK"]
    else:
        way = drives[:, None] * [math.cos(constants["DIRECTION"]), math.sin(constants["DIRECTION"])]
    pins = np.array(constants["A"]) + way
    one, two = driver.moving_pivot, follower.moving_pivot
    require_equal("the driver's pin at the poses", pins, reference.places.act(one), tolerance)
    require_equal(
        "the follower's pin", constants["B0"], reference.places[start].act(two), tolerance
    )
    require_equal(
        "the coupler's length", constants["COUPLER"], np.linalg.norm(two - one), tolerance
    )
    if isinstance(follower, RR):
        require_equal("the follower's fixed pivot", constants["B"], follower.fixed_pivot, tolerance)
        require_equal("the follower's length", constants["ROCKER"], follower.radius, tolerance)
    else:
        foot, along = _rail(follower)
        off = (np.array(constants["RAIL"]) - foot) @ np.array([-along[1], along[0]])
        require_equal("the follower's rail", off, [0, 0], tolerance)
    arm = two - one
    for name, point in (("BODY", [0.0, 0.0]), ("BODY_X", [constants["COUPLER"], 0.0])):
        size, angle = constants[name]
        turn = complex(*arm) / abs(complex(*arm)) * complex(math.cos(angle), math.sin(angle))
        at = complex(*one) + size * turn
        require_equal(f"{name} on the coupler", [at.real, at.imag], point, tolerance)
