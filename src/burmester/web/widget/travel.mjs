// What a linkage passes through along a stretch of its way: its places, and how far its blocks go.
//
// A stretch is { low, high }, two frames of a way, which may be fractions.

import { act, back, normalOf, placeAt } from "./kinematics.mjs";

/** @typedef {import("./types").Dyad} Dyad @typedef {import("./types").Place} Place
 * @typedef {{ low: number, high: number }} Stretch @typedef {{ scene: number, chart: { length: number } }} Data */

const LONGEST_STEP = 0.015; // scenes: where frames are farther apart, there are places between them
const MOST_BETWEEN = 40; // places between two frames

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
