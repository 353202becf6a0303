"""Linkages drawn at random, with the poses that they lead through, as the tasks of a batch."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import asdict, dataclass, field
from typing import Any, final

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from burmester import __version__
from burmester.batch.answer_rows import structs
from burmester.batch.manifest import digest_of
from burmester.batch.parts import DrawnTasks, Part, TableTasks
from burmester.batch.schema import DYAD, POSE
from burmester.batch.sources import Source
from burmester.errors import InputError
from burmester.numerics.arrays import FloatArray
from burmester.stacked.datasheet import datasheet
from burmester.stacked.random_linkages import RandomLinkages, SampleOptions, random_linkages

_POSES = pa.list_(POSE)
# What was drawn, behind the columns of every batch.
DRAWN = pa.schema(
    [
        ("given", _POSES),
        ("exact_poses", _POSES),
        ("drawn_type", pa.string()),
        ("drawn_dyads", pa.list_(DYAD)),
        ("drawn_transmission_deg", pa.float64()),
        ("inputs_deg", pa.list_(pa.float64())),
        ("curve", _POSES),
    ]
)
MOST = 10**12  # linkages


@final
@dataclass(frozen=True, slots=True)
class Sample:
    """So many random usable four-bars, each a task through the poses that it leads through.

    count: how many; options: what is drawn, see `SampleOptions`.

    Raises
    ------
    InputError
        E134.

    Examples
    --------
    >>> Sample.of(1000, seed=7, poses=10, noise=1e-3).options.poses
    10
    """

    count: int
    options: SampleOptions = field(default_factory=SampleOptions)

    def __post_init__(self) -> None:
        if not 0 < self.count <= MOST:
            raise InputError(
                "E134", f"a sample of {self.count} linkages", help="give a count above zero"
            )

    @classmethod
    def of(cls, count: int, **options: Any) -> Sample:
        """A sample with options by their names."""
        return cls(count, SampleOptions(**options))

    @property
    def data(self) -> dict[str, Any]:
        """What is drawn, as plain data."""
        options = json.loads(json.dumps(asdict(self.options)))
        return {"count": self.count, **options}

    @property
    def datasheet(self) -> str:
        """How the linkages are drawn, for whoever gets the files."""
        return datasheet(self.options, self.count, __version__) + COLUMNS


COLUMNS = """
## Columns

`task` is the number of the linkage. `given` holds its poses with their errors, which the answers
in the row are of, `exact_poses` those without. `drawn_type`, `drawn_dyads` (the driver first) and
`drawn_transmission_deg` are the linkage, `inputs_deg` the driver's angles at the poses, `curve` the
places along the coupler curve. The longest link is the unit of length, angles are degrees. No task
was left out: how its answer ended is in `outcome`.
"""


def sample_source(sample: Sample) -> Source:
    """The draws as a source of tasks."""

    def parts(size: int) -> Iterator[Part]:
        for number, first in enumerate(range(0, sample.count, size)):
            end = min(first + size, sample.count)
            tasks = DrawnTasks(sample.options, range(first, end))
            yield Part(number, tasks, end / sample.count)

    told = {"draws": sample.data}
    return Source("sample", "sample", digest_of(sample.data), parts, told=told)


def drawn_table(tasks: DrawnTasks) -> tuple[TableTasks, RandomLinkages]:
    """The poses of draws as a table, and what was drawn."""
    found = random_linkages(tasks.recipe, np.array(tasks.numbers, dtype=np.int64))
    count, poses = found.poses.shape[:2]
    table = TableTasks(
        found.number,
        np.arange(count + 1, dtype=np.int64) * poses,
        found.poses.reshape(-1, 3),
        None,
        None,
        degrees=False,
        label="the sample",
    )
    return table, found


def drawn_columns(found: RandomLinkages) -> list[Any]:
    """The columns of `DRAWN`."""
    from burmester.fourbar.linkage import TYPES  # noqa: PLC0415

    types = pa.array(TYPES, pa.string()).take(pa.array(found.type, pa.int32()))
    return [
        _poses(found.poses),
        _poses(found.exact_poses),
        types,
        _lists(_dyads(found), 2),
        pa.array(found.transmission_deg),
        _lists(pa.array(np.degrees(found.inputs).ravel()), found.inputs.shape[1]),
        _poses(found.curve),
    ]


def _lists(values: Any, each: int) -> Any:
    """Values as lists of the same length."""
    offsets = np.arange(len(values) // each + 1, dtype=np.int32) * each
    return pa.ListArray.from_arrays(pa.array(offsets), values)


def _poses(places: FloatArray) -> Any:
    """Places (T, N, 3), radians, as lists of poses."""
    count, each = places.shape[:2]
    x, y, angle = places.reshape(-1, 3).T
    if not each:
        return pa.array([[]] * count, _POSES)
    columns = {"x": x, "y": y, "angle_deg": np.degrees(angle)}
    return _lists(structs(POSE, len(x), columns), each)


def _dyads(found: RandomLinkages) -> Any:
    """The dyads of the linkages, two a linkage, as values of `DYAD`."""
    kinds = found.linkages.kinds.ravel()
    numbers = found.linkages.dimensions.reshape(len(kinds), -1)
    pin = kinds == 0
    one, two, moving_x, moving_y, length = numbers.T[:5]

    def of(which: NDArray[np.bool_], values: FloatArray) -> FloatArray:
        return np.where(which, values, np.nan)

    columns = {
        "kind": np.where(pin, "RR", "PR"),
        "fixed_x": of(pin, one),
        "fixed_y": of(pin, two),
        "moving_x": moving_x,
        "moving_y": moving_y,
        "length": of(pin, length),
        "normal_deg": of(~pin, np.degrees(one)),
        "offset": of(~pin, two),
    }
    return structs(DYAD, len(kinds), columns)
