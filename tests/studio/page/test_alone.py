"""W13: a studio on a machine that reaches no other one; nothing tries to, and everything works."""

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from burmester.cli import main
from tests.oracles import browser as browsers

ALONE = ["unshare", "-rn"]  # a network namespace, and the right to set up its loopback


def test_w13_a_studio_without_a_network_does_all_it_does(tmp_path, capsys):
    browsers.path()
    pytest.importorskip("playwright.sync_api", reason="no playwright for this machine")
    if shutil.which(ALONE[0]) is None or subprocess.run([*ALONE, "true"], check=False).returncode:
        pytest.skip("no network namespace here: unshare -rn is missing or not allowed")
    root = Path(__file__).parents[3]
    command = [*ALONE, sys.executable, "-m", "tests.oracles.studio_alone", str(tmp_path)]
    ran = subprocess.run(command, check=True, cwd=root, stdout=subprocess.PIPE, timeout=180)
    seen = json.loads(ran.stdout)
    assert seen["interfaces"] == ["lo"]
    assert (seen["elsewhere"], seen["counted"]) == ("ENETUNREACH", 1)  # what tries is counted
    assert seen["by the server"] == 0
    assert seen["asked"] == ["http://127.0.0.1"]
    assert seen["wrong"] == []
    # What the page handed over is what the command finds, here where there is a network.
    with pytest.raises(SystemExit):
        main(["synthesize", "--all", "--json", str(tmp_path / "task.toml")])
    found = json.loads(capsys.readouterr().out)
    x, y, _ = seen["pose"]
    fourth = found["task"]["poses"][3]
    assert (fourth["x"], fourth["y"]) == (x, y)
    result = json.loads((tmp_path / "result.json").read_text(encoding="utf-8"))
    assert result["linkages"] == found["linkages"]
    main_id = result["linkages"][0]["id"]
    drawn = tmp_path / "drawn.svg"
    with pytest.raises(SystemExit):
        main(["export", str(tmp_path / "result.json"), "--linkage", main_id, "-o", str(drawn)])
    assert drawn.read_bytes() == (tmp_path / "linkage.svg").read_bytes()
