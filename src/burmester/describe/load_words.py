"""What a linkage bears under its loads, in sentences."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from burmester.tasks.motion_task import Task
from burmester.wording import listed

if TYPE_CHECKING:
    from burmester.loads.load_figures import Extremes, LoadFigures


def load_notes(figures: LoadFigures | None, task: Task) -> list[str]:
    """Sentences, each a line; none where there are no loads."""
    if figures is None:
        return []
    unit = "N·m" if figures.turns else "N"
    held = figures.effort
    out = [f"Held by its driver with {_from_to(held)} {unit}; most {_where(held, task)}."]
    if (hand := figures.hand) is not None:
        rub = f" Friction takes up to {figures.rub:.2g} N more." if figures.rub else ""
        out.append(f"A hand moves it with {_from_to(hand)} N{_sign(hand)}.{rub}")
    # The pins of a link that weighs nothing bear the same but for rounding: the first is told.
    name, force = max(figures.pins.items(), key=lambda pin: float(f"{pin[1]:.9g}"))
    out.append(f"Its pins bear at most {force:.3g} N, pin {name}.")
    out.append(_rests(figures, task))
    for each in figures.springs:
        turned = each.spring.kind == "torsion"
        length = "°" if turned else f" {task.length_unit}"
        low, high = each.length
        out.append(
            f"Its {each.spring.kind} spring goes from {low:.4g} to {high:.4g}{length}, and "
            f"{_push_or_pull(each.tension, 'N·m' if turned else 'N')}."
        )
    if (drive := figures.drive) is not None:
        out.append(
            f"In {drive.drive.duration_s:g} s ({drive.drive.profile}) its driver bears "
            f"{_from_to(drive.effort)} {unit}; the body moves at up to {drive.speed:.3g} "
            f"{task.length_unit}/s."
        )
    return out


def _from_to(values: Extremes) -> str:
    return f"{values.least:.3g} to {values.greatest:.3g}"


def _sign(hand: Extremes) -> str:
    if hand.least < 0 < hand.greatest:
        return "; below zero it holds the body back"
    return ", which hold the body back" if hand.greatest <= 0 else ""


def _push_or_pull(tension: tuple[float, float], unit: str) -> str:
    low, high = sorted(map(abs, tension))
    verb = "pushes" if tension[1] <= 0 else "pulls" if tension[0] >= 0 else "pushes and pulls"
    return f"{verb} with {low:.3g} to {high:.3g} {unit}"


def _where(values: Extremes, task: Task) -> str:
    greatest = abs(values.greatest) >= abs(values.least)
    return _between(values.at_poses[1 if greatest else 0], task)


def _between(poses: tuple[int, int], task: Task) -> str:
    one, two = (named(pose - 1, task) for pose in poses)
    return f"at {one}" if one == two else f"between {one} and {two}"


def named(pose: int, task: Task) -> str:
    """A pose by its name, or its number; pose: from 0."""
    name = task.names[pose] if task.names else ""
    return f"'{name}'" if name else f"pose {pose + 1}"


def _rests(figures: LoadFigures, task: Task) -> str:
    stays = [named(each, task) for each in figures.stays]
    text = f"It stays by itself at {listed(stays)}." if stays else "It stays by itself at no pose."
    stable = [each for each in figures.rests if each.stable]
    if not figures.turns:
        return text
    if stable:
        at = listed([_between(each.between_poses, task) for each in stable])
        text += f" Let go, it comes to rest {at}."
    elif not stays and math.copysign(1, figures.effort.least) == math.copysign(
        1, figures.effort.greatest
    ):
        text += " Let go, it goes all the way to one end."
    return text
