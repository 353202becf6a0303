"""What is said of linkages, in sentences, tables and JSON: held against what they do when driven.

The numbers are computed again from the dimensions that the JSON gives, by the driver of `witness`,
in plain complex numbers; the words are looked for around them.
"""

import io
import json
import math
import re
from dataclasses import replace
from importlib import resources

import jsonschema
import numpy as np
import pytest
from rich.console import Console

from burmester import cli
from burmester.describe.sentences import type_doubt
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.io.cases import names
from burmester.io.reading.poses import read_task
from burmester.io.result import synthesis_data
from burmester.io.terminal import show_synthesis
from burmester.synthesis.motion_generation import synthesize
from burmester.tasks.motion_task import Task
from burmester.tasks.options import SynthesisOptions
from burmester.tasks.requirements import Requirements
from burmester.web.data import report_data
from tests.oracles import witness

# What other programs rely on; more may be required here, nothing less.
CONTRACT = {
    "linkage": "id rank dyads type position_error angle_error_deg usable defects driver "
    "min_transmission_angle_deg",
    "defect": "kind message poses",
}
SCHEMA = json.loads(
    resources.files("burmester").joinpath("io/synthesis.schema.json").read_text("utf-8")
)
CASES = names()


def synthesized(task, **options):
    """The synthesis, what --json prints of it, and the screen, `width` columns wide."""
    synthesis = synthesize(task, SynthesisOptions(**options))
    data = json.loads(json.dumps(synthesis_data(synthesis), allow_nan=False))
    jsonschema.Draft202012Validator(SCHEMA).validate(data)

    def screen(width=200, whole=True):
        out = io.StringIO()
        console = Console(file=out, width=width, highlight=False)
        show_synthesis(synthesis, console, everything=whole, dyads=whole, verbose=whole)
        return out.getvalue()

    return synthesis, data, screen


@pytest.fixture(scope="module")
def cases():
    found = {}

    def case(name):
        if name not in found:
            found[name] = synthesized(read_task(f"case:{name}"))
        return found[name]

    return case


def decoded(data):
    """A dyad of the JSON."""
    match data["kind"]:
        case "RR":
            return RR(
                np.array(data["fixed_pivot"]),
                np.array(data["moving_pivot"]),
                np.array(data["radius"]),
            )
        case "PR":
            angle = np.radians(data["line"]["normal_deg"])
            return PR(angle, np.array(data["line"]["offset"]), np.array(data["moving_pivot"]))
        case "RP":
            angle = np.radians(data["line"]["normal_deg"])
            return RP(np.array(data["fixed_pivot"]), angle, np.array(data["line"]["offset"]))
    raise AssertionError(data["kind"])


def rows(poses):
    return np.array([[pose["x"], pose["y"], math.radians(pose["angle_deg"])] for pose in poses])


def on_dyad(dyad, at):
    """How far body places (n, 3) are from what a dyad allows."""
    d, turn = at[:, 0] + 1j * at[:, 1], np.exp(1j * at[:, 2])
    if dyad["kind"] == "RR":
        pin = d + turn * complex(*dyad["moving_pivot"])
        return abs(pin - complex(*dyad["fixed_pivot"])) - dyad["radius"]
    normal = np.exp(1j * math.radians(dyad["line"]["normal_deg"]))
    if dyad["kind"] == "PR":
        point = d + turn * complex(*dyad["moving_pivot"])
    else:
        point = (complex(*dyad["fixed_pivot"]) - d) / turn
    return (np.conj(normal) * point).real - dyad["line"]["offset"]


@pytest.mark.parametrize("name", CASES)
def test_the_errors_are_those_of_the_places_where_the_linkage_can_be(cases, name):
    _, data, _ = cases(name)
    size = data["characteristic_length"]
    wanted = rows(data["task"]["poses"])
    poses = Displacement(wanted[:, :2], wanted[:, 2])
    for linkage in data["linkages"]:
        at = rows(linkage["coupler"])
        for dyad in linkage["dyads"]:
            reach = size + abs(dyad.get("radius", 0.0))
            assert np.abs(on_dyad(dyad, at)).max() < 1e-8 * reach
        away = np.hypot(*(at - wanted)[:, :2].T)
        turned = np.abs(np.angle(np.exp(1j * (at - wanted)[:, 2])))
        for key, values in (
            ("position_error", away),
            ("angle_error_deg", np.degrees(turned)),
        ):
            assert linkage[key]["max"] == pytest.approx(values.max(), rel=1e-9, abs=1e-12 * size)
            assert linkage[key]["rms"] == pytest.approx(
                np.sqrt((values**2).mean()), rel=1e-9, abs=1e-12 * size
            )
        if linkage["usable"]:
            pair = Linkage(*map(decoded, linkage["dyads"]))
            length = data["length_per_radian"]
            driven = witness.misses(pair, poses, length)
            said = np.hypot(away, length * turned)
            assert said == pytest.approx(driven, rel=1e-4, abs=1e-6 * size)


def least_transmission(linkage, at, steps=40_001):
    """The least angle between coupler and follower, or its guide's normal, over the travel."""
    first, second = map(decoded, linkage["dyads"])
    low, high = (math.radians(end) for end in linkage["drives"]["first"]["travel_deg"])
    drive = np.linspace(low, high, steps)
    where, phi = witness.places(first, second, drive)
    pin = at[:, 0] + 1j * at[:, 1] + np.exp(1j * at[:, 2]) * complex(*first.moving_pivot)
    angle = np.angle(pin - complex(*first.fixed_pivot))
    both, turned = witness.places(first, second, angle)
    gaps = abs(both - (at[:, 0] + 1j * at[:, 1])) + abs(np.exp(1j * (turned - at[:, 2])) - 1)
    (side,) = set(gaps.argmin(axis=0))  # of both assemblies, the one with the poses
    hand, far = complex(*first.moving_pivot), complex(*second.moving_pivot)
    turn = np.exp(1j * phi[side])
    coupler = turn * (far - hand)
    if isinstance(second, RR):
        follower = where[side] + turn * far - complex(*second.fixed_pivot)
    else:
        follower = np.exp(1j * float(second.normal_angle))
    folded = np.abs(np.angle(coupler / follower))
    return np.degrees(np.nanmin(np.minimum(folded, np.pi - folded)))


@pytest.mark.parametrize("name", ["ge2012-exact", "ge2012-approximate", "motiongen-rrrp"])
def test_the_least_transmission_angle_is_that_of_the_whole_way(cases, name):
    _, data, screen = cases(name)
    tried = 0
    for linkage in data["linkages"]:
        kinds = [dyad["kind"] for dyad in linkage["dyads"]]
        if linkage["usable"] and kinds in (["RR", "RR"], ["RR", "PR"]):
            least = least_transmission(linkage, rows(linkage["coupler"]))
            said = linkage["min_transmission_angle_deg"]
            assert said["range"] == pytest.approx(least, abs=1e-3)
            assert said["range"] <= said["poses"] + 1e-9
            table = screen().split("Usable, the best first")[1]
            row = next(line for line in table.splitlines() if line.startswith(f"{linkage['id']} "))
            *_, angle, extent, sensitivity = row.split()
            assert float(angle.rstrip("°")) == pytest.approx(least, abs=0.1)
            assert float(extent) == pytest.approx(linkage["quality"]["extent"], rel=0.05)
            assert float(sensitivity) == pytest.approx(linkage["quality"]["sensitivity"], rel=0.05)
            tried += 1
    assert tried >= 2


@pytest.mark.parametrize("name", CASES)
def test_the_first_sentence_says_what_the_best_linkage_does(cases, name):
    _, data, screen = cases(name)
    best = data["linkages"][0]
    text = screen()
    usable = sum(linkage["usable"] for linkage in data["linkages"])
    share = "usable" if len(data["linkages"]) == 1 else f"{usable} of them usable"
    counted = rf"^{len(data['linkages'])} four-bars? .*, {share}\.$"
    assert re.search(counted, text, re.MULTILINE)
    said = re.fullmatch(
        r"L1, an? (.+) driven by ([DM]\d+), passes every pose (.+), transmission angle "
        r"(\S+)° or more\.",
        text.splitlines()[0],
    )
    assert said is not None
    kind, driver, how, least = said.groups()
    assert kind == best["type"]
    assert driver == best["dyads"][0]["id"]
    range_ = best["min_transmission_angle_deg"]["range"]
    assert range_ - 0.1 < float(least) <= range_ * (1 + 1e-9)
    if how == "exactly, up to rounding":
        assert best["position_error"]["max"] < 1e-10 * data["characteristic_length"]
    else:
        position, angle = re.fullmatch(r"within (\S+) and (\S+)°", how).groups()
        assert float(position) == pytest.approx(best["position_error"]["max"], rel=0.05)
        assert float(angle) == pytest.approx(best["angle_error_deg"]["max"], rel=0.05)


def test_why_it_is_not_the_closest_one(cases):
    _, data, screen = cases("motiongen-mixed5")
    best = data["linkages"][0]
    missed = f"{best['position_error']['max']:.2g} and {best['angle_error_deg']['max']:.2g}°"
    *works, closest = data["linkages"]
    said = " ".join(screen().split())
    assert f"This one works and misses by {missed}; the closest one, {closest['id']}," in said
    assert "passes every pose exactly but locks between poses 3 and 4, at a dead point." in said
    assert all(each["usable"] and each["sought"] for each in works)
    assert not closest["usable"]
    (defect,) = closest["defects"]
    assert defect["kind"] == "branch"
    assert defect["poses"] == [3, 4]
    assert defect["certain"]
    # The crank of the closest one is on both sides of a dead point at those poses.
    pair = [decoded(dyad) for dyad in closest["dyads"]]
    at = rows(closest["coupler"])
    sides = []
    for x, y, angle in at[[2, 3]]:
        turn = np.exp(1j * angle)
        coupler = turn * complex(*(pair[1].moving_pivot - pair[0].moving_pivot))
        pin = x + 1j * y + turn * complex(*pair[1].moving_pivot)
        follower = pin - complex(*pair[1].fixed_pivot)
        sides.append(np.sign(np.angle(coupler / follower)))
    assert sides[0] != sides[1]


@pytest.mark.parametrize("width", [40, 60, 80, 200])
@pytest.mark.parametrize("name", CASES)
def test_nothing_is_wider_than_the_screen_or_cut_off(cases, name, width):
    _, data, screen = cases(name)
    text = screen(width)
    assert max(map(len, text.splitlines())) <= width
    assert all(line == line.rstrip() for line in text.splitlines())
    assert "…" not in text
    assert not re.search(r"\de\+", text)
    one_line = " ".join(text.split())
    usable = [each for each in data["linkages"] if each["usable"]]
    for linkage in data["linkages"]:
        assert re.search(rf"\b{linkage['id']}\b", one_line)
        if linkage["usable"]:
            assert linkage["type"].split()[0] in one_line
        for defect in linkage["defects"]:
            if defect["kind"] != "assembly":
                assert " ".join(defect["message"].split()) in one_line
    short = " ".join(screen(width, whole=False).split())
    rest = len(data["linkages"]) - len(usable) - (0 if usable else 3)
    hidden = sum(not re.search(rf"\b{each['id']}\b", short) for each in usable)
    assert hidden <= max(0, len(usable) - 4)
    if hidden:
        assert f"{hidden} more{f', and {rest} not usable' if rest else ''}: --all" in short
    elif rest > 0:
        assert f"{rest} more, not usable: --all" in short.lower()
    assert ("Usable, the best first" in short) == (len(usable) > 1)
    for heading in ("Not usable, and why", "rms miss"):
        assert heading not in short


def on_a_terminal(synthesis, encoding):
    """The screen of a terminal that shows the characters of an encoding."""
    raw = io.BytesIO()
    out = io.TextIOWrapper(raw, encoding=encoding, errors="replace")
    console = Console(file=out, width=120, force_terminal=True, color_system=None)
    show_synthesis(synthesis, console)
    out.flush()
    return raw.getvalue().decode(encoding)


@pytest.mark.parametrize("name", CASES)
def test_a_terminal_that_can_shows_the_best_linkage(cases, name):
    """Pivots of the sketch are as far apart, along each axis, as those of the linkage."""
    synthesis, _, _ = cases(name)
    best, rows = synthesis.usable[0], on_a_terminal(synthesis, "utf-8").splitlines()
    place = best.error.places[0]
    pins = [each.dyad.fixed_pivot for each in best.dyads if isinstance(each.dyad, RR | RP)]
    hands = [
        place.act(each.dyad.moving_pivot) for each in best.dyads if isinstance(each.dyad, RR | PR)
    ]
    drawn = [
        (x, -2.0 * y)
        for marks in ("▲", "●■")
        for y, line in enumerate(rows)
        for x, char in enumerate(line)
        if char in marks
    ]
    assert len(drawn) == len(pins) + len(hands)
    assert drawn
    ground = sorted(drawn[: len(pins)])
    moving = sorted(drawn[len(pins) :])
    shown = np.array([*ground, *moving])
    true = np.array([*sorted(map(tuple, pins)), *sorted(map(tuple, hands))])
    # One scale and one shift lead from the linkage to the characters, within a character.
    shown, true = shown - shown.mean(axis=0), true - true.mean(axis=0)
    scale = (shown * true).sum() / (true**2).sum()
    assert scale > 0
    assert np.abs(shown - scale * true).max() < 1.6


def test_no_sketch_where_it_cannot_be_read(cases):
    synthesis, _, screen = cases("ge2012-exact")
    assert "▲" not in screen(120)
    assert "▲" in on_a_terminal(synthesis, "utf-8")
    assert "▲" not in on_a_terminal(synthesis, "latin-1")


def numbers_near(text):
    return [float(number) for number in re.findall(r"-?\d+\.?\d*(?:e-?\d+)?", text)]


def test_dimensions_have_at_least_the_digits_to_which_they_are_known(cases):
    _, data, screen = cases("ge2012-exact")
    best = data["linkages"][0]
    block = screen().split("L1 in full\n")[1].splitlines()[:6]
    regions = best["pivot_uncertainty"]["dyads"]
    parts = [
        (dyad[key], region[key]["half_width"] if key != "radius" else region["length"])
        for dyad, region in zip(best["dyads"], regions, strict=True)
        for key in ("fixed_pivot", "moving_pivot", "radius")
    ]
    for line, (value, give) in zip(block, parts, strict=True):
        left, right = line.split("±")
        shown = numbers_near(left.split("pivot")[-1].split("length")[-1])
        assert float(right) == pytest.approx(give, rel=0.3)
        (places,) = {len(number.split(".")[1]) for number in re.findall(r"\d+\.\d+", left)}
        half = 0.501 * 10.0**-places
        assert shown == pytest.approx(np.atleast_1d(value).tolist(), rel=0, abs=half)
        assert 10.0**-places < max(give, best["position_error"]["max"])


def test_the_precision_of_the_poses_is_what_the_regions_come_from(cases):
    task = read_task("case:ge2012-exact")
    _, rough, screen = synthesized(replace(task, resolution=tuple(10 * np.array(task.resolution))))
    _, fine, _ = cases("ge2012-exact")
    for a, b in zip(rough["linkages"][:4], fine["linkages"][:4], strict=True):
        for one, other in zip(
            a["pivot_uncertainty"]["dyads"], b["pivot_uncertainty"]["dyads"], strict=True
        ):
            for key in ("fixed_pivot", "moving_pivot"):
                if one[key] and one[key]["determined"]:
                    assert one[key]["half_width"] == pytest.approx(
                        10 * other[key]["half_width"], rel=1e-6
                    )
    sigma = rough["task"]["pose_sigma"]
    assert sigma["position"] == pytest.approx(5e-4 / math.sqrt(3))
    assert sigma["angle_deg"] == pytest.approx(0.05 / math.sqrt(3))
    assert "if the poses err by 0.00029 and 0.029° (standard deviations" in screen()
    whole = replace(task, resolution=(task.resolution[0], 0.0))  # angles in whole degrees, say
    _, _, screen = synthesized(whole)
    assert "if the positions of the poses err by 2.9e-05 and their angles are exact" in screen()
    exact = replace(task, resolution=(0.0, 0.0))
    _, data, screen = synthesized(exact)
    assert data["task"]["pose_sigma"] == {"position": 0, "angle_deg": 0}
    assert "±" not in screen()
    assert "The poses are taken as exact" in " ".join(screen().split())


def small_turn(decimals=3):
    """Poses of a four-bar that turn by 1.8° only, in mm."""
    a = RR(np.zeros(2), np.zeros(2), np.array(12.0))
    b = RR(np.array([30.0, 0.0]), np.array([28.0, 8.0]), np.array(22.0))
    where, phi = witness.places(a, b, np.linspace(1.0, 1.25, 9))
    table = np.column_stack([where[0].real, where[0].imag, np.degrees(phi[0])]).round(decimals)
    return "x_mm,y_mm,angle_deg\n" + "".join(
        f"{x:.{decimals}f},{y:.{decimals}f},{angle:.{decimals}f}\n" for x, y, angle in table
    )


def test_a_motion_that_determines_no_pivots_is_told_as_one(tmp_path):
    file = tmp_path / "small.csv"
    file.write_text(small_turn())
    task = read_task(str(file))
    synthesis, data, screen = synthesized(task)
    assert data["outcome"]["code"] == "R305"
    turn = np.ptp([pose["angle_deg"] for pose in data["task"]["poses"]])
    assert f"the body turns only {turn:.2g}°" in data["outcome"]["why"]
    first = data["linkages"][0]
    text, regions = " ".join(screen().split()), synthesis.linkages[0].uncertainty
    said = re.search(
        r"L1 works, and the (fixed|moving) pivot of (\w+) may be moved by about ±(\S+) mm along "
        r"(\S+)° in [FM], the others with it",
        text,
    )
    if said is None:
        assert "L1 works, and its pivots may be moved by far more than the motion's own" in text
        span = np.linalg.norm(np.ptp(task.poses.translation, axis=0))
        assert max(each.half_width for each in regions) > 100 * span
    else:
        named = next(k for k, dyad in enumerate(first["dyads"]) if dyad["id"] == said[2])
        region = regions[named]
        pivot = region.fixed if said[1] == "fixed" else region.moving
        assert float(said[3]) == pytest.approx(pivot.half_width, rel=0.05)
        assert float(said[4]) == pytest.approx(math.degrees(pivot.direction), abs=0.51)
    usable = [linkage for linkage in data["linkages"] if linkage["usable"]]
    assert usable
    assert not any(linkage["pivot_uncertainty"]["determined"] for linkage in usable)
    assert run(file) == 0
    assert run(file, "--require-determined") == 1


def run(*arguments):
    with pytest.raises(SystemExit) as stop:
        cli.main(["synthesize", *map(str, arguments)])
    return stop.value.code


NEEDED = {
    "transmission": (["--min-transmission", "89.9", "--type", "crank-rocker"], "transmission"),
    "type": (["--type", "double-crank"], "type"),
    "within": (["--within", "1e-6"], "assembly"),
    "ratio": (["--link-ratio", "1.5", "--kinds", "RR"], "link ratio"),
}


@pytest.mark.parametrize("name", NEEDED)
def test_nothing_usable_is_told_with_the_reason_and_a_way_that_leads_on(name, capsys):
    arguments, kind = NEEDED[name]
    assert run("case:ge2012-exact", *arguments, "--json") == 1
    data = json.loads(capsys.readouterr().out)
    jsonschema.Draft202012Validator(SCHEMA).validate(data)
    outcome = data["outcome"]
    assert outcome["code"] == "R301"
    assert not any(linkage["usable"] for linkage in data["linkages"])
    closest = min(data["linkages"], key=lambda each: each["position_error"]["max"])
    reasons = {each["kind"] for each in closest["unmet"] + closest["defects"]}
    assert kind in reasons
    assert f"the closest one, {closest['id']}, misses by" in outcome["why"]
    # What the help says is done to the letter, and leads to the linkage that it names.
    way = re.search(r"with (--.+?) (L\d+) would do", outcome["help"])
    assert way is not None, outcome["help"]
    options, named = re.findall(r'"[^"]+"|\S+', way[1]), way[2]
    options = [option.strip('"') for option in options]
    kept = []
    for flag, value in zip(arguments[::2], arguments[1::2], strict=True):
        kept += [] if flag in options else [flag, value]
    assert run("case:ge2012-exact", *kept, *options, "--json") == 0
    again = json.loads(capsys.readouterr().out)
    promised = next(each for each in data["linkages"] if each["id"] == named)
    best = again["linkages"][0]
    assert best["usable"]
    assert best["position_error"]["max"] <= promised["position_error"]["max"] * (1 + 1e-6)


def test_poses_out_of_order_are_told_and_any_order_helps(tmp_path, capsys):
    table = read_task("case:ge2012-exact")
    order = [0, 1, 2, 5, 4, 3, 6, 7, 8, 9]
    file = tmp_path / "shuffled.csv"
    points, angles = table.poses.translation[order], np.degrees(table.poses.angle[order])
    file.write_text(
        "x,y,angle_deg\n"
        + "".join(f"{x:.4f},{y:.4f},{a:.2f}\n" for (x, y), a in zip(points, angles, strict=True))
    )
    run(file, "--json")
    data = json.loads(capsys.readouterr().out)
    closest = min(data["linkages"], key=lambda each: each["position_error"]["max"])
    assert closest["position_error"]["max"] < 1e-4
    (defect,) = closest["defects"]
    assert defect["kind"] == "order"
    assert defect["message"] == "meets the poses in the order 1-2-3-6-5-4-7-8-9-10"
    assert defect["poses"] == [4, 6]
    if data["outcome"]["code"] == "R301":
        assert "with --any-order" in data["outcome"]["help"]
    assert run(file, "--any-order") == 0
    assert "L1, a crank-rocker" in capsys.readouterr().out


def test_weak_transmission_is_a_warning_unless_it_was_asked_for(cases):
    synthesis, data, _ = cases("ge2012-exact")
    (weak,) = [each for each in data["warnings"] if each["code"] == "W210"]
    least = data["linkages"][0]["min_transmission_angle_deg"]["range"]
    assert least < 40
    assert f"falls to {math.floor(10 * least) / 10:g}°" in weak["message"]
    named = re.search(r"take (L\d+), which has (\S+)° or more", weak["help"])
    other = next(each for each in data["linkages"] if each["id"] == named[1])
    assert other["usable"]
    assert other["min_transmission_angle_deg"]["range"] >= float(named[2]) > least
    asked = replace(synthesis.task, requirements=Requirements(transmission_deg=20))
    _, data, _ = synthesized(asked)
    assert not [each for each in data["warnings"] if each["code"] == "W210"]
    assert data["task"]["requirements"] == {"transmission_deg": pytest.approx(20)}
    _, good, _ = cases("motiongen-rrpr")
    assert good["linkages"][0]["min_transmission_angle_deg"]["range"] > 40
    assert not [each for each in good["warnings"] if each["code"] == "W210"]


def test_pivots_that_are_hardly_determined_are_a_warning():
    task = read_task("case:ge2012-exact")
    synthesis, data, screen = synthesized(replace(task, resolution=(2e-3, math.radians(0.2))))
    warned = [each["message"] for each in data["warnings"] if each["code"] == "W209"]
    loose = [
        each["id"]
        for each in data["linkages"]
        if each["usable"] and not each["pivot_uncertainty"]["determined"]
    ]
    assert loose
    assert len(loose) < sum(each["usable"] for each in data["linkages"])
    (message,) = warned
    assert all(re.search(rf"\b{name}\b", message) for name in loose)
    best = next(each for each in synthesis.linkages if each.id == loose[0])
    widest = max(each.half_width for each in best.uncertainty)
    said = float(re.search(r"about ±(\S+)", message)[1])
    assert said == pytest.approx(widest, rel=0.05)
    points = np.array([[pose["x"], pose["y"]] for pose in data["task"]["poses"]])
    span = float(re.search(r"the poses span (\S+)\)", message)[1])
    assert span == pytest.approx(np.hypot(*np.ptp(points, axis=0)), rel=0.05)
    if loose[0] == "L1":
        sure = next(
            each["id"]
            for each in data["linkages"]
            if each["usable"] and each["pivot_uncertainty"]["determined"]
        )
        assert f"those of {sure} they do not" in " ".join(screen().split())
    # Half-widths are given just where they reach no farther than a twentieth of span and link,
    # and the linkage's widest no farther than 0.3 spans.
    size = np.hypot(*np.ptp(points, axis=0))
    flags = []
    for found, shown in zip(synthesis.linkages, data["linkages"], strict=True):
        runaway = max(each.half_width for each in found.uncertainty) > 0.3 * size
        for dyad, one, region in zip(
            found.dyads, found.uncertainty, shown["pivot_uncertainty"]["dyads"], strict=True
        ):
            link = float(dyad.dyad.radius) if isinstance(dyad.dyad, RR) else np.inf
            reach = 0.0 if runaway else 0.05 * min(size, link)
            for part, of_pivot in ((one.fixed, "fixed_pivot"), (one.moving, "moving_pivot")):
                if part is not None:
                    given = region[of_pivot]
                    flags.append(given["determined"])
                    assert given["determined"] == (part.major <= reach)
                    assert given["half_width"] == (part.major if given["determined"] else None)
                    assert given["minor"] == (part.minor if part.minor <= reach else None)
            if one.length is not None:
                assert region["length"] == (one.length if one.length <= reach else None)
                assert region["length_determined"] == (one.length <= reach)
    assert set(flags) == {True, False}


def test_what_building_makes_of_the_error_is_told_with_its_unit():
    task = replace(read_task("case:ge2012-exact"), length_unit="mm")
    _, data, screen = synthesized(task, manufacturing_tolerance=0.01)
    best = data["linkages"][0]
    said = re.search(
        r"Built to ±0\.01 mm: position errors of up to (\S+) mm \(95 % of linkages\), at most "
        r"(\S+) mm, to first order\.",
        screen(),
    )
    assert said is not None
    # Driven once more, from dimensions that are off by as much.
    rng = np.random.default_rng(3)
    wanted = rows(data["task"]["poses"])
    poses = Displacement(wanted[:, :2], wanted[:, 2])
    pair, worst = [decoded(dyad) for dyad in best["dyads"]], []
    for _ in range(6):
        off = [
            RR(
                dyad.fixed_pivot + rng.uniform(-0.01, 0.01, 2),
                dyad.moving_pivot + rng.uniform(-0.01, 0.01, 2),
                dyad.radius + rng.uniform(-0.01, 0.01),
            )
            for dyad in pair
        ]
        length = data["length_per_radian"]
        worst.append(witness.misses(Linkage(*off), poses, length).max())
    most, bound = map(float, said.groups())
    assert most < bound
    assert bound == pytest.approx(best["tolerance"]["bound"], rel=0.05)
    assert most == pytest.approx(best["tolerance"]["max_95"], rel=0.05)
    # Angles count here as well, so these are a little more than positions alone.
    assert 0.2 * most < np.median(worst) < 2 * bound
    assert "passes every pose within 3.4e-05 mm and" in screen()
    assert "L1 in full, in mm" in screen()


def test_schema_asks_for_all_that_others_rely_on():
    for name, keys in CONTRACT.items():
        assert set(keys.split()) <= set(SCHEMA["$defs"][name]["required"])
    broken = synthesis_data(synthesize(read_task("case:motiongen-prpr")))
    for key in CONTRACT["linkage"].split():
        cut = json.loads(json.dumps(broken))
        del cut["linkages"][0][key]
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.Draft202012Validator(SCHEMA).validate(cut)


def test_sliders_travel_is_a_length_and_cranks_travel_an_angle(cases):
    _, data, _ = cases("motiongen-rrrp")
    best = data["linkages"][0]
    assert [dyad["kind"] for dyad in best["dyads"]] == ["RR", "PR"]
    at = rows(best["coupler"])
    crank, slider = best["dyads"]
    d, turn = at[:, 0] + 1j * at[:, 1], np.exp(1j * at[:, 2])
    normal = np.exp(1j * math.radians(slider["line"]["normal_deg"]))
    along = (np.conj(normal) * (d + turn * complex(*slider["moving_pivot"]))).imag
    low, high = best["drives"]["second"]["travel"]
    assert low <= along.min() + 1e-9
    assert high >= along.max() - 1e-9
    assert high - low < 1.3 * np.ptp(along)
    swung = np.angle(d + turn * complex(*crank["moving_pivot"]) - complex(*crank["fixed_pivot"]))
    first, last = best["drives"]["first"]["travel_deg"]
    swung = first + np.mod(np.degrees(swung) - first + 1e-6, 360) - 1e-6
    assert (swung <= last + 1e-6).all()
    assert [swung.min(), swung.max()] == pytest.approx([first, last], abs=1e-6)


def test_names_of_poses_are_used_in_what_is_said():
    task = read_task("case:motiongen-mixed5")
    named = Task(task.poses, names=("a", "b", "c", "d", "e"), resolution=task.resolution)
    _, data, screen = synthesized(named)
    assert "locks between poses c and d" in screen()
    closest = min(data["linkages"], key=lambda each: each["position_error"]["max"])
    assert closest["defects"][0]["poses"] == [3, 4]


ASKED_IN_VAIN = Requirements(transmission_deg=89.9, types=frozenset({"crank-rocker"}))


def test_failures_and_units_fit_the_screen_as_well(tmp_path):
    file = tmp_path / "small.csv"
    file.write_text(small_turn())
    base = read_task("case:ge2012-exact")
    for task in (
        read_task(str(file)),
        replace(base, length_unit="mm", requirements=ASKED_IN_VAIN),
        Task(Displacement(np.random.default_rng(1).normal(size=(8, 2)) * 1e10, np.arange(8.0))),
    ):
        _, data, screen = synthesized(task)
        for width in (60, 80, 200):
            _failure_fits(data, screen(width), width)


def _failure_fits(data, text, width):
    """What is said of a synthesis fits the screen, and nothing of it is lost."""
    works = any(each["usable"] for each in data["linkages"])
    code = data["outcome"]["code"]
    assert text.startswith("L1, " if works else f"result[{code}]: ")
    assert max(map(len, text.splitlines())) <= width
    assert "…" not in text
    unusable = [each for each in data["linkages"] if not each["usable"]]
    if not works:
        assert " ".join(data["outcome"]["help"].split()) in " ".join(text.split())
        # The nearest three stand above the others, with their reasons.
        nearest = sorted(unusable, key=lambda each: each["position_error"]["max"])[:3]
        above = text.split("\nNot usable either")[0]
        for each in nearest:
            assert re.search(rf"^{each['id']} +{each['type']}", above, re.MULTILINE)


def test_another_type_within_the_uncertainty_is_told_beside_the_type():
    """Poses of three decimals of a four-bar whose Grashof sums differ by a thousandth."""
    dyads = RR([0, 0], [0, 0], 1.0), RR([3.0, 0], [2.3, 0], 1.699)
    z, phi = (each[0] for each in witness.places(*dyads, np.linspace(0.4, 2.2, 9)))
    rows = np.column_stack([z.real, z.imag, phi]).round(3)
    requirements = Requirements(types=frozenset({"triple-rocker", "crank-rocker"}))
    task = Task(Displacement.from_poses(rows), resolution=(5e-4, 5e-4), requirements=requirements)
    synthesis, data, screen = synthesized(task)
    best = next(each for each in synthesis.usable if each.other_types)
    first = next(each for each in data["linkages"] if each["id"] == best.id)
    g, a, h, b = (first["links"][name] for name in ("ground", "driver", "coupler", "follower"))
    own = (
        "triple-rocker"
        if 2 * (max(g, a, h, b) + min(g, a, h, b)) > g + a + h + b
        else "crank-rocker"
    )
    (other,) = {"triple-rocker", "crank-rocker"} - {own}
    assert first["type"] == own
    assert first["possible_types"] == [own, other]
    text = screen()
    doubt = f"could be a {other} within ±"
    assert type_doubt(synthesis, best) == doubt
    assert f"{best.id} {own} ±" in " ".join(text.split())
    top = synthesis.usable[0]  # the best within the digits may be far from another type
    assert ("could be" in text.split("driven by")[0]) == bool(top.other_types)
    page = report_data(synthesis)
    shown = next(each for each in page["linkages"] if each["id"] == best.id)
    assert f"{best.id} is a {own}, and {doubt}." in shown["said"]["notes"]
    # Sharper poses leave no doubt, and none is told.
    exact = np.column_stack([z.real, z.imag, phi])
    _sharp, data, screen = synthesized(
        replace(task, poses=Displacement.from_poses(exact), resolution=(0.0, 0.0))
    )
    assert data["linkages"][0]["possible_types"] == ["triple-rocker"]
    assert "could be" not in screen()


def test_rounded_dimensions_leave_no_type_open():
    dyads = RR([0, 0], [0, 0], 1.0), RR([3.0, 0], [2.3, 0], 1.69)
    z, phi = (each[0] for each in witness.places(*dyads, np.linspace(0.4, 2.2, 9)))
    rows = np.column_stack([z.real, z.imag, phi]).round(2)
    task = Task(Displacement.from_poses(rows), resolution=(5e-3, 5e-3))
    _, data, _ = synthesized(task)
    assert any(len(each["possible_types"]) > 1 for each in data["linkages"])
    _, data, _ = synthesized(task, rounding_step=0.01)
    assert all(len(each["possible_types"]) == 1 for each in data["linkages"] if "rounded" in each)
    assert any("rounded" in each for each in data["linkages"])


def test_three_poses_are_answered_on_25_lines():
    """On a screen of 80 columns; what is left out is told with --verbose, and named."""
    synthesis, _, screen = synthesized(
        Task.from_rows([[0, 0, 0], [3, 1, 30], [5, 3, 60]], angle_unit="deg")
    )
    short = screen(80, whole=False).rstrip().splitlines()
    assert len(short) <= 25
    whole = " ".join(screen(80).split())
    for words in ("Recommended is", "Smallest: ", "sens.: the position error at a pose"):
        assert words in whole
        assert words not in " ".join(short)
    assert "how to read this: --verbose." in " ".join(short)
    assert len(synthesis.usable) > 4
