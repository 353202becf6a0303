"""Draw docs/curves.png: the path of a foot, the linkage that traces it, and its two cognates.

Run it from the project's root: .venv/bin/python docs/curves.py
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from burmester import plot, read_task, synthesize
from burmester.fourbar.cognates import cognates

DPI = 110
ROOT = Path(__file__).parents[1]
INKS = ("#1d4f9e", "#b3541e", "#22633a")


def drawn():
    """The figure."""
    task = read_task(ROOT / "examples" / "leg.csv")
    best = min(synthesize(task).usable, key=lambda each: each.error.rms)
    own = best.driver_first
    place = best.error.places[3]
    point = place.translation
    figure, axes = plt.subplots(figsize=(7.4, 4.6), layout="constrained")
    # The body of the linkage itself is placed by its angle; a cognate's turns as the shared link.
    bodies = [(own, place.angle)]
    for each, side in zip(cognates(own), (own.first, own.second), strict=True):
        arm = place.act(side.moving_pivot) - side.fixed_pivot
        bodies.append((each, np.arctan2(arm[1], arm[0])))
    for number, (each, angle) in enumerate(bodies):
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        pins = [point + turn @ side.moving_pivot for side in (each.first, each.second)]
        grounds = [side.fixed_pivot for side in (each.first, each.second)]
        ink, wide = INKS[number], 2.2 if number == 0 else 1.3
        name = f"{best.id}, a {each.type}" if number == 0 else f"cognate, a {each.type}"
        line = np.array([grounds[0], pins[0], pins[1], grounds[1]])
        axes.plot(*line.T, "o-", color=ink, lw=wide, ms=4, label=name, zorder=3 - number / 10)
        axes.fill(*np.array([*pins, point]).T, color=ink, alpha=0.13, lw=0)
        axes.plot(*np.array(grounds).T, "^", color=ink, ms=8, mfc="white", zorder=4)
    loop = np.concatenate([task.poses.translation, task.poses.translation[:1]])
    axes.plot(*loop.T, ".", color="#202020", ms=4, label="the path", zorder=5)
    axes.set_aspect("equal")
    axes.axis("off")
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 0.9), frameon=False)
    return figure


if __name__ == "__main__":
    with plot.house_style():
        drawn().savefig(Path(__file__).parent / "curves.png", dpi=DPI)
