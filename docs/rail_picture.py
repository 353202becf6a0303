"""Make the picture of a rail in docs: the window stay at its poses.

Run it from the project's root:

    .venv/bin/python -m docs.rail_picture
"""

from burmester import read_task, synthesize


def main():
    """Draw the recommended linkage of the template."""
    best = synthesize(read_task("src/burmester/templates/window-stay.toml")).best
    figure = best.plot()
    figure.savefig("docs/rail.png", dpi=90, bbox_inches="tight")


if __name__ == "__main__":
    main()
