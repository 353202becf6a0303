"""Six-bars of Watt's first kind driven by Newton's method on their bars alone.

No circle is met with another here and no dead point is known: the moving joints C, D, E, G, H are
ten unknowns, the distances between joints of one link and the angle of the driver ten equations.
From one place the next is found by small steps of the driver; where the Jacobian changes its sign
the linkage has locked on the way.
"""

from dataclasses import dataclass

import numpy as np

MOVING = "CDEGH"
LIST = ("AC", "BD", "CD", "CE", "DE", "BG", "DG", "GH", "EH")


def _c(pair):
    return complex(*np.asarray(pair, dtype=float))


@dataclass
class Run:
    """Body places (x, y, angle) at the drives, the sign of each Jacobian, the worst gap."""

    places: np.ndarray
    signs: np.ndarray
    gap: float
    joints: np.ndarray
    angles: np.ndarray  # the least of both loops' transmission angles, from the joints


def dimensions(linkage):
    """The bars of a linkage, from its numbers alone."""
    d, g = _c(linkage.coupler_joint), _c(linkage.crank_joint)
    arm, crank = float(linkage.coupler_arm), float(linkage.second_crank)
    return {
        "AC": float(linkage.first_crank),
        "BD": crank,
        "CD": abs(d),
        "CE": arm,
        "DE": abs(d - arm),
        "BG": abs(g),
        "DG": abs(g - crank),
        "GH": float(linkage.floating_link),
        "EH": abs(_c(linkage.link_joint) - _c(linkage.body_joint)),
    }


def assembled(linkage, pose, driver, drive):
    """The moving joints at a pose (x, y, angle) of the body, C or D from the driver's angle."""
    a, b = _c(linkage.fixed_first), _c(linkage.fixed_second)
    body = complex(pose[0], pose[1])
    turn = np.exp(1j * pose[2])
    e, h = (body + turn * _c(each) for each in (linkage.body_joint, linkage.link_joint))
    at_d, at_g = _c(linkage.coupler_joint), _c(linkage.crank_joint)
    arm = float(linkage.coupler_arm)
    if driver == "first":
        c = a + float(linkage.first_crank) * np.exp(1j * drive)
        d = c + (e - c) / arm * at_d
    else:  # the coupler is known by D and E
        d = b + float(linkage.second_crank) * np.exp(1j * drive)
        c = d + (e - d) / (arm - at_d) * (0 - at_d)
    g = b + (d - b) / float(linkage.second_crank) * at_g
    return np.array([c, d, e, g, h])


def _equations(joints, bars, ground, driver, drive):
    at = dict(zip(MOVING, joints, strict=True)) | ground
    rows, values = [], []
    for bar in LIST:
        p, q = bar
        gap = at[p] - at[q]
        row = np.zeros(10)
        for joint, sign in ((p, 1), (q, -1)):
            if joint in MOVING:
                k = 2 * MOVING.index(joint)
                row[k : k + 2] += 2 * sign * np.array([gap.real, gap.imag])
        rows.append(row)
        values.append(abs(gap) ** 2 - bars[bar] ** 2)
    end, pivot = ("C", "A") if driver == "first" else ("D", "B")
    normal = 1j * np.exp(1j * drive)  # the driver is along the drive: nothing across it
    row = np.zeros(10)
    k = 2 * MOVING.index(end)
    row[k : k + 2] = normal.real, normal.imag
    rows.append(row)
    values.append((np.conj(normal) * (at[end] - ground[pivot])).real)
    return np.array(values), np.array(rows)


def _angle(tip, one, other):
    p, q = one - tip, other - tip
    cosine = abs((p * np.conj(q)).real) / abs(p * q)
    return np.arccos(min(1.0, cosine))


def driven(linkage, pose, driver, drives):
    """The linkage, assembled at a pose where the driver is at drives[0], driven along `drives`."""
    bars = dimensions(linkage)
    ground = {"A": _c(linkage.fixed_first), "B": _c(linkage.fixed_second)}
    size = max(bars.values())
    joints = assembled(linkage, pose, driver, drives[0])
    places, signs, gap, trail, angles = [], [], 0.0, [], []
    e0, h0 = _c(linkage.body_joint), _c(linkage.link_joint)
    before = None
    for drive in drives:
        guess = joints if before is None else 2 * joints - before
        now = guess
        for _ in range(12):
            value, jacobian = _equations(now, bars, ground, driver, drive)
            step = np.linalg.solve(jacobian, value)
            now = now - step.view(complex)
            if np.abs(step).max() < 1e-13 * size:
                break
        value, jacobian = _equations(now, bars, ground, driver, drive)
        gap = max(gap, np.abs(value).max() / size**2)
        signs.append(np.sign(np.linalg.det(jacobian / size)))
        before, joints = joints, now
        c, d, e, g, h = joints
        first = _angle(d, c, ground["B"]) if driver == "first" else _angle(c, d, ground["A"])
        angles.append(min(first, _angle(h, g, e)))
        turn = (h - e) / (h0 - e0)
        origin = e - turn * e0
        places.append((origin.real, origin.imag, np.angle(turn)))
        trail.append(joints)
    return Run(np.array(places), np.array(signs), gap, np.array(trail), np.array(angles))
