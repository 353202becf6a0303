"""Draw docs/ten-poses.svg: the paper's ten poses and the four-bar found for them.

Run it from the project's root: .venv/bin/python docs/picture.py
"""

from pathlib import Path

import numpy as np

from burmester import Displacement, synthesize
from burmester.io.reading.poses import read_task

LINE = '<path d="{d}" fill="none" stroke="{stroke}" stroke-width="{width}" {more}/>'
SCALE, MARGIN = 90.0, 40.0


def main() -> None:
    synthesis = synthesize(read_task("examples/poses.csv"))
    linkage, poses = synthesis.linkages[0].linkage, synthesis.task.poses
    first, second = linkage.first, linkage.second

    def path(points, closed=False):
        steps = " L".join(f"{SCALE * x:.1f},{-SCALE * y:.1f}" for x, y in points)
        return f"M{steps}" + ("Z" if closed else "")

    def draw(points, stroke, width, more="", closed=False):
        d = path(points, closed)
        return LINE.format(d=d, stroke=stroke, width=width, more=more)

    parts = []
    # The motion of the coupler: one turn of the crank, the assembly that holds the poses.
    crank = np.linspace(0, 2 * np.pi, 721)
    turn = np.stack([np.cos(crank), np.sin(crank)], axis=-1)
    pins = first.fixed_pivot + first.radius * turn
    reach = first.moving_pivot - second.moving_pivot
    coupler, gap = np.hypot(*reach), pins - second.fixed_pivot
    size = np.hypot(gap[:, 0], gap[:, 1])
    bend = np.arccos((coupler**2 + size**2 - second.radius**2) / (2 * coupler * size))
    for side in (1, -1):
        toward = np.arctan2(-gap[:, 1], -gap[:, 0]) + side * bend
        angle = toward - np.arctan2(-reach[1], -reach[0])
        spin = Displacement(np.zeros((len(angle), 2)), angle)
        curve = pins - spin.act(first.moving_pivot)
        if np.hypot(*(curve - poses.translation[0]).T).min() < 0.05:
            parts.append(draw(curve, "#7a8aa0", 2, 'stroke-dasharray="2 5"'))
    for k in range(len(poses.angle)):
        axes = poses[k].act(np.array([[0.38, 0], [0, 0], [0, 0.22]]))
        parts.append(draw(axes, "#c0392b", 3, 'stroke-linecap="round"'))
    at = 2
    a, b = poses[at].act(first.moving_pivot), poses[at].act(second.moving_pivot)
    body = [a, b, poses.translation[at]]
    parts.append(
        f'<path d="{path(body, True)}" fill="#2c6fbb" fill-opacity="0.13" '
        'stroke="#2c6fbb" stroke-width="3"/>'
    )
    for dyad, pin in ((first, a), (second, b)):
        parts.append(draw([dyad.fixed_pivot, pin], "#22303c", 7, 'stroke-linecap="round"'))
    for x, y in (first.fixed_pivot, second.fixed_pivot):
        foot = [(x, y), (x - 0.14, y - 0.24), (x + 0.14, y - 0.24)]
        parts.append(draw(foot, "#22303c", 3, closed=True))
    for x, y in (first.fixed_pivot, second.fixed_pivot, a, b):
        parts.append(
            f'<circle cx="{SCALE * x:.1f}" cy="{-SCALE * y:.1f}" r="7" fill="#ffffff" '
            'stroke="#22303c" stroke-width="3"/>'
        )
    corners = np.vstack([poses.translation, first.fixed_pivot, second.fixed_pivot, a, b])
    low, high = corners.min(axis=0) - 0.45, corners.max(axis=0) + 0.45
    width, height = SCALE * (high - low)
    box = f"{SCALE * low[0]:.0f} {-SCALE * high[1]:.0f} {width:.0f} {height:.0f}"
    Path("docs/ten-poses.svg").write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}" width="{width:.0f}" '
        f'height="{height:.0f}" role="img">\n<title>Ten poses and the crank-rocker that guides '
        f'the body through them</title>\n<rect x="{SCALE * low[0]:.0f}" y="{-SCALE * high[1]:.0f}" '
        'width="100%" height="100%" fill="#ffffff"/>\n' + "\n".join(parts) + "\n</svg>\n"
    )


main()
