"""Tasks of every kind that a page has to show."""

from dataclasses import replace

import numpy as np

from burmester import Requirements, Task, read_task
from burmester.geometry.displacement import Displacement

NAMES = (
    "closed, locked",
    "first crack",
    "knuckle clears",
    "wrist up",
    "top of the arc",
    "over the sill",
    "reach",
    "handover",
    "release over the tray",
    "open, at rest",
)


def ellipse():
    """Poses of a body whose two sliders run on crossed rails."""
    turn = np.linspace(0, 1.2, 7)
    places = np.stack([30 * np.cos(turn), 12 * np.sin(turn)], axis=-1)
    return Task(Displacement(places, turn), length_unit="mm")


def hardly_turning():
    """Poses of a body that turns by three degrees, known to a tenth of a millimetre."""
    poses = np.array(
        [
            (0, 0, 0),
            (10.02, 1.01, 0.5),
            (20.05, 2.3, 1.1),
            (30.1, 4.1, 1.4),
            (40.0, 6.2, 2.1),
            (50, 8.9, 2.6),
            (60, 12.1, 3.2),
        ]
    )
    known = Displacement(poses[:, :2], np.radians(poses[:, 2]))
    return Task(known, resolution=(5e-2, np.radians(5e-2)), length_unit="mm")


TASKS = {
    "four-bar": lambda: read_task("case:ge2012-exact"),
    "rail": lambda: read_task("case:motiongen-rrrp"),
    "slot": lambda: read_task("case:motiongen-rrpr"),
    "rail and slot": lambda: read_task("case:motiongen-prpr"),
    "two rails": ellipse,
    "hardly turning": hardly_turning,
    "long names": lambda: replace(read_task("case:ge2012-exact"), names=NAMES),
    "asked": lambda: replace(
        read_task("case:ge2012-exact"), requirements=Requirements(transmission_deg=20)
    ),
    "apart": lambda: read_task("case:motiongen-shoulder"),
}
