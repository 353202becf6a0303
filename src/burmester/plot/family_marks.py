"""What all pictures of a family share: colours of pairs, marks of linkages, names of places.

Pairs that work are coloured by their least transmission angle, in a scale that is dark where it is
small and grows lighter throughout; the others have four greys and tints of different lightness, so
that nothing depends on hue.
"""

from __future__ import annotations

from typing import Final

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Normalize, to_rgb
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke
from numpy.typing import NDArray

from burmester.families.family_map import FamilyMap
from burmester.families.pair_verdicts import PairClass
from burmester.fourbar.dyad import RP, RR, Dyad
from burmester.fourbar.linkage import Linkage
from burmester.numerics.arrays import FloatArray
from burmester.plot.style import VERMILION, plain
from burmester.requirements.transmission import TRANSMISSION

SCALE: Final = "cividis"  # of transmission angles
SCALE_STEP: Final = 5.0  # degrees; that scale ends at a multiple of it
TINTS: Final = {
    PairClass.OUTSIDE_BOUNDS: "#9fb4c7",
    PairClass.ORDER: "#d9bfa3",
    PairClass.BRANCH: "#dfe2e6",
    PairClass.CIRCUIT: "#f6f6f4",
    PairClass.NO_LINKAGE: "#ffffff",
}
TICKS: Final = (0.0, 0.25, 0.5, 0.75)  # places along a loop that are marked, on both pictures
LONGEST_NAME: Final = 12  # characters; names of poses that are longer give way to numbers
LETTERS: Final = "ABCDEFGH"  # of loops, where there are several


def colors_of(found: FamilyMap, classes: NDArray[np.int8], transmission: FloatArray) -> FloatArray:
    """The colours (*, 3) of pairs by their classes (*,) and transmission angles (*,)."""
    table = np.zeros((len(PairClass), 3))
    for kind, tint in TINTS.items():
        table[kind] = to_rgb(tint)
    works = classes <= PairClass.FARTHER
    shades = mpl.colormaps[SCALE](scale_of(found)(np.degrees(np.where(works, transmission, 0.0))))
    return np.asarray(np.where(works[..., None], shades[..., :3], table[classes]))


def scale_of(found: FamilyMap) -> Normalize:
    """From what is asked for to the next full step above the best pair."""
    asked = float(found.bounds.asked[TRANSMISSION])
    works = np.where(found.verdicts.classes <= PairClass.FARTHER, found.verdicts.transmission, 0.0)
    best = np.ceil(np.degrees(works.max(initial=0.0)) / SCALE_STEP) * SCALE_STEP
    return Normalize(asked, max(best, asked + SCALE_STEP))


def rings(ax: Axes, recommended: Linkage | None) -> list[Line2D]:
    """Rings around the fixed pivots of a linkage, as far as it has any."""
    dyads: list[Dyad] = [] if recommended is None else [recommended.first, recommended.second]
    points = [each.fixed_pivot for each in dyads if isinstance(each, RR | RP)]
    return ring(ax, *np.transpose(points)) if points else []


def ring(ax: Axes, x: object, y: object) -> list[Line2D]:
    halo = [withStroke(linewidth=3.6, foreground="white")]
    style: dict[str, object] = {"ms": 10, "mfc": "none", "mec": VERMILION, "mew": 1.8, "zorder": 6}
    return ax.plot(x, y, "o", path_effects=halo, **style)  # type: ignore[arg-type]


def pose_names(found: FamilyMap) -> list[str] | None:
    """The names of the poses, where all are short; else their numbers stand there."""
    names = found.task.names
    if names is None or max(map(len, names)) > LONGEST_NAME:
        return None
    return [plain(name) or str(k) for k, name in enumerate(names, start=1)]


def place_name(found: FamilyMap, loop: int, share: float) -> str:
    """The name of a place along a loop: its share, after the loop's letter where there are some."""
    return f"{LETTERS[loop] if found.loop.max() else ''} {share:g}".strip()
