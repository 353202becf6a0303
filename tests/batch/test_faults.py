"""What may happen to a batch: its files stay whole, and going on ends with the same bytes."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pyarrow.parquet as pq
import pytest
from benchmarks.batch_kills import campaign, command, strays

from burmester import InputError
from burmester.batch import manifest as manifests
from burmester.batch import run
from burmester.batch.manifest import read_summary
from burmester.batch.out_folder import OutFolder
from tests.oracles.batches import PARTS, as_table, files_of, rows
from tests.samples import samples

pytestmark = pytest.mark.skipif(os.name != "posix", reason="signals as POSIX has them")
TASKS = 12
PARTS_OF_MANY = 80


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A batch that nothing happened to: the folder of the tasks, with OUT beside them."""
    folder = tmp_path_factory.mktemp("whole")
    (folder / "tasks.csv").write_text(as_table(rows(TASKS, seed=3)))
    again(folder)
    return folder


def again(folder, **settings):
    """The batch of a folder, begun or gone on with."""
    given = {"depth": "pencil", "part_tasks": 2, "workers": 1, **settings}
    return run(folder / "tasks.csv", folder / "out", **given)


@pytest.fixture
def copy(whole, tmp_path):
    """A folder to do harm to."""
    shutil.copytree(whole, tmp_path / "copy")
    return tmp_path / "copy"


def test_a_run_that_is_killed_goes_on_and_ends_with_the_same_bytes(tmp_path):
    """A sample of `benchmarks/batch_kills.py`, which kills two hundred times."""
    kills = len(samples(10, 4))
    found = campaign(kills, 20261123, tmp_path)
    assert found["kills"] == kills
    assert found["half files"] == found["other bytes"] == found["left behind"] == 0
    assert found["unfinished"] > 0


def nothing(out):
    pass


def parts(out):
    """One is cut off, a bit of one is turned, one is lost."""
    part = out / "part-000002.parquet"
    part.write_bytes(part.read_bytes()[:-9])
    part = out / "part-000003.parquet"
    data = bytearray(part.read_bytes())
    data[len(data) // 2] ^= 4
    part.write_bytes(data)
    (out / "part-000000.parquet").unlink()


def lines(out):
    """A bit of the first is turned, the last is torn."""
    data = bytearray((out / "_parts.jsonl").read_bytes())
    data[data.index(b'"bytes": ') + 9] ^= 1
    (out / "_parts.jsonl").write_bytes(data[:-40])


def empty_manifest(out):
    (out / "_manifest.json").write_bytes(b"")


def changed_manifest(out):
    text = (out / "_manifest.json").read_text()
    (out / "_manifest.json").write_text(text.replace('"tasks": 12', '"tasks": 13'))


def lost_manifest(out):
    (out / "_manifest.json").unlink()


def other_json(out):
    """Lines that are JSON, and no records; one is sealed."""
    good = (out / "_parts.jsonl").read_bytes().splitlines()
    forged = {"run": json.loads(good[0])["run"], "part": "0"}
    forged["seal"] = manifests.digest_of(forged)[:16]
    odd = [b"[]", b"1", b"null", b'"seal"', b'{"seal": 1}', b"[" * 9000, b"\0", b"\xff"]
    lines = [*good[2:], *odd, json.dumps(forged).encode()]
    (out / "_parts.jsonl").write_bytes(b"\n".join(lines))


def manifest_of_a_list(out):
    (out / "_manifest.json").write_bytes(b"[]")


def links(out):
    """Every file is a link to one elsewhere; one part leads to a part that is damaged."""
    there = out.parent / "there"
    out.rename(there)
    out.mkdir()
    for each in there.iterdir():
        (out / each.name).symlink_to(each)
    (there / ".lock").unlink()
    (out / ".lock").unlink()
    (there / "part-000001.parquet").write_bytes(b"precious")


def hard_links(out):
    for each in out.iterdir():
        os.link(each, out.parent / f"{each.name}.link")
    (out / "part-000001.parquet").write_bytes(b"precious")


def link_to_nothing(out):
    (out / "part-000001.parquet").unlink()
    (out / "part-000001.parquet").symlink_to("nowhere")


def leftovers(out):
    (out / ".burmester-0123456789abcdef-part-000001.parquet").write_bytes(b"half")


REDONE = "some parts were damaged or unfinished, and are done again"
ANEW = "the manifest was damaged, and is written anew"
DAMAGE = {
    nothing: (0, []),
    parts: (3, [REDONE]),
    lines: (2, [REDONE]),
    empty_manifest: (0, [ANEW]),
    changed_manifest: (0, [ANEW]),
    lost_manifest: (0, [ANEW]),
    leftovers: (0, []),
    other_json: (2, [REDONE]),
    manifest_of_a_list: (0, [ANEW]),
    links: (1, [REDONE]),
    hard_links: (1, [REDONE]),
    link_to_nothing: (1, [REDONE]),
}


@pytest.mark.parametrize("damage", DAMAGE, ids=lambda damage: damage.__name__)
def test_what_is_damaged_is_done_again_and_nothing_else(damage, copy, whole):
    times = {each.name: each.stat().st_mtime_ns for each in (copy / "out").glob(PARTS)}
    damage(copy / "out")
    summary = again(copy)
    redone, notes = DAMAGE[damage]
    assert list(summary.notes) == notes
    assert summary.complete
    assert files_of(copy / "out") == files_of(whole / "out")
    later = {each.name: each.stat().st_mtime_ns for each in (copy / "out").glob(PARTS)}
    assert sum(times[name] != later[name] for name in times) == redone


def contents(folder):
    return {each.name: each.read_bytes() for each in folder.iterdir()}


def test_what_links_in_the_folder_lead_to_stays(copy, whole):
    links(copy / "out")
    before = contents(copy / "there")
    again(copy)
    assert contents(copy / "there") == before
    assert files_of(copy / "out") == files_of(whole / "out")


def test_a_link_in_place_of_the_lock_is_refused(copy):
    (copy / "out" / ".lock").unlink()
    (copy / "out" / ".lock").symlink_to(copy / "made")
    assert "symbolic link" in refused("E141", again, copy).why
    assert not (copy / "made").exists()


@pytest.mark.parametrize("name", ["_manifest.json", "_parts.jsonl", "part-000001.parquet"])
def test_a_pipe_in_the_folder_is_refused_and_not_waited_for(copy, name):
    (copy / "out" / name).unlink()
    os.mkfifo(copy / "out" / name)
    assert "pipe" in refused("E141", again, copy).why


def test_strange_parts_of_a_complete_batch_are_named(copy):
    """A reader of Parquet folders would take them in; the parts alone are the batch."""
    names = ["part-000006.parquet", "part-1.parquet", "more.parquet", "part-\x1b[2J.parquet"]
    for name in [*names, "_own.parquet", "remarks.txt"]:
        (copy / "out" / name).write_bytes(b"")
    (note,) = again(copy).notes
    assert note == (
        r"more.parquet, part-\x1b[2J.parquet, part-000006.parquet and part-1.parquet are not of "
        "this batch; readers of the folder take it in: move it away"
    )
    assert read_summary(copy / "out").notes == (note,)


def refused(code, call, *arguments, **settings):
    with pytest.raises(InputError) as caught:
        call(*arguments, **settings)
    assert caught.value.code == code
    return caught.value


def test_another_batch_is_never_mixed_in(copy, whole, monkeypatch):
    before = files_of(whole / "out")
    error = refused("E180", again, copy, depth="dyads")
    assert error.why == 'depth is "pencil" there and "dyads" here'
    error = refused("E180", again, copy, part_tasks=3)
    assert error.why == "part_tasks is 2 there and 3 here"
    (copy / "options.toml").write_text('length_unit = "mm"\n')
    error = refused("E180", again, copy, options=copy / "options.toml")
    assert error.why == 'options.length_unit is null there and "mm" here'
    with monkeypatch.context() as patch:
        patch.setattr("burmester.batch.part_file.__version__", "0.2.0")
        error = refused("E180", again, copy)
        assert error.why == 'versions.burmester is "0.1.0" there and "0.2.0" here'
    text = (copy / "tasks.csv").read_text()
    (copy / "tasks.csv").write_text(text.replace("0", "1", 1))
    error = refused("E180", again, copy)
    assert error.why.startswith("tasks.sha256 is ")
    empty_manifest(copy / "out")
    refused("E180", again, copy)
    assert {**files_of(copy / "out"), "_manifest.json": b""} == {**before, "_manifest.json": b""}


def test_a_second_run_on_a_folder_is_refused(copy):
    with OutFolder(str(copy / "out")).held():
        error = refused("E181", again, copy)
    assert error.where == str(copy / "out")
    assert again(copy).complete


def test_parts_of_somebody_else_are_left_alone(copy):
    for name in ("_manifest.json", "_parts.jsonl"):
        (copy / "out" / name).unlink()
    before = files_of(copy / "out")
    assert "delete these parts" in refused("E140", again, copy).help
    assert files_of(copy / "out") == before


def test_a_directory_in_the_way_is_told_with_its_path(copy):
    out = copy / "out"
    before = files_of(out)
    (out / "part-000004.parquet").unlink()
    (out / "part-000004.parquet").mkdir()
    error = refused("E141", again, copy)
    assert "part-000004.parquet cannot be written" in error.message
    assert error.why == "it is a folder"
    (out / "part-000004.parquet").rmdir()
    kept = {name: data for name, data in before.items() if name != "part-000004.parquet"}
    assert {name: data for name, data in files_of(out).items() if name in kept} != {}
    assert again(copy).complete
    assert files_of(out) == before
    (copy / "file").write_text("")
    for place in (copy / "file", copy / "file" / "out"):
        error = refused("E141", run, copy / "tasks.csv", place, depth="pencil")
        assert "file" in f"{error.message} {error.why}"


@pytest.mark.skipif(sys.platform != "linux" or os.geteuid() != 0, reason="only root can mount")
def test_a_full_and_a_read_only_disk(copy, whole, tmp_path):
    disk = tmp_path / "disk"
    disk.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=160k", "tmpfs", str(disk)]
    if subprocess.run(mount, capture_output=True, check=False).returncode:
        pytest.skip("no disk can be mounted here")
    arguments = ["--depth", "pencil", "--part-tasks", "2", "--workers", "1"]
    try:
        (disk / "filler").write_bytes(bytes(100_000))
        process = subprocess.run(
            command(copy / "tasks.csv", disk / "out", *arguments),
            capture_output=True,
            text=True,
            check=False,
            timeout=60,
        )
        assert process.returncode == 2
        assert "error[E141]" in process.stderr
        assert "No space left on device" in process.stderr
        assert str(disk / "out") in process.stderr
        there = {name for name in files_of(disk / "out") if name.endswith(".parquet")}
        assert there
        for name in there:
            assert (disk / "out" / name).read_bytes() == (whole / "out" / name).read_bytes()
        (disk / "filler").unlink()
        subprocess.run(["mount", "-o", "remount,ro", str(disk)], check=True)
        error = refused("E141", run, copy / "tasks.csv", disk / "out", depth="pencil")
        assert "Read-only file system" in error.why
        subprocess.run(["mount", "-o", "remount,rw", str(disk)], check=True)
        run(copy / "tasks.csv", disk / "out", depth="pencil", part_tasks=2, workers=1)
        assert files_of(disk / "out") == files_of(whole / "out")
    finally:
        subprocess.run(["umount", str(disk)], check=True)


def begun(folder, out, *arguments):
    """A run that has written a part and is not done."""
    (folder / "many.csv").write_text(as_table(rows(PARTS_OF_MANY, seed=4)))
    process = subprocess.Popen(
        command(folder / "many.csv", out, "--depth", "pencil", "--part-tasks", "1", *arguments),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    while not list(Path(out).glob(PARTS)):
        assert process.poll() is None, process.stderr.read()
        time.sleep(0.02)
    return process


def test_ctrl_c_finishes_what_runs_and_says_how_to_go_on(tmp_path):
    process = begun(tmp_path, tmp_path / "out", "--workers", "2", "--json")
    os.killpg(process.pid, signal.SIGINT)  # as a terminal does: to all processes of the group
    said, told = process.communicate(timeout=120)
    assert process.returncode == 130
    assert "the same command goes on" in told
    assert "Traceback" not in told
    done = manifests.read_sealed(
        (tmp_path / "out" / "_manifest.json").read_bytes(), manifests.OF_MANIFEST
    )
    parts = sorted((tmp_path / "out").glob(PARTS))
    assert done["parts"] == len(parts) < PARTS_OF_MANY
    assert not done["complete"]
    assert f'"parts": {len(parts)}' in said
    assert sum(pq.read_metadata(each).num_rows for each in parts) == done["tasks"]
    assert strays(tmp_path / "out") == []


def test_ctrl_c_twice_stops_at_once():
    process = subprocess.Popen(
        [sys.executable, "-m", "tests.oracles.slow_batch"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    workers = {int(process.stdout.readline()) for _ in range(2)}
    os.killpg(process.pid, signal.SIGINT)
    time.sleep(0.5)
    assert process.poll() is None  # it waits for what runs
    os.killpg(process.pid, signal.SIGINT)
    _, told = process.communicate(timeout=50)  # not the minute that the parts take
    assert process.returncode == 130, told
    gone(workers)


def children_of(process):
    """The processes that a process has started."""
    lists = Path(f"/proc/{process.pid}/task").glob("*/children")  # of each thread
    return [child for each in lists for child in each.read_text().split()]


def gone(numbers):
    """Wait until processes have ended; they need seconds for it, and more on a busy machine."""
    until = time.monotonic() + 60
    while any(Path(f"/proc/{each}").exists() for each in numbers):
        assert time.monotonic() < until, "a worker was left behind"
        time.sleep(0.05)


@pytest.mark.skipif(sys.platform != "linux", reason="looks for processes where Linux lists them")
def test_workers_end_with_a_run_that_is_killed(tmp_path):
    process = begun(tmp_path, tmp_path / "out", "--workers", "2")
    children = children_of(process)
    assert len(children) >= 2
    process.kill()
    process.communicate(timeout=120)  # the workers hold its streams as well
    gone(children)


@pytest.mark.skipif(sys.platform != "linux", reason="looks for processes where Linux lists them")
def test_a_worker_that_somebody_kills_changes_nothing(tmp_path):
    process = begun(tmp_path, tmp_path / "out", "--workers", "2")
    for child in map(int, children_of(process)):
        if b"spawn_main" in Path(f"/proc/{child}/cmdline").read_bytes():
            os.kill(child, signal.SIGKILL)
            break
    _, told = process.communicate(timeout=120)
    assert process.returncode == 0, told
    run(tmp_path / "many.csv", tmp_path / "other", depth="pencil", part_tasks=1, workers=1)
    assert files_of(tmp_path / "out") == files_of(tmp_path / "other")
