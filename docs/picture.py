"""Draw docs/ten-poses.svg and -dark.svg: a linkage that carries its body through ten poses.

The animation is CSS inside the SVG: one turn of the crank, over and over.  Whoever asks for less
motion sees it stand at the first pose.  Run it from the project's root:

    .venv/bin/python docs/picture.py
"""

from pathlib import Path

import numpy as np

from burmester import read_task, synthesize
from burmester.fourbar.loop_closure import DrivenLoop

SCALE = 60.0  # pixels per unit of the poses
SECONDS = 12  # of a turn
STEPS = 180  # key frames of a turn; the browser interpolates between them
PLATE, BAR, PIN = 13.0, 7.5, 4.5  # pixels: half the width of plate and bars, radius of pins
MARGIN = 14.0  # pixels around everything that moves

COLOURS = {
    "ten-poses.svg": {
        "ink": "#24303c",
        "paper": "#ffffff",
        "faint": "#8a97a5",
        "plate": "#2f6fd0",
        "crank": "#e0782f",
        "follower": "#5b6a79",
    },
    "ten-poses-dark.svg": {
        "ink": "#dbe4ee",
        "paper": "#0d1117",
        "faint": "#6f7d8c",
        "plate": "#5c9bff",
        "crank": "#f2994a",
        "follower": "#9aa9b8",
    },
}

STYLE = """
.body, .crank, .follower, .pose {{ animation: {seconds}s linear infinite; }}
.body {{ animation-name: body; }}
.crank {{ animation-name: crank; }}
.follower {{ animation-name: follower; }}
.pose {{ animation-name: pass; opacity: 0.32; }}
@keyframes pass {{ 0% {{ opacity: 1; }} 14%, 96% {{ opacity: 0.32; }} 100% {{ opacity: 1; }} }}
@media (prefers-reduced-motion: reduce) {{ * {{ animation-play-state: paused !important; }} }}
"""


def seen(points):
    """Points of the plane (n, 2) as pixels, y downwards."""
    return SCALE * np.asarray(points) * (1, -1)


def line(points):
    return "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points)


def rounded(points, radius):
    """The outline of a convex polygon (n, 2) in pixels, widened by a radius."""
    points = np.asarray(points)
    edges = np.roll(points, -1, axis=0) - points
    if np.linalg.det(edges[:2]) < 0:
        return rounded(points[::-1], radius)
    outward = radius * np.stack([edges[:, 1], -edges[:, 0]], -1) / np.hypot(*edges.T)[:, None]
    parts = []
    for k in range(len(points)):
        start, end = points[k] + outward[k - 1], points[k] + outward[k]
        step = "M" if k == 0 else "L"
        parts.append(
            f"{step}{start[0]:.1f} {start[1]:.1f}A{radius} {radius} 0 0 1 {end[0]:.1f} {end[1]:.1f}"
        )
    return "".join(parts) + "Z"


def keyframes(name, frames):
    steps = "".join(f"{100 * k / STEPS:.4g}%{{transform:{f}}}" for k, f in enumerate(frames))
    return f"@keyframes {name}{{{steps}}}"


def placed(place, angle):
    """A CSS transform: from the body's pixels to those of the ground."""
    x, y = seen(place)
    return f"translate({x:.2f}px,{y:.2f}px) rotate({-np.degrees(angle):.2f}deg)"


def disc(point, radius, more):
    return f'<circle cx="{point[0]:.1f}" cy="{point[1]:.1f}" r="{radius}" {more}/>'


def one_turn(linkage, poses):
    """Crank angles (STEPS + 1,), the coupler's places then, and at which share each pose is met."""
    crank, loop = linkage.first, DrivenLoop.of(linkage)
    pins = poses.act(crank.moving_pivot) - crank.fixed_pivot
    meets = np.unwrap(np.arctan2(pins[:, 1], pins[:, 0]))
    sense = np.sign(meets[-1] - meets[0])
    angle = meets[0] + sense * np.linspace(0, 2 * np.pi, STEPS + 1)
    both = loop.closed_at(angle[:, None])
    ways = both.translation.reshape(STEPS + 1, 2, 2)
    away = np.hypot(*np.moveaxis(ways - poses.translation[0], -1, 0)).min(axis=0)
    way = int(away.argmin())
    turned = np.unwrap(both.angle.reshape(STEPS + 1, 2)[:, way])
    return angle, ways[:, way], turned, (sense * (meets - meets[0]) / (2 * np.pi)) % 1.0


def picture(linkage, poses, colour):
    crank, follower = linkage.first, linkage.second
    angle, places, turned, share = one_turn(linkage, poses)
    a, b = seen(crank.moving_pivot), seen(follower.moving_pivot)
    plate = rounded([a, b, (0.0, 0.0)], PLATE)
    # Paths of the three points of the body: a circle, an arc, the coupler curve.
    c, s = np.cos(turned), np.sin(turned)

    def path(point):
        x, y = point
        return places + np.stack([c * x - s * y, s * x + c * y], -1)

    far = path(follower.moving_pivot)
    swing = np.unwrap(np.arctan2(*(far - follower.fixed_pivot).T[::-1]))

    def bar(radius):
        return rounded([(0.0, 0.0), (SCALE * float(radius), 0.0)], BAR)

    def turning(dyad, angles):
        return [placed(dyad.fixed_pivot, value) for value in angles]

    bodies = [placed(*each) for each in zip(places, turned, strict=True)]
    style = STYLE.format(seconds=SECONDS) + "\n".join(
        [
            keyframes("body", bodies),
            keyframes("crank", turning(crank, angle)),
            keyframes("follower", turning(follower, swing)),
        ]
    )
    thin = f'fill="none" stroke="{colour["faint"]}"'
    parts = [
        f'<path d="{line(seen(path(crank.moving_pivot)))}" {thin} stroke-width="1" opacity="0.6"/>',
        f'<path d="{line(seen(far))}" {thin} stroke-width="1" opacity="0.6"/>',
    ]
    for k in range(len(poses.angle)):
        parts.append(
            f'<g class="pose" style="animation-delay:{(share[k] - 1) * SECONDS:.2f}s">'
            f'<path d="{plate}" style="transform:{placed(poses.translation[k], poses.angle[k])}" '
            f'fill="{colour["plate"]}" fill-opacity="0.18" stroke="{colour["plate"]}" '
            'stroke-width="1.3"/></g>'
        )
    parts.append(
        f'<path d="{line(seen(places))}" fill="none" stroke="{colour["ink"]}" '
        'stroke-width="1.6" stroke-dasharray="1 5" stroke-linecap="round"/>'
    )
    dot = f'fill="{colour["plate"]}" stroke="{colour["paper"]}" stroke-width="1"'
    parts.extend(disc(point, 4, dot) for point in seen(poses.translation))
    for dyad in (crank, follower):
        x, y = seen(dyad.fixed_pivot)
        parts.append(
            f'<path d="M{x:.1f} {y:.1f}l-13 22h26z" fill="{colour["paper"]}" '
            f'stroke="{colour["ink"]}" stroke-width="2" stroke-linejoin="round"/>'
            f'<path d="M{x - 20:.1f} {y + 22:.1f}h40" stroke="{colour["ink"]}" stroke-width="2" '
            'stroke-linecap="round"/>'
        )
    for name, dyad in (("follower", follower), ("crank", crank)):
        parts.append(
            f'<path class="{name}" d="{bar(dyad.radius)}" fill="{colour[name]}" '
            f'stroke="{colour["paper"]}" stroke-width="1.5"/>'
        )
    pin = f'fill="{colour["paper"]}" stroke="{colour["ink"]}" stroke-width="2"'
    parts.append(
        f'<g class="body"><path d="{plate}" fill="{colour["plate"]}" fill-opacity="0.82" '
        f'stroke="{colour["paper"]}" stroke-width="1.5"/>'
        + disc(a, PIN, pin)
        + disc(b, PIN, pin)
        + disc((0.0, 0.0), 3.5, f'fill="{colour["ink"]}"')
        + "</g>"
    )
    for dyad in (crank, follower):
        parts.append(disc(seen(dyad.fixed_pivot), PIN, pin))
    grounds = [dyad.fixed_pivot for dyad in (crank, follower)]
    extent = seen(np.vstack([places, far, path(crank.moving_pivot), *grounds]))
    low, high = extent.min(axis=0) - PLATE - MARGIN, extent.max(axis=0) + PLATE + MARGIN
    width, height = np.ceil(high - low)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{low[0]:.0f} {low[1]:.0f} {width:.0f} '
        f'{height:.0f}" width="{width:.0f}" height="{height:.0f}" role="img">\n'
        "<title>A crank-rocker carries its body through ten poses</title>\n"
        f"<style>{style}</style>\n" + "\n".join(parts) + "\n</svg>\n"
    )


def pictures(poses="examples/poses.csv"):
    """Both pictures by their names."""
    result = synthesize(read_task(poses))
    linkage = result.linkages[0].linkage
    return {name: picture(linkage, result.task.poses, colour) for name, colour in COLOURS.items()}


def main():
    for name, drawn in pictures().items():
        Path("docs", name).write_text(drawn)


if __name__ == "__main__":
    main()
