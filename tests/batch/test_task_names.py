"""A task whose rows stand in two places is told, wherever they are; nothing else is."""

import numpy as np
import pytest

from burmester.batch.long_tables import TaskNames, digests, table_parts
from burmester.errors import InputError

pa = pytest.importorskip("pyarrow")
pq = pytest.importorskip("pyarrow.parquet")


def written(folder, names, ending):
    """A table with two rows a task."""
    path = str(folder / f"tasks{ending}")
    rows = np.repeat(names, 2)
    zeros = np.zeros(len(rows))
    if ending == ".parquet":
        columns = {"task": pa.array(rows.tolist()), "x": zeros, "y": zeros, "angle_deg": zeros}
        pq.write_table(pa.table(columns), path, row_group_size=64)
    else:
        lines = ["task,x,y,angle_deg", *(f"{name},0,0,0" for name in rows), ""]
        (folder / f"tasks{ending}").write_text("\n".join(lines))
    return path


def read(path, size):
    return [name for part in table_parts(path, size) for name in part.tasks.names]


def shuffled(kind, count=700):
    numbers = np.random.default_rng(0).permutation(count)
    return [f"née {each}" for each in numbers] if kind == "texts" else numbers.tolist()


@pytest.mark.parametrize("kind", ["numbers", "texts"])
@pytest.mark.parametrize("ending", [".csv", ".parquet"])
@pytest.mark.parametrize("size", [7, 64])
def test_each_name_once_in_any_order_is_read(tmp_path, kind, ending, size):
    names = shuffled(kind)
    assert read(written(tmp_path, names, ending), size) == names


@pytest.mark.parametrize("kind", ["numbers", "texts"])
@pytest.mark.parametrize("ending", [".csv", ".parquet"])
@pytest.mark.parametrize(("first", "second"), [(0, 699), (3, 650), (340, 360)])
def test_a_name_in_two_parts_is_told_with_its_row(tmp_path, kind, ending, first, second):
    for names in (shuffled(kind), sorted(shuffled(kind))):
        names[second] = names[first]
        with pytest.raises(InputError) as caught:
            read(written(tmp_path, names, ending), 7)
        assert caught.value.code == "E108"
        assert str(names[first]) in caught.value.message
        assert caught.value.where.endswith(f", row {2 * second + 1}")


@pytest.mark.parametrize("digest", [digests, lambda names: np.zeros(len(names), np.int64)])
def test_names_that_share_a_digest_are_not_the_same(digest):
    parts = [["b", "d"], ["c", "a"], ["e", "f"], ["d", "g"]]
    rows = [0, 2, 4, 6]

    def earlier(row):
        yield from (
            pa.array(part[: max(0, row - at)]) for part, at in zip(parts, rows, strict=True)
        )

    names = TaskNames(earlier, digest)
    found = [names.repeated(pa.array(part), at) for part, at in zip(parts, rows, strict=True)]
    assert found == [None, None, None, "d"]


@pytest.mark.parametrize("step", [1, -1])
def test_names_that_go_one_way_are_not_kept(step):
    def never(row):
        raise AssertionError("names were read again")

    names = TaskNames(never)
    numbers = np.arange(1000)[::step].reshape(-1, 10)
    for row, part in enumerate(np.random.default_rng(0).permuted(numbers, axis=1)):
        assert names.repeated(pa.array(part), 10 * row) is None
