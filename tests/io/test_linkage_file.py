"""A linkage from a file: results, exports, and two dyads as a person writes them."""

import json

import numpy as np
import pytest

import burmester
from burmester import PR, RP, RR, InputError
from burmester.io.linkage_file import read_linkage
from burmester.synthesis.given_linkage import OpenLink

PIVOTS = """\
length_unit = "mm"

[[dyads]]
fixed_pivot = [100, -68]
moving_pivot = [53, -47]

[[dyads]]
fixed_pivot = [12, -17]
moving_pivot = [80, -17]
length = 68
"""
PLAIN = [
    {"fixed_pivot": [0, 0], "moving_pivot": [1, 2]},
    {"fixed_pivot": [5, 0], "moving_pivot": [3, 2], "radius": 2.5},
]


@pytest.fixture(scope="module")
def result():
    return burmester.synthesize(burmester.read_task("case:motiongen-rrpr"))


def agree(one, other):
    (kind, *numbers), (other_kind, *others) = dimensions(one), dimensions(other)
    assert kind == other_kind
    assert numbers == pytest.approx(others, rel=1e-12)


def dimensions(dyad):
    parts = [np.ravel(getattr(dyad, name)) for name in type(dyad).__slots__]
    return [type(dyad).__name__, *np.concatenate(parts).tolist()]


def test_pivots_as_a_person_writes_them(tmp_path):
    file = tmp_path / "lid.toml"
    file.write_text(PIVOTS)
    first, second = read_linkage(file)
    assert isinstance(first, OpenLink)
    assert (first.fixed_pivot.tolist(), first.moving_pivot.tolist()) == ([100, -68], [53, -47])
    assert isinstance(second, RR)
    assert float(second.radius) == 68
    file = tmp_path / "lid.json"
    file.write_text(json.dumps({"dyads": PLAIN, "poses": [[1, 2, 3]], "remark": "mine"}))
    first, second = read_linkage(file, unit="mm")
    assert float(second.radius) == 2.5


def test_lines_in_both_forms(tmp_path):
    file = tmp_path / "slide.json"
    point = {"point": [1.0, 2.0], "direction_deg": 30.0}
    angle = np.radians(120)
    normal = {"normal_deg": 120.0, "offset": np.cos(angle) + 2 * np.sin(angle)}
    read = []
    for line in (point, normal):
        dyads = {"line": line, "moving_pivot": [3, 4]}, {"line": line, "fixed_pivot": [5, 6]}
        file.write_text(json.dumps({"dyads": dyads}))
        read.append(read_linkage(file))
    for slider, slot in read:
        assert isinstance(slider, PR)
        assert isinstance(slot, RP)
        assert slider.moving_pivot.tolist() == [3, 4]
        assert slot.fixed_pivot.tolist() == [5, 6]
    for one, other in zip(*read, strict=True):
        assert float(one.normal_angle) == pytest.approx(float(other.normal_angle), abs=1e-15)
        assert float(one.offset) == pytest.approx(float(other.offset), abs=1e-15)
        # The point is on the line, and one step along the direction is, too.
        n = np.array([np.cos(one.normal_angle), np.sin(one.normal_angle)])
        ahead = np.array([np.cos(np.pi / 6), np.sin(np.pi / 6)])
        for step in (0, 7):
            assert n @ (np.array([1, 2]) + step * ahead) == pytest.approx(float(one.offset))


def test_every_linkage_of_a_result_by_its_id(result, tmp_path):
    file = result.save(tmp_path / "result.json")
    for found in result:
        read = read_linkage(file, found.id.lower())
        for one, other in ((found.linkage.first, read.first), (found.linkage.second, read.second)):
            agree(one, other)
    agree(read_linkage(file).first, result.best.linkage.first)
    with pytest.raises(InputError) as caught:
        read_linkage(file, "L99")
    assert (caught.value.code, caught.value.help) == ("E151", "give --id L1")


def test_an_export_holds_the_linkage(result, tmp_path):
    file = result.export(tmp_path / "one.json", "L2")
    first, second = read_linkage(file, "L2")
    led = result["L2"].driver_first
    for one, other in ((led.first, first), (led.second, second)):
        agree(one, other)
    with pytest.raises(InputError) as caught:
        read_linkage(file, "L1")
    assert caught.value.code == "E151"


@pytest.mark.parametrize(
    ("name", "text", "code", "told"),
    [
        ("a.json", "{", "E109", "this is not JSON"),
        ("a.toml", "[[dyads]", "E109", "this is not TOML"),
        ("a.dxf", "0\nSECTION\n", "E156", "it is neither JSON nor TOML"),
        ("a.toml", "", "E156", "it has nothing, and no list of dyads"),
        ("a.json", "[1, 2]", "E156", "it is [1, 2], not an object with dyads"),
        ("a.json", '{"dyads": [1, 2]}', "E156", "no list of dyads"),
        ("a.json", json.dumps({"dyads": PLAIN[:1]}), "E156", "it has 1 dyads"),
        ("a.json", json.dumps({"dyads": PLAIN * 2}), "E156", "it has 4 dyads"),
        ("a.toml", PIVOTS.replace("mm", "in"), "E156", "the linkage is in in"),
        ("a.toml", PIVOTS.replace("moving", "movin"), "E156", "dyads[0].movin_pivot is not known"),
        ("a.toml", PIVOTS.replace("moving_pivot = [53, -47]\n", ""), "E156", "it has fixed_pivot"),
        (
            "a.toml",
            PIVOTS.replace("[53, -47]", "[53]"),
            "E156",
            "moving_pivot is no point",
        ),
        ("a.toml", PIVOTS.replace("-47", "nan"), "E156", "dyads[0].moving_pivot[1] is no finite"),
        ("a.toml", PIVOTS.replace("-47", "true"), "E156", "it is True"),
        ("a.toml", PIVOTS.replace("-47", '"3"'), "E156", "it is '3'"),
        ("a.toml", PIVOTS.replace("length = 68", "length = -68"), "E156", "dyads[1].length is -68"),
        ("a.toml", PIVOTS + "radius = 68\n", "E156", "has a length and a radius"),
        ("a.toml", PIVOTS + 'kind = "PR"\n', "E156", "is of kind 'PR'"),
        ("a.toml", PIVOTS + "line = 3\n", "E156", "dyads[1] is no dyad"),
        ("a.json", '{"dyads": [{"line": 3, "moving_pivot": [1, 2]}, {}]}', "E156", "is no line"),
        ("a.json", '{"schema": "burmester.synthesis/1"}', "E150", "has no task"),
    ],
)
def test_other_files_are_refused(tmp_path, name, text, code, told):
    file = tmp_path / name
    file.write_text(text)
    with pytest.raises(InputError) as caught:
        read_linkage(file, unit="mm")
    error = caught.value
    assert error.code == code
    assert told in f"{error.message}; {error.why}"
    assert error.where == str(file)
    assert error.help


def test_no_bytes_break_the_reader(tmp_path, result):
    rng = np.random.default_rng(5)
    codes = set()
    texts = [PIVOTS.encode(), json.dumps({"dyads": PLAIN}).encode(), result.to_json().encode()]
    for k in range(300):
        data = bytearray(texts[k % 2 if k % 10 else 2])
        for _ in range(int(rng.integers(1, 5))):
            at = int(rng.integers(len(data)))
            data[at] = rng.integers(32, 127) if rng.uniform() < 0.9 else rng.integers(256)
        file = tmp_path / ("a.json" if k % 3 else "a.toml")
        file.write_bytes(bytes(data))
        code = None
        try:
            read_linkage(file)
        except InputError as error:
            code = error.code
        codes.add(code)
    assert {None, "E109", "E156"} <= codes
