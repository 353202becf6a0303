"""What a linkage may bear, where its task has loads: forces, where it stays, how fast it moves.

Each figure is nan, and no bound on it is missed, until a linkage has been loaded.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Final

from burmester.errors import InputError
from burmester.requirements.requirement import Looser, Number, Requirement, above, shown
from burmester.wording import listed

if TYPE_CHECKING:
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


HAND_FORCE: Final = _most(
    "hand_force_N",
    "the greatest force of the hand",
    "N",
    figure="hand_force",
    option="--hand-force",
    such=40,
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
# What each needs that a task may lack.
NEEDS: Final[dict[Requirement, Callable[[Any], bool]]] = {
    HAND_FORCE: lambda loads: loads.hand is not None,
    BODY_SPEED: lambda loads: loads.drive is not None,
    BODY_ACCELERATION: lambda loads: loads.drive is not None,
}
