// What a linkage passes through along a stretch of its way: its places, and how far its blocks go.
//
// A stretch is { low, high }, two frames of a way, which may be fractions.

import { act, back, normalOf, placeAt } from "./kinematics.mjs";

/** The places along a stretch of a way, its ends among them. */
export function placesOf(linkage, way, { low, high }, length) {
  const places = [placeAt(linkage, way, low, length)];
  for (let k = Math.floor(low) + 1; k < high; k += 1) places.push({ x: way.x[k], y: way.y[k], a: way.angle[k] });
  places.push(placeAt(linkage, way, high, length));
  return places;
}

/** How far a block is along the line of its slider, counted from the foot of the origin's normal. */
export function alongLine(dyad, place) {
  const [nx, ny] = normalOf(dyad);
  const [x, y] = dyad.kind === "PR" ? act(place, dyad.moving_pivot) : back(place, dyad.fixed_pivot);
  return nx * y - ny * x;
}

/** The ends of the travel of a block over some places. */
export function travelOf(dyad, places) {
  const along = places.map((place) => alongLine(dyad, place));
  return [along.reduce((a, b) => Math.min(a, b)), along.reduce((a, b) => Math.max(a, b))];
}

/** The point of a slider's line at a distance along it: of F for PR, of M for RP. */
export function pointOnLine(dyad, along) {
  const [nx, ny] = normalOf(dyad), { offset } = dyad.line;
  return [offset * nx - along * ny, offset * ny + along * nx];
}
