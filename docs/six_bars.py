"""The pictures of docs/six-bars.md.

Run it from the project's root: .venv/bin/python docs/six_bars.py
"""

from pathlib import Path

import numpy as np
from matplotlib.patches import Circle, Polygon

import burmester
from burmester import plot
from burmester.export import Options
from burmester.export.parts.plate import moved, outline_points
from burmester.export.parts.plates import assembly_of
from burmester.plot.style import BLUE, GREEN, GREY, ORANGE, VERMILION

TASK = Path("src/burmester/templates/window-opener.toml")
COLOURS = {
    "ground": GREY,
    "first-crank": VERMILION,
    "coupler": ORANGE,
    "second-crank": GREEN,
    "floating-link": "#8a6d3b",
    "body-link": BLUE,
}


def plates(chosen, pose):
    """A six-bar as plates at a pose, the lowest layer first."""
    made = assembly_of(chosen, Options(pose=pose))
    figure = plot.figure(5.2, 5.2)
    ax = figure.add_subplot()
    for plate in sorted(made.plates, key=lambda each: each.layer):
        place, colour = plate.at(made.drawn), COLOURS[plate.owner]
        corners = place.act(outline_points(plate, 0.01 * plate.radius))
        above = 2 + 2 * plate.layer
        ax.add_patch(
            Polygon(corners, facecolor=colour, alpha=0.55, edgecolor="black", zorder=above)
        )
        for x, y, diameter in moved(plate, place)[1].tolist():
            hole = Circle((x, y), diameter / 2, facecolor="white", edgecolor="black")
            hole.set_zorder(above + 1)
            ax.add_patch(hole)
    for pin in made.pins:
        at = made.plate(pin.plate).at(made.drawn).act(np.array([pin.x, pin.y]))
        ax.annotate(pin.name, at, (5, 5), textcoords="offset points", zorder=99)
    ax.set_aspect("equal")
    ax.autoscale_view()
    ax.set_axis_off()
    return figure


def main():
    """Draw the six-bar of the window opener at its poses, and as plates."""
    result = burmester.synthesize_six_bars(burmester.read_task(TASK))
    with plot.house_style():
        for name, figure in (
            ("six-bars", result.plot()),
            ("six-bar-plates", plates(result.best, 3)),
        ):
            figure.savefig(Path(__file__).with_name(f"{name}.png"), dpi=130, bbox_inches="tight")


if __name__ == "__main__":
    main()
