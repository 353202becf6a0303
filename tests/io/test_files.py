"""Files are there whole or not at all, whatever happens while they are written."""

from __future__ import annotations

import os
import re
import signal
import stat
import subprocess
import sys
import tempfile
import textwrap
import threading
import time
import zipfile
from contextlib import suppress
from pathlib import Path

import pytest

from burmester.errors import InputError
from burmester.io.files import atomic_file, open_plain, require_writable, write
from tests.oracles.kill import campaign, leftovers, state
from tests.samples import samples

POSIX = os.name == "posix"
ROOT = POSIX and os.geteuid() == 0
posix = pytest.mark.skipif(not POSIX, reason="signals and modes as POSIX has them")

OLD, NEW = b"old " * 1000, b"new " * 2000
STEPS = ("open", "close", "chmod", "fsync", "link", "replace", "unlink")


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    """Every test runs in a folder of its own, which holds no temporary file at its end."""
    monkeypatch.chdir(tmp_path)
    yield tmp_path
    assert leftovers(tmp_path) == []


@pytest.fixture(params=["links", "no links"])
def links(request, monkeypatch):
    """A file system with hard links, and one without."""

    def refuse(*_, **__):
        raise PermissionError(1, "Operation not permitted")

    if request.param == "no links":
        monkeypatch.setattr(os, "link", refuse)
    return request.param == "links"


def refused(code, call, *arguments, **options):
    with pytest.raises(InputError) as caught:
        call(*arguments, **options)
    assert caught.value.code == code
    return caught.value


def child(script, *arguments, **options):
    """A Python process of its own that knows nothing but files."""
    command = [sys.executable, "-c", textwrap.dedent(script), *map(str, arguments)]
    return subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options
    )


def test_bytes_and_text_as_they_are(here, links):
    write("a.bin", b"\x00\xff\r\n")
    write(here / "b.txt", "µm\r\n\n")
    assert Path("a.bin").read_bytes() == b"\x00\xff\r\n"
    assert Path("b.txt").read_bytes() == b"\xc2\xb5m\r\n\n"
    assert sorted(os.listdir()) == ["a.bin", "b.txt"]


def test_nothing_is_replaced_without_force(links):
    write("a", OLD)
    error = refused("E140", write, "a", NEW)
    assert error.message == "a exists already"
    assert Path("a").read_bytes() == OLD
    assert "--force" in error.help
    write("a", NEW, force=True)
    assert Path("a").read_bytes() == NEW


def test_a_file_that_comes_meanwhile_is_not_touched(links):
    def late():
        with atomic_file("a") as temporary:
            temporary.write_bytes(NEW)
            Path("a").write_bytes(OLD)

    refused("E140", late)
    assert Path("a").read_bytes() == OLD


def test_of_many_that_want_a_new_name_one_gets_it(links):
    for turn in range(20):
        gate, won, lost = threading.Barrier(8), [], []

        def run(k, name=f"a{turn}", gate=gate, won=won, lost=lost):
            gate.wait()
            try:
                write(name, bytes([k]) * 10_000)
                won.append(k)
            except InputError as error:
                lost.append(error.code)

        threads = [threading.Thread(target=run, args=(k,)) for k in range(8)]
        for each in threads:
            each.start()
        for each in threads:
            each.join()
        assert lost == ["E140"] * 7
        assert Path(f"a{turn}").read_bytes() == bytes(won) * 10_000


@posix
def test_modes_follow_the_umask_or_the_file_replaced():
    before = os.umask(0o027)
    try:
        write("a", NEW)
        assert stat.S_IMODE(os.stat("a").st_mode) == 0o640
        os.chmod("a", 0o604)
        write("a", OLD, force=True)
        assert stat.S_IMODE(os.stat("a").st_mode) == 0o604
    finally:
        os.umask(before)


@pytest.mark.skipif(not ROOT, reason="only root can give files away")
def test_a_file_replaced_keeps_its_owner():
    write("a", OLD)
    os.chown("a", 1234, 4321)
    write("a", NEW, force=True)
    assert (os.stat("a").st_uid, os.stat("a").st_gid) == (1234, 4321)


@posix
def test_what_links_lead_to_stays(here):
    """A symbolic link is replaced by a file, and so is one of several names of a file."""
    (here / "deep").mkdir()
    write("deep/target", OLD)
    os.chmod("deep/target", 0o604)
    os.symlink("deep/target", "link")
    os.symlink("deep/new", "dangling")
    os.symlink("no folder/a", "nowhere")
    os.symlink("deep", "folder")
    os.link("deep/target", "hard")
    for name in ("link", "dangling", "nowhere", "hard"):
        why = refused("E140", write, name, NEW).why
        assert (why is None) == (name == "hard")
        assert why is None or "symbolic link" in why
        require_writable(name, force=True)
        write(name, NEW, force=True)
        assert not os.path.islink(name)
        assert Path(name).read_bytes() == NEW
    write("folder/new", NEW)  # a folder may be named by a link
    assert sorted(os.listdir("deep")) == ["new", "target"]
    assert (here / "deep/target").read_bytes() == OLD
    assert stat.S_IMODE(os.stat("link").st_mode) != 0o604  # a link has no mode to hand on
    assert leftovers(here / "deep") == []


@posix
def test_a_plain_file_is_opened_and_nothing_else(here):
    write("file", OLD)
    os.symlink("file", "link")
    os.symlink("new", "dangling")
    os.mkfifo("pipe")
    os.mkdir("folder")
    for name in ("link", "dangling"):
        with pytest.raises(OSError, match="symbolic link"):
            open_plain(name, "ab")
    for name in ("pipe", "folder"):
        for mode in ("rb", "ab"):
            with pytest.raises(OSError, match="folder"):
                open_plain(name, mode)
    with open_plain("link", "rb") as file:
        assert file.read() == OLD
    assert not os.path.exists("new")


def test_a_library_may_write_by_itself(here):
    """It gets a path with the suffix it goes by, in the folder of the target."""
    with atomic_file("drawing.zip") as temporary:
        assert temporary.suffix == ".zip"
        assert temporary.parent == Path(os.path.realpath(here))
        with zipfile.ZipFile(temporary, "w") as archive:
            archive.writestr("one", "1")
        assert not os.path.exists("drawing.zip")
    with zipfile.ZipFile("drawing.zip") as archive:
        assert archive.read("one") == b"1"


def _spoilt(name, fault):
    with atomic_file(name, force=True) as temporary:
        temporary.write_bytes(NEW)
        raise fault


@pytest.mark.parametrize("fault", [KeyboardInterrupt, SystemExit, ValueError, FileExistsError])
def test_a_block_that_fails_leaves_nothing(here, fault):
    write("a", OLD)
    for name in ("a", "b"):
        with pytest.raises(fault):
            _spoilt(name, fault)
    assert os.listdir() == ["a"]
    assert Path("a").read_bytes() == OLD


class Interrupted:
    """The calls to the system, with a Ctrl-C before or after one of them."""

    def __init__(self, patch, fatal, moment):
        self.calls, self.fatal, self.moment = 0, fatal, moment
        for name in STEPS:
            patch.setattr(os, name, self.counted(getattr(os, name)))

    def counted(self, real):
        def step(*arguments, **options):
            self.calls += 1
            mine = self.calls == self.fatal
            if mine and self.moment == "before":
                raise KeyboardInterrupt
            value = real(*arguments, **options)
            if mine:
                raise KeyboardInterrupt
            return value

        return step


@pytest.mark.parametrize("force", [False, True])
@pytest.mark.parametrize("moment", ["before", "after"])
def test_an_interrupt_at_every_step(here, monkeypatch, links, force, moment):
    """Old or new, and nothing left."""
    found, old = [], OLD if force else None
    for fatal in range(1, 30):
        (here / "a").unlink(missing_ok=True)
        if force:
            write("a", OLD)
        with monkeypatch.context() as patch:
            steps = Interrupted(patch, fatal, moment)
            with suppress(KeyboardInterrupt):
                write("a", NEW, force=force)
        assert leftovers(here) == []
        found.append((here / "a").read_bytes() if (here / "a").exists() else None)
        if steps.calls < fatal:
            break
    assert found.pop() == NEW
    assert len(found) >= 8
    if not links and not force and moment == "after":
        found.remove(b"")  # the one moment that `atomic_file` tells of
    assert set(found) == {old, NEW}


@posix
@pytest.mark.parametrize("force", [False, True])
def test_the_disk_has_it_before_its_name(monkeypatch, force):
    """The order that outlives a power cut: the file, its name, and then the folder."""
    write("a", OLD)
    if not force:
        os.unlink("a")
    told, real = [], {name: getattr(os, name) for name in ("fsync", "link", "replace")}

    def fsync(descriptor):
        found = os.fstat(descriptor)
        told.append("folder" if stat.S_ISDIR(found.st_mode) else found.st_size)
        real["fsync"](descriptor)

    def named(name):
        return lambda *paths: (told.append(name), real[name](*paths))

    monkeypatch.setattr(os, "fsync", fsync)
    for name in ("link", "replace"):
        monkeypatch.setattr(os, name, named(name))
    write("a", NEW, force=force)
    assert told == [len(NEW), "replace" if force else "link", "folder"]


KILLED_AT = """
import os, signal, sys
from burmester.io.files import write

path, force, fatal = sys.argv[1], sys.argv[2] == "force", int(sys.argv[3])
calls = 0

def counted(real):
    def step(*arguments, **options):
        global calls
        calls += 1
        if calls == fatal:
            os.kill(os.getpid(), signal.SIGKILL)
        return real(*arguments, **options)
    return step

for name in ("open", "close", "chmod", "fsync", "link", "replace", "unlink"):
    setattr(os, name, counted(getattr(os, name)))
write(path, b"new " * 2000, force=force)
"""


@posix
@pytest.mark.parametrize("force", ["force", "new"])
def test_a_kill_at_every_step(here, force):
    """The file is absent, old or new; what is left is swept when it has become old."""
    found, left = [], 0
    for fatal in range(1, 30):
        (here / "a").unlink(missing_ok=True)
        if force == "force":
            write("a", OLD)
        process = child(KILLED_AT, "a", force, fatal)
        _, said = process.communicate()
        for each in leftovers(here):
            left += 1
            os.utime(each, (0, 0))
        if process.returncode == 0:
            break
        assert process.returncode == -signal.SIGKILL, said
        found.append((here / "a").read_bytes() if (here / "a").exists() else None)
    assert set(found) == {OLD if force == "force" else None, NEW}
    assert left >= 3
    write("a", NEW, force=True)


@posix
def test_kills_at_random_moments(here):
    """Seeded, but where they hit is the scheduler's."""
    kills = len(samples(200, 40))
    found = campaign(kills, 20261121, here)
    assert found["broken"] == 0
    assert min(found[each] for each in ("0", "1", "absent")) > 0
    assert found["left over"] > kills // 10  # so many hit in the midst of it
    for name in ("new", "again"):
        write(name, NEW, force=True)


def test_the_campaign_knows_a_broken_file(here):
    write("a", bytes(3_000_000))
    assert state(here / "a") == "broken"
    assert state(here / "b") == "absent"


def test_only_old_files_of_the_same_target_are_swept(here):
    def left(target, age):
        path = here / f".burmester-{os.urandom(8).hex()}-{target}"
        path.write_bytes(b"half")
        os.utime(path, (time.time() - age,) * 2)
        return path

    swept = [left("a.dxf", age) for age in (3700, 1e6)]
    kept = [left("a.dxf", 3500), left("aa.dxf", 1e6), left(f"{'b' * 46}.dxf", 1e6)]
    other = here / ".burmester-notes-a.dxf"
    other.write_bytes(b"of somebody else")
    os.utime(other, (0, 0))
    write("a.dxf", NEW)
    assert [each.exists() for each in swept] == [False, False]
    assert [each.exists() for each in [*kept, other]] == [True] * 4
    write(f"{'b' * 60}.dxf", NEW)  # only the end of a long name is kept
    assert not kept[2].exists()
    for each in [*kept[:2], other]:
        each.unlink()


@posix
def test_ctrl_c_in_the_midst(here):
    write("a", OLD)
    process = child(
        """
        import sys, time
        from burmester.io.files import atomic_file

        with atomic_file("a", force=True) as temporary, open(temporary, "wb") as file:
            file.write(b"half")
            file.flush()
            print("ready", flush=True)
            time.sleep(60)
        """
    )
    assert process.stdout.readline() == "ready\n"
    assert len(leftovers(here)) == 1
    process.send_signal(signal.SIGINT)
    _, said = process.communicate()
    assert process.returncode in (-signal.SIGINT, 130)
    assert "KeyboardInterrupt" in said
    assert Path("a").read_bytes() == OLD


def test_a_folder_that_is_not_there_and_the_help(here):
    for check in (require_writable, lambda path: write(path, NEW)):
        error = refused("E141", check, "no such/folder/a b.toml")
        assert error.why == "there is no folder no such/folder"
    command = re.search("`(.*)`", error.help)[1]
    if POSIX:
        assert command == "mkdir -p 'no such/folder'"
        subprocess.run(command, shell=True, check=True)
        write("no such/folder/a b.toml", NEW)


@pytest.mark.parametrize(
    ("path", "why"),
    [
        (".", "it is a folder"),
        ("new/", "it ends like the name of a folder"),
        ("", "its name is empty"),
        ("file/deep/er/a", "file is a file, not a folder"),
        ("a\0b", "embedded null"),
        pytest.param("x" * 300, "too long", marks=posix),
        pytest.param("loop", "symbolic links", marks=posix),
        pytest.param(os.devnull, "a device or a pipe", marks=posix),
        pytest.param("pipe", "a device or a pipe", marks=posix),
        pytest.param("nowhere/a", "there is no folder", marks=posix),
    ],
)
@pytest.mark.parametrize("force", [False, True])
def test_names_that_cannot_be_written(here, path, why, force):
    write("file", OLD)
    if POSIX:
        os.symlink("loop", "loop")
        os.symlink("no folder/a", "nowhere")
        os.mkfifo("pipe")
    there = sorted(os.listdir())
    for check in (require_writable, lambda path, force: write(path, NEW, force=force)):
        error = refused("E141", check, path, force=force)
        assert why in error.why
        assert error.help
    assert sorted(os.listdir()) == there
    if path == ".":
        write(error.help.removeprefix("give the name of a file, such as "), NEW)
        assert Path("NAME").read_bytes() == NEW


def test_free_names_are_free(here):
    write("a", OLD)
    require_writable("b")
    require_writable("a", force=True)
    refused("E140", require_writable, "a")
    assert os.listdir() == ["a"]
    assert Path("a").read_bytes() == OLD


def test_names_of_all_lengths_and_letters(here):
    for name in ("é" * 120 + ".toml", "\U0001f600" * 62, "a b;$(c).toml", "-", ".hidden", "n\nl"):
        if POSIX or name in ("-", ".hidden"):
            write(name, NEW)
            assert Path(name).read_bytes() == NEW
            assert "\n" not in refused("E140", write, name, OLD).message


@posix
def test_folders_and_files_that_are_closed():
    """Root may write anywhere, so a child gives up being root first."""
    with tempfile.TemporaryDirectory() as folder:
        closed = Path(folder, "closed")
        closed.mkdir()
        (closed / "file").write_bytes(OLD)
        fixed = Path(folder, "fixed")
        fixed.write_bytes(OLD)
        os.chmod(folder, 0o777)
        os.chmod(closed, 0o555)
        os.chmod(fixed, 0o444)
        process = child(
            """
            import os, sys
            from burmester.errors import InputError
            from burmester.io.files import require_writable, write

            if os.geteuid() == 0:
                os.setgid(65534)
                os.setuid(65534)
            for name in ("closed/new", "closed/file", "fixed"):
                path = os.path.join(sys.argv[1], name)
                writing = lambda path, force: write(path, b"new", force=force)
                for check in (require_writable, writing):
                    try:
                        check(path, force=True)
                    except InputError as error:
                        print(error.code, error.why)
            """,
            folder,
        )
        said, failed = process.communicate()
        assert (closed / "file").read_bytes() == OLD == fixed.read_bytes()
        os.chmod(closed, 0o755)
    lines = [line.replace(os.path.realpath(folder), "FOLDER") for line in said.splitlines()]
    permission = "E141 Permission denied, in the folder FOLDER/closed"
    assert lines[:2] == [permission] * 2, failed
    # what is closed is the folder; the file in it is root's where this runs as root
    assert lines[2:4] == ["E141 the file is read-only" if ROOT else permission] * 2
    assert lines[4:] == ["E141 the file is read-only"] * 2


@posix
def test_a_limit_on_the_size_of_files(here):
    write("a", OLD)
    process = child(
        """
        import resource, signal
        from burmester.io.files import write

        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))
        try:
            write("a", bytes(1_000_000), force=True)
        except Exception as error:
            print(error)
        """
    )
    said, failed = process.communicate()
    assert said.splitlines()[:2] == [
        "error[E141]: a cannot be written",
        "  why: File too large",
    ], failed
    assert Path("a").read_bytes() == OLD


@pytest.mark.skipif(not (ROOT and sys.platform == "linux"), reason="only root can mount a disk")
def test_a_disk_that_is_full(here):
    disk = here / "disk"
    disk.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=256k", "tmpfs", str(disk)]
    if subprocess.run(mount, capture_output=True, check=False).returncode:
        pytest.skip("no disk can be mounted here")
    try:
        write(disk / "a", OLD)
        for name, force in (("a", True), ("b", False)):
            error = refused("E141", write, disk / name, bytes(1_000_000), force=force)
            free = os.statvfs(disk).f_bavail * os.statvfs(disk).f_frsize
            said = re.fullmatch(r"No space left on device; (\d+) kB are free there", error.why)
            assert int(said[1]) == round(free / 1e3)
        assert (disk / "a").read_bytes() == OLD
        assert os.listdir(disk) == ["a"]
        subprocess.run(["mount", "-o", "remount,ro", str(disk)], check=True)
        error = refused("E141", require_writable, disk / "b")
        assert error.why.startswith("Read-only file system, in the folder ")
        refused("E141", write, disk / "a", NEW, force=True)
        assert (disk / "a").read_bytes() == OLD
    finally:
        subprocess.run(["umount", str(disk)], check=True)


def test_a_disk_that_is_full_without_mounting_one(monkeypatch):
    """The same with a disk that only says so, for those who are not root."""
    write("a", OLD)

    def full(_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    error = refused("E141", write, "a", NEW, force=True)
    assert re.fullmatch(r"No space left on device; [\d.e+]+ .B are free there", error.why)
    assert Path("a").read_bytes() == OLD


def test_an_error_of_a_library_names_the_file_that_is_meant():
    """Nobody knows the temporary file, and it has gone."""

    def failing(fault):
        with atomic_file("drawing.svg") as temporary:
            raise fault(str(temporary))

    with pytest.raises(RuntimeError) as caught:
        failing(lambda name: RuntimeError(f"cannot open {name}", 7))
    assert caught.value.args == ("cannot open drawing.svg", 7)
    error = refused(
        "E162",
        failing,
        lambda name: InputError("E162", "no", where=name, why=f"{name}: no", help=f"see {name}"),
    )
    assert (error.where, error.why, error.help) == (
        "drawing.svg",
        "drawing.svg: no",
        "see drawing.svg",
    )


@pytest.mark.skipif(not POSIX, reason="limits on the size of files as POSIX has them")
@pytest.mark.parametrize("fault", ["RuntimeError('failed')", "OSError('pipe')", "None"])
def test_a_library_that_hides_a_full_disk_is_found_out(here, fault):
    """It says anything, or nothing and writes half: the disk itself is asked."""
    process = child(
        """
        import os, resource, sys
        from burmester.errors import BurmesterError, InputError
        from burmester.io.files import atomic_file

        resource.setrlimit(resource.RLIMIT_FSIZE, (10_000, 10_000))
        fault = eval(sys.argv[1]) or BurmesterError("E160", "it does not contain the linkage")
        try:
            with atomic_file("a.step") as temporary:
                try:
                    temporary.write_bytes(bytes(20_000))
                except OSError:
                    raise fault from None
        except InputError as error:
            print(error.code, error.message, error.why, sep="; ")
        """,
        fault,
    )
    out, said = process.communicate()
    assert out == "E141; a.step cannot be written; File too large\n", said
    assert os.listdir() == []


def test_a_library_that_fails_by_itself_is_not_blamed_on_the_disk():
    with pytest.raises(RuntimeError), atomic_file("a.step"):
        raise RuntimeError("no solid")


@pytest.mark.skipif(not POSIX, reason="names of bytes as POSIX has them")
def test_a_name_is_told_without_what_a_terminal_obeys():
    name = os.fsdecode(b"a\xff\x1b[2J\nb")
    write(name, OLD)
    assert refused("E140", write, name, NEW).message == r"a\xff\x1b[2J\nb exists already"
    error = refused("E141", write, f"{name}c/d", NEW)
    assert error.help == r"run `mkdir -p $'a\xff\x1b[2J\nbc'`, or give another name"
    subprocess.run(["bash", "-c", in_backticks(error.help)], check=True)
    write(f"{name}c/d", NEW)


def in_backticks(help):
    return re.search("`(.*)`", help)[1]
