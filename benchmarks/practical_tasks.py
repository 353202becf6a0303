"""Tasks as designers have them, drawn at random: hinges, lids, pick-and-place, lifts, grippers.

Each is a smooth motion that no four-bar makes exactly, in poses with two decimals.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from burmester import Task

__all__ = ["FAMILIES", "practical_tasks"]

Rows = np.ndarray


def _hinge(rng: np.random.Generator, share: np.ndarray) -> Rows:
    """A turn about a far point, with points off the circle by 2 to 20."""
    radius, turn = rng.uniform(50, 400), np.radians(rng.uniform(45, 110))
    start, off = rng.uniform(0, 2 * np.pi), rng.uniform(2, 20)
    angle = start + turn * share
    bump = off * np.sin(np.pi * rng.uniform(0.5, 2) * share + rng.uniform(0, np.pi))
    x, y = (radius + bump) * np.cos(angle), (radius + bump) * np.sin(angle)
    lag = np.radians(rng.uniform(-5, 5)) * np.sin(np.pi * share)
    return np.column_stack([x, y, np.degrees(turn * share + lag)])


def _lid(rng: np.random.Generator, share: np.ndarray) -> Rows:
    """Up and back, while it turns by 70 to 110 degrees."""
    width, height = rng.uniform(40, 200, 2)
    turn = rng.uniform(70, 110)
    x, y = -width * share ** rng.uniform(1, 2), height * np.sin(np.pi / 2 * share)
    return np.column_stack([x, y, turn * share ** rng.uniform(0.7, 1.5)])


def _pick_and_place(rng: np.random.Generator, share: np.ndarray) -> Rows:
    """An arch, with the body turned by 60 to 180 degrees on the way."""
    width, height = rng.uniform(100, 400), rng.uniform(50, 200)
    turn = rng.uniform(60, 180) * rng.choice([-1, 1])
    smooth = share * share * (3 - 2 * share)
    return np.column_stack([width * share, height * np.sin(np.pi * share), turn * smooth])


def _lift(rng: np.random.Generator, share: np.ndarray) -> Rows:
    """Up along a shallow arc, turning by 5 to 25 degrees."""
    height, bulge = rng.uniform(80, 400), rng.uniform(5, 60)
    turn = rng.uniform(5, 25) * rng.choice([-1, 1])
    return np.column_stack([bulge * np.sin(np.pi * share), height * share, turn * share])


def _gripper(rng: np.random.Generator, share: np.ndarray) -> Rows:
    """A finger that closes: short travel, 15 to 60 degrees."""
    reach, drop = rng.uniform(10, 60), rng.uniform(2, 20)
    turn = rng.uniform(15, 60)
    return np.column_stack(
        [reach * share, -drop * share**2, -turn * share ** rng.uniform(0.7, 1.4)]
    )


FAMILIES: dict[str, Callable[[np.random.Generator, np.ndarray], Rows]] = {
    "hinge": _hinge,
    "lid": _lid,
    "pick and place": _pick_and_place,
    "lift": _lift,
    "gripper": _gripper,
}


def practical_tasks(count: int, seed: int, *families: str) -> Iterator[tuple[str, Task]]:
    """Tasks of six to nine poses, the families in turn (all where none is named)."""
    names = families or tuple(FAMILIES)
    rng = np.random.default_rng(seed)
    for k in range(count):
        name = names[k % len(names)]
        share = np.linspace(0, 1, int(rng.integers(6, 10)))
        rows = np.round(FAMILIES[name](rng, share), 2)
        task = Task.from_rows(rows, angle_unit="deg", length_unit="mm")
        resolution = (0.005, float(np.radians(0.005)))
        yield name, Task(task.poses, length_unit="mm", resolution=resolution)
