"""The window opener: a task for six bars that no four-bar does."""

import numpy as np

import burmester
from burmester.io import templates
from burmester.sixbar.six_bars import SixBarOptions
from burmester.synthesis.six_bars import synthesize_six_bars
from tests.sixbar.driving import require_driven


def test_no_four_bar_does_it_and_a_six_bar_does(tmp_path):
    file = tmp_path / "opener.toml"
    file.write_text(templates.text("window-opener"), encoding="utf-8")
    task = burmester.read_task(file)
    four = burmester.synthesize(task)
    assert not four.usable
    assert "--six-bars" in four.outcome.help
    best = synthesize_six_bars(task, SixBarOptions(kind="Watt I", chains=5000)).six_bars.found[0]
    require_driven(best, task)
    assert np.degrees(best.transmission) >= 30
    jamb, sash = task.limits[0].fixed_pivot, task.limits[0].moving_pivot
    linkage = best.linkage
    assert jamb.distance(np.array([linkage.fixed_first, linkage.fixed_second])).max() < 1e-6
    assert sash.distance(np.array([linkage.body_joint, linkage.link_joint])).max() < 1e-6
