"""The same bytes from a Dask cluster, over TCP, one of whose workers is killed on the way."""

import json
import os
import signal
import subprocess
import sys
import threading
import time

import pytest

from burmester import InputError
from burmester.batch import engines, run
from tests.oracles.batches import as_table, files_of, rows

distributed = pytest.importorskip("distributed")
pytestmark = [
    pytest.mark.skipif(os.name != "posix", reason="signals as POSIX has them"),
    # Of Dask's own, at the end of a cluster.
    pytest.mark.filterwarnings("ignore::ResourceWarning", "ignore::DeprecationWarning"),
]
TASKS = 40


@pytest.fixture(scope="module")
def cluster():
    with distributed.LocalCluster(
        n_workers=2,
        threads_per_worker=1,
        processes=True,
        protocol="tcp",
        dashboard_address=None,
        silence_logs=50,
    ) as started:
        yield started


def workers(cluster):
    """The processes of the workers, by their addresses."""
    with distributed.Client(cluster.scheduler_address, set_as_default=False) as client:
        return client.run(os.getpid)


def test_a_cluster_writes_the_same_bytes_though_a_worker_is_killed(cluster, tmp_path):
    (tmp_path / "tasks.csv").write_text(as_table(rows(TASKS, seed=6)))
    given = {"depth": "pencil", "part_tasks": 2}
    killed = []
    before = workers(cluster)

    def kill(progress):
        if progress.tasks and not killed:
            killed.append(min(before.values()))
            os.kill(killed[0], signal.SIGKILL)

    address = cluster.scheduler_address
    assert address.startswith("tcp://")
    summary = run(tmp_path / "tasks.csv", tmp_path / "out", dask=address, progress=kill, **given)
    assert (summary.complete, summary.tasks, len(killed)) == (True, TASKS, 1)
    assert killed[0] not in workers(cluster).values()
    run(tmp_path / "tasks.csv", tmp_path / "other", workers=1, **given)
    assert files_of(tmp_path / "out") == files_of(tmp_path / "other")
    assert not [each for each in threading.enumerate() if "burmester" in each.name]


def test_an_address_where_nobody_is_is_told(tmp_path):
    (tmp_path / "tasks.csv").write_text(as_table(rows(1)))
    with pytest.raises(InputError) as caught:
        run(tmp_path / "tasks.csv", tmp_path / "out", depth="pencil", dask="nowhere://host:1")
    assert caught.value.code == "E182"
    assert "nowhere://host:1" in caught.value.message


@pytest.fixture
def scheduler(tmp_path):
    """A scheduler and one worker, each a process of its own; the scheduler and its address."""
    file = tmp_path / "scheduler.json"
    dask = [sys.executable, "-m", "dask"]
    here = ["scheduler", "--host", "127.0.0.1", "--port", "0", "--scheduler-file", str(file)]
    begun = [subprocess.Popen([*dask, *here, "--no-dashboard"], stderr=subprocess.DEVNULL)]
    try:
        end = time.monotonic() + 60
        while not file.exists() or not file.read_text().endswith("}"):
            assert begun[0].poll() is None
            assert time.monotonic() < end
            time.sleep(0.05)
        address = json.loads(file.read_text())["address"]
        worker = ["worker", address, "--nthreads", "1", "--no-dashboard", "--no-nanny"]
        begun.append(subprocess.Popen([*dask, *worker], stderr=subprocess.DEVNULL))
        yield begun[0], address
    finally:
        for process in begun:
            process.kill()
            process.wait()


def test_a_scheduler_that_dies_is_told_and_the_batch_goes_on_without(
    scheduler, tmp_path, monkeypatch
):
    monkeypatch.setattr(engines, "CONNECT_S", 1.0)
    process, address = scheduler
    (tmp_path / "tasks.csv").write_text(as_table(rows(TASKS, seed=6)))
    out, given = tmp_path / "out", {"depth": "pencil", "part_tasks": 2}

    def kill(progress):
        if progress.tasks:
            process.kill()

    with pytest.raises(InputError) as caught:
        run(tmp_path / "tasks.csv", out, dask=address, progress=kill, **given)
    assert caught.value.code == "E182"
    assert caught.value.message == f"the cluster at {address} does not answer any more"
    assert "it goes on" in caught.value.help
    done = {name: data for name, data in files_of(out).items() if name.startswith("part-")}
    assert 0 < len(done) < TASKS // 2
    summary = run(tmp_path / "tasks.csv", out, workers=1, **given)
    assert (summary.complete, summary.tasks, summary.outcomes) == (True, TASKS, {"solved": TASKS})
    assert done.items() <= files_of(out).items()
