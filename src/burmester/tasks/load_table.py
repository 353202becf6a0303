"""What can be stated of loads, by its names in files: kinds of springs, materials, profiles.

Without NumPy, as the tables of options and requirements: pages make fields of it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final, Literal, NamedTuple, TypeAlias

DENSITIES: Final[Mapping[str, float]] = {  # kg/m³
    "steel": 7850.0,
    "aluminium": 2700.0,
    "stainless": 7900.0,
    "acrylic": 1190.0,
    "plywood": 680.0,
}
Profile: TypeAlias = Literal["constant", "3-4-5", "trapezoid", "table"]
PROFILES: Final = ("3-4-5", "trapezoid", "constant")  # those that a duration is enough for
SpringKind: TypeAlias = Literal[
    "extension", "compression", "gas", "constant", "torsion", "counterweight"
]

# Which numbers a kind of spring needs, and which it may have besides; all are 0 or more.
NEEDED: Final[Mapping[SpringKind, tuple[str, ...]]] = {
    "extension": ("rate_N_per_mm", "free_length"),
    "compression": ("rate_N_per_mm", "free_length"),
    "gas": ("force_N", "compressed_force_N", "stroke", "length"),
    "constant": ("force_N",),
    "torsion": ("rate_Nm_per_deg",),
    "counterweight": ("mass_kg",),
}
POSSIBLE: Final[Mapping[SpringKind, tuple[str, ...]]] = {
    "extension": ("initial_N", "greatest_length"),
    "compression": ("least_length", "greatest_length"),
    "gas": ("friction_N",),
    "constant": ("least_length", "greatest_length"),
    "torsion": ("free_deg",),
    "counterweight": (),
}
SIGNED: Final = ("free_deg",)


class SpringNumber(NamedTuple):
    """A number of a spring in a form: its label, what it counts, and where it begins.

    usual: a number to begin with; of a length as a share of the distance of the spring's ends.
    """

    label: str
    kind: Literal["number", "length", "angle"]
    usual: float


SPRING_NUMBERS: Final[Mapping[str, SpringNumber]] = {
    "rate_N_per_mm": SpringNumber("rate, N/mm", "number", 0.5),
    "free_length": SpringNumber("free length", "length", 0.8),
    "initial_N": SpringNumber("initial tension, N", "number", 0),
    "greatest_length": SpringNumber("greatest length", "length", 2),
    "least_length": SpringNumber("least length", "length", 0.3),
    "force_N": SpringNumber("force, N", "number", 100),
    "compressed_force_N": SpringNumber("force compressed, N", "number", 130),
    "stroke": SpringNumber("stroke", "length", 0.4),
    "length": SpringNumber("length when extended", "length", 1.1),
    "friction_N": SpringNumber("friction, N", "number", 0),
    "rate_Nm_per_deg": SpringNumber("rate, N·m per degree", "number", 0.05),
    "free_deg": SpringNumber("free at", "angle", 0),
    "mass_kg": SpringNumber("mass, kg", "number", 1),
}
SPRING_WORDS: Final[Mapping[SpringKind, str]] = {
    "gas": "gas spring",
    "extension": "extension spring",
    "compression": "compression spring",
    "constant": "constant force",
    "torsion": "torsion spring at a joint",
    "counterweight": "counterweight",
}
PROFILE_WORDS: Final = {
    "3-4-5": "at rest at both ends (3-4-5)",
    "trapezoid": "trapezoid of speed",
    "constant": "constant speed",
}
