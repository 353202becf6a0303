"""Motion capture of a known four-bar, and the files that programs export of such a recording.

The linkage moves by plane trigonometry alone, and the files are written by hand: nothing of the
package is used.  A missing marker is NaN here.
"""

from typing import NamedTuple

import numpy as np

FRAMES_A_SECOND = 100

# A crank-rocker: fixed pivots, crank, coupler, rocker; and markers in the frame of the coupler.
GROUND = np.array([[0.0, 0.0], [100.0, 10.0]])
LINKS = (40.0, 110.0, 80.0)
MARKERS = {"M1": (30.0, 50.0), "M2": (120.0, 20.0), "M3": (60.0, -30.0)}


class FourBar(NamedTuple):
    """A linkage whose crank turns fully, and markers on its coupler."""

    ground: np.ndarray = GROUND
    links: tuple[float, float, float] = LINKS
    markers: dict[str, tuple[float, float]] = MARKERS


USUAL = FourBar()


def crank_rocker(angles, linkage=USUAL):
    """The pins on crank and rocker for angles of the crank, each (N, 2)."""
    crank, coupler, rocker = linkage.links
    first = linkage.ground[0] + crank * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    between = linkage.ground[1] - first
    distance = np.hypot(*between.T)
    beside = np.arccos((coupler**2 + distance**2 - rocker**2) / (2 * coupler * distance))
    direction = np.arctan2(between[:, 1], between[:, 0]) + beside
    second = first + coupler * np.stack([np.cos(direction), np.sin(direction)], axis=1)
    return first, second


def recording(frames=200, *, noise=0.3, seed=1, turn=(0.3, 4.8), height=900.0, linkage=USUAL):
    """Names and places (N, K, 3) of the markers on the coupler and of one at rest, in mm."""
    rng = np.random.default_rng(seed)
    first, second = crank_rocker(np.linspace(*turn, frames), linkage)
    along = (second - first) / linkage.links[1]
    across = np.stack([-along[:, 1], along[:, 0]], axis=1)
    flat = [first + u * along + v * across for u, v in linkage.markers.values()]
    flat.append(np.tile([5.0, -20.0], (frames, 1)))
    places = np.stack([np.c_[each, np.full(frames, height)] for each in flat], axis=1)
    return (*linkage.markers, "BASE"), places + noise * rng.normal(size=places.shape)


def _cells(places, digits):
    return [[("" if np.isnan(v) else f"{v:.{digits}f}") for v in row.ravel()] for row in places]


def nexus(names, places, first=101, digits=2):
    """Vicon Nexus: sections, names above every X, units below the axes."""
    head = "Trajectories\n100\n" + ",," + ",,,".join(f"Arm:{name}" for name in names) + ",,\n"
    head += "Frame,Sub Frame" + ",X,Y,Z" * len(names) + "\n,,"
    head += ",".join(["mm"] * 3 * len(names)) + "\n"
    rows = _cells(places, digits)
    return head + "".join(f"{first + k},0,{','.join(row)}\n" for k, row in enumerate(rows))


def motive(names, places):
    """OptiTrack Motive: in metres, a rigid body beside the markers, a line of types."""
    count = len(names)
    head = "Format Version,1.23,Take Name,Take 2024-03-01,Capture Frame Rate,100.000000,"
    head += "Rotation Type,Quaternion,Length Units,Meters,Coordinate Space,Global\n\n"
    head += f",Type,{','.join(['Rigid Body'] * 7 + ['Marker'] * 3 * count)}\n"
    head += f",Name,{','.join(['Arm'] * 7 + [name for name in names for _ in range(3)])}\n"
    head += f",ID,{','.join(['1'] * (7 + 3 * count))}\n"
    head += f",,{','.join(['Rotation'] * 4 + ['Position'] * 3 * (count + 1))}\n"
    head += f"Frame,Time (Seconds),X,Y,Z,W,X,Y,Z{',X,Y,Z' * count}\n"
    rows = _cells(places / 1000, 6)
    times = (f"{k / FRAMES_A_SECOND:.6f}" for k in range(len(rows)))
    body = "0.1,0.2,0.3,0.9,0.5,0.5,0.9"
    lines = zip(times, rows, strict=True)
    return head + "".join(f"{k},{t},{body},{','.join(row)}\n" for k, (t, row) in enumerate(lines))


def trc(names, places):
    """TRC, of OpenSim and Motion Analysis: tabs, X1 Y1 Z1 below the names, a blank line."""
    head = "PathFileType\t4\t(X/Y/Z)\tarm.trc\n"
    head += "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\n"
    head += f"100.00\t100.00\t{len(places)}\t{len(names)}\tmm\t100.00\n"
    head += "Frame#\tTime\t" + "\t\t\t".join(names) + "\t\t\n\t\t"
    head += "\t".join(f"X{k}\tY{k}\tZ{k}" for k in range(1, len(names) + 1)) + "\n\n"
    tab = "\t"
    return head + "".join(
        f"{k + 1}\t{k / FRAMES_A_SECOND:.3f}\t{tab.join(row)}\n"
        for k, row in enumerate(_cells(places, 3))
    )


def deeplabcut(names, places, likelihood):
    """DeepLabCut: places in a picture, each with a likelihood (N, K)."""
    head = "scorer" + ",DLC_resnet50" * 3 * len(names) + "\n"
    head += "bodyparts," + ",".join(name for name in names for _ in range(3)) + "\n"
    head += "coords" + ",x,y,likelihood" * len(names) + "\n"
    lines = []
    for k, row in enumerate(places):
        cells = [
            f"{x:.5f},{y:.5f},{sure:.4f}"
            for (x, y, _), sure in zip(row, likelihood[k], strict=True)
        ]
        lines.append(f"{k},{','.join(cells)}\n")
    return head + "".join(lines)


def tracker(names, places):
    """Tracker: a track's name above its t, x and y, tabs between them."""
    head = "\t\t\t".join(names) + "\t\t\n" + "\t".join(["t\tx\ty"] * len(names)) + "\n"
    lines = []
    for k, row in enumerate(places):
        time = f"{k / 30:.4f}"
        lines.append("\t".join(f"{time}\t{x:.4E}\t{y:.4E}" for x, y, _ in row) + "\n")
    return head + "".join(lines)


def one_line(names, places, form="{name}:{axis}", separator=","):
    """A table as tools for C3D files write it, names and axes in one line."""
    axes = [form.format(name=name, axis=axis) for name in names for axis in "XYZ"]
    lines = []
    for k, row in enumerate(_cells(places, 3)):
        lines.append(separator.join([f"{k / FRAMES_A_SECOND:.2f}", *row]))
    text = "\n".join(lines) + "\n"
    text = text.replace(".", ",") if separator == ";" else text
    return separator.join(["Time", *axes]) + "\n" + text
