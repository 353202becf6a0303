// The plane as a picture: what it has to hold, its scale in pixels, and the signs of kinematics.

import { s } from "./dom.mjs";
import { act } from "./kinematics.mjs";
import { markPoints } from "./load_marks.mjs";
import { degrees, px } from "./numbers.mjs";
import { pointOnLine, travelOf } from "./travel.mjs";

export const AXIS = 26; // pixels: the x axis of a pose
export const BLOCK = [22, 14]; // pixels: a slider's length and height
const WIDEST = 4; // sizes of the scene: a point farther from its middle is far, and does not widen the picture

/** Tells of a point whether it is too far from the poses to widen the picture unasked. */
export function farFrom(data) {
  const [x, y] = ["x", "y"].map((k) => {
    const [low, high] = data.poses.reduce(([a, b], pose) => [Math.min(a, pose[k]), Math.max(b, pose[k])], [Infinity, -Infinity]);
    return (low + high) / 2;
  });
  return (point) => !(Math.hypot(point[0] - x, point[1] - y) < WIDEST * data.scene);
}

/** The pivots of a linkage at some places: { dyad, fixed, at } each; a slot of the body by its ends. */
export function pivotsAt(linkage, places) {
  const found = [];
  for (const dyad of linkage.led) {
    if (dyad.fixed_pivot) found.push({ dyad, fixed: true, at: dyad.fixed_pivot });
    const own = dyad.moving_pivot
      ? [dyad.moving_pivot]
      : dyad.kind === "RP" && places.length ? travelOf(dyad, places).map((end) => pointOnLine(dyad, end)) : [];
    for (const point of own) for (const place of places) found.push({ dyad, fixed: false, at: act(place, point) });
  }
  for (const { joints } of places) for (const at of Object.values(joints ?? {})) found.push({ fixed: false, at });
  return found;
}

/** The box of everything that the picture has to hold: [x low, y low, x high, y high].
 *
 * places: those that the linkage takes; far: whether far pivots widen it, too.
 */
export function boundsOf(data, linkage, places, far) {
  const isFar = farFrom(data), box = [Infinity, Infinity, -Infinity, -Infinity];
  const include = ([x, y]) => {
    if (!Number.isFinite(x + y) || (!far && isFar([x, y]))) return;
    box[0] = Math.min(box[0], x);
    box[1] = Math.min(box[1], y);
    box[2] = Math.max(box[2], x);
    box[3] = Math.max(box[3], y);
  };
  for (const pose of data.poses) include([pose.x, pose.y]);
  if (linkage) {
    for (const row of linkage.pose_errors) if (row.x !== null) include([row.x, row.y]);
    for (const place of places) include([place.x, place.y]);
    for (const { at } of pivotsAt(linkage, places)) include(at);
    for (const at of markPoints(data, places)) include(at);
  }
  const least = 0.25 * data.scene;
  for (const k of [0, 1]) {
    const lack = least - (box[k + 2] - box[k]);
    if (lack > 0) {
      box[k] -= lack / 2;
      box[k + 2] += lack / 2;
    }
  }
  return box;
}

/** From the plane to pixels, as large as it fits: the scale, and X and Y of a point. */
export function viewOf(box, width, height, margin) {
  const scale = Math.min(
    (width - 2 * margin) / (box[2] - box[0]),
    (height - 2 * margin) / (box[3] - box[1]),
  );
  const left = width / 2 - (scale * (box[0] + box[2])) / 2;
  const top = height / 2 + (scale * (box[1] + box[3])) / 2;
  return { scale, left, top, width, height, X: (x) => left + scale * x, Y: (y) => top - scale * y };
}

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
