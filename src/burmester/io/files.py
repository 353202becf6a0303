"""Files that are there whole or not at all: every output of this package is written here.

A temporary file beside the target is written, flushed to the disk and then put in place under the
target's name.  Whoever looks sees the old file or the new one, also after a crash.  What is
replaced is a name in its folder and nothing else: a symbolic link gives way to a file, and what it
leads to stays as it was, as do the other names (hard links) of a file that is replaced.

E140 the file exists already        E141 the file cannot be written
E142 it is the file that is read
"""

from __future__ import annotations

import errno
import os
import re
import shlex
import stat
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from io import FileIO
from pathlib import Path

from burmester.cures import Cure, Help
from burmester.errors import BurmesterError, InputError
from burmester.printable import printable
from burmester.signals import unfinished

STALE_SECONDS = 3600.0  # age above which a temporary file was left by a killed process

_WINDOWS = os.name == "nt"
_BLOCK = 1 << 16  # bytes that are written to ask a disk whether it is full
_KEPT = 50  # characters of the target's name in the temporary one, which has 255 bytes at most
_TEMPORARY = re.compile(r"\.burmester-[0-9a-f]{16}-")
_DISK = (errno.ENOSPC, errno.EFBIG, errno.EIO, errno.EROFS, getattr(errno, "EDQUOT", errno.ENOSPC))
_FULL = (errno.ENOSPC, getattr(errno, "EDQUOT", errno.ENOSPC))
# What file systems without hard links say, and what those say whose folders take no fsync.
_NO_LINKS = (errno.EPERM, errno.ENOSYS, errno.EOPNOTSUPP, errno.ENOTSUP, errno.EMLINK, errno.EINVAL)
_NO_SYNC = (errno.EINVAL, errno.EACCES, errno.EBADF, errno.ENOSYS, errno.EOPNOTSUPP, errno.ENOTSUP)


def write(
    path: str | os.PathLike[str], data: bytes | str, *, force: bool = False, swept: bool = False
) -> None:
    """Write a whole file; text as UTF-8, its line ends as they are.  Errors: see `atomic_file`."""
    with atomic_file(path, force=force, swept=swept) as temporary, open(temporary, "wb") as file:
        file.write(data.encode(errors="backslashreplace") if isinstance(data, str) else data)


@contextmanager
def atomic_file(
    path: str | os.PathLike[str], *, force: bool = False, swept: bool = False
) -> Iterator[Path]:
    """An empty file to write into, which becomes `path` when the block ends without an error.

    It lies in the folder of `path` and has its suffix.  A file that is replaced hands on its mode
    and its owner.  Without `force`, a file that exists is
    not touched, whenever it came.  Where the block is left by an exception, KeyboardInterrupt
    too, nothing remains, and its error names `path`, never the temporary file.  A killed process
    leaves a file `.burmester-...` behind, which the next one to write to `path` sweeps away after
    an hour.  On a file system without hard links, a process that is killed in the moment between
    claiming a new name and filling it leaves an empty file there, and so may one that is
    interrupted while it claims it.  swept: whether that has been done already (`sweep`), by one
    who writes so many files that to look through the folder for each would take long.
    Raises InputError E140 and E141.
    """
    given = os.fspath(path)
    target = _target(given, force)
    if not swept:
        _sweep(target)
    with _temporary(target) as temporary:
        try:
            _create(temporary)
            yield temporary
            _settle(temporary, target, force)
        except Exception as error:
            refused = _disk_error(error, temporary, target)
            if refused is None:
                _name_target(error, temporary, given)
                raise
            with suppress(OSError):  # before the room that is left is counted
                os.unlink(temporary)
            if isinstance(refused, FileExistsError) and not force:
                raise _exists(given) from None
            raise cannot_write(given, refused, target) from None


def open_plain(path: str | os.PathLike[str], mode: str) -> FileIO:
    """Open a file of a folder that others may write to, unbuffered, in a binary mode.

    Raises OSError for a folder, a device or a pipe, which may wait for ever.  A link may be read
    through, but to write or to lock only the file of that very name is opened.
    """

    def opener(name: str, flags: int) -> int:
        links = 0 if mode == "rb" else getattr(os, "O_NOFOLLOW", 0)
        try:
            descriptor = os.open(name, flags | links | getattr(os, "O_NONBLOCK", 0), 0o666)
            if stat.S_ISREG(os.fstat(descriptor).st_mode):
                return descriptor
            os.close(descriptor)
        except OSError as error:
            if links and os.path.islink(name):
                raise OSError(errno.ELOOP, "it is a symbolic link", name) from None
            if error.errno not in (errno.EISDIR, errno.ENXIO):
                raise
        raise OSError(errno.EISDIR, "it is no file, but a folder, device or pipe", name)

    return FileIO(path, mode, opener=opener)


def sweep(folder: str | os.PathLike[str]) -> None:
    """Remove what killed processes left in a folder that nobody else writes to now."""
    with suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            if _TEMPORARY.match(entry.name):
                with suppress(OSError):
                    os.unlink(entry.path)


def require_writable(
    path: str | os.PathLike[str], *, force: bool = False, source: str | None = None
) -> None:
    """Refuse now what `atomic_file` would refuse later: to be called before a long computation.

    Tries the folder with an empty file.  source: the file that is read, "-" for standard input.
    Raises InputError E140, E141, and E142 where `path` is the source, under whatever name.
    """
    given = os.fspath(path)
    if source is not None:
        _require_other(given, source)
    target = _target(given, force)
    with _temporary(target) as temporary:
        try:
            _create(temporary)
        except OSError as error:
            raise cannot_write(given, error, target) from None


def _require_other(given: str, source: str) -> None:
    """Refuse to replace what is read: its only copy may be lost, and is no pose file any more."""
    try:
        read = os.fstat(0) if source == "-" else os.stat(source)
        same = os.path.samestat(read, os.stat(given))
    except (OSError, ValueError):
        return  # one of them is not there, and whoever opens it says so
    if same and stat.S_ISREG(read.st_mode):
        raise InputError(
            "E142",
            f"{_plain(given)} is the file that is read",
            why="its content would be lost",
            help="give another name",
        )


def _target(given: str, force: bool) -> Path:
    """The file that is meant, in its own folder, if it may be written as far as can be seen."""
    if not given:
        raise _refused(given, "its name is empty", "give the name of a file")
    target = Path(given)
    try:
        place, name = os.path.split(given)
        target, is_link = Path(os.path.realpath(place), name), os.path.islink(given)
        known = _stat(given) or (os.lstat(given) if is_link else None)
        if known is None and not given.endswith(_separators()):
            folder = _stat(str(target.parent))
            if folder is not None and stat.S_ISDIR(folder.st_mode):
                return target
            code = errno.ENOENT if folder is None else errno.ENOTDIR
            raise OSError(code, os.strerror(code))
    except (OSError, ValueError) as error:  # ValueError: a null character in the path
        raise cannot_write(given, error, target) from None
    if known is None or stat.S_ISDIR(known.st_mode):
        why = "it is a folder" if known else "it ends like the name of a folder"
        inside = _plain(os.path.join(given, "NAME"))
        raise _refused(given, why, f"give the name of a file, such as {inside}")
    if not (stat.S_ISREG(known.st_mode) or stat.S_ISLNK(known.st_mode)):
        why = "it is a device or a pipe, not a file"
        raise _refused(given, why, "give the name of a file")
    if not force:
        raise _exists(given)
    if not (is_link or os.access(target, os.W_OK)):
        unlock = f"attrib -r {quoted(given)}" if _WINDOWS else f"chmod u+w {quoted(given)}"
        raise _refused(given, "the file is read-only", f"give another name, or run `{unlock}`")
    return target


def _stat(path: str) -> os.stat_result | None:
    try:
        return os.stat(path)
    except FileNotFoundError:
        return None


@contextmanager
def _temporary(target: Path) -> Iterator[Path]:
    """A free name with the target's suffix; whatever is there at the end is removed."""
    temporary = target.with_name(f".burmester-{os.urandom(8).hex()}-{target.name[-_KEPT:]}")
    unfinished.add(str(temporary))
    try:
        yield temporary
    finally:
        with suppress(OSError):
            os.unlink(temporary)
        unfinished.discard(str(temporary))


def _create(temporary: Path) -> None:
    """An empty file with the mode that the umask leaves."""
    os.close(os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666))


def _disk_error(error: Exception, temporary: Path, target: Path) -> OSError | None:
    """What the system, asked, has against this file, if that is the reason."""
    if isinstance(error, OSError):
        if error.filename is None:
            if error.errno in _DISK:
                return error
        elif os.fsdecode(error.filename) in (str(temporary), str(target), str(target.parent)):
            return error
    if isinstance(error, InputError):
        return None
    try:
        with open(temporary, "ab", buffering=0) as file:
            file.write(bytes(_BLOCK))
            os.fsync(file.fileno())
    except OSError as found:
        return found if found.errno in _DISK else None
    return None


def _name_target(error: Exception, temporary: Path, given: str) -> None:
    """Let an error tell of the file that is meant, not of one that nobody knows."""

    def named(text: str) -> str:
        return text.replace(str(temporary), given).replace(temporary.name, given)

    error.args = tuple(named(each) if isinstance(each, str) else each for each in error.args)
    for field in ("message", "where", "why", "help"):
        text = getattr(error, field, None) if isinstance(error, BurmesterError) else None
        if text and named(text) != text:  # else what it knows beside its words is kept
            setattr(error, field, named(text))


def _settle(temporary: Path, target: Path, force: bool) -> None:
    """Bring the temporary file to the disk, and then under the target's name."""
    replaced = _stat(str(target)) if force and not target.is_symlink() else None
    with open_plain(temporary, "rb+") as file:
        if replaced is not None and not _WINDOWS:
            own = os.fstat(file.fileno())
            if (own.st_uid, own.st_gid) != (replaced.st_uid, replaced.st_gid):
                with suppress(OSError):  # only root may give files away
                    os.chown(file.fileno(), replaced.st_uid, replaced.st_gid)
            os.chmod(file.fileno(), stat.S_IMODE(replaced.st_mode))
        os.fsync(file.fileno())
    if force:
        os.replace(temporary, target)
    else:
        _put_new(temporary, target)
    if not _WINDOWS:  # where folders cannot be opened
        _sync_folder(target.parent)


def _put_new(temporary: Path, target: Path) -> None:
    """The same under a name that nobody has; raises FileExistsError if somebody has it."""
    if _WINDOWS:  # where a file does not replace another unless told to
        os.rename(temporary, target)
        return
    try:
        os.link(temporary, target)
    except OSError as error:
        if error.errno not in _NO_LINKS:
            raise
        # Claims the name: only this empty file of our own is replaced.
        claim = os.open(target, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)
        try:
            os.close(claim)
            os.replace(temporary, target)
        except BaseException:
            with suppress(OSError):
                os.unlink(target)
            raise
    else:
        os.unlink(temporary)


def _sync_folder(folder: Path) -> None:
    """A name is on the disk only when its folder is."""
    try:
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
    except OSError as error:
        if error.errno not in _NO_SYNC:
            raise


def _sweep(target: Path) -> None:
    """Remove what killed processes left of this target long ago."""
    with suppress(OSError), os.scandir(target.parent) as entries:
        for entry in entries:
            start = _TEMPORARY.match(entry.name)
            if start and entry.name[start.end() :] == target.name[-_KEPT:]:
                with suppress(OSError):
                    if time.time() - entry.stat(follow_symlinks=False).st_mtime > STALE_SECONDS:
                        os.unlink(entry.path)


def _exists(given: str) -> InputError:
    force = Cure("force", True)
    help = Help.of("give another name, or add {} to replace it", force)
    link = Help.of("it is a symbolic link; {} replaces the link, and what it leads to stays", force)
    why = link if os.path.islink(given) else None
    return InputError("E140", f"{_plain(given)} exists already", why=why, help=help)


def _refused(given: str, why: str, help: str) -> InputError:
    return InputError("E141", f"{_plain(given) or 'a file'} cannot be written", why=why, help=help)


def cannot_write(given: str, error: OSError | ValueError, target: Path) -> InputError:
    """E141 for a path as it was given, with the system's words and a way out.

    target: the file that is meant, its folder behind all links.
    """
    why = getattr(error, "strerror", None) or str(error)
    code, folder = getattr(error, "errno", None), os.path.dirname(given) or os.curdir
    if code == errno.ENOENT and os.path.islink(folder):  # to a folder that is not there
        folder = str(target.parent)
    if code == errno.ENOENT and not os.path.isdir(folder):
        make = f"{'mkdir' if _WINDOWS else 'mkdir -p'} {quoted(folder)}"
        why = f"there is no folder {_plain(folder)}"
        return _refused(given, why, f"run `{make}`, or give another name")
    if code == errno.ENOTDIR:
        file = next((str(each) for each in target.parents if each.is_file()), folder)
        return _refused(given, f"{_plain(file)} is a file, not a folder", "give another name")
    if code in _FULL:
        why = f"{why}{_free(target.parent)}"
        return _refused(given, why, "free some space there, or give a name on another disk")
    if code in (errno.EACCES, errno.EPERM, errno.EROFS):
        why = f"{why}, in the folder {_plain(str(target.parent))}"
        return _refused(given, why, "give a name in a folder that you may write to")
    help = {
        errno.ENAMETOOLONG: "give a shorter name",
        errno.EFBIG: "give a name on another disk, or raise the limit on the size of files",
        errno.EINVAL: "give a name of letters, digits, - and _",
        errno.ELOOP: "remove the symbolic link, or give another name",
    }.get(code or 0, "give another name")
    return _refused(given, why, help)


def _free(folder: Path) -> str:
    """How much room there is, in words."""
    from shutil import disk_usage

    try:
        free = disk_usage(folder).free
    except OSError:
        return ""
    size, unit = (free / 1e6, "MB") if free >= 1e6 else (free / 1e3, "kB")
    return f"; {size:.3g} {unit} are free there"


def _separators() -> tuple[str, ...]:
    return tuple(filter(None, (os.sep, os.altsep)))


def quoted(path: str) -> str:
    """A path as the shell of this system takes it, on one line and without escape codes."""
    if not (_WINDOWS or path.isprintable()):
        escaped = path.replace("\\", r"\\").replace("'", r"\'")
        return f"$'{printable(escaped)}'"  # as bash and zsh read it
    return f'"{path}"' if _WINDOWS else shlex.quote(path)


def _plain(path: str) -> str:
    """A path that can be printed, whatever it is."""
    plain = printable(path)
    return plain if len(plain) <= 200 else f"{plain[:100]}...{plain[-97:]}"
