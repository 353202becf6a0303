"""The springs and forces of a task as parts of a MuJoCo model; metres, newtons.

A spring is a tendon between two sites, or an angle between two bodies.  Where its force is no line
through zero at some length, an actuator without a command of its own has the rest of the force.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Final, final

import numpy as np

from burmester.export.description import number, xy
from burmester.export.models.dynamic_model import DynamicModel
from burmester.loads.masses import body_named
from burmester.loads.spring_laws import SpringLaw
from burmester.mechanisms.bodies import GROUND
from burmester.numerics.arrays import FloatArray
from burmester.tasks.loads import Loads, Spring

ENDLESS: Final = 1e6  # metres or newtons: no spring is as long or as strong


@final
@dataclass
class AppliedLoads:
    """Lines of XML.  sites: of each body, the ground among them; tendons; actuators.

    left_out: the numbers of forces that act between some poses only, which no model has.
    """

    sites: dict[str, list[str]] = field(default_factory=dict)
    tendons: list[str] = field(default_factory=list)
    actuators: list[str] = field(default_factory=list)
    left_out: list[int] = field(default_factory=list)

    @classmethod
    def of(cls, model: DynamicModel) -> AppliedLoads:
        """Those of a model; empty where its task has no loads."""
        out, loads = cls(), model.chosen.task.loads
        if loads is None:
            return out
        for count, course in enumerate(model.at_poses().springs, start=1):
            spring = course.spring
            if spring.kind == "torsion":
                out._add_torsion(f"spring_{count}", spring, float(course.length[0]), model)
            else:
                out._add_straight(f"spring_{count}", spring, model, loads)
        out._add_forces(model, loads)
        return out

    def _site(self, body: str, name: str, at: FloatArray) -> None:
        self.sites.setdefault(body, []).append(f'<site name="{name}" pos="{xy(at)} 0"/>')

    def _actuator(self, name: str, on: str, bias: tuple[float, float], more: str = "") -> None:
        """What pushes by bias[0] + bias[1] length."""
        prm = " ".join(map(number, (*bias, 0.0)))
        self.actuators.append(
            f'<general name="{name}" {on} gainprm="0" biastype="affine" biasprm="{prm}"{more}/>'
        )

    def _add_straight(self, name: str, spring: Spring, model: DynamicModel, loads: Loads) -> None:
        metre = model.reference.scale
        for end, letter in zip(spring.ends, "ab", strict=True):
            body = body_named(end.link, model.reference)
            self._site(body, f"{name}_{letter}", np.array(end.point) * metre)
        law = SpringLaw.of(spring, metre, loads.celsius)
        rest = law.start - law.rest / law.rate if law.rate > 0 else -1.0  # where the tension is 0
        stiff = ""
        if rest >= 0:
            low = 0.0 if law.least == 0 else rest
            high = ENDLESS if law.most == 0 else rest
            stiff = f' stiffness="{number(law.rate)}" springlength="{number(low)} {number(high)}"'
        elif law.least == 0:
            self._actuator(
                name,
                f'tendon="{name}"',
                (law.rate * law.start - law.rest, -law.rate),
                f' forcelimited="true" forcerange="{number(-ENDLESS)} 0"',
            )
        else:
            self._actuator(name, f'tendon="{name}"', (law.rate * law.start - law.rest, -law.rate))
        friction = spring.count * spring["friction_N"]
        rubs = f' frictionloss="{number(friction)}"' if friction else ""
        self.tendons.append(
            f'<spatial name="{name}"{stiff}{rubs}><site site="{name}_a"/><site site="{name}_b"/>'
            "</spatial>"
        )

    def _add_torsion(self, name: str, spring: Spring, angle: float, model: DynamicModel) -> None:
        """Add a torsion spring over a sum of joints; angle: at the first pose."""
        one, other = (body_named(end.link, model.reference) for end in spring.ends)
        turning = _angle_of(other, model) - _angle_of(one, model)
        off = angle - float(turning @ model.joints.at_poses[0])
        free = np.radians(spring["free_deg"])
        stiff = spring.count * float(np.degrees(spring["rate_Nm_per_deg"]))
        joints = "".join(
            f'<joint joint="{body}" coef="{number(coef)}"/>'
            for body, coef in zip(model.names, turning.tolist(), strict=True)
            if coef
        )
        if not joints:
            return
        self.tendons.append(f'<fixed name="{name}">{joints}</fixed>')
        self._actuator(name, f'tendon="{name}"', (stiff * (free - off), -stiff))

    def _add_forces(self, model: DynamicModel, loads: Loads) -> None:
        body = model.reference.body
        for count, force in enumerate(loads.forces, start=1):
            if force.from_pose is not None or force.to_pose is not None:
                self.left_out.append(count)
                continue
            name = f"force_{count}"
            self._site(body, name, force.at * model.reference.scale)
            frame = ""
            if force.frame == "F":
                self._site(GROUND, f"{name}_frame", np.zeros(2))
                frame = f' refsite="{name}_frame"'
            on = f'site="{name}"{frame} gear="{xy(force.force)} 0 0 0 0"'
            self._actuator(name, on, (1.0, 0.0))
        if loads.torque:
            self._site(body, "torque", np.zeros(2))
            self._actuator("torque", 'site="torque" gear="0 0 0 0 0 1"', (loads.torque, 0.0))


def _angle_of(body: str, model: DynamicModel) -> FloatArray:
    """By how much each joint (k,) turns a body."""
    out, limbs = np.zeros(len(model.names)), {each.body: each for each in model.reference.tree}
    while body != GROUND:
        out[model.names.index(body)] = 0.0 if limbs[body].slides else 1.0
        body = limbs[body].on
    return out
