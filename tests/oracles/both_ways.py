"""The curve that a linkage really travels from point to point, by the witness's own kinematics."""

import numpy as np

from tests.oracles.witness import places

STEPS = 40  # of the driver between two points, at least
FINEST = 0.01  # radians; a step of the driver is no longer


def travelled(first, second, where, closed):
    """Pieces (complex arrays) of the curve between places `where` (x, y, angle), the first driving.

    The driver goes from place to place: where it turns fully, in the sense in which most of its
    steps are short, else straight.  Of a closed path the last piece leads back to the first place.
    """
    z = where.translation[:, 0] + 1j * where.translation[:, 1]
    pin = z + complex(*first.moving_pivot) * np.exp(1j * where.angle)
    drive = np.angle(pin - complex(*first.fixed_pivot))
    both = places(first, second, drive)[0]
    side = int(np.nansum(abs(both - z), axis=1).argmin())
    whole = np.isfinite(places(first, second, np.linspace(0, 2 * np.pi, 721))[0]).all()
    step = np.angle(np.exp(1j * np.diff(drive, append=drive[:1])))
    if whole:
        forward, short = np.diff(drive, append=drive[:1]) % (2 * np.pi), np.abs(step) > 1e-6
        ahead = forward[:-1][short[:-1]]
        sense = 1 if ahead.sum() <= (2 * np.pi - ahead).sum() else -1
        step = np.where(np.abs(step) > 1e-6, sense * ((sense * step) % (2 * np.pi)), step)
        # What goes back by less than a point's share of the way is a step back, no turn.
        back = np.abs(step) > 2 * np.pi - 0.05
        step = np.where(back, step - 2 * np.pi * np.sign(step), step)
    pieces = []
    for j in range(len(drive) if closed else len(drive) - 1):
        number = max(STEPS, int(abs(step[j]) / FINEST))
        pieces.append(
            places(first, second, drive[j] + step[j] * np.linspace(0, 1, number))[0][side]
        )
    return pieces


def from_segment(points, a, b):
    """The distances of points (n,) from the segment between a and b, as complex numbers."""
    chord = b - a
    share = np.clip(((points - a) * np.conj(chord)).real / max(abs(chord) ** 2, 1e-300), 0, 1)
    return np.abs(points - a - share * chord)


def from_path(points, path, closed):
    """The distances of points (n,) from the nearest chord of a path (N,)."""
    ends = np.append(path[1:], path[:1]) if closed else path[1:]
    return np.min([from_segment(points, a, b) for a, b in zip(path, ends, strict=False)], axis=0)
