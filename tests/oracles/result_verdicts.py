"""What the package makes of a saved result, held against what a sound one is."""

import json
import re
import warnings

import numpy as np

from burmester.api.result import Result
from burmester.errors import InputError
from burmester.export import FORMATS, export
from burmester.io.saved import read_result
from burmester.printable import printable
from burmester.requirements.types import TYPES
from tests.oracles.file_verdicts import check_refusal

QUICK = ("json", "csv", "svg", "openscad", "mjcf", "urdf", "pylinkage")  # formats made in no time


def judged(data, folder, to):
    """What becomes of the bytes of a result: the code of a refusal, or "exported".

    Raises AssertionError for a poor refusal and for a result that is taken and contradicts itself;
    a warning of NumPy is an error.
    """
    path = folder / "result.json"
    path.write_bytes(data)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            result = read_result(path)
            check_sound(result.synthesis)
            if not result.synthesis.linkages:
                return "no linkage"
            export(result.choose(), to, folder / f"out{FORMATS[to].suffix}", force=True)
    except InputError as error:
        error.where = error.where or str(path)
        check_refusal(error)
        return error.code
    return "exported"


def check_sound(result):
    """A result that is taken has ids, types and numbers of the usual form, and these agree."""
    for each in result.linkages:
        names = [each.id, *(dyad.id for dyad in each.dyads)]
        assert all(re.fullmatch(r"[A-Z]+[1-9][0-9]*", name, re.ASCII) for name in names)
        assert len(set(names)) == 3
        assert each.type in TYPES
        assert each.type == each.driver_first.type
        assert set(each.other_types) <= TYPES.keys() - {each.type}
        places = each.error.places
        assert len(places.angle) == len(result.task.poses.angle)
        assert not each.usable or np.isfinite(each.error.worst)
    held = Result.of(result)  # all that a person does with it gives no traceback
    assert all(map(str.isprintable, repr(held).splitlines()))
    json.loads(held.to_json())
    assert held._repr_html_()
    texts = (result.outcome.message, result.outcome.help or "", result.outcome.why or "")
    assert all(text == printable(text) for text in texts)
    for name in (*(result.task.names or ()), result.task.length_unit or ""):
        assert name == printable(name)
