"""A tracer of coupler motions that knows no drive, no dead point and no closing equation.

It walks along the coupler's motion in small steps (x, y, angle), by the constraints alone.
"""

import numpy as np

from burmester.fourbar.dyad import RP, RR
from burmester.fourbar.linkage import Linkage

FAR = 40.0  # an open circuit is left where the body is as far away
BEND, LONG, SHORT = 0.1, 0.05, 1e-6  # of a step: its greatest turn, its greatest and least length
NEAR = 1e-3  # from a pose to the walk that meets it
TOO_CLOSE = 2e-2  # from a walk to a pose that it does not meet, below which nothing is said


def constraint(dyad, at):
    """A dyad's equation and its gradient (k, 3) at x, y, angle (k, 3)."""
    d, t = at[:, 0] + 1j * at[:, 1], np.exp(1j * at[:, 2])
    if isinstance(dyad, RP):
        n, c = np.exp(1j * dyad.normal_angle), dyad.fixed_pivot @ [1, 1j]
        body = np.conj(t) * (c - d)
        along = t * n
        value = (np.conj(n) * body).real - dyad.offset
        return value, np.column_stack([-along.real, -along.imag, (np.conj(n) * -1j * body).real])
    arm = t * (dyad.moving_pivot @ [1, 1j])
    if isinstance(dyad, RR):
        to = d + arm - dyad.fixed_pivot @ [1, 1j]
        value, along = (abs(to) ** 2 / dyad.radius - dyad.radius) / 2, to / dyad.radius
    else:
        along = np.exp(1j * dyad.normal_angle)
        value = (np.conj(along) * (d + arm)).real - dyad.offset
    turning = (np.conj(along) * 1j * arm).real
    return value, np.stack(np.broadcast_arrays(along.real, along.imag, turning), axis=-1)


def directions(linkage, at):
    (_, a), (_, b) = constraint(linkage.first, at), constraint(linkage.second, at)
    along = np.cross(a, b)
    return along / np.linalg.norm(along, axis=1, keepdims=True)


def back_on(linkage, at):
    """Newton's method, by the shortest step."""
    for _ in range(4):
        (f, a), (g, b) = constraint(linkage.first, at), constraint(linkage.second, at)
        aa, ab, bb = (a * a).sum(1), (a * b).sum(1), (b * b).sum(1)
        det = aa * bb - ab * ab
        at = at - (a * ((f * bb - g * ab) / det)[:, None] + b * ((g * aa - f * ab) / det)[:, None])
    return at


def gap(a, b):
    """The difference of rows (*, 3), the angle within half a turn."""
    out = a - b
    out[..., 2] = (out[..., 2] + np.pi) % (2 * np.pi) - np.pi
    return out


def walks(linkage, start, sense):
    """For each linkage (k,) the walk (n, 3) from start (k, 3) in a sense (k,), and if it closed."""
    walked = [[row] for row in start]
    closed, ended = np.zeros(len(start), bool), np.zeros(len(start), bool)
    at, step, travelled = start.copy(), np.full(len(start), 1e-3), np.zeros(len(start))
    along = directions(linkage, at) * sense[:, None]
    first = along.copy()
    for _ in range(40_000):
        go = np.flatnonzero(~ended)
        if not len(go):
            return [np.array(rows) for rows in walked], closed
        some = Linkage(linkage.first[go], linkage.second[go])
        new = back_on(some, at[go] + step[go, None] * along[go])
        heading = directions(some, new)
        turn = (heading * along[go]).sum(1)
        heading *= np.sign(turn)[:, None]
        hop = np.linalg.norm(new - at[go], axis=1)
        # However it turns, the chord has to lie between both directions.
        sound = (np.abs(turn) > np.cos(BEND)) & (hop < 1.2 * step[go])
        sound &= ((new - at[go]) * heading).sum(1) > np.cos(BEND) * hop
        step[go[~sound]] /= 2
        assert (step > SHORT).all(), "the tracer is lost"
        before, after = gap(at[go], start[go]), gap(new, start[go])
        behind, ahead = (before * first[go]).sum(1), (after * first[go]).sum(1)
        share = np.divide(behind, behind - ahead, out=np.zeros_like(behind), where=behind != ahead)
        met = before + share[:, None] * (after - before)
        home = sound & (behind < 0) & (ahead >= 0) & (travelled[go] > 0)
        home &= (np.linalg.norm(met, axis=1) < NEAR) & ((heading * first[go]).sum(1) > 0.9)
        new[home] -= after[home]  # end where it began, not beyond
        done = go[sound]
        for k, row in zip(done, new[sound], strict=True):
            walked[k].append(row)
        at[done], along[done] = new[sound], heading[sound]
        travelled[done] += hop[sound]
        step[done] = np.minimum(1.3 * step[done], LONG)
        closed[go[home]] = True
        ended = closed | (np.abs(at[:, :2]).max(axis=1) > FAR)
    raise AssertionError("the tracer does not come to an end")


def driven(dyad, rows):
    """The coordinate of the ground joint along a walk (n, 3), without jumps."""
    d, t = rows[:, 0] + 1j * rows[:, 1], np.exp(1j * rows[:, 2])
    if isinstance(dyad, RP):
        return rows[:, 2] + dyad.normal_angle
    pin = d + t * (dyad.moving_pivot @ [1, 1j])
    if isinstance(dyad, RR):
        return np.unwrap(np.angle(pin - dyad.fixed_pivot @ [1, 1j]))
    return (pin * np.exp(-1j * dyad.normal_angle)).imag


def met_at(walk, rows):
    """How far each of rows (m, 3) is from a walk (n, 3), and at which step it is met."""
    base, leg = walk[:-1], np.diff(walk, axis=0)
    away = gap(rows[:, None], base)
    share = np.clip((away * leg).sum(-1) / (leg**2).sum(-1), 0, 1)
    far = np.linalg.norm(away - share[..., None] * leg, axis=-1)
    return far.min(axis=1), far.argmin(axis=1)
