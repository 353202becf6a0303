"""Strange poses: always an answer or a clear refusal, never a crash and never invalid JSON."""

import io
import json

import numpy as np
import pytest
from rich.console import Console

from burmester import synthesize
from burmester.errors import InputError
from burmester.geometry.displacement import Displacement
from burmester.io.result import synthesis_data
from burmester.io.terminal import show_synthesis
from burmester.tasks.motion_task import Task
from tests.oracles.strange_poses import STRANGE
from tests.samples import samples


def answer(task, method):
    try:
        return synthesize(task, method)
    except InputError as error:
        return error


@pytest.mark.parametrize("method", ["auto", "pencil", "complete"])
@pytest.mark.parametrize("name", STRANGE)
def test_strange_poses(name, method, monkeypatch):
    """The searches for linkages that work take seconds: one task of twelve has them.

    "complete" is what "auto" chooses for six poses or more: once is enough.
    """
    rng = np.random.default_rng(list(STRANGE).index(name))
    for number in samples(12, 3):
        if number == (1 if method == "auto" else 0):
            monkeypatch.setattr(
                "burmester.linkages.from_dyads.defect_free_linkages", lambda *_: None
            )
            monkeypatch.setattr(
                "burmester.linkages.further_pairs.links_of_pivot_map", lambda *_: []
            )
            monkeypatch.setattr(
                "burmester.synthesis.motion_generation.with_usual_pivots",
                lambda _, found: (found, []),
            )
            monkeypatch.setattr(
                "burmester.synthesis.none_explained.explained", lambda found, _: found
            )
        rows = rng.normal(size=(int(rng.integers(3, 13)), 3)) * [10, 10, 1]
        task = Task(Displacement.from_poses(STRANGE[name](rows, rng)))
        synthesis = answer(task, method)
        if isinstance(synthesis, InputError):
            assert synthesis.code == "E121"
            assert method != "auto"
            assert len(np.unique(task.poses.as_matrix().round(9), axis=0)) < 6
            continue
        data = json.loads(json.dumps(synthesis_data(synthesis), allow_nan=False))
        code = data["outcome"]["code"]
        told = code in {"R302", "R303", "R309"} or "R310" <= code <= "R319"
        made = {"R300", "R301", "R305", "R307", "R308"}
        assert told or code in made
        if code != "R309":
            assert bool(data["linkages"]) == (code in made | {"R313", "R316"})
        if code in made:
            works = any(found.usable for found in synthesis.linkages)
            assert works == (code != "R301")
            settled = any(found.usable and found.determined for found in synthesis.linkages)
            assert settled == (code in {"R300", "R307", "R308"})
        for dyad in synthesis.dyads:
            # What is called an error is one: recomputed, it is the same.
            miss = np.abs(dyad.dyad.residual(task.poses)).max()
            size = synthesis.length + float(getattr(dyad.dyad, "radius", 0.0))
            assert abs(miss - dyad.max_error) < 1e-6 * size + 1e-9 * np.abs(rows).max()
        screen = io.StringIO()
        show_synthesis(synthesis, Console(file=screen, width=80))
        assert data["outcome"]["message"].split(";")[0] in " ".join(screen.getvalue().split())
