"""The page of six-bars of made-up classes: all joints are where the mechanism has them."""

from dataclasses import replace

import numpy as np
import pytest

from burmester.report.page import page_of
from burmester.sixbar.six_bars import SixBarOptions
from burmester.synthesis.six_bars import synthesize_six_bars
from burmester.web.six_bar_data import six_bar_report
from tests.oracles import browser as browsers
from tests.oracles.relabelled import renamed, seen_from_coupler
from tests.report.drawn_six_bars import DRAWN, SCRUB, points
from tests.sixbar.tasks import TURNING, task


@pytest.mark.parametrize("make", [renamed, seen_from_coupler])
def test_joints_are_where_the_mechanism_has_them(browser, make, tmp_path):
    synthesis = synthesize_six_bars(task(TURNING), SixBarOptions(chains=400, most=1))
    found = make(synthesis.six_bars.found[0])
    problem = replace(synthesis.problem, given=found.task)
    six_bars = replace(synthesis.six_bars, found=(found,))
    data = six_bar_report(replace(synthesis, problem=problem, six_bars=six_bars))
    file = tmp_path / "page.html"
    file.write_text(page_of(data, "A made-up class"), encoding="utf-8")
    pivot, end = found.skeleton.arm(found.driver)
    with browsers.opened(browser, file) as (page, said, _):
        for k in range(6):
            if k < 5:  # it stands at the first pose
                drive = found.drive[k]
                drawn = page.evaluate(DRAWN)
                assert page.locator(".bm-now").inner_text().endswith(f"at pose {k + 1}, exact")
                page.click(".bm-next")
            else:
                page.evaluate(SCRUB, 0.37)
                drawn = page.evaluate(DRAWN)
                joints = points(drawn)
                near = np.angle(joints[end] - joints[pivot])
                middle = np.mean(found.drive_range)
                drive = near + 2 * np.pi * round((middle - near) / (2 * np.pi))
            joints, wanted = points(drawn), found.joints(np.array([drive]))
            assert set(joints) == set(wanted)
            for name, place in wanted.items():
                assert abs(joints[name] - complex(*place[0])) * drawn["scale"] < 1e-3
            place = found.body(np.array([drive]))
            assert np.abs(place.translation[0] - drawn["body"][:2]).max() * drawn["scale"] < 1e-3
            assert abs(np.exp(1j * (place.angle[0] - drawn["body"][2])) - 1) < 1e-5
        assert {"".join(sorted(each)) for each in drawn["links"]} == {
            "".join(sorted(own)) for own in [*found.skeleton.links.values()][1:]
        }
        assert page.locator(".bm-plane .bm-fixed-pin").count() == len(found.skeleton.drivers)
        assert said == []
