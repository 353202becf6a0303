"""A servo on the driver's joint: a motor that a spring and a damper hold to its command.

Its commands at the poses lead the driver by what the spring yields under the linkage's weight, so
that the linkage comes to rest at the poses themselves.
"""

from __future__ import annotations

import math
from typing import Final, NamedTuple, final

import numpy as np

from burmester.export.models.dynamic_model import DynamicModel
from burmester.numerics.arrays import FloatArray
from burmester.tasks.loads import STANDARD_GRAVITY

LONGEST_STEP: Final = 1e-3  # seconds: time step, shorter for linkages below 10 cm
STEP_SHARE: Final = 0.01  # of sqrt(span / g), the time of a fall: longest time step
FREQUENCY: Final = 0.3  # radians a time step: natural frequency
ARMATURE: Final = 0.01  # of the reduced inertia: that of the motor itself
# The same where there are more loops: the driver is often so light beside all that it moves that
# the damping of the servo, which a step of MuJoCo weighs against the driver alone, would shake
# them.
LOOPS_ARMATURE: Final = 0.3


@final
class Servo(NamedTuple):
    """A servo, and the time step (seconds) that suits it.

    frequency: natural, radians a second.
    stiffness, damping, armature: newtons, metres and kilograms, or N m, radians and kg m².
    share: of what the driver moves, the armature.
    controls: (N,), the commands at the poses, within the joint's limits; at a dead point, where no
    motor holds, they do not lead.
    """

    time_step: float
    frequency: float
    stiffness: float
    damping: float
    armature: float
    share: float
    controls: FloatArray

    @classmethod
    def of(cls, model: DynamicModel) -> Servo:
        """A servo with critical damping for the median of the inertia at the poses."""
        step = min(LONGEST_STEP, STEP_SHARE * math.sqrt(model.reference.span / STANDARD_GRAVITY))
        step = float(f"{step:.1e}")
        load = model.at_poses()
        moved_by_driver = load.inertia[0]
        finite = moved_by_driver[np.isfinite(moved_by_driver)]
        inertia = float(np.median(finite)) if len(finite) else model.masses[model.driver].about_z()
        share = ARMATURE if len(model.reference.closures) == 1 else LOOPS_ARMATURE
        frequency, moved = FREQUENCY / step, (1 + share) * inertia
        stiffness = moved * frequency**2
        lead = np.nan_to_num(load.effort / stiffness, nan=0.0, posinf=0.0, neginf=0.0)
        motor = model.motor
        at = model.joints.at_poses[:, motor] + lead
        controls = np.clip(at, model.low[motor], model.high[motor])
        damping = 2 * moved * frequency
        return cls(step, frequency, stiffness, damping, share * inertia, share, controls)
