// Instantaneous kinematics at a place of a linkage: the instant centre, the drive and the
// transmission angle with either dyad as the driver.  The definitions are those of
// burmester/fourbar/instantaneous.py.

import { act, back, gradient, normalOf } from "./kinematics.mjs";
import { radians } from "./numbers.mjs";
import { alongLine } from "./travel.mjs";
import { cross } from "./vectors.mjs";

/** @typedef {import("./types").Dyad} Dyad @typedef {import("./types").Place} Place */

/** The point of F about which the body turns at a place; null where it only translates.
 *
 * @param {Dyad[]} dyads both dyads of the linkage
 * @param {Place} place
 */
export function instantCentre(dyads, place) {
  const [u, v, omega] = cross(gradient(dyads[0], place), gradient(dyads[1], place));
  const centre = [place.x - v / omega, place.y + u / omega];
  return Number.isFinite(centre[0]) && Number.isFinite(centre[1]) ? centre : null;
}

/** The instant centre in F and in M.
 * @param {Dyad[]} dyads @param {Place} place */
export function centrodePoint(dyads, place) {
  const fixed = instantCentre(dyads, place);
  return fixed && { fixed, moving: back(place, fixed) };
}

/** The input of a dyad at a place: its angle in radians, or its way along its line.
 * @param {Dyad} dyad @param {Place} place */
export function driveOf(dyad, place) {
  if (dyad.kind === "PR") return alongLine(dyad, place);
  if (dyad.kind === "RP") return place.a + radians(dyad.line.normal_deg);
  const [x, y] = act(place, dyad.moving_pivot);
  return Math.atan2(y - dyad.fixed_pivot[1], x - dyad.fixed_pivot[0]);
}

/** The transmission angle in degrees, from 0 to 90; null where none is defined.
 * @param {Dyad} driver @param {Dyad} follower @param {Place} place */
export function transmissionOf(driver, follower, place) {
  if (driver.kind === "PP" || follower.kind === "PP") return null;
  const slot = (/** @type {Dyad} */ dyad) => {
    const [nx, ny] = normalOf(dyad), c = Math.cos(place.a), d = Math.sin(place.a);
    return [c * nx - d * ny, d * nx + c * ny];
  };
  if (driver.kind === "RP" && follower.kind === "RP") return 90;
  if (follower.kind === "RP") {
    const pin = act(place, driver.moving_pivot), [x, y] = follower.fixed_pivot;
    return between(slot(follower), [x - pin[0], y - pin[1]]);
  }
  const end = act(place, follower.moving_pivot);
  const lever = follower.kind === "PR" ? normalOf(follower) : [end[0] - follower.fixed_pivot[0], end[1] - follower.fixed_pivot[1]];
  if (driver.kind === "RP") return between(slot(driver), lever);
  const start = act(place, driver.moving_pivot);
  return between([end[0] - start[0], end[1] - start[1]], lever);
}

/** @param {number[]} a @param {number[]} b */
const between = (a, b) => (Math.atan2(Math.abs(a[0] * b[1] - a[1] * b[0]), Math.abs(a[0] * b[0] + a[1] * b[1])) * 180) / Math.PI;
