"""STEP and STL, read back: OCC's own solids, a reader of triangles of our own, and complex numbers.

Where holes belong is told by the dyads and the pose, drawn by hand here; no code of the export is
asked.
"""

import math
import struct
from collections import Counter
from dataclasses import replace
from importlib import import_module
from importlib.util import find_spec
from itertools import combinations
from types import SimpleNamespace

import numpy as np
import pytest

from burmester.errors import BurmesterError, InputError
from burmester.export.options import Options
from burmester.export.parts.plates import assembly_of
from burmester.export.solids import solid
from burmester.export.solids.solid import read_stl, shells_of
from burmester.fourbar.dyad import PP, PR, RP, RR
from burmester.fourbar.linkage import Linkage
from tests.oracles import witness
from tests.oracles.handed_over import found
from tests.oracles.saved_linkages import PAPER, paper, saved

pytestmark = pytest.mark.skipif(find_spec("build123d") is None, reason="solids need build123d")


class _Cad:
    """build123d, which takes seconds to import, for who uses it."""

    def __getattr__(self, name):
        if name.startswith("_"):  # what pytest asks of all that a module has
            raise AttributeError(name)
        return getattr(import_module("build123d"), name)


cad = _Cad()

POSE = 4
HOLE, WIDTH, THICK, GAP = 6.0, 14.0, 5.0, 1.0
OPTIONS = Options(hole=HOLE, width=WIDTH, thickness=THICK, gap=GAP, pose=POSE)
ASSEMBLED = replace(OPTIONS, assembled=True)


def with_slider(kind):
    """A crank of 40 mm and a slider: poses of a third of its turn."""
    first = RR([0, 0], [20.0, -10], 40.0)
    second = PR(1.2, -30.0, [150.0, 20]) if kind is PR else RP([130.0, 15], 1.4, 12.0)
    where, phi = witness.places(first, second, np.linspace(0.3, 2.5, 5))
    rows = np.column_stack([where[0].real, where[0].imag, phi[0]])
    return saved(first, second, rows, unit="mm")


def paper_in_mm():
    """The paper's linkage, 20 mm to its unit."""
    dyads = [RR(20 * d.fixed_pivot, 20 * d.moving_pivot, 20 * d.radius) for d in PAPER]
    poses = paper().task.poses
    rows = np.column_stack([20 * poses.translation, poses.angle])
    return saved(*dyads, rows, unit="mm")


LINKAGES = {"RR": paper_in_mm, "PR": lambda: with_slider(PR), "RP": lambda: with_slider(RP)}


@pytest.fixture(scope="module", params=LINKAGES)
def made(request, tmp_path_factory):
    """What is written of one linkage, and how it reads."""
    chosen, folder = LINKAGES[request.param](), tmp_path_factory.mktemp("solid")
    step, stl, flat = folder / "a.step", folder / "a.stl", folder / "b.stl"
    solid.write_step(chosen, step, OPTIONS)
    solid.write_stl(chosen, stl, ASSEMBLED)
    solid.write_stl(chosen, flat, OPTIONS)
    whole = cad.import_step(str(step))
    parts = {each.label: each for each in whole.children}
    return SimpleNamespace(chosen=chosen, step=step, stl=stl, flat=flat, whole=whole, parts=parts)


def pivots(chosen):
    """By plate, the holes (x + iy) and the slots (normal as a complex number, offset), in mm."""
    poses = chosen.error.places
    d = complex(*poses.translation[POSE - 1])
    turn = np.exp(1j * poses.angle[POSE - 1])
    holes = {"ground": [], "coupler": []}
    slots = {"ground": [], "coupler": []}
    dyads = (chosen.linkage.first, chosen.linkage.second)
    for dyad, name in zip(dyads, ("driver", "follower"), strict=True):
        if not isinstance(dyad, PR):
            holes["ground"].append(complex(*dyad.fixed_pivot))
        if not isinstance(dyad, RP):
            pin = d + turn * complex(*dyad.moving_pivot)
            holes["coupler"].append(pin)
        if isinstance(dyad, RR):
            holes[name] = [complex(*dyad.fixed_pivot), pin]
        if isinstance(dyad, PR):
            slots["ground"].append((np.exp(1j * dyad.normal_angle), float(dyad.offset)))
        if isinstance(dyad, RP):
            n = turn * np.exp(1j * dyad.normal_angle)
            slots["coupler"].append((n, float(dyad.offset) + (n.conjugate() * d).real))
    return holes, slots


def plates_of(parts):
    """Without pins; a second ground plate is ground, too."""
    return {name: part for name, part in parts.items() if not name.startswith("pin")}


def hollows(part):
    """Axes of cylinders of the hole's radius, as OCC tells them: x + iy at z = 0."""
    found = []
    for face in part.faces().filter_by(cad.GeomType.CYLINDER):
        if abs(face.radius - HOLE / 2) < 1e-9:
            axis = face.axis_of_rotation
            assert abs(abs(axis.direction.Z) - 1) < 1e-12
            found.append(complex(axis.position.X, axis.position.Y))
    return np.array(found)


def grounds(parts):
    return [part for name, part in parts.items() if name.startswith("ground")]


def test_step_has_its_parts_by_name(made):
    links = [isinstance(d, RR) for d in (made.chosen.linkage.first, made.chosen.linkage.second)]
    wanted = {
        "ground",
        "coupler",
        *(n for n, k in zip(("driver", "follower"), links, strict=True) if k),
    }
    assert set(plates_of(made.parts)) - {"ground-2"} == wanted
    assert sum(name.startswith("pin") for name in made.parts) == 2 + sum(links)
    assert made.whole.label.replace("_", " ") == f"L1 {made.chosen.type}"
    colours = {name: tuple(part.color) for name, part in plates_of(made.parts).items()}
    assert len(set(colours.values())) == len(wanted)


def test_step_has_every_hole_at_its_pivot_and_no_other(made):
    holes, slots = pivots(made.chosen)
    span = np.ptp(np.array([h.real for each in holes.values() for h in each]))
    for name, wanted in holes.items():
        part = grounds(made.parts) if name == "ground" else [made.parts[name]]
        axes = np.concatenate([hollows(each) for each in part])
        away = abs(axes[:, None] - np.array(wanted))
        assert (away.min(axis=0) <= 1e-9 * span).all()
        rest = axes[away.min(axis=1) > 1e-9 * span]
        lines = slots.get(name, [])
        # A hole is one or two faces, a slot's two ends are the rest.
        assert (len(rest) > 0) == bool(lines)
        for n, offset in lines:
            assert abs((np.conj(n) * rest).real - offset).max() <= 1e-9 * span


def bare_area(name, plate):
    """By Steiner's formula for all within a radius of a convex polygon, less what is cut."""
    corners = plate.skeleton @ [1, 1j]
    sides = np.roll(corners, -1) - corners
    inside = (np.conj(corners) * np.roll(corners, -1)).imag.sum() / 2
    r = WIDTH / 2
    round_it = abs(sides).sum() if len(corners) > 1 else 0.0
    area = inside + round_it * r + math.pi * r * r
    for x1, y1, x2, y2, width in plate.slots:
        area -= math.hypot(x2 - x1, y2 - y1) * width + math.pi * width**2 / 4
    return area - len(plate.holes) * math.pi * HOLE**2 / 4


def test_volumes_are_area_times_thickness(made):
    assembly = assembly_of(made.chosen, OPTIONS)
    for plate in assembly.plates:
        part = made.parts[plate.name]
        assert part.volume == pytest.approx(THICK * bare_area(plate.name, plate), rel=1e-9)
        box = part.bounding_box()
        assert pytest.approx(plate.layer * (THICK + GAP), abs=1e-6) == box.min.Z
        assert pytest.approx(THICK, abs=1e-6) == box.max.Z - box.min.Z


def moved_to(parts, chosen, drive):
    """The parts moved from the drawn pose to where the witness has the linkage."""
    first, second = chosen.linkage.first, chosen.linkage.second
    now = complex(*chosen.error.places.translation[POSE - 1])
    turn = float(chosen.error.places.angle[POSE - 1])
    where, phi = witness.places(first, second, np.array([drive]))
    side = 1 if isinstance(second, RR) else 0
    then, to = complex(where[side][0]), float(phi[side][0])

    def coupler(z):
        return then + np.exp(1j * (to - turn)) * (z - now)

    motion = {"coupler": (coupler(0), to - turn)}
    for dyad, name in ((first, "driver"), (second, "follower")):
        if isinstance(dyad, RR):
            pivot = complex(*dyad.fixed_pivot)
            pins = [
                d + np.exp(1j * a) * complex(*dyad.moving_pivot) - pivot
                for d, a in ((now, turn), (then, to))
            ]
            by = np.angle(pins[1] / pins[0])
            motion[name] = (pivot - np.exp(1j * by) * pivot, by)
    out = {}
    fixed = [complex(*d.fixed_pivot) for d in (first, second) if not isinstance(d, PR)]
    for name, part in parts.items():
        if name.startswith("ground"):
            out[name] = part
        elif name.startswith("pin"):
            box = part.bounding_box()
            at = complex(box.center().X, box.center().Y)
            there = at if min(abs(at - f) for f in fixed) < 1e-6 else coupler(at)
            out[name] = part.moved(cad.Location((there.real - at.real, there.imag - at.imag, 0)))
        else:
            shift, by = motion[name]
            out[name] = part.moved(
                cad.Location((shift.real, shift.imag, 0), (0, 0, math.degrees(by)))
            )
    return out


def test_nothing_collides_along_the_motion(made):
    chosen = made.chosen
    arm = [
        complex(*d) + np.exp(1j * a) * complex(*chosen.linkage.first.moving_pivot)
        for d, a in zip(chosen.error.places.translation, chosen.error.places.angle, strict=True)
    ]
    drives = np.unwrap(np.angle(np.array(arm) - complex(*chosen.linkage.first.fixed_pivot)))
    for drive in np.linspace(drives[0], drives[-1], 9):
        there = moved_to(made.parts, chosen, drive)
        boxes = {name: part.bounding_box() for name, part in there.items()}
        for one, two in combinations(there, 2):
            a, b = boxes[one], boxes[two]
            if min(a.max.Z, b.max.Z) - max(a.min.Z, b.min.Z) < 1e-6:
                continue
            common = there[one].intersect(there[two])
            volume = 0.0 if common is None else sum(each.volume for each in common)
            assert volume < 1e-3, (one, two, drive)


def test_pins_run_from_plate_to_plate(made):
    """Each pin goes right through two plates' holes, or a hole and a slot."""
    for name, pin in made.parts.items():
        if not name.startswith("pin"):
            continue
        box = pin.bounding_box()
        at = complex(box.center().X, box.center().Y)
        through = 0
        for part in plates_of(made.parts).values():
            own = part.bounding_box()
            if own.min.Z > box.min.Z - 1e-6 and own.max.Z < box.max.Z + 1e-6:
                # On the hole's axis, or between the ends of a slot.
                axes = hollows(part)
                if abs(axes - at).min() < 1e-6:
                    through += 1
                elif len(axes) > 1:
                    middle = cad.Vertex(at.real, at.imag, (own.min.Z + own.max.Z) / 2)
                    through += abs(part.distance_to(middle) - HOLE / 2) < 1e-6
        assert through == 2, name
        assert pytest.approx(0.98 * HOLE, abs=1e-4) == box.max.X - box.min.X


def triangles(path):
    """By the format's definition: 80 bytes, a count, and 50 bytes each."""
    data = path.read_bytes()
    (count,) = struct.unpack_from("<I", data, 80)
    assert len(data) == 84 + 50 * count
    return [struct.unpack_from("<12fH", data, 84 + 50 * k) for k in range(count)]


def test_stl_is_closed_and_its_normals_point_outwards(made):
    for path in (made.stl, made.flat):
        edges = Counter()
        volume = 0.0
        for row in triangles(path):
            corners = [row[3:6], row[6:9], row[9:12]]
            for k in range(3):
                edges[corners[k], corners[(k + 1) % 3]] += 1
            a, b, c = map(np.array, corners)
            cross = np.cross(b - a, c - a)
            volume += float(a @ np.cross(b, c)) / 6
            assert cross @ row[:3] > 0.99 * np.linalg.norm(cross)
        assert all(count == 1 and edges[b, a] == 1 for (a, b), count in edges.items())
        # Facets leave 0.13% of the radius off an arc, at most.
        assert volume == pytest.approx(sum(part.volume for part in made.parts.values()), rel=2e-3)


def test_stl_has_the_rims_of_the_holes_on_their_circles(made):
    corners = np.array([row[3:12] for row in triangles(made.stl)]).reshape(-1, 3)
    holes, _ = pivots(made.chosen)
    for z in holes["ground"] + holes["coupler"]:
        arm = corners[:, :2] @ [1, 1j] - z
        rim = arm[(abs(arm) > 0.99 * HOLE / 2) & (abs(arm) < 1.02 * HOLE / 2)]
        # Of both plates, bottom and top.
        assert abs(abs(rim) - HOLE / 2).max() < 1e-6 * abs(corners).max()
        around = np.sort(np.angle(rim[abs(rim) > 0]))
        steps = np.diff(np.append(around, around[0] + 2 * np.pi))
        assert steps.max() < 0.105  # so a chord is within 0.0014 radii of its arc
        assert abs(np.unique(np.round(rim, 4)).mean()) < 0.01 * HOLE


def test_flat_parts_lie_beside_each_other(made):
    shells = shells_of(read_stl(made.flat))
    volumes = sorted(part.volume for part in made.parts.values())
    found = sorted(
        float(np.einsum("ij,ij", np.cross(s[:, 0], s[:, 1]), s[:, 2])) / 6 for s in shells
    )
    np.testing.assert_allclose(found, volumes, rtol=5e-3)
    boxes = [s.reshape(-1, 3) for s in shells]
    assert all(abs(box[:, 2].min()) < 1e-9 for box in boxes)
    # From the corner on, two widths from each other.
    np.testing.assert_allclose(np.concatenate(boxes).min(axis=0), 0, atol=1e-3 * WIDTH)
    for one, two in combinations(boxes, 2):
        gap = np.maximum(one.min(axis=0) - two.max(axis=0), two.min(axis=0) - one.max(axis=0))
        assert gap[:2].max() > 1.99 * WIDTH


def ring(points, centre):
    """The vertices (n,), complex, of a hole's rim about a centre, each once."""
    arm = np.unique(points[:, :2] @ [1, 1j] - centre)
    return arm[abs(abs(arm) - HOLE / 2) < 0.02 * HOLE]


def middle_of(rim):
    """Where the perpendicular bisectors of the chords of a rim (n,) from its first vertex meet."""
    chord = rim[1:] - rim[0]
    left = np.column_stack([chord.real, chord.imag])
    right = (np.conj(chord) * (rim[1:] + rim[0])).real / 2
    return complex(*np.linalg.lstsq(left, right, rcond=None)[0])


def test_flat_links_have_their_holes_as_far_apart_as_they_are_long(made):
    shells = [each.reshape(-1, 3) for each in shells_of(read_stl(made.flat))]
    plates = [each for each in shells if abs(np.ptp(each[:, 2]) - THICK) < 1e-6]
    for dyad in (made.chosen.linkage.first, made.chosen.linkage.second):
        if not isinstance(dyad, RR):
            continue
        length = float(dyad.radius)
        fits = []
        for points in plates:
            low, high = points.min(axis=0), points.max(axis=0)
            middle = (low[1] + high[1]) / 2
            if abs(high[1] - low[1] - WIDTH) > 0.01 * WIDTH:
                continue
            ends = [complex(x, middle) for x in (low[0] + WIDTH / 2, high[0] - WIDTH / 2)]
            rims = [ring(points, end) for end in ends]
            if all(len(rim) > 30 for rim in rims):
                centres = [end + middle_of(rim) for end, rim in zip(ends, rims, strict=True)]
                fits.append(abs(centres[1] - centres[0]))
        assert min(abs(np.array(fits) - length)) < 1e-4


@pytest.mark.parametrize("what", ["turned", "moved"])
def test_flat_parts_that_lie_wrong_are_refused(made, tmp_path, what):
    """One plate turned by a tenth of a degree in its place, or a little into the table."""
    data = bytearray(made.flat.read_bytes())
    rows = np.frombuffer(data, dtype=np.uint8, offset=84).reshape(-1, 50)
    numbers = np.ascontiguousarray(rows[:, 12:48]).view("<f4").reshape(-1, 3, 3)
    first = len(shells_of(read_stl(made.flat))[0])
    part = numbers[:first].copy()
    if what == "turned":
        angle = math.radians(0.1)
        turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
        part[..., :2] = part[..., :2] @ turn
    else:
        part[..., 2] -= 0.01
    for k, triangle in enumerate(part):
        struct.pack_into("<9f", data, 84 + 50 * k + 12, *triangle.ravel())
    path = tmp_path / "x.stl"
    path.write_bytes(data)
    why = refused(solid.check_stl, made.chosen, path, OPTIONS)
    assert ("from its pivot" if what == "turned" else "z = 0") in why


def test_what_was_written_passes_its_own_check(made):
    solid.check_step(made.chosen, made.step, OPTIONS)
    solid.check_stl(made.chosen, made.stl, ASSEMBLED)
    solid.check_stl(made.chosen, made.flat, OPTIONS)


def refused(check, *args):
    with pytest.raises(BurmesterError) as caught:
        check(*args)
    assert caught.value.code == "E160"
    return caught.value.why


def test_another_pose_is_refused(made):
    other = replace(ASSEMBLED, pose=1)
    assert "from its pivot" in refused(solid.check_step, made.chosen, made.step, other)
    assert "from its pivot" in refused(solid.check_stl, made.chosen, made.stl, other)


def rewritten(made, path, change):
    """The STEP file with its parts changed, in their own assembly."""
    parts = {name: part.moved(cad.Location()) for name, part in made.parts.items()}
    change(parts)
    for name, part in parts.items():
        part.label = name
    cad.export_step(cad.Compound(label="L1", children=list(parts.values())), str(path))
    return path


@pytest.mark.parametrize("name", ["ground", "driver", "coupler"])
def test_a_part_that_is_moved_by_little_is_refused(made, tmp_path, name):
    def change(parts):
        parts[name] = parts[name].moved(cad.Location((1e-5, 1e-5, 0)))

    path = rewritten(made, tmp_path / "x.step", change)
    assert "from its pivot" in refused(solid.check_step, made.chosen, path, OPTIONS)


def test_parts_in_each_others_way_are_refused(made, tmp_path):
    def change(parts):
        low = parts["coupler"].bounding_box().min.Z
        parts["coupler"] = parts["coupler"].moved(cad.Location((0, 0, -low + 1)))

    path = rewritten(made, tmp_path / "x.step", change)
    assert "collide" in refused(solid.check_step, made.chosen, path, OPTIONS)


def test_a_missing_part_and_a_thicker_one_are_refused(made, tmp_path):
    path = rewritten(made, tmp_path / "x.step", lambda parts: parts.pop("pin-1"))
    assert "parts" in refused(solid.check_step, made.chosen, path, OPTIONS)

    def thicker(parts):
        parts["driver"] = parts["driver"].scale(1.001)

    path = rewritten(made, tmp_path / "y.step", thicker)
    assert "mm³" in refused(solid.check_step, made.chosen, path, OPTIONS)


def test_a_broken_stl_is_refused(made, tmp_path):
    data = made.stl.read_bytes()
    count = int.from_bytes(data[80:84], "little")
    path = tmp_path / "x.stl"
    path.write_bytes(data[:80] + (count - 1).to_bytes(4, "little") + data[84:-50])
    assert "closed" in refused(solid.check_stl, made.chosen, path, ASSEMBLED)
    path.write_bytes(data[:-1])
    assert "triangles" in refused(solid.check_stl, made.chosen, path, ASSEMBLED)
    # All of it a hundredth of a millimetre aside.
    rows = bytearray(data)
    for k in range(count):
        for corner in range(3):
            at = 84 + 50 * k + 12 + 12 * corner
            struct.pack_into("<f", rows, at, struct.unpack_from("<f", rows, at)[0] + 0.01)
    path.write_bytes(bytes(rows))
    assert "from its pivot" in refused(solid.check_stl, made.chosen, path, ASSEMBLED)


def test_plates_that_touch(made, tmp_path):
    chosen, options = made.chosen, Options(hole=HOLE, width=WIDTH, thickness=THICK, gap=0.0)
    path = tmp_path / "x.stl"
    for each in (options, replace(options, assembled=True)):
        solid.write_stl(chosen, path, each)
        solid.check_stl(chosen, path, each)


def test_inches_become_millimetres(tmp_path):
    poses = paper().task.poses
    rows = np.column_stack([poses.translation, poses.angle])
    chosen = saved(*PAPER, rows, unit="in")
    path = tmp_path / "x.step"
    solid.write_step(chosen, path, Options())
    solid.check_step(chosen, path, Options())
    driver = next(p for p in cad.import_step(str(path)).children if p.label == "driver")
    axes = {
        (round(f.axis_of_rotation.position.X, 9), round(f.axis_of_rotation.position.Y, 9))
        for f in driver.faces().filter_by(cad.GeomType.CYLINDER)
    }
    (a, b) = (complex(*each) for each in axes)
    assert abs(a - b) == pytest.approx(25.4 * PAPER[0].radius, abs=1e-8)


def test_a_body_that_only_translates_is_no_plates(tmp_path):
    chosen = paper()
    other = found(Linkage(PAPER[0], PP(0.0)), chosen.task, chosen.error, "L9")
    with pytest.raises(InputError) as caught:
        solid.write_step(other, tmp_path / "x.step", Options())
    assert caught.value.code == "E163"
