"""A whole task moved, turned, mirrored and scaled: linkages taken along are judged the same."""

import cmath
import json

import pytest

import burmester
from burmester.io.reading.poses import read_task
from burmester.live.document import document_of, task_of
from burmester.studio.opening import template
from tests.oracles.page_modules import value

MOVES = [  # turn in degrees, scale, mirror, and where the origin of F goes
    {"turn": 37.0, "scale": 1.0, "mirror": False, "x": 210.0, "y": -35.0},
    {"turn": 123.0, "scale": 0.6, "mirror": True, "x": -40.0, "y": 12.0},
    {"turn": 90.0, "scale": 2.5, "mirror": True, "x": 0.0, "y": 7.0},
]
# What a whole document may say besides; numbers that decide, one way or the other.
BESIDE = {
    "lid-hinge": {
        "keep_out": [
            {"name": "post", "box": [[98, -85], [104, -73]]},
            {"polygon": [[-60, 80], [-20, 100], [-60, 140]]},
        ],
        "surroundings": {"link_width": 6, "margin": 3},
        "requirements": {
            "transmission_deg": 40,
            "within": 0.5,
            "footprint": {"box": [[0, -100], [110, 30]]},
        },
        "limits": [
            {"fixed_pivot": {"box": [[60, -100], [150, -10]]}, "length": {"least": 30, "most": 55}},
            {"moving_pivot": {"line": [[0, -17], [10, -16]]}, "kinds": ["RR"]},
        ],
    },
    "sprung-lid": {
        "loads": {
            "body": {"mass_kg": 4, "center": [200, 12], "inertia_kgm2": 0.02},
            "links": {"driver": 0.4},
            "force": {"at": [300, 5], "force_N": [2, -3], "from_pose": 1, "to_pose": 2},
            "torque_Nm": 0.7,
            "hand": {"at": [420, 0]},
        },
        "requirements": {"hand_force_N": 12, "driver_torque_Nm": 15, "body_speed": 100},
        "springs": [
            {"kind": "extension", "ground_point": [300, -200], "body_point": [200, 0],
             "rate_N_per_mm": 0.05, "free_length": 90, "initial_N": 4},
            {"kind": "torsion", "from": {"link": "ground"}, "to": {"link": "driver"},
             "rate_Nm_per_deg": 0.02, "free_deg": 80},
            {"kind": "torsion", "from": {"link": "driver"}, "to": {"link": "body"},
             "rate_Nm_per_deg": 0.03, "free_deg": -40},
            {"kind": "counterweight", "to": {"link": "follower", "point": [-30, 10]},
             "mass_kg": 0.6},
        ],
    },
}  # fmt: skip


class Along:
    """The same move as `task_transform` makes, with complex numbers."""

    def __init__(self, turn, scale, mirror, x, y):
        self.factor, self.by = scale * cmath.rect(1, turn * cmath.pi / 180), complex(x, y)
        self.scale, self.mirror, self.turn = scale, mirror, turn

    def _pair(self, z):
        return [z.real, z.imag]

    def fixed(self, point):
        z = complex(*point)
        return self._pair(self.factor * (z.conjugate() if self.mirror else z) + self.by)

    def moving(self, point):
        x, y = point
        return [self.scale * x, -self.scale * y if self.mirror else self.scale * y]

    def dyad(self, stated):
        at = {"PR": self.fixed, "RP": self.moving}.get(stated["kind"])
        out = {}
        if at:
            turn = self.turn if stated["kind"] == "PR" else 0.0
            direction = stated["line"]["direction_deg"]
            out["line"] = {
                "point": at(stated["line"]["point"]),
                "direction_deg": turn + (-direction if self.mirror else direction),
            }
        if "fixed_pivot" in stated:
            out["fixed_pivot"] = self.fixed(stated["fixed_pivot"])
        if "moving_pivot" in stated:
            out["moving_pivot"] = self.moving(stated["moving_pivot"])
        if "radius" in stated:
            out["length"] = self.scale * stated["radius"]
        return out


def judged(task, dyads, folder):
    file = folder / "linkage.json"
    file.write_text(json.dumps({"dyads": dyads}))
    return json.loads(burmester.judge(task, file).to_json())["linkages"][0]


def told(linkage, along):
    """What a verdict says, in the units of the task that was not moved."""
    scale = along.scale
    out = {
        "usable": linkage["usable"],
        "unmet": sorted(each["kind"] for each in linkage["unmet"]),
        "short": len(linkage["shortcomings"]),
        "error": linkage["position_error"]["max"] / scale,
        "angle": linkage["angle_error_deg"]["max"],
        "transmission": linkage["min_transmission_angle_deg"]["range"],
    }
    if "clearance" in linkage:
        out["clear"] = linkage["clearance"]["least"] / scale
    if loads := linkage.get("loads"):
        torque, hand = loads["driver_torque_Nm"], loads["hand_force_N"]
        ends = torque["least"] / scale, torque["greatest"] / scale
        out["torque"] = sorted(map(abs, ends))  # a mirrored driver turns the other way
        out["hand"] = [hand["least"], hand["greatest"]]
        out["pins"] = [*loads["pin_force_N"].values()]
    return out


@pytest.mark.parametrize("name", ["lid-hinge", "sprung-lid", "window-stay", "drawer"])
def test_a_linkage_taken_along_is_judged_the_same(name, tmp_path):
    document = template(name)["document"] | BESIDE.get(name, {})
    plain = {key: each for key, each in document.items() if key not in ("loads", "springs")}
    plain["requirements"] = {}
    found = json.loads(burmester.synthesize(task_of(plain)).to_json())["linkages"]
    assert found
    task, still = task_of(document), Along(0, 1, False, 0, 0)
    verdicts = []
    for by in MOVES:
        along = Along(**by)
        there = value("task_transform.mjs", "return m.transformed(task, by)", task=document, by=by)
        moved = task_of(there)
        for linkage in found[:3]:
            at_home = told(judged(task, [*map(still.dyad, linkage["dyads"])], tmp_path), still)
            away = told(judged(moved, [*map(along.dyad, linkage["dyads"])], tmp_path), along)
            verdicts.append(at_home)
            assert away.keys() == at_home.keys()
            for key, each in at_home.items():
                assert away[key] == (each if isinstance(each, bool) else _near(each)), (key, by)
    assert any(each["unmet"] for each in verdicts) or name not in BESIDE


def _near(each):
    exact = isinstance(each, list) and each and isinstance(each[0], str)
    return each if exact or each == [] else pytest.approx(each, rel=1e-5, abs=1e-7)


def test_what_has_no_other_axes_is_not_turned_aslant():
    task = {"poses": [{"x": 1, "y": 2, "angle": 3, "tolerance": {"x": 0.1, "y": 0.2}}]}
    say = "return m.aslant(task, { turn, scale: 1, mirror: false, x: 0, y: 0 })"
    assert "pose 1" in value("task_transform.mjs", say, task=task, turn=30)
    assert value("task_transform.mjs", say, task=task, turn=90) == ""
    turned = value(
        "task_transform.mjs",
        "return m.movedPose({ turn: 90, scale: 2, mirror: false, x: 0, y: 0 }, task.poses[0])",
        task=task,
    )
    assert turned == {"x": -4, "y": 2, "angle": 93, "tolerance": {"x": 0.4, "y": 0.2}}


def test_turned_numbers_claim_no_more_digits_than_those_before():
    """Of numbers with two decimals a turn makes twelve, and the poses are not known better."""
    task = read_task("case:ge2012-approximate")
    document = document_of(task)
    sigma = {"position": task.resolution[0] / 3**0.5, "angle_deg": 0.1}
    there = value(
        "task_transform.mjs", "return m.transformed(task, by, sigma)",
        task=document, by=MOVES[1], sigma=sigma,
    )  # fmt: skip
    assert task_of(there).resolution[0] == pytest.approx(0.6 * task.resolution[0])
