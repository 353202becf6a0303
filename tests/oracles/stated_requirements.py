"""Requirements as files and options state them, and what is compared of them."""

import numpy as np
import pytest

from burmester.errors import InputError
from burmester.geometry.displacement import Displacement
from burmester.io.reading.poses import read_task
from burmester.tasks.motion_task import Task
from burmester.tasks.requirements import Requirements

POSES = 'angle_unit = "deg"\nposes = [[0, 0, 0], [1, 2.5, 30], [3, 1, 60.25]]\n'
CSV = "x,y,angle_deg\n0,0,0\n1,2.5,30\n3,1,60.25\n"
THREE = Displacement(np.array([[0.0, 0], [1, 2.5], [3, 1]]), np.array([0, 0.5, 1]))
INF = float("inf")


def refused(attempt, code="E134", where=True):
    with pytest.raises(InputError) as caught:
        attempt()
    error = caught.value
    assert error.code == code, str(error)
    assert error.help
    assert bool(error.where) == where
    return error


def refused_task(limits, asked_for, code="E132"):
    return refused(lambda: Task(THREE, limits=limits, requirements=asked_for), code, where=False)


def values(found):
    """Requirements as plain data, so that two of them can be compared."""
    area = found.footprint
    return {
        "transmission_deg": found.transmission_deg,
        "types": found.types,
        "driver": found.driver,
        "footprint": None if area is None else area.vertices.tolist(),
        "link_ratio": found.link_ratio,
        "within": found.within,
        "within_deg": found.within_deg,
        "any_order": found.any_order,
    }


NOTHING = values(Requirements())


def reader(folder):
    """Reads text as if it were the file `poses.SUFFIX` in a folder."""

    def read(content, suffix=".toml", **options):
        path = folder / f"poses{suffix}"
        path.write_text(content)
        return read_task(path, **options)

    return read


SQUARE = [[0, 0], [4, 0], [4, 2.5], [0, 2.5]]
SAID = {  # TOML, options, a field and its value
    "within an angle": ("within_deg = 1.5", ["--within-angle", "1.5"], "within_deg", 1.5),
    "transmission": (
        "transmission_deg = 37.5",
        ["--min-transmission", "37.5"],
        "transmission_deg",
        37.5,
    ),
    "no transmission": ("transmission_deg = 0", ["--min-transmission", "0"], "transmission_deg", 0),
    "types": (
        'types = ["crank-rocker", "Double Slider"]',
        ["--type", "crank-rocker, Double Slider"],
        "types",
        {"crank-rocker", "double slider"},
    ),
    "types, apart": (
        'types = ["grashof", "slider-crank"]',
        ["--type", "slider-crank", "--type", "grashof"],
        "types",
        {"grashof", "slider-crank"},
    ),
    **{
        name: (f'driver = "{name}"', ["--driver", name], "driver", name)
        for name in ("any", "crank")
    },
    "box": (
        "footprint = { box = [[0, 0], [4, 2.5]] }",
        ["--footprint", "box:0,0:4,2.5"],
        "footprint",
        SQUARE,
    ),
    "polygon": (
        "footprint.polygon = [[0, 0], [-1, 0.5], [-1e1, -2]]",
        ["--footprint", "polygon:0,0:-1,0.5:-1e1,-2"],
        "footprint",
        [[0, 0], [-1, 0.5], [-10, -2]],
    ),
    "no footprint": ("", ["--footprint", "any"], "footprint", None),
    "ratio": ("link_ratio = 4.25", ["--link-ratio", "4.25"], "link_ratio", 4.25),
    "within": ("within = 3e-3", ["--within", "3e-3"], "within", 0.003),
    "any order": ("any_order = true", ["--any-order"], "any_order", True),
    "in order": ("any_order = false", [], "any_order", False),
}
