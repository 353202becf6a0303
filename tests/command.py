"""The command, run by a test: in this process, or in one of its own where that is what matters."""

import io
import os
import subprocess
import sys
from contextlib import redirect_stderr, redirect_stdout
from typing import NamedTuple
from unittest.mock import patch

from burmester import cli


class Done(NamedTuple):
    """How a command ended, and what it printed."""

    returncode: int
    stdout: str
    stderr: str


def run(*arguments: object, stdin: str = "") -> Done:
    """Run a command line here, where what another test has solved is at hand."""
    out, err, code = io.StringIO(), io.StringIO(), None
    given = io.TextIOWrapper(io.BytesIO(stdin.encode()), encoding="utf-8")
    with redirect_stdout(out), redirect_stderr(err), patch.object(sys, "stdin", given):
        try:
            cli.main([str(each) for each in arguments])
        except SystemExit as end:
            code = end.code
    return Done(code, out.getvalue(), err.getvalue())


def process(*arguments: object, stdin: str | None = None, env: dict[str, str] | None = None):
    """Run it as its users do."""
    return subprocess.run(
        [sys.executable, "-m", "burmester", *map(str, arguments)],
        input=stdin,
        capture_output=True,
        encoding=(env or {}).get("PYTHONIOENCODING", "utf-8"),
        check=False,
        timeout=60,
        env={**os.environ, **(env or {})},
    )
