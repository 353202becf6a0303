"""What a linkage may bear, where its task has loads: forces, where it stays, how fast it moves.

Each figure is nan, and no bound on it is missed, until a linkage has been loaded.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

from burmester.errors import InputError
from burmester.requirements.requirement import Looser, Number, Requirement, above, number, shown
from burmester.wording import figure, listed

if TYPE_CHECKING:
    from burmester.numerics.arrays import FloatArray
    from burmester.requirements.figures import Figures


def _most(
    name: str, subject: str, unit: str, *, figure: str, option: str, such: float
) -> Requirement:
    """A greatest magnitude of a figure; unit: "N", or one with a place for that of lengths."""

    def said(figures: Figures, bound: float, length: str) -> str:
        own = unit.format(length)
        value = getattr(figures, figure)
        return f"{subject} is {value:.3g} {own}; at most {bound:g} {own} is allowed"

    def looser(bound: float, figures: Figures, share: float) -> Looser | None:
        value = getattr(figures, figure)
        if not value > bound:
            return None
        text = above(bound + share * (value - bound))
        words = f"{subject} of {text} instead of {bound:g}"
        return Looser(float(text), words, math.log(float(text) / bound))

    return Requirement(
        name=name,
        kind=figure.replace("_", " "),
        excess=lambda figures, bound: figures.beyond(getattr(figures, figure), bound),
        said=said,
        form="number",
        option=option,
        label=f"{subject.removeprefix('the greatest ')} at most",
        metavar="NUMBER" if "{" in unit else unit.replace("·", ""),
        help=f"{subject[0].upper()}{subject[1:]} that is allowed.",
        subject=f"{subject} is",
        words=lambda bound: f"{subject} of at most {bound:g}",
        such=f"{name} is one number, such as {such:g}",
        checked=Number(
            "number",
            subject,
            subject + " of at most {:g} is impossible",
            why="it is a magnitude, and nothing moves without any",
            help=f"give a number above zero, such as {such:g}",
            above=0,
        ),
        looser=looser,
    )


_GREATEST: Final = _most(
    "hand_force_N",
    "the greatest force of the hand",
    "N",
    figure="hand_force",
    option="--hand-force",
    such=40,
)


def _corridor(given: Any) -> float | tuple[float, float]:
    """A greatest magnitude, or the least and the greatest force with their signs: E134."""
    if isinstance(given, int | float) or not hasattr(given, "__len__"):
        greatest: float = _GREATEST.checked(given)
        return greatest
    help = "give one number, the greatest magnitude; or the least and the greatest, such as [0, 40]"
    if isinstance(given, str) or len(given) != 2:
        message = f"{HAND_FORCE.subject} {shown(given)}, neither one number nor two"
        raise InputError("E134", message, help=help)
    least, greatest = (number(each, "a force of the hand") for each in given)
    if least >= greatest:
        message = f"a force of the hand from {least:g} to {greatest:g} N is impossible"
        raise InputError("E134", message, why="the least is not below the greatest", help=help)
    return least, greatest


def _outside(figures: Figures, bound: Any) -> tuple[FloatArray, FloatArray]:
    """By how much forces are below and above a corridor, in N."""
    return figures.lack(figures.hand_least, bound[0]), figures.lack(
        -figures.hand_greatest, -bound[1]
    )


def _hand_excess(figures: Figures, bound: Any) -> FloatArray:
    if not isinstance(bound, tuple):
        return _GREATEST.excess(figures, bound)
    below, over = _outside(figures, bound)
    excess: FloatArray = figures.none + (below + over) / max(map(abs, bound))
    return excess


def _hand_said(figures: Figures, bound: Any, length: str) -> str:
    if not isinstance(bound, tuple):
        return _GREATEST.said(figures, bound, length)
    least, greatest = figures.hand_least, figures.hand_greatest
    back = ", holding the body back," if least < 0 <= bound[0] else ""
    return (
        f"the hand moves it{back} with {figure(least, 3)} to {figure(greatest, 3)} N; "
        f"{bound[0]:g} to {bound[1]:g} N is allowed"
    )


def _hand_looser(bound: Any, figures: Figures, share: float) -> Looser | None:
    if not isinstance(bound, tuple):
        return _GREATEST.looser(bound, figures, share)
    size, moved = max(map(abs, bound)), [*map(float, _outside(figures, bound))]
    if not sum(moved) > 0:
        return None
    step = 10.0 ** (math.floor(math.log10(max(size, *moved))) - 2)
    low = math.floor((bound[0] - share * moved[0]) / step) * step if moved[0] else bound[0]
    high = math.ceil((bound[1] + share * moved[1]) / step) * step if moved[1] else bound[1]
    wider = float(f"{low:.4g}"), float(f"{high:.4g}")
    words = f"{_between(wider)} instead of {bound[0]:g} to {bound[1]:g} N"
    return Looser(wider, words, (bound[0] - wider[0] + wider[1] - bound[1]) / size)


def _between(bound: Any) -> str:
    return f"a force of the hand from {bound[0]:g} to {bound[1]:g} N"


HAND_FORCE: Final = replace(
    _GREATEST,
    form="corridor",
    metavar="N|LEAST:GREATEST",
    label="force of the hand in N, least and greatest",
    help="Greatest force of the hand, either way; or its least and greatest force on the way from "
    "the first pose to the last, below zero where it holds the body back.",
    excess=_hand_excess,
    said=_hand_said,
    looser=_hand_looser,
    words=lambda bound: _between(bound) if isinstance(bound, tuple) else _GREATEST.words(bound),
    written=lambda bound: (
        ":".join(f"{each:g}" for each in bound) if isinstance(bound, tuple) else f"{bound:g}"
    ),
    plain=lambda bound: [*bound] if isinstance(bound, tuple) else bound,
    such="hand_force_N is one number, such as 40, or the least and the greatest, such as [0, 40]",
    checked=_corridor,
)
DRIVER_TORQUE: Final = _most(
    "driver_torque_Nm",
    "the greatest torque of the driver",
    "N·m",
    figure="driver_torque",
    option="--driver-torque",
    such=5,
)
PIN_FORCE: Final = _most(
    "pin_force_N",
    "the greatest force of a pin",
    "N",
    figure="pin_force",
    option="--pin-force",
    such=500,
)
BODY_SPEED: Final = _most(
    "body_speed",
    "the greatest speed of the body",
    "{}/s",
    figure="body_speed",
    option="--body-speed",
    such=500,
)
BODY_ACCELERATION: Final = _most(
    "body_acceleration",
    "the greatest acceleration of the body",
    "{}/s²",
    figure="body_acceleration",
    option="--body-acceleration",
    such=2000,
)


def _poses(given: Any) -> frozenset[str]:
    names = [given] if isinstance(given, str) else list(given) if given is not None else []
    if not names or not all(isinstance(name, str) for name in names):
        help = 'give names or numbers of poses as texts, such as ["open"]'
        raise InputError("E134", f"stays_at is {shown(given)}, not names of poses", help=help)
    return frozenset(names)


def _missed(figures: Figures, poses: frozenset[str]) -> frozenset[str]:
    return poses - figures.stays if figures.stays is not None else frozenset()


STAYS_AT: Final = Requirement(
    name="stays_at",
    kind="rest",
    excess=lambda figures, poses: figures.none + len(_missed(figures, poses)),
    said=lambda figures, poses, _unit: (
        f"it does not stay by itself at {listed(sorted(_missed(figures, poses)))}"
    ),
    form="names",
    option="--stays-at",
    label="stays at",
    metavar="POSE[,POSE]",
    help="Poses, by name or number, at which the linkage stays by itself.",
    subject="the poses at which it stays are",
    words=lambda poses: f"staying at {listed(sorted(poses))}",
    such='stays_at is a list of poses by name or number, such as ["open"]',
    checked=_poses,
    written=lambda poses: ",".join(sorted(poses)),
    plain=sorted,
)


def _closing(figures: Figures, bound: float, _unit: str) -> str:
    return (
        f"it closes by itself from {math.degrees(figures.closes):.3g}° on; from {bound:g}° is asked"
    )


CLOSES_FROM: Final = Requirement(
    name="closes_from_deg",
    kind="closing",
    excess=lambda figures, bound: figures.lack(figures.closes, math.radians(bound)),
    said=_closing,
    form="number",
    option="--closes-from",
    label="closes from",
    metavar="DEG",
    help="Angle of the body from the first pose from which it closes by itself.",
    subject="the angle from which it closes is",
    words="closing from {:g}° on".format,
    such="closes_from_deg is one angle in degrees, such as 10",
    checked=Number(
        "angle",
        "the angle from which it closes",
        "closing from {:g}° on says nothing",
        why="it is how far the body is turned from the first pose",
        help="give an angle above zero, such as 10",
        above=0,
    ),
)
OF_LOADS: Final = (
    HAND_FORCE,
    DRIVER_TORQUE,
    PIN_FORCE,
    STAYS_AT,
    CLOSES_FROM,
    BODY_SPEED,
    BODY_ACCELERATION,
)
# Of violations that come from loads; a spring off its stroke is one.
KINDS_OF_LOADS: Final = frozenset({"spring", *(each.kind for each in OF_LOADS)})
# What each needs that a task may lack.
NEEDS: Final[dict[Requirement, Callable[[Any], bool]]] = {
    HAND_FORCE: lambda loads: loads.hand is not None,
    BODY_SPEED: lambda loads: loads.drive is not None,
    BODY_ACCELERATION: lambda loads: loads.drive is not None,
}
