"""The figures of a linkage under its loads as plain data: the keys `loads` and `drive`."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from burmester.loads.load_figures import DriveFigures, Extremes, LoadFigures


def load_figures_data(figures: LoadFigures, names: tuple[str, ...] | None) -> dict[str, Any]:
    """Efforts in N m where the driver turns, else in N; lengths in the task's unit.

    names: of the poses; those without have numbers.
    """
    effort = "driver_torque_Nm" if figures.turns else "driver_force_N"
    coordinate = "driver_deg" if figures.turns else "driver_m"
    return {
        "loads": {
            effort: _extremes(figures.effort),
            "hand_force_N": None if figures.hand is None else _extremes(figures.hand),
            "hand_friction_N": None if figures.hand is None else figures.rub,
            "pin_force_N": figures.pins,
            "equilibria": [
                {
                    coordinate: each.driver,
                    "stable": each.stable,
                    "between_poses": list(each.between_poses),
                }
                for each in figures.rests
            ],
            "stays_at": [(names[k] if names else "") or str(k + 1) for k in figures.stays],
            "springs": [
                {
                    "kind": each.spring.kind,
                    "count": each.spring.count,
                    "ends": [
                        {"link": end.link, "point": list(end.point)} for end in each.spring.ends
                    ],
                    "length": dict(zip(("least", "greatest"), each.length, strict=True)),
                    "force_N": dict(zip(("least", "greatest"), each.tension, strict=True)),
                }
                for each in figures.springs
            ],
        },
        "drive": None if figures.drive is None else _drive(figures.drive, effort),
    }


def _extremes(values: Extremes) -> dict[str, Any]:
    return {
        **{
            name: value if math.isfinite(value) else None
            for name, value in (("least", values.least), ("greatest", values.greatest))
        },
        "at_poses": [list(each) for each in values.at_poses],
    }


def _drive(figures: DriveFigures, effort: str) -> dict[str, Any]:
    return {
        "duration_s": figures.drive.duration_s,
        "profile": figures.drive.profile,
        effort: _extremes(figures.effort),
        "body_speed": {"greatest": figures.speed},
        "body_acceleration": {"greatest": figures.acceleration},
    }
