// Whether the chosen linkage meets what is drawn: pivots in their regions, lengths, kinds, what must not be touched.
//
// What is said here colours a drawing while a thing is dragged.  The verdict is the server's.

import { act } from "../widget/kinematics.mjs";
import { radians } from "../widget/numbers.mjs";
import { limitsOf, poseName, regionsOf, standing } from "./document.mjs";
import { boxCorners, distanceTo, overlap, segmentFromPolygon } from "./region_geometry.mjs";

const ROUNDING = 1e-6; // of the size of the motion: what rounding may put a pivot outside
const MOST_PLACES = 90; // of the motion at which outlines are compared
const KEYS = ["fixed_pivot", "moving_pivot"];

/** The linkage that is drawn now: followed, or that of the last whole search, or the one that was placed; or null. */
export function currentLinkage(store) {
  if (store.chosen === "placed") return store.placed?.linkage ?? null;
  const followed = store.followed?.linkages.find(({ id }) => id === store.chosen);
  if (followed?.led) return followed;
  if (store.followed?.vanished?.some(({ id }) => id === store.chosen)) return null;
  return store.solved?.linkages.find(({ id }) => id === store.chosen) ?? null;
}

const PIVOT = { fixed_pivot: "fixed pivot", moving_pivot: "moving pivot" };

/** What a dyad misses of a table of limits: { key, dyad, away } each; away is a length, Infinity where there is no such pivot. */
function missed(table, dyad, slack) {
  const found = [];
  for (const key of KEYS) {
    if (!table[key]) continue;
    const [[shape, stated]] = Object.entries(table[key]), points = shape === "point" ? [stated] : stated;
    const away = dyad[key] ? distanceTo(dyad[key], shape, points) : Infinity;
    if (away > slack) found.push({ key, dyad: dyad.id, away });
  }
  const { least = 0, most = Infinity } = table.length ?? {};
  if (table.length && dyad.kind === "RR" && (dyad.radius < least - slack || dyad.radius > most + slack)) {
    found.push({ key: "length", dyad: dyad.id, away: Math.max(least - dyad.radius, dyad.radius - most) });
  }
  if (table.kinds && !table.kinds.includes(dyad.kind)) found.push({ key: "kinds", dyad: dyad.id, away: Infinity });
  return found;
}

/** For each table of limits what the linkage misses of it: a list of lists.
 *
 * Of two tables each is for one dyad; which, is what leaves the least missed.
 */
export function limitsMissed(document, linkage, size) {
  const tables = limitsOf(document), slack = ROUNDING * size, [one, other] = linkage.led;
  if (tables.length < 2) return tables.map((table) => [...missed(table, one, slack), ...missed(table, other, slack)]);
  return limitedDyads(document, linkage, size).map((dyad, k) => missed(tables[k], dyad, slack));
}

/** The dyads of a linkage in the order of the tables of limits, as far as there are two. */
export function limitedDyads(document, { led: [one, other] }, size) {
  const tables = limitsOf(document), slack = ROUNDING * size;
  const [straight, crossed] = [[one, other], [other, one]].map((dyads) => tables.length > 1 && dyads.flatMap((dyad, k) => missed(tables[k], dyad, slack)).length);
  return crossed < straight ? [other, one] : [one, other];
}

/** What is missed, in a sentence. */
export function missedSentence({ key, dyad, away }, unit) {
  const by = `${Number(away.toPrecision(2))}${unit ? ` ${unit}` : ""}`;
  if (key === "kinds") return `${dyad} is of another kind.`;
  if (key === "length") return `The link of ${dyad} is ${by} beyond its range.`;
  return away === Infinity ? `${dyad} has no ${PIVOT[key]}.` : `The ${PIVOT[key]} of ${dyad} is ${by} outside.`;
}

/** The places of the body between the first pose and the last, along the way on which most poses are. */
export function usedPlaces(linkage) {
  const rows = (linkage.pose_errors ?? []).filter((row) => row.way !== null && row.frame !== null);
  if (!rows.length || !linkage.ways?.length) return [];
  const counts = new Map();
  for (const { way } of rows) counts.set(way, (counts.get(way) ?? 0) + 1);
  const [best] = [...counts].sort((a, b) => b[1] - a[1])[0], way = linkage.ways[best];
  const frames = rows.filter((row) => row.way === best).map(({ frame }) => frame);
  const low = Math.floor(Math.min(...frames)), high = Math.ceil(Math.max(...frames)), stride = Math.max(1, Math.ceil((high - low) / MOST_PLACES));
  const places = [];
  for (let k = low; k <= high && k < way.x.length; k += stride) places.push({ x: way.x[k], y: way.y[k], a: way.angle[k] });
  return places;
}

/** The corners of a region that is stated in numbers, or null: of a drawing only the server knows them. */
export const regionCorners = (region) => region.polygon ?? (region.box ? boxCorners(region.box) : null);

/** A body where it is at a place. */
const seen = (body, place) => body.map((corner) => act(place, corner));

function posePlace(document, k) {
  const { x, y, angle } = standing(document, k);
  return { x, y, a: radians(angle) };
}

/** What touches each region on the way: "", or a sentence. */
export function regionsTouched(document, linkage, body) {
  const places = usedPlaces(linkage), width = document.surroundings?.link_width ?? 0, margin = document.surroundings?.margin ?? 0;
  const apart = Math.ceil(document.poses.length / MOST_PLACES), some = [...document.poses.keys()].filter((k) => k % apart === 0);
  return regionsOf(document).map((region) => {
    const corners = regionCorners(region);
    if (!corners) return "";
    const pose = body.length > 2 ? some.find((k) => overlap(seen(body, posePlace(document, k)), corners)) : undefined;
    if (pose !== undefined) return `The body touches it at pose ${poseName(document, pose)}.`;
    if (!places.length) return "";
    if (body.length > 2 && places.some((place) => overlap(seen(body, place), corners))) return "The body touches it.";
    for (const dyad of linkage.led) {
      if (dyad.kind !== "RR") continue;
      const near = Math.min(...places.map((place) => segmentFromPolygon([dyad.fixed_pivot, act(place, dyad.moving_pivot)], corners)));
      if (near === 0 || near < width / 2) return `The link of ${dyad.id} touches it.`;
      if (near < width / 2 + margin) return `The link of ${dyad.id} comes nearer than the margin.`;
    }
    return "";
  });
}
