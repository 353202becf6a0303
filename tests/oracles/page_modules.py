"""The page's modules without a page: what an expression over them is worth, by Node."""

import json
import shutil
import subprocess
from pathlib import Path

import pytest

FOLDER = Path(__file__).parents[2] / "src" / "burmester" / "web" / "studio"


def value(module, script, **given):
    """What a script returns; `m` is the module, and names that are given are constants."""
    node = shutil.which("node")
    if node is None:
        pytest.skip("no Node on this machine")
    names = "".join(f"const {name} = {json.dumps(each)};\n" for name, each in given.items())
    text = f"import * as m from {json.dumps((FOLDER / module).as_uri())};\n{names}"
    text += f"process.stdout.write(JSON.stringify((() => {{ {script} }})() ?? null));"
    ran = subprocess.run(
        [node, "--input-type=module", "-"],
        input=text.encode(),
        capture_output=True,
        check=False,
        timeout=60,
    )
    assert ran.returncode == 0, ran.stderr.decode()
    return json.loads(ran.stdout)
