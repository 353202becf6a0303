"""Poses that no designer has in mind, made of random rows (N, 3)."""

import numpy as np

STRANGE = {
    "anything": lambda rows, rng: rows,
    "whole numbers": lambda rows, rng: np.round(rows),
    "no turn": lambda rows, rng: rows * [1, 1, 0],
    "no travel": lambda rows, rng: rows * [0, 0, 1],
    "on a line": lambda rows, rng: rows * [1, 0, 1],
    "repeated": lambda rows, rng: rows[rng.integers(0, max(2, len(rows) // 2), len(rows))],
    "tiny": lambda rows, rng: rows * 1e-9,
    "huge": lambda rows, rng: rows * [1e9, 1e9, 1],
    "far away": lambda rows, rng: np.add(rows, [1e7, 0, 0]),
    "half turns": lambda rows, rng: np.column_stack(
        [rows[:, :2], rng.choice([0, np.pi], len(rows))]
    ),
    "two angles": lambda rows, rng: np.column_stack(
        [rows[:, :2], rng.choice([0.1, 0.7], len(rows))]
    ),
    "little turn": lambda rows, rng: rows * [1, 1, 1e-6],
    "two sliders": lambda rows, rng: np.column_stack(
        [-2 * np.cos(rows[:, 2]), 0 * rows[:, 2], rows[:, 2]]
    ),
    "rolling": lambda rows, rng: np.column_stack(
        [np.cos(rows[:, 2]), np.sin(rows[:, 2]), rows[:, 2]]
    ),
}
