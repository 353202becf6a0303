"""Draw docs/functions.png: the structural error of log10 x by three ways to make it small.

Run it from the project's root: .venv/bin/python docs/functions_picture.py
"""

import numpy as np

import burmester
from burmester import plot
from burmester.plot.style import BLACK, BLUE, GREEN, VERMILION

WAYS = (
    ("five exact pairs, Chebyshev's spacing", {"pairs": 5}, GREEN),
    ("least squares", {}, VERMILION),
    ("minimax", {"minimax": True}, BLUE),
)

with plot.house_style():
    drawing = plot.figure(7.0, 4.0)
    ax = drawing.add_axes((0.12, 0.14, 0.84, 0.74))
    for name, how, color in WAYS:
        found = burmester.synthesize_function(
            "log10(x)", (1, 2), input_deg=60, output_deg=60, **how
        )
        curve = found.to_dict()["linkages"][0]["error_curve"]
        ax.plot(curve["input_deg"], 1000 * np.array(curve["error_deg"]), color=color, label=name)
    ax.axhline(0, color=BLACK, lw=0.6)
    ax.set_xlabel("input (deg)")
    ax.set_ylabel("structural error (thousandths of a degree)")
    ax.grid(True, lw=0.4, alpha=0.5)
    ax.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=3, frameon=False, fontsize="small")
    drawing.savefig("docs/functions.png", metadata={"Software": None})
