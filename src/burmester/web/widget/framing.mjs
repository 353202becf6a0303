// What a picture holds, and how large: computed here for the report, the studio and notebooks.

import { act } from "./kinematics.mjs";
import { markPoints } from "./load_marks.mjs";
import { radians } from "./numbers.mjs";
import { pointOnLine, travelOf } from "./travel.mjs";

const WIDEST = 4; // sizes of the scene: a point farther from its middle is far, and does not widen the picture
const ROOM = 2.5; // sizes of what is near: as large as that a picture gets for all of the rest
const SPARE = 0.75; // of the size of what is near: so far it reaches for a rest that is larger
const LEAST = 0.25; // sizes of the scene that a picture holds at least
const MOST_PLACES = 400; // of the motion whose outlines the picture is made to hold; its margin holds those between
const INSET = 12; // pixels from the edge of a picture to a mark there

/** The box of points: [x low, y low, x high, y high]. */
export const bounds = (points) =>
  points.reduce(([x, y, u, v], [a, b]) => (Number.isFinite(a + b) ? [Math.min(x, a), Math.min(y, b), Math.max(u, a), Math.max(v, b)] : [x, y, u, v]), [Infinity, Infinity, -Infinity, -Infinity]);

/** Where the body is at every pose k: the place that a linkage takes for it, or else the pose itself, if it has an angle. */
export const placesAtPoses = (data, linkage) =>
  data.poses.flatMap((pose, k) => {
    const row = linkage?.pose_errors[k], at = row && row.x !== null ? row : pose;
    return at.angle_deg === null ? [] : [{ x: at.x, y: at.y, a: radians(at.angle_deg), k }];
  });

/** Tells of a point whether it is too far from the poses to widen the picture unasked: farther than the body reaches, too. */
export function farFrom(data) {
  const [x, y, u, v] = bounds(data.poses.map((pose) => [pose.x, pose.y])), reach = (data.body ?? []).reduce((most, [a, b]) => Math.max(most, Math.hypot(a, b)), 0);
  return (point) => !(Math.hypot(point[0] - (x + u) / 2, point[1] - (y + v) / 2) < Math.max(WIDEST * data.scene, reach));
}

/** The pivots of a linkage at some places, points of F: its fixed ones, and the moving ones; a slot of the body by its ends. */
export function pivotsAt(linkage, places) {
  const fixed = linkage.led.flatMap((dyad) => (dyad.fixed_pivot ? [dyad.fixed_pivot] : []));
  const own = linkage.led.flatMap((dyad) => (dyad.moving_pivot ? [dyad.moving_pivot] : dyad.kind === "RP" && places.length ? travelOf(dyad, places).map((end) => pointOnLine(dyad, end)) : []));
  return [...fixed, ...places.flatMap((place) => [...own.map((point) => act(place, point)), ...Object.values(place.joints ?? {})])];
}

/** Points of F that a picture has to hold: poses, what is near of the linkage at its places, and the body wholly at its poses and along them.
 *
 * far: far pivots, too; close: without the body. */
export function nearPoints(data, linkage, places, { far = false, close = false } = {}) {
  const isFar = farFrom(data), seen = (point) => far || !isFar(point);
  const reached = linkage ? [...linkage.pose_errors.filter((row) => row.x !== null), ...places] : [];
  const points = [...[...data.poses, ...reached].map(({ x, y }) => [x, y]), ...(linkage ? [...pivotsAt(linkage, places), ...markPoints(data, places)] : [])];
  const some = places.filter((place, k) => k % Math.ceil(places.length / MOST_PLACES) === 0 && seen([place.x, place.y]));
  const corners = data.body && !close ? [...placesAtPoses(data, linkage), ...some].flatMap((place) => data.body.map((corner) => act(place, corner))) : [];
  return [...points.filter(seen), ...corners];
}

/** The box of a picture: near points all of them, others as far as they leave room for these; whole: all of both. */
export function fitted(near, others, whole) {
  const all = bounds([...near, ...others]);
  const [x, y, u, v] = bounds(near), size = Math.max(u - x, v - y) || 1, reach = SPARE * size;
  if (whole || !near.length || Math.max(all[2] - all[0], all[3] - all[1]) <= ROOM * size) return all;
  return [Math.max(all[0], x - reach), Math.max(all[1], y - reach), Math.min(all[2], u + reach), Math.min(all[3], v + reach)];
}

/** The box of a picture of a task and a linkage at places, never narrower than a share of the scene.  whole: far pivots and all of the
 * regions, too; close: neither body nor regions. */
export function boxOf(data, linkage, places, { whole = false, close = false } = {}) {
  const near = nearPoints(data, linkage, places, { far: whole, close }), regions = close ? [] : data.keep_out.flatMap((region) => region.outline);
  const box = fitted(near, regions, whole || !linkage), least = LEAST * data.scene;
  for (const k of [0, 1]) {
    const lack = Math.max(0, least - (box[k + 2] - box[k]));
    box[k] -= lack / 2;
    box[k + 2] += lack / 2;
  }
  return box;
}

/** From the plane to pixels, as large as it fits: the scale, and X and Y of a point. */
export function viewOf(box, width, height, margin) {
  const scale = Math.min((width - 2 * margin) / (box[2] - box[0]), (height - 2 * margin) / (box[3] - box[1]));
  const left = width / 2 - (scale * (box[0] + box[2])) / 2, top = height / 2 + (scale * (box[1] + box[3])) / 2;
  return { scale, left, top, width, height, X: (x) => left + scale * x, Y: (y) => top - scale * y };
}

/** Where the edge of a picture is towards a point of F, in pixels, and the angle of the way there; null where the point is in the picture. */
export function edgeTowards({ X, Y, width, height }, at) {
  const x = X(at[0]), y = Y(at[1]), cx = width / 2, cy = height / 2;
  if (x >= 0 && y >= 0 && x <= width && y <= height) return null;
  const size = Math.hypot(x - cx, y - cy), u = (x - cx) / size, v = (y - cy) / size;
  const reach = Math.min((cx - INSET) / Math.abs(u), (cy - INSET) / Math.abs(v));
  return { x: cx + reach * u, y: cy + reach * v, angle: Math.atan2(-v, u) };
}
