"""Function generators under requirements, against SciPy's SLSQP.

    .venv/bin/python -m benchmarks.function_requirements
    .venv/bin/python -m benchmarks.function_requirements --count 40 --seed 0 --starts 24

Tasks are the published ones of TABLE, and as many as --count says drawn at random: a function, its
range, how far the links turn, and what the linkage has to keep (transmission angle, link ratio,
type).  SLSQP takes the greatest error (or, for least squares, their sum of squares) as objective
and all that is asked as constraints, with errors by an arccosine of its own; it begins at the
critical points of Freudenstein's residual, at the further starts of the program, and at random
linkages.  What it finds is checked at 721 places.  Told is for each task the best of both; the last
line counts the tasks for which the program says none though SLSQP finds one, and those for which it
is more than 5 % worse.
"""

import argparse
import time
import warnings

import numpy as np
from scipy.optimize import minimize

from burmester.fourbar.linkage import TYPE_OF_SIGNS
from burmester.functions.critical_generators import critical_generators
from burmester.functions.exact_pairs import generators_of_phases
from burmester.functions.nearest_generators import FurtherStarts
from burmester.numerics.arrays import concatenate
from burmester.synthesis.function_generation import generate_function
from burmester.tasks.function_task import FunctionTask, SampledFunction, even_spacing
from burmester.tasks.requirements import Requirements

# Function, range of x, degrees of input and output, and the greatest error with 30 degrees of
# transmission that a search by SLSQP alone had found, degrees.
TABLE = [
    ("sqrt(x)", np.sqrt, (1, 4), 80, 80, 0.064),
    ("tan(x)", np.tan, (0, np.pi / 4), 90, 90, 0.25),
    ("1/x", np.reciprocal, (1, 2), 90, 90, 0.345),
    ("1/x", np.reciprocal, (1, 3), 60, 60, 1.33),
    ("cos(x)", np.cos, (0, np.pi / 2), 90, 90, 1.72),
    ("log10(x)", np.log10, (1, 10), 90, 90, 2.27),
    ("log(x)", np.log, (1, 2), 90, 90, 0.038),
]
FUNCTIONS = [
    ("sqrt(x)", np.sqrt, (0.2, 2), (3, 9)),
    ("x**2", np.square, (-0.3, 1), (1.5, 4)),
    ("x**1.5", lambda x: x**1.5, (0, 1), (1.5, 5)),
    ("x**3", lambda x: x**3, (-1, 0.5), (0.8, 2)),
    ("1/x", np.reciprocal, (0.7, 1.5), (2, 4)),
    ("log(x)", np.log, (0.5, 1.5), (2, 8)),
    ("exp(x)", np.exp, (-1, 0), (0.8, 2)),
    ("sin(x)", np.sin, (-0.5, 0.5), (1.2, 2.4)),
    ("cos(x)", np.cos, (-0.3, 0.5), (1.2, 2.4)),
    ("tan(x)", np.tan, (-0.6, 0.2), (0.6, 1.1)),
    ("atan(x)", np.arctan, (-1, 0.5), (1, 4)),
]
PAIRS = 61
PLACES = 721  # at which what SLSQP found is checked
LEAST = 1.0  # degree of transmission, below which neither looks
WORSE = 1.05


def task_of(values, x, input_deg, output_deg, *, minimax=False, output_phase=None, **asked):
    """The task of a function at 61 even inputs; asked: of `Requirements`."""
    function = SampledFunction("f", values, x, np.radians(input_deg), np.radians(output_deg))
    return FunctionTask(
        *function.at(even_spacing(PAIRS)),
        function=function,
        minimax=minimax,
        output_phase=output_phase,
        requirements=Requirements(**asked),
    )


def drawn(rng):
    """A task at random, and its name."""
    name, values, low, high = FUNCTIONS[rng.integers(len(FUNCTIONS))]
    x = (round(rng.uniform(*low), 2), round(rng.uniform(*high), 2))
    turns = rng.choice([45, 60, 75, 90, 110], 2)
    sign = rng.choice([1, -1])
    least = rng.choice([0, 20, 30, 35, 40, 45])
    ratio = rng.choice([0, 4, 6, 10], p=[0.4, 0.2, 0.2, 0.2])
    kinds = [None, "double-rocker", "crank-rocker", "double-crank", "triple-rocker"]
    kind = kinds[rng.choice(5, p=[0.6, 0.1, 0.1, 0.1, 0.1])]
    minimax = bool(rng.random() < 0.7)
    task = task_of(
        values, x, turns[0], sign * turns[1], minimax=minimax,
        transmission_deg=float(least),
        link_ratio=float(ratio) if ratio else np.inf,
        types={kind} if kind else None,
    )  # fmt: skip
    norm = "minimax" if minimax else "rms"
    asks = f"{least}° ratio {ratio or '-'} {kind or 'any type'}"
    return f"{name} {x[0]:g}:{x[1]:g} {turns[0]}/{sign * turns[1]} {norm} {asks}", task


def made(v, side, inputs):
    """The outputs of links and phases v (5,) with logarithms of lengths, and the cosines there."""
    a, r, b = np.exp(v[:3])
    to = a * np.exp(1j * (v[3] + inputs)) - 1  # from the output's pivot to the input's pin
    size = np.abs(to)
    cosine = (b * b + size**2 - r * r) / (2 * b * size)
    turn = to * np.exp(-1j * side * np.arccos(np.clip(cosine, -1, 1)) - 1j * v[4])
    return turn, (r * r + b * b - size**2) / (2 * r * b), np.abs(cosine).max()


def signs_of(kinds):
    return [s for s, name in TYPE_OF_SIGNS.items() if name in kinds]


def sums(v):
    g, a, r, b = 1.0, *np.exp(v[:3])
    return np.array([g - a + r - b, g - a - r + b, r + b - g - a]) / (g + a + r + b)


def slsqp(task, start, side, signs):
    """The end of a descent from v (5,), its error; infinite where it keeps not what is asked."""
    least = max(task.requirements.transmission, np.radians(LEAST))
    ratio = min(task.requirements.link_ratio, 1e4)

    def errors(v, inputs, outputs):
        return np.angle(made(v, side, inputs)[0] * np.exp(-1j * outputs))

    def kept(v):
        cosine = made(v, side, task.inputs)[1]
        size = np.append(v[:3], 0.0)
        rows = [np.cos(least) - cosine, np.cos(least) + cosine,
                np.log(ratio) - (size[:, None] - size).ravel()]  # fmt: skip
        if signs is not None:
            rows.append(np.array(signs) * sums(v) - 1e-3)
        return np.concatenate(rows)

    if not np.isfinite(errors(start, task.inputs, task.outputs)).all():
        return start, np.inf
    unit = np.radians(1.0)
    bounds = [(-np.log(10), np.log(10))] * 3 + [(-20, 20)] * 2
    if task.minimax:
        first = np.append(start, np.abs(errors(start, task.inputs, task.outputs)).max() / unit)
        constraints = [
            {"type": "ineq", "fun": kept},
            {"type": "ineq", "fun": lambda v: v[5] - errors(v, task.inputs, task.outputs) / unit},
            {"type": "ineq", "fun": lambda v: v[5] + errors(v, task.inputs, task.outputs) / unit},
        ]
        end = minimize(lambda v: v[5], first, method="SLSQP", constraints=constraints,
                       bounds=[*bounds, (0, None)], options={"maxiter": 150})  # fmt: skip
    else:
        end = minimize(
            lambda v: ((errors(v, task.inputs, task.outputs) / unit) ** 2).mean(), start,
            method="SLSQP", constraints=[{"type": "ineq", "fun": kept}], bounds=bounds,
            options={"maxiter": 150, "ftol": 1e-10},
        )  # fmt: skip
    v = end.x[:5]
    inputs = np.linspace(*task.input_ends, PLACES)
    _, cosine, reach = made(v, side, inputs)
    size = np.append(v[:3], 0.0)
    good = np.isfinite(v).all() and reach < 1 and np.abs(cosine).max() < np.cos(least) + 1e-5
    good = good and np.ptp(size) < np.log(ratio) + 1e-5
    if signs is not None:
        good = good and (np.array(signs) * sums(v) > 0).all()
    if not good:
        return v, np.inf
    error = errors(v, task.inputs, task.outputs)
    return v, float(np.abs(error).max() if task.minimax else np.sqrt((error**2).mean()))


def witnessed(task, starts, rng, *, every=1):
    """The least error of SLSQP from the same starts as the program's and from random ones.

    every: which of the former are taken, such as 4 for each fourth.
    """
    points = critical_generators(task)
    same, _ = generators_of_phases(task, points.input_phase, points.output_phase)
    same = same[np.isfinite(same.sizes).all(axis=-1)]
    same = same.with_better_side(task.inputs, task.outputs)
    wanted = task.requirements
    same = concatenate([same, FurtherStarts.of(task).near(wanted.bounds, 16)])
    begins = [
        (np.array([np.log(g.input_link), np.log(g.coupler), np.log(g.output_link), g.input_phase,
                   g.output_phase]), float(g.side))
        for g in (same[k] for k in range(0, len(same), every))
    ]  # fmt: skip
    begins += [
        (np.append(rng.uniform(-1.5, 1.5, 3), rng.uniform(-np.pi, np.pi, 2)), rng.choice([1, -1]))
        for _ in range(starts)
    ]
    best = np.inf
    for start, side in begins:
        start[:3] = np.clip(start[:3], -2.3, 2.3)
        for signs in signs_of(task.types) if task.types else [None]:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                best = min(best, slsqp(task, start, side, signs)[1])
    return best


def best_of(task):
    """The least error of a usable linkage of the program, in the same norm."""
    errors = [each.errors for each in generate_function(task).usable]
    if task.minimax:
        return min((float(np.abs(e).max()) for e in errors), default=np.inf)
    return min((float(np.sqrt((e**2).mean())) for e in errors), default=np.inf)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--starts", type=int, default=24)
    given = parser.parse_args()
    rng = np.random.default_rng(given.seed)
    tasks = []
    for name, values, x, turn, made_turn, known in TABLE:
        task = task_of(values, x, turn, made_turn, minimax=True, transmission_deg=30)
        tasks.append((f"{name} {x[0]:g}:{x[1]:.4g} {turn}/{made_turn} table {known}°", task))
    tasks += [drawn(rng) for _ in range(given.count)]
    none, worse, better, seconds = [], [], 0, []
    for name, task in tasks:
        begun = time.process_time()
        ours = best_of(task)
        seconds.append(time.process_time() - begun)
        theirs = witnessed(task, given.starts, rng)
        mark = ""
        if np.isfinite(theirs) and not np.isfinite(ours):
            none.append(name)
            mark = "NONE"
        elif ours > WORSE * theirs + 1e-9:
            worse.append(name)
            mark = "WORSE"
        elif ours < theirs / WORSE:
            better += 1
        degrees = f"{np.degrees(ours):9.4g}° SLSQP {np.degrees(theirs):9.4g}°"
        print(f"{name:62} {degrees} {seconds[-1]:5.1f} s {mark}", flush=True)
    print(
        f"{len(tasks)} tasks: {len(none)} none where SLSQP finds one, {len(worse)} more than 5 % "
        f"worse, {better} more than 5 % better; {np.median(seconds):.1f} s median"
    )
