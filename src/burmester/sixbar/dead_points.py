"""Where a six-bar locks while a crank drives it, in closed form.

The first loop, A, C, D, B, is a four-bar and locks as one does.  The second, D, E, H, G, moves by
the angle at D between the coupler and the second crank, which is a function of the first loop
alone.  It locks where its diagonal EG is as long as the floating link and the body's EH together,
or as their difference: at two angles at D with two signs each, which the first loop has at two
drives each.  So there are at most eight dead points of the second loop beside at most two of the
first, and between two that follow each other nothing locks.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from burmester.mechanisms.circles import arccos_or_nan
from burmester.mechanisms.four_bar_loop import FourBarLoop
from burmester.numerics.arrays import ComplexArray, FloatArray, complex_of
from burmester.sixbar.motion import Drive, Sides, drive_of, joints_at, sides_of

if TYPE_CHECKING:
    from burmester.sixbar.watt import WattLinkage

__all__ = ["OF_FIRST_LOOP", "dead_places", "dead_points", "first_loop", "turning_points"]

OF_FIRST_LOOP = 4  # dead points of the first loop; those of the second follow them


def dead_points(linkage: WattLinkage, sides: Sides, driver: Drive) -> FloatArray:
    """The drives at which linkages (*,) lock on their branch: (*, 12), nan where there is none.

    Formula `second-loop` of the theory.
    sides: of the branch, which is that of the first loop; the second locks where its two sides
    meet.
    """
    loop = first_loop(linkage)
    e, g = _arms(linkage)
    body = np.abs(complex_of(linkage.link_joint) - complex_of(linkage.body_joint))
    link = linkage.floating_link
    reach = np.stack([body + link, np.abs(body - link)], axis=-1)
    between = arccos_or_nan(np.abs(e), np.abs(g), reach)
    offset = np.angle(e / g)[..., None]
    joints = loop.with_angle(np.concatenate([offset + between, offset - between], axis=-1))
    second = _drives_on_branch(joints, sides, driver)
    return np.concatenate([loop.locked(first=driver == "first"), second], axis=-1)


def dead_places(linkage: WattLinkage, driver: Drive) -> ComplexArray:
    """The joints (m, 7) at all dead points of one linkage."""
    out = []
    for first in (1.0, -1.0):
        sides = Sides(np.array(first), np.ones(()))
        drives = dead_points(linkage, sides, driver)
        own, other = drives[:OF_FIRST_LOOP], drives[OF_FIRST_LOOP:]
        if first > 0:  # both sides of the first loop meet there
            out += [
                joints_at(linkage, own, Sides(np.zeros(()), np.array(k)), driver) for k in (1, -1)
            ]
        out.append(joints_at(linkage, other, Sides(sides.first, np.zeros(())), driver))
    joints = np.concatenate(out)
    return joints[np.isfinite(joints).all(axis=-1)]


def first_loop(linkage: WattLinkage) -> FourBarLoop:
    """The loop A, C, D, B of linkages (*,)."""
    a, b = complex_of(linkage.fixed_first), complex_of(linkage.fixed_second)
    coupler = np.abs(complex_of(linkage.coupler_joint))
    return FourBarLoop.of(a, b, linkage.first_crank, coupler, linkage.second_crank)


def turning_points(linkage: WattLinkage, sides: Sides, driver: Drive) -> FloatArray:
    """The drives at which a transmission angle of linkages (*,) may be least: (*, 10), or nan.

    Formula `second-loop-turns` of the theory.
    Those at which the driver is in line with the ground, so that the first loop's diagonal turns
    back; those at which the first crank is, so that the angle at D does; and those at which the
    angle in the second loop between DE and DG passes zero or half a turn.
    """
    loop = first_loop(linkage)
    e, g = _arms(linkage)
    way, offset = np.angle(loop.direction)[..., None], np.angle(e / g)[..., None]
    diagonal = loop.with_angle(np.concatenate([offset, offset + np.pi], axis=-1))
    joints = np.concatenate([loop.with_straight_crank(), diagonal], axis=-2)
    inside = _drives_on_branch(joints, sides, driver)
    return np.concatenate([way, way + np.pi, inside], axis=-1)


def _arms(linkage: WattLinkage) -> tuple[ComplexArray, ComplexArray]:
    """DE as DC sees it, and DG as DB sees it: (*,) each.

    Turned by the angle at D from DC to DB, the second is as DC sees it.
    """
    d, g = complex_of(linkage.coupler_joint), complex_of(linkage.crank_joint)
    return (d - linkage.coupler_arm) * np.abs(d) / d, linkage.second_crank - g


def _drives_on_branch(joints: ComplexArray, sides: Sides, driver: Drive) -> FloatArray:
    """The drives (*, k) of first loops (*, k, 4) that are closed on a branch's side; else nan."""
    whole = np.concatenate([joints, joints[..., :3]], axis=-1)  # the second loop is not asked
    with np.errstate(invalid="ignore"):
        same = sides_of(whole, driver).first == sides.first[..., None]
    return np.where(same, drive_of(whole, driver), np.nan)
