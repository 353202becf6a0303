"""How long function generators take: five exact pairs, and all optima of more pairs.

    .venv/bin/python -m benchmarks.functions --count 20 --seed 0
    .venv/bin/python -m benchmarks.functions --count 20 --seed 0 --starts 1000

Tasks are pairs that a random linkage makes over 60 to 120 degrees of its input, with noise of half
a degree where there are more than five; and log10 x, whose residuals nearly vanish.  Told are the
median and the greatest processor time of one core, and how many critical points were reached of
all.  With --starts SciPy's minimisers begin at so many random linkages instead; told is how often
they end where nothing was found before.
"""

import argparse
import time

import numpy as np
from scipy.optimize import least_squares, minimize

from burmester.functions.critical_generators import critical_generators
from burmester.functions.exact_pairs import exact_generators
from burmester.functions.generator import Generator
from burmester.synthesis.function_generation import generate_function
from burmester.tasks.function_task import FunctionTask, SampledFunction, even_spacing


def pairs(rng, count, noise_deg):
    """Pairs of a random linkage that goes through its range on one branch."""
    while True:
        span = np.radians(rng.uniform(60, 120))
        lengths = np.exp(rng.uniform(-1, 1, (3, 1)))
        phases = rng.uniform(-np.pi, np.pi, (2, 1))
        one = Generator(*lengths, *phases, rng.choice([-1.0, 1.0], 1))
        if one.runs_through(0, span)[0]:
            inputs = np.linspace(0, span, count)
            outputs = np.unwrap(one.outputs(inputs)[0])
            return FunctionTask(inputs, outputs + np.radians(noise_deg) * rng.normal(size=count))


def logarithm(minimax):
    """log10 x from 1 to 2, 60 and 60 degrees, at 61 inputs."""
    function = SampledFunction("log10(x)", np.log10, (1, 2), np.radians(60), np.radians(60))
    return FunctionTask(*function.at(even_spacing(61)), function=function, minimax=minimax)


def measured(name, solve, tasks):
    """Print the times of a list of tasks."""
    solve(tasks[0])  # what is loaded once does not count
    times, reached = [], []
    for task in tasks:
        start = time.process_time()
        found = solve(task)
        times.append(time.process_time() - start)
        reached.append((getattr(found, "found", None), getattr(found, "solutions", None)))
    counted = [f"{a} of {b}" for a, b in reached if b]
    least = min(counted, default="")
    middle, worst = 1e3 * np.median(times), 1e3 * max(times)
    print(f"{name:34} {middle:8.1f} ms median {worst:8.1f} ms at most   {least}")


def residual(v, task):
    """|B - A| - r at pairs: zero where a linkage with links a, r, b and two phases meets them."""
    a, r, b, p, q = v
    gap = 1 + b * np.exp(1j * (q + task.outputs)) - a * np.exp(1j * (p + task.inputs))
    return np.abs(gap) - r


def freudenstein(v, task):
    """The squared residual of Freudenstein's equation for R1, R2 and two phases."""
    r1, r2, p, q = v
    theta, phi = p + task.inputs, q + task.outputs
    f = r1 * np.cos(phi) - r2 * np.cos(theta) - np.cos(theta - phi)
    return ((f - f.mean()) ** 2).sum()


def witnessed_exact(tasks, starts, rng):
    """Ends of random starts at linkages that meet five pairs, and how many of them are new."""
    ends = new = 0
    for task in tasks:
        known = exact_generators(task).generators.sizes[:, 1:]
        for _ in range(starts):
            start = [*np.exp(rng.uniform(-1.5, 1.5, 3)), *rng.uniform(-np.pi, np.pi, 2)]
            end = least_squares(residual, start, args=(task,), xtol=1e-14, ftol=1e-14)
            sizes = np.abs(end.x[:3])
            # Links without length meet all pairs, and sliders have no size to compare.
            if end.cost < 1e-24 and sizes.max() < 50 and min(sizes[0], sizes[2]) > 1e-3:
                ends += 1
                new += not (np.abs(known - sizes).max(axis=1) < 1e-4 * sizes.max()).any()
    return ends, new


def witnessed_critical(tasks, starts, rng):
    """The same for minima of Freudenstein's squared residual, by their values."""
    ends = new = 0
    for task in tasks:
        points = critical_generators(task)
        at = np.column_stack([points.ratios, points.input_phase, points.output_phase])
        known = np.array([freudenstein(v, task) for v in at[points.real]])
        for _ in range(starts):
            start = [*rng.normal(size=2), *rng.uniform(-np.pi, np.pi, 2)]
            end = minimize(freudenstein, start, args=(task,), method="BFGS", tol=1e-12)
            if np.abs(end.x[:2]).max() < 1e3 and np.abs(end.jac).max() < 1e-7:
                ends += 1
                new += not (np.abs(known - end.fun) < 1e-5 * end.fun + 1e-12).any()
    return ends, new


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--starts", type=int, default=0)
    given = parser.parse_args()
    rng = np.random.default_rng(given.seed)
    if given.starts:
        for count, noise, witnessed in ((5, 0.0, witnessed_exact), (10, 0.5, witnessed_critical)):
            tasks = [pairs(rng, count, noise) for _ in range(given.count)]
            ends, new = witnessed(tasks, given.starts // given.count, rng)
            print(f"{count} pairs, {given.count} tasks: {ends} ends of random starts, {new} new")
        raise SystemExit
    five = [pairs(rng, 5, 0.0) for _ in range(given.count)]
    measured("five pairs, all solutions", exact_generators, five)
    measured("five pairs, judged", generate_function, five)
    for count in (6, 10, 40):
        tasks = [pairs(rng, count, 0.5) for _ in range(given.count)]
        measured(f"{count} pairs, all optima", generate_function, tasks)
    measured("log10 x, 61 pairs, least squares", generate_function, [logarithm(False)])
    measured("log10 x, 61 pairs, minimax", generate_function, [logarithm(True)])
