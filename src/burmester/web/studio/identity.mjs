// Which linkage of a new answer is which of the one before, by the coordinates of their dyads.

import { radians } from "../widget/numbers.mjs";

const SAME = 2e-3; // scenes: dyads that lie farther apart are different ones
const AMBIGUOUS = 0.25; // a second candidate has to be farther than the first by that factor

/** The numbers of a dyad as points: lengths in scenes, directions on the unit circle. */
function coordinates(dyad, scene) {
  const out = [];
  for (const point of [dyad.fixed_pivot, dyad.moving_pivot]) if (point) out.push(point[0] / scene, point[1] / scene);
  if (dyad.radius !== undefined) out.push(dyad.radius / scene);
  if (dyad.line) {
    // A line is the same with its normal turned round, and its offset's sign with it.
    const angle = radians(dyad.line.normal_deg), offset = dyad.line.offset / scene;
    const sense = Math.cos(angle) > 1e-9 || (Math.abs(Math.cos(angle)) <= 1e-9 && Math.sin(angle) > 0) ? 1 : -1;
    out.push(sense * Math.cos(angle), sense * Math.sin(angle), sense * offset);
  }
  if (dyad.angle_deg !== undefined) out.push(Math.cos(radians(dyad.angle_deg)), Math.sin(radians(dyad.angle_deg)));
  return out;
}

/** How far two dyads are from each other, relative to their own size; Infinity between kinds. */
export function dyadDistance(one, other, scene) {
  if (one.kind !== other.kind) return Infinity;
  const a = coordinates(one, scene), b = coordinates(other, scene);
  const size = 1 + Math.max(...a.map(Math.abs));
  return Math.max(...a.map((value, k) => Math.abs(value - b[k]))) / size;
}

/** How far two linkages are from each other, whichever of their dyads comes first. */
export function linkageDistance(one, other, scene) {
  const pairs = (p, q) => Math.max(dyadDistance(one.led[0], other.led[p], scene), dyadDistance(one.led[1], other.led[q], scene));
  return Math.min(pairs(0, 1), pairs(1, 0));
}

/** How far a search moved a linkage from where it was followed to, in its size; 0 where it stands as it stood. */
export function shiftOf(followed, searched, scene) {
  const away = linkageDistance(followed, searched, scene);
  return away > SAME && Number.isFinite(away) ? away : 0;
}

/** For each linkage before the id with which it goes on; without an entry it does not.
 *
 * A linkage goes on as the nearest one where both are each other's nearest and no other is about
 * as near.
 * @param {{id: string, led: object[]}[]} before
 * @param {{id: string, led: object[]}[]} after
 * @param {number} scene the size of the drawing, in the task's unit
 * @returns {Map<string, string>}
 */
export function continuedAs(before, after, scene) {
  const away = before.map((one) => after.map((other) => linkageDistance(one, other, scene)));
  const nearest = (row) => {
    let best = -1, second = Infinity;
    row.forEach((value, k) => {
      if (best < 0 || value < row[best]) [best, second] = [k, best < 0 ? Infinity : row[best]];
      else if (value < second) second = value;
    });
    return best >= 0 && row[best] < SAME && row[best] <= AMBIGUOUS * second ? best : -1;
  };
  const names = new Map();
  before.forEach((one, i) => {
    const j = nearest(away[i]);
    if (j >= 0 && nearest(away.map((row) => row[j])) === i) names.set(one.id, after[j].id);
  });
  return names;
}
