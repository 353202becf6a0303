"""Poses of the cases that the package carries."""

import json
from importlib import resources

import numpy as np

from burmester.geometry.displacement import Displacement


def poses_of(name):
    case = json.loads(resources.files("burmester").joinpath(f"cases/{name}.json").read_text())
    rows = np.array(case["poses"])
    return case, Displacement(rows[:, :2], np.radians(rows[:, 2]))
