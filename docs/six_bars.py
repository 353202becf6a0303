"""The picture of docs/six-bars.md.

Run it from the project's root: .venv/bin/python docs/six_bars.py
"""

from pathlib import Path

import burmester
from burmester import plot

TASK = Path("src/burmester/templates/window-opener.toml")


def main():
    """Draw the six-bar of the window opener at its poses."""
    result = burmester.synthesize_six_bars(burmester.read_task(TASK))
    with plot.house_style():
        figure = result.plot()
        figure.savefig(Path(__file__).with_name("six-bars.png"), dpi=130, bbox_inches="tight")


if __name__ == "__main__":
    main()
