"""The links: the ratio of the longest to the shortest, their lengths, the extent, change points.

Only the ratio can be asked for; the others belong to the standard of linkages to build.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

from burmester.requirements.requirement import Looser, Number, Requirement, above
from burmester.wording import figure

if TYPE_CHECKING:
    from burmester.requirements.figures import Figures


def _said(figures: Figures, bound: float, _unit: str) -> str:
    ratio = f"{figures.ratio:.3g}"
    its = (
        f"joints of one link are {ratio} times as far from each other as those of another"
        if figures.joints
        else f"its longest link is {ratio} times its shortest"
    )
    return f"{its}; at most {bound:g} times is allowed"


def _short(figures: Figures, _length: object) -> str:
    ratio = figure(figures.ratio)
    if figures.joints:
        return f"has joints {ratio} times as far from each other on one link as on another"
    return f"has a link {ratio} times as long as another"


def _looser(bound: float, figures: Figures, share: float) -> Looser | None:
    ratio = figures.ratio
    if not ratio > bound:
        return None
    text = above(bound + share * (ratio - bound))
    words = f"a longest link of {text} times the shortest instead of {bound:g}"
    return Looser(float(text), words, math.log(float(text) / bound))


def _length_words(figures: Figures, length: str) -> str:
    return f"has joints {length} from each other" if figures.joints else f"has a link of {length}"


LINK_RATIO: Final = Requirement(
    name="link_ratio",
    kind="link ratio",
    excess=lambda figures, bound: figures.beyond(figures.ratio, bound),
    said=_said,
    standard=10.0,
    short=_short,
    assumed=(5.0, 10.0),
    words="a longest link of at most {:g} times the shortest".format,
    form="number",
    default=math.inf,
    option="--link-ratio",
    label="link ratio at most",
    metavar="R",
    help="Longest link divided by the shortest, at most.",
    subject="the greatest link ratio is",
    such="link_ratio is one number, such as 5",
    checked=Number(
        "number",
        "the greatest link ratio",
        "a link ratio of at most {:g} is impossible",
        why="the longest of the four links is never shorter than the shortest",
        help="give a ratio of 1 or more, such as 5",
        least=1,
        infinite=True,
    ),
    looser=_looser,
)
# In spans of the motion: a shorter link magnifies the errors of its pins at the body; a longer one
# is hardly to be placed.
SHORTEST_LINK: Final = Requirement(
    name="shortest_link",
    kind="lengths",
    excess=lambda figures, bound: figures.below(figures.shortest, bound),
    standard=0.05,
    scaled=True,
    short=lambda figures, length: _length_words(figures, length(figures.shortest)),
)
LONGEST_LINK: Final = Requirement(
    name="longest_link",
    kind="lengths",
    excess=lambda figures, bound: figures.beyond(figures.longest, bound),
    standard=10.0,
    scaled=True,
    short=lambda figures, length: _length_words(figures, length(figures.longest)),
)
# Of all links together: a linkage whose Grashof excess is less may flip over.
CHANGE_POINT: Final = Requirement(
    name="change_point",
    kind="change point",
    excess=lambda figures, bound: figures.lack(figures.change, bound) / bound,
    standard=1e-3,
    short=lambda _figures, _length: "is at a change point",
)
EXTENT: Final = Requirement(
    name="extent",
    kind="extent",
    excess=lambda figures, bound: figures.beyond(figures.extent, bound),
    standard=4.0,
    scaled=True,
    short=lambda figures, length: f"needs room of {length(figures.extent)}",
)
