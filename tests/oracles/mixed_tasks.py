"""Tasks of every sort, several of one number of poses, for what works on stacks of them."""

import numpy as np

from burmester.fourbar.dyad import PR, RP, RR
from tests.oracles.witness import random_four_bar, random_poses


def mixed_tasks(count, seed=0):
    """Rows (T, count, 3) with the names (T,) of what they are."""
    rng = np.random.default_rng([seed, count])
    shaken = rng.normal(scale=[1e-3, 1e-3, 1e-3], size=(8, count, 3))
    tasks = {}
    for k in range(4):
        linkage = random_poses(random_four_bar(rng, RR), rng, count, ordered=k > 0)
        tasks[f"four-bar {k}"] = linkage
        tasks[f"noisy four-bar {k}"] = linkage + shaken[k]
        tasks[f"rough {k}"] = rng.normal(size=(count, 3))
    for k, kind in enumerate((PR, RP)):
        linkage = random_poses(random_four_bar(rng, kind), rng, count)
        tasks[f"{kind.__name__} linkage"] = linkage
        tasks[f"noisy {kind.__name__} linkage"] = linkage + shaken[4 + k]
    general = rng.normal(size=(count, 3))
    tasks["far away"] = general * [30, 30, 1] + [2e4, -5e4, 0]
    tasks["small turns"] = general * [1, 1, 1e-3]
    tasks["translation"] = general * [1, 1, 0]
    tasks["straight translation"] = general[:, :1] * [1.0, 2.0, 0.0]
    tasks["rest"] = np.tile(general[:1], (count, 1))
    tasks["one pose twice"] = np.concatenate([general[:-1], general[:1]])
    tasks["two poses only"] = general[np.arange(count) % 2]
    turn = np.exp(1j * general[:, 2])
    about = 1 + 2j + (3 - 1j) * turn
    tasks["turn about a point"] = np.stack([about.real, about.imag, general[:, 2]], axis=-1)
    cardan = 1 + 2j + 0.5 / turn
    tasks["two sliders"] = np.stack([cardan.real, cardan.imag, general[:, 2]], axis=-1)
    tasks["two angles"] = np.stack([*general[:, :2].T, (np.arange(count) % 2) * 0.7], axis=-1)
    tasks["nothing"] = np.zeros((count, 3))
    tasks["beyond all measure"] = general * [1e70, 1.0, 1.0]
    return np.array(list(tasks.values())), list(tasks)
