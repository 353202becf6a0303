"""Files made at random: what is taken is taken exactly, what is refused says why, nothing crashes.

The campaign with thousands of files is `benchmarks/fuzz_readers.py`; `scripts/fuzz` searches
over bytes.  What a file means is told by its maker (`fuzzed_files`) and by a second reader that
shares no code with the package (`plain_reader`).
"""

import json
import random
from decimal import Decimal

import pyarrow
import pyarrow.parquet
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from burmester.cli import main
from burmester.errors import InputError
from burmester.io.reading import option_text, specification_text
from burmester.io.reading.pose_table import Source
from burmester.io.reading.poses import read_task
from tests.oracles import fuzzed_files, plain_reader, recordings
from tests.oracles.file_verdicts import check_refusal, judged
from tests.oracles.fuzzed_files import File
from tests.oracles.plain_reader import Plain
from tests.samples import samples, share

LANGUAGES = ("csv", "json", "toml", "parquet")
SEEDS = st.randoms(use_true_random=False)
LENGTHS, ANGLES = st.floats(-1e50, 1e50), st.floats(-1e9, 1e9)


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    """Where a file may be written; its suffix is its own."""
    return tmp_path_factory.mktemp("fuzzed") / "poses"


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_sample_of_the_campaign(language, path):
    seeds = samples(400, 120)
    verdicts = [judged(fuzzed_files.any_file(language, seed), path) for seed in seeds]
    assert verdicts.count("exact") > 0.3 * len(seeds)
    assert verdicts.count("unsure") < 0.03 * len(seeds)


def test_dialects_of_many_countries_are_read_exactly(path):
    seeds = samples(400, 120)
    verdicts = [judged(fuzzed_files.any_file("dialects", seed), path) for seed in seeds]
    assert verdicts.count("exact") > 0.9 * len(seeds)
    assert set(verdicts) <= {"exact", "E104", "E112", "E122"}  # two ways, or beyond a double


def test_workbooks_are_read_exactly(path):
    seeds = samples(150, 60)
    verdicts = [judged(fuzzed_files.any_file("workbooks", seed), path) for seed in seeds]
    assert verdicts.count("exact") > 0.86 * len(seeds)
    assert set(verdicts) <= {"exact", "E104", "E112", "E122"}


def test_no_row_of_a_wrong_width_is_taken(path):
    verdicts = {
        (file.maker, judged(file, path))
        for file in (fuzzed_files.any_file("shapes", seed) for seed in samples(800, 250))
    }
    assert {verdict for _, verdict in verdicts} <= {"E104", "E106", "E107"}
    assert len({maker for maker, _ in verdicts}) == 11


@given(SEEDS)
def test_what_is_written_as_csv_is_read_back(path, rng):
    judged(fuzzed_files.csv_file(rng), path)


@pytest.mark.parametrize("language", ["json", "toml"])
@given(rng=SEEDS)
def test_what_is_written_as_a_tree_is_read_back(language, path, rng):
    assert judged(fuzzed_files.tree_file(rng, language), path) in ("exact", "E112")


@given(
    st.lists(st.tuples(LENGTHS, LENGTHS, ANGLES), min_size=3, max_size=6),
    st.sampled_from(["csv", "json", "toml"]),
    SEEDS,
)
def test_every_double_is_read_back(path, rows, language, rng):
    """As Python prints it; a decimal comma may need another number to prove it."""
    texts = [[repr(number) for number in row] for row in [*rows, (1.0, 0.0, 0.0)]]
    key = Plain([tuple(map(Decimal, row)) for row in texts], None, "rad", None, None, None)
    if language == "csv":
        sheet = fuzzed_files.Sheet(["x", "y", "angle_rad"], texts, rng.choice(",;\t|"), ".")
        data = fuzzed_files.write(rng, sheet)
    else:
        poses = [[fuzzed_files.Raw(text) for text in row] for row in texts]
        tree = fuzzed_files.Pairs([("angle_unit", "rad"), ("poses", poses)])
        data = fuzzed_files.document(tree, language, rng).encode()
    assert judged(File(data, f".{language}", {}, key, "doubles"), path) == "exact"


def sound(language, rng):
    if language == "recordings":
        write = rng.choice(
            (recordings.nexus, recordings.motive, recordings.trc, recordings.tracker)
        )
        text, options = write(*recordings.recording(12)), {"points": "M1,M2"}
        return File(text.encode(), ".csv", options, None, "recording")
    if language == "workbooks":
        return fuzzed_files.workbook_file(rng)
    return fuzzed_files.sound_file(language, rng)


@pytest.mark.parametrize("language", [*LANGUAGES, "workbooks", "recordings"])
@settings(max_examples=share(60))
@given(rng=SEEDS, at=st.integers(0, 3000), cut=st.integers(0, 40), new=st.binary(max_size=12))
def test_other_bytes_in_a_file_do_no_harm(language, path, *, rng, at, cut, new):
    file = sound(language, rng)
    at %= len(file.data) + 1
    data = file.data[:at] + new + file.data[at + cut :]
    judged(file._replace(data=data, key=None, maker="bytes"), path)


PIECES = [
    *fuzzed_files.STRANGE_WORDS,
    *fuzzed_files.KEYS,
    "\n",
    "\t",
    " ",
    "{",
    "}",
    "[",
    "]",
    "=",
    ":",
]
PIECES += ["x,y,angle_deg\n", "poses", "[[poses]]\n", '"poses"', "1", "-2.5", "sep=;\n", "[1,2,3],"]


@settings(max_examples=share(200))
@given(
    st.lists(st.sampled_from(PIECES), max_size=30), st.sampled_from([".csv", ".json", ".toml", ""])
)
def test_pieces_of_files_do_no_harm(path, pieces, suffix):
    data = "".join(pieces).encode("utf-8", "surrogatepass")
    judged(File(data, suffix, {"angle_unit": "deg"}, None, "pieces"), path)


DEEP = 20_000
MONSTERS = {
    "brackets.json": b"[" * DEEP,
    "closed.json": b"[" * DEEP + b"]" * DEEP,
    "objects.json": b'{"a":' * DEEP,
    "a deep number.json": b"[[1,2," + b"[" * 600 + b"]" * 600 + b"]]",
    "a deep point.json": b'[{"p":' + b"[" * 600 + b"]" * 600 + b',"q":[1,2]}]',
    "a deep limit.json": b'{"poses":[],"limits":' + b"[" * 600 + b"]" * 600 + b"}",
    "digits.json": b'{"angle_unit":"deg","poses":[[' + b"1" * DEEP + b",2,3]]}",
    "exponent.json": b"[[1e" + b"9" * DEEP + b",2,3]]",
    "escapes.json": b'["' + b'\\"' * DEEP + b'",NaN]',
    "brackets.toml": b"a=" + b"[" * DEEP,
    "tables.toml": b"a=" + b"{a=" * DEEP,
    "dots.toml": b"a." * 2000 + b"a=1",
    "digits.toml": b"a=" + b"1" * DEEP,
    "hex.toml": b'angle_unit="deg"\nposes=[[0x' + b"f" * DEEP + b",2,3]]",
    "quotes.csv": b"x,y,angle_deg\n" + b'"' * DEEP,
    "odd quotes.csv": b"x,y,angle_deg\n" + b'"a' * (DEEP + 1),
    "separators.csv": b"x,y,angle_deg\n" + b"," * DEEP,
    "header of separators.csv": b"," * DEEP + b"\n1,2,3\n",
    "header of names.csv": b"x,y,angle_deg" + b',"#"' * 1000 + b"\n1,2,3\n",
    "header of strangers.csv": b"x,y," + b"stranger," * 1000 + b"\n1,2,3\n",
    "digits.csv": b"x,y,angle_deg\n" + b"1" * DEEP + b",2,3\n",
    "exponent.csv": b"x,y,angle_deg\n1e" + b"9" * DEEP + b",2,3\n",
    "one commas.csv": b"x;y;angle_deg\n" + b"1,111" * DEEP + b";2;3\n",
    "blanks.csv": b"x,y,angle_deg\n" + b" \t" * DEEP + b"x",
    "empty.csv": b"",
    "mark.csv": b"\xef\xbb\xbf",
    "half.csv": b"\xff\xfe\x00",
    "magic.parquet": b"PAR1",
    "magic twice.parquet": b"PAR1PAR1",
}
LONG = 200_000  # what takes the square of this would take minutes
MONSTERS |= {
    "row of separators.csv": b"x,y,angle_deg\n1,2,3" + b"," * LONG + b"4",
    "lines of separators.csv": b",,\n" * (LONG // 3) + b"x,y,angle_deg\n1,2\n",
    "comments of separators.csv": b"#,;\t\n" * (LONG // 5),
    "long header of separators.csv": b"," * LONG + b"\n1,2,3\n",
    "long header of names.csv": b"x,y,angle_deg" + b',"#"' * (LONG // 4) + b"\n1,2,3\n",
    "a long name.csv": b"x,y,angle_deg," + b"a " * (LONG // 2) + b"\n1,2,3,4\n",
    "a long comment.csv": b"#x,y,angle_deg" + b",#n" * (LONG // 3) + b"\n1,2,3\n",
    "a long row of numbers.csv": b"1," * (LONG // 2) + b"1\n",
    "quoted row.csv": b'x,y,angle_deg\n"1","2","3"' + b',""' * (LONG // 3),
    "thousands.csv": b"x;y;angle_deg\n1" + b" 111" * (LONG // 4) + b";1;2",
    "long number and a unit.csv": b"x,y,angle_deg\n" + b"1" * 300 + b"mm,1,2",
    "long digits.csv": "x,y,angle_deg\n{},1,2".format("\u0661" * 300).encode(),
    "number and text.json": b"[" + b"1" * LONG + b"mm]",
    "nought and digits.json": b"[0" + b"1" * LONG + b",2]",
    "word.json": b"[" + b"a" * LONG + b"]",
    "open quote.json": b"[" * 2000 + b'"' + b'\\"' * (LONG // 2),
    "blank.json": b"[1" + b" " * LONG + b"2]",
    "empty poses.json": b'{"poses":[' + b",".join([b"{}"] * LONG) + b"]}",
    "numbers for poses.json": b"[" + b",".join([b"1"] * LONG) + b"]",
    "decimal comma.toml": b"a=[1" + b"," + b"1" * LONG,
    "many dots.toml": b"a." * (LONG // 2) + b"a=1",
    "many dots in a head.toml": b"[" + b"a." * (LONG // 2) + b"a]",
    "many dots in a table.toml": b"x={" + b'"a" . ' * (LONG // 6) + b"a=1}",
}


@pytest.mark.parametrize("name", MONSTERS)
def test_monsters_are_refused_in_few_words(name, path):
    path = path.with_suffix(f".{name.rpartition('.')[2]}")
    path.write_bytes(MONSTERS[name])
    with pytest.raises(InputError) as caught:  # the plain reader would take minutes for some
        read_task(path)
    check_refusal(caught.value)


@pytest.mark.parametrize("column", ["x", "name", "exact", "#note"])
def test_text_in_parquet_that_is_not_utf_8(column, path):
    damaged = pyarrow.array([b"\xc8\xff", b"1", b"2"])
    text = pyarrow.Array.from_buffers(pyarrow.string(), 3, damaged.buffers())
    columns = {name: [1.0, 2.0, 4.0] for name in ("x", "y", "angle_rad")} | {column: text}
    sink = pyarrow.BufferOutputStream()
    pyarrow.parquet.write_table(pyarrow.table(columns), sink)
    judged(File(sink.getvalue().to_pybytes(), ".parquet", {}, None, "damaged"), path)


TEXTS = st.one_of(
    st.text("0123456789.,:-+eE axlinebogpty\u0661", max_size=25),
    st.lists(st.sampled_from([*fuzzed_files.STRANGE_WORDS, ",", ":", "box:", "1", "any"])).map(
        "".join
    ),
    st.text(max_size=10),
)


@settings(max_examples=share(200))
@given(TEXTS)
def test_texts_of_options_are_taken_or_refused(text):
    """Every option of `synthesize` with a text of its own."""
    readers = [
        lambda: specification_text.limits_from_options(fixed_pivot=[text]).limits(),
        lambda: specification_text.limits_from_options(length=[text]).limits(),
        lambda: specification_text.limits_from_options(kinds=[text]).limits(),
        lambda: specification_text.requirements_from_options(min_transmission=text),
        lambda: specification_text.requirements_from_options(types=[text]),
        lambda: specification_text.requirements_from_options(footprint=text),
        lambda: specification_text.requirements_from_options(link_ratio=text),
        lambda: specification_text.requirements_from_options(within=text),
        lambda: specification_text.pose_sigma(text),
        lambda: option_text.lengths_from_texts("--stock", [text]),
        lambda: option_text.positive_from_text(Source("--round", text), text),
    ]
    for read in readers:
        try:
            read()
        except InputError as error:
            check_refusal(error)


def run(arguments, capsys):
    """The exit code of the command; it prints one object of JSON and no traceback."""
    with pytest.raises(SystemExit) as stop:
        main([*arguments, "--json"])
    out, err = capsys.readouterr()
    assert "Traceback" not in err
    assert isinstance(json.loads(out), dict)
    assert out.count("\n") == 1
    return stop.value.code


def test_the_command_answers_in_json(path, capsys, monkeypatch):
    """The search for linkages that work takes a second a file: it is left out."""
    monkeypatch.setattr("burmester.linkages.from_dyads.defect_free_linkages", lambda *_: None)
    monkeypatch.setattr("burmester.linkages.further_pairs.links_of_pivot_map", lambda *_: [])
    rng, codes = random.Random(5), set()
    for seed in samples(60, 20):
        file = fuzzed_files.any_file(rng.choice(LANGUAGES), seed)
        plain = plain_reader.read(file.data, file.suffix)
        numbers = [abs(n) for pose in plain.poses for n in pose] if plain else []
        if len(numbers) > 20 or any(n and not 1e-6 < n < 1e9 for n in numbers):
            continue
        poses = path.with_suffix(file.suffix)
        poses.write_bytes(file.data)
        unit = file.options.get("angle_unit")
        option = [f"--angle-unit={unit}"] if unit else []
        codes.add(run(["synthesize", str(poses), *option], capsys))
    assert {1, 2} <= codes <= {0, 1, 2}


def test_a_file_name_that_is_not_text_is_told(capsys):
    assert run(["synthesize", "no\udcffsuch.csv"], capsys) == 2
