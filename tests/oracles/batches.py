"""Tasks in long tables, folders of parts as bytes, and work that does something to its worker."""

import gc
import os
import signal
import struct
import time
from multiprocessing.connection import Connection
from pathlib import Path
from typing import NamedTuple

import numpy as np

from burmester.batch.worker import within

PARTS = "part-*.parquet"


def rows(count, poses=10, seed=0, noise=0.0):
    """Poses (count, poses, 3) of a body on a crank-rocker of its own for each task; degrees."""
    rng = np.random.default_rng(seed)
    out = []
    while len(out) < count:
        ground, crank, coupler, rocker = rng.uniform([3, 1, 3, 2.5], [4, 1.4, 4, 3.5])
        turn = np.sort(rng.uniform(0, 2 * np.pi, poses))
        joint = crank * np.exp(1j * turn)
        way = ground - joint
        cosine = (coupler**2 + np.abs(way) ** 2 - rocker**2) / (2 * coupler * np.abs(way))
        if np.abs(cosine).max() >= 0.98:
            continue
        angle = np.angle(way) + np.arccos(cosine)
        point = joint + (0.7 + 0.9j) * np.exp(1j * angle)
        frame = np.exp(1j * rng.uniform(-np.pi, np.pi))
        point = frame * point + complex(*rng.uniform(-5, 5, 2))
        degrees = np.degrees(np.angle(np.exp(1j * angle) * frame))
        out.append(np.column_stack([point.real, point.imag, degrees]))
    return np.array(out) + noise * rng.normal(size=(count, poses, 3))


def as_table(tasks, names=None):
    """The text of a long table."""
    names = range(len(tasks)) if names is None else names
    lines = ["task,x,y,angle_deg"]
    for name, poses in zip(names, tasks, strict=True):
        lines += [f"{name},{x:.6f},{y:.6f},{angle:.6f}" for x, y, angle in poses]
    return "\n".join([*lines, ""])


def as_file(poses):
    """The text of one task's own file, with the digits of `as_table`."""
    lines = [f"{x:.6f},{y:.6f},{angle:.6f}" for x, y, angle in poses]
    return "\n".join(["x,y,angle_deg", *lines, ""])


def files_of(folder):
    """All files of a batch as bytes, by name."""
    return {each.name: each.read_bytes() for each in Path(folder).iterdir()}


class Numbers(NamedTuple):
    """Tasks that are numbers."""

    values: tuple[int, ...]

    def __len__(self):
        return len(self.values)

    def only(self, indices):
        return Numbers(tuple(self.values[k] for k in indices))


AS_GOOD_AS_ENDLESS_S = 20.0
FIRST_ONLY, KILLS, ENDLESS, RAISES, GREEDY, TOGETHER, HALF = range(1001, 1008)


def squares(part, plan, left_out):
    """The squares of the numbers of a part; special ones do harm.

    plan: a folder.  FIRST_ONLY: kills its process once only.  KILLS: whenever it is tried.
    TOGETHER: where it is not alone.  HALF: is killed in the midst of an answer.
    """
    values = [each for k, each in enumerate(part.tasks.values) if k not in left_out]
    if FIRST_ONLY in values:
        try:
            os.close(os.open(os.path.join(plan, "once"), os.O_CREAT | os.O_EXCL))
        except FileExistsError:
            pass
        else:
            os.kill(os.getpid(), signal.SIGKILL)
    if KILLS in values:
        os.kill(os.getpid(), signal.SIGKILL)
    if HALF in values:
        for each in gc.get_objects():
            if isinstance(each, Connection) and each.writable:
                os.write(each.fileno(), struct.pack("!i", 100) + b"half of it")
        os.kill(os.getpid(), signal.SIGKILL)
    if RAISES in values:
        raise ValueError("no such number")
    if GREEDY in values:
        bytearray(4 << 30)
    if TOGETHER in values and len(values) > 1:
        raise ValueError("too many")
    if ENDLESS in values:
        # Where nothing ends it the test has to fail, not to hang.
        end = time.monotonic() + AS_GOOD_AS_ENDLESS_S
        with within(0.5):
            while time.monotonic() < end:
                time.sleep(0.01)
    return [each**2 for each in values], dict(left_out)
