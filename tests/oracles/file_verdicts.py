"""What the package makes of a file, held against its maker and a plain reader."""

import re

from burmester.errors import InputError
from burmester.io.reading.poses import read_task
from burmester.io.reading.tables import pose_rows
from tests.oracles import plain_reader


def judged(file, path):
    """What the package makes of a file: "exact", "points", "unsure" or the code of its refusal.

    "unsure" is a file that is taken and whose meaning neither its maker nor the plain reader
    knows.  Raises AssertionError for a wrong number, for a poor refusal, and for a sound file
    that is refused, unless it can be read in two ways.
    """
    path = path.with_suffix(file.suffix)
    path.write_bytes(file.data)
    plain = plain_reader.read(file.data, file.suffix)
    error, block = None, pose_rows.BLOCK
    pose_rows.BLOCK = 80 if len(file.data) % 2 else block  # small ones have more than one block
    try:
        task = read_task(path, **file.options)
    except InputError as refused:
        error = refused
    finally:
        pose_rows.BLOCK = block
    if error:
        check_refusal(error)
        if error.code == "E112" and (meant := file.key or plain) is not None:
            assert plain_reader.extreme(meant), f"not extreme, but {error}"
            return error.code
        two_ways = "two ways" in error.message or " may be pose " in error.message
        assert file.maker != "sound" or two_ways, f"sound, but {error}"
        return error.code
    unit = file.options.get("angle_unit")
    for meant in (file.key, plain):
        if meant is not None:
            assert (why := plain_reader.wrong(task, meant, unit)) == "", why
    if file.key is None and plain is None:
        points = task.tolerances is not None and bool(task.tolerances.free[:, 2].all())
        return "points" if points else "unsure"  # points: the column of angles was taken away
    return "exact"


def check_refusal(error):
    """A refusal says which, what, where and what to do, in text that can be printed."""
    assert re.fullmatch("E1[0-9][0-9]", error.code), error.code
    assert error.exit_code == 2
    assert error.message
    assert error.where
    assert error.help
    lines = str(error).encode().decode().split("\n")
    assert lines[0].startswith(f"error[{error.code}]: ")
    assert max(map(len, lines)) < 1000, max(lines, key=len)[:200]
