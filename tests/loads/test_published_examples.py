"""Worked examples that makers of gas springs publish: lids on a hinge, by hand's moments.

Camloc (eurekaknowledge.co.uk, "Mounting positions: gas spring sizing continued") and Berthold Marx
(bertholdmarx.com, "Decision making aid") both hold a lid of 50 kg with two springs a quarter of a
metre from its hinge, and find 784.8 N a spring.  Left out is Camloc's row of 0.3 m, whose 523.2 N
are not what its formula gives (654 N).
"""

import numpy as np
import pytest

from burmester.loads.loaded_motion import LoadedLinkage
from burmester.tasks.loads import End, Loads, Spring
from tests.oracles.handed_over import rr
from tests.oracles.loaded_linkages import driven_at

HORIZONTAL, UPRIGHT = 0.0, np.pi / 2
EDGE = 1200  # mm from the hinge to the edge of the lid, where a hand pushes
EXAMPLES = [  # centre of gravity and attachment in mm; what Camloc prints of one spring, of a hand
    (800, 250, 784.8, 327),
    (800, 200, 981.0, 327),
    (600, 250, 588.0, 245),
    (1000, 250, 981.0, 408),
]


def hand_force(drive, *springs):
    """What a hand bears at the edge of a lid, the crank AC, as its links else weigh nothing."""
    dyads = (rr([0, 0], [0, 0], EDGE), rr([3600, 0], [2600, 0], 2200))
    drives = drive + np.radians([0, 10, 20, 30])
    loads = Loads(springs=springs, hand=[0, 0])
    loaded = LoadedLinkage.of(driven_at(dyads, drives, loads)).at(31)
    return loaded.hand_force(loaded.effort)[0]


def weight(centre):
    at = (End("ground", (0, 0)), End("driver", (centre, 0)))
    return Spring("counterweight", at, {"mass_kg": 50})


def perpendicular(attached, force, drive):
    """Two springs that pull with a constant force at right angles to the lid, at one pose."""
    far = attached * np.exp(1j * drive) + 400j * np.exp(1j * drive)
    at = (End("ground", (far.real, far.imag)), End("driver", (attached, 0)))
    return Spring("constant", at, {"force_N": force}, 2)


@pytest.mark.parametrize(("centre", "attached", "force", "closing"), EXAMPLES)
def test_a_lid_on_two_gas_springs(centre, attached, force, closing):
    """Printed to a newton or a tenth, with 9.81 m/s2."""
    alone = hand_force(HORIZONTAL, weight(centre))
    held = hand_force(HORIZONTAL, weight(centre), perpendicular(attached, force, HORIZONTAL))
    assert alone == pytest.approx(2 * force * attached / EDGE, rel=1.5e-3)
    assert abs(held) <= 1.5e-3 * alone
    # Upright the weight is over the hinge, and a hand at the edge has the springs against it.
    upright = hand_force(UPRIGHT, weight(centre), perpendicular(attached, force, UPRIGHT))
    assert upright == pytest.approx(-closing, abs=1.0)


def test_a_lid_that_is_held_in_its_middle():
    """Berthold Marx: 50 kg, 1.5 m long, and 5 kp of friction in the springs' force."""
    spring = perpendicular(250, 784.8 - 5 * 9.81, HORIZONTAL)
    assert abs(hand_force(HORIZONTAL, weight(750), spring)) < 0.2
