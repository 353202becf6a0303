"""Draw docs/family-map.png: which pairs of dyads of MotionGen's four poses work.

Run it from the project's root: .venv/bin/python docs/family_map.py
"""

from pathlib import Path

import numpy as np

from burmester import Linkage, Task, plot
from burmester.families.family_map import curve_map
from burmester.families.pair_verdicts import PairClass
from burmester.io.cases import load

DPI = 110


def drawn():
    """The figure, with the pair that transmits best."""
    found = curve_map(Task.from_rows(load("motiongen-four-line")["poses"], angle_unit="deg"))
    works = found.verdicts.classes == PairClass.WORKS
    angle = np.where(works, found.verdicts.transmission, 0.0)
    i, j = np.unravel_index(angle.argmax(), angle.shape)
    return plot.family_figure(found, Linkage(found.first[i], found.second[j]))


if __name__ == "__main__":
    with plot.house_style():
        drawn().savefig(Path(__file__).parent / "family-map.png", dpi=DPI)
