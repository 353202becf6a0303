// What a linkage passes through along a stretch of its way: its places, and how far its blocks go.
//
// A stretch is { low, high }, two frames of a way, which may be fractions; sense: 1 where time runs from low to high, -1
// where it runs from high to low.

import { act, back, normalOf, placeAt, valueAt } from "./kinematics.mjs";

/** @typedef {import("./types").Dyad} Dyad @typedef {import("./types").Place} Place
 * @typedef {{ low: number, high: number, sense?: number }} Stretch @typedef {{ scene: number, chart: { length: number } }} Data */

const LONGEST_STEP = 0.015; // scenes: where frames are farther apart, there are places between them
const MOST_BETWEEN = 40; // places between two frames
const LEAST_STRETCH = 1e-6; // frames: poses closer together than that are no stretch to play

/** The frames of a way that are played, from the first of its poses to the last one; whole: all of the way, in the same sense.
 * isApart: whether the poses themselves are a stretch.
 * @param {import("./types").Moved} linkage @param {number} index @param {boolean} whole */
export function stretchOf(linkage, index, whole = false) {
  const last = (linkage?.ways[index]?.x.length ?? 2) - 1, frames = linkage.pose_errors.filter((row) => row.way === index).map((row) => row.frame);
  const low = frames.reduce((a, b) => Math.min(a, b), last), high = frames.reduce((a, b) => Math.max(a, b), 0);
  const isApart = high - low > LEAST_STRETCH, sense = frames[frames.length - 1] < frames[0] ? -1 : 1;
  return { ...(isApart && !whole ? { low, high } : { low: 0, high: last }), sense, isApart };
}

/** The places of a linkage along a stretch of a way, as `placesAlong`.
 * @param {Data} data @param {import("./types").Moved} linkage @param {import("./types").Way} way @param {Stretch} stretch */
export const placesOf = (data, linkage, way, stretch) =>
  placesAlong(data, stretch, (u) => (Number.isInteger(u) && !way.joints ? { x: way.x[u], y: way.y[u], a: way.angle[u] } : placeAt(linkage, way, u, data.chart.length)));

/** The places along a stretch, its ends among them, close enough for a smooth path; at: the place at a frame.
 * @param {Data} data @param {Stretch} stretch @param {(u: number) => Place} at */
function placesAlong(data, { low, high }, at) {
  const places = [at(low)];
  let before = low;
  const goTo = (/** @type {number} */ u) => {
    const next = at(u), last = places[places.length - 1];
    const count = Math.min(MOST_BETWEEN, Math.floor(Math.hypot(next.x - last.x, next.y - last.y) / (LONGEST_STEP * data.scene)));
    for (let k = 1; k <= count; k += 1) places.push(at(before + (k / (count + 1)) * (u - before)));
    places.push(next);
    before = u;
  };
  for (let k = Math.floor(low) + 1; k < high; k += 1) goTo(k);
  goTo(high);
  return places;
}

/** The way of a linkage on which most of its poses are.
 * @param {import("./types").Moved} linkage */
export function wayOfMost({ ways }) {
  const counts = ways.map((/** @type {any} */ way) => way.poses.length);
  return Math.max(0, counts.indexOf(Math.max(...counts)));
}

/** The place of the driver at a time, in seconds, of a motion whose times are known over the driver.
 * @param {{ time: { x: number[], y: number[] } }} timed @param {number} time */
export function driveAtTime({ time: { x, y } }, time) {
  // Where the driver's angle falls in time, so do the times along it.
  return y[0] <= y[y.length - 1] ? valueAt({ x: y, y: x }, time) : valueAt({ x: [...y].reverse(), y: [...x].reverse() }, time);
}

/** How far a block is along the line of its slider, counted from the foot of the origin's normal.
 * @param {Dyad} dyad @param {Place} place */
export function alongLine(dyad, place) {
  const [nx, ny] = normalOf(dyad);
  const [x, y] = dyad.kind === "PR" ? act(place, dyad.moving_pivot) : back(place, dyad.fixed_pivot);
  return nx * y - ny * x;
}

/** The ends of the travel of a block over some places.
 * @param {Dyad} dyad @param {Place[]} places */
export function travelOf(dyad, places) {
  const along = places.map((place) => alongLine(dyad, place));
  return [along.reduce((a, b) => Math.min(a, b)), along.reduce((a, b) => Math.max(a, b))];
}

/** The point of a slider's line at a distance along it: of F for PR, of M for RP.
 * @param {Dyad} dyad @param {number} along */
export function pointOnLine(dyad, along) {
  const [nx, ny] = normalOf(dyad), { offset } = dyad.line;
  return [offset * nx - along * ny, offset * ny + along * nx];
}
