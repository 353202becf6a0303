// The signs of kinematics, in pixels.

import { s } from "./dom.mjs";
import { degrees, px } from "./numbers.mjs";

export const AXIS = 26; // pixels: the x axis of a pose
export const BLOCK = [22, 14]; // pixels: a slider's length and height

/** Where a part stands, in pixels, and its angle in radians. */
export const transform = (x, y, angle) => `translate(${px(x)} ${px(y)}) rotate(${px(degrees(-angle))})`;

/** A fixed pivot on the ground: a hatched foot. */
export function foot() {
  let hatch = "";
  for (let k = -2; k <= 2; k += 1) hatch += `M${5.5 * k + 3} 16l-6 7`;
  return s(
    "g",
    { class: "bm-foot" },
    s("path", { class: "bm-solid", d: "M0 0L-10 16H10Z" }),
    s("path", { class: "bm-ground", d: `M-16 16H16${hatch}` }),
  );
}

/** The frame of a pose or of the body: x axis with a head, y axis shorter without one. */
export function axes(length) {
  const l = length, head = Math.max(4, 0.22 * length);
  return `M0 0H${l}m${-head} ${-head / 2}l${head} ${head / 2}l${-head} ${head / 2}M0 0V${-0.6 * l}`;
}

/** A path through points, in pieces where some are missing. */
export function polyline(points, view) {
  let path = "", pen = "M";
  for (const [x, y] of points) {
    if (!Number.isFinite(x) || !Number.isFinite(y)) {
      pen = "M";
      continue;
    }
    path += `${pen}${px(view.X(x))} ${px(view.Y(y))}`;
    pen = "L";
  }
  return path;
}

/** The convex hull of a few points. */
export function hull(points) {
  const sorted = [...points].sort((p, q) => p[0] - q[0] || p[1] - q[1]);
  const half = (list) => {
    const kept = [];
    for (const point of list) {
      while (kept.length > 1) {
        const [a, b] = kept.slice(-2);
        if ((b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0]) > 0) break;
        kept.pop();
      }
      kept.push(point);
    }
    return kept.slice(0, -1);
  };
  const corners = [...half(sorted), ...half(sorted.reverse())];
  return corners.length ? corners : sorted.slice(0, 1);
}
