// The loads of a task as a document states them: its tables `loads`, `springs` and `drive`, and changes of them.

import { act } from "../widget/kinematics.mjs";
import { bodyOf, withKeys } from "./document.mjs";

export const LOADS = ["loads", "springs", "drive"];
const BETWEEN = ["extension", "compression", "gas", "constant"]; // kinds of springs that go from one point to another
const GROUND = { x: 0, y: 0, a: 0 };
const SIDES = { ground_point: ["from", "ground"], body_point: ["to", "body"] };
const LED = ["driver", "follower"]; // the links of a four-bar beside its ground and its body

const isEmpty = (value) => value === undefined || (typeof value === "object" && value !== null && !Object.keys(value).length);

/** A tree with a value at a path of keys; undefined takes it away, and with it the tables that it leaves empty.
 * @param {any} tree @param {(string | number)[]} path @param {any} value @returns {any} */
export function setAt(tree, [key, ...rest], value) {
  const next = rest.length ? setAt(tree?.[key] ?? (typeof rest[0] === "number" ? [] : {}), rest, value) : value;
  if (!Array.isArray(tree)) return withKeys(tree ?? {}, { [key]: isEmpty(next) ? undefined : next });
  const list = [...tree];
  list.splice(Number(key), 1, ...(isEmpty(next) ? [] : [next]));
  return list;
}

/** What stands at a path of a tree, or undefined. */
export const valueOf = (tree, path) => path.reduce((inner, key) => inner?.[key], tree);

export const springsOf = ({ springs = [] }) => [springs].flat();
export const forcesOf = ({ loads }) => [loads?.force ?? []].flat();
export const hasLoads = (document) => LOADS.some((key) => document[key] !== undefined);

/** Whether a spring has a point at each end, and not only at the second. */
export const isBetween = ({ kind }) => BETWEEN.includes(kind);

/** An end of a spring: { link, point, path }, the path below the spring. */
export function endOf(spring, side) {
  const [key, link] = SIDES[side], end = spring[key];
  return spring[side] || !end ? { link, point: spring[side] ?? [0, 0], path: [side] } : { link: end.link ?? "ground", point: end.point ?? [0, 0], path: [key, "point"] };
}

/** A spring with an end on another link, at a point of it. */
export function withEnd(spring, side, link, point) {
  const [key, usual] = SIDES[side];
  return withKeys(spring, link === usual ? { [side]: point, [key]: undefined } : { [side]: undefined, [key]: { link, point } });
}

/** The ends of a spring that are points: both, of a counterweight its own, of a torsion spring none. */
export const sidesOf = (spring) => (isBetween(spring) ? Object.keys(SIDES) : spring.kind === "counterweight" ? ["body_point"] : []);

/** Loads as a report has them for drawings, from a document. */
export const drawnLoads = (document) => (hasLoads(document) ? {
  hand: document.loads?.hand?.at ?? null,
  springs: springsOf(document).map((spring) => ({ kind: spring.kind, ends: spring.kind === "torsion" ? [{ link: "joint", point: [0, 0] }] : sidesOf(spring).map((side) => endOf(spring, side)) })),
} : null);

/** Where the frame of a link is while the body is at a place; null where that is not known. */
export function linkPlace(link, place, linkage) {
  if (link === "ground") return GROUND;
  if (link === "body" || link === "coupler") return place;
  const dyad = linkage?.led?.[LED.indexOf(link)];
  if (!place || dyad?.kind !== "RR") return null;
  const [x, y] = dyad.fixed_pivot, [u, v] = act(place, dyad.moving_pivot);
  return { x, y, a: Math.atan2(v - y, u - x) };
}

/** The centre of the body's mass: the one that is stated, or that of its outline; null where there is none. */
export function centreOf(document) {
  const { body } = document.loads ?? {}, corners = bodyOf(document);
  if (!body || body.center || corners.length < 3) return body?.center ?? null;
  let area = 0, x = 0, y = 0;
  const [[x0, y0]] = corners;
  corners.forEach(([a, b], k) => {
    const [c, d] = corners[(k + 1) % corners.length], cross = (a - x0) * (d - y0) - (c - x0) * (b - y0);
    [area, x, y] = [area + cross, x + cross * (a + c - 2 * x0), y + cross * (b + d - 2 * y0)];
  });
  return area ? [x0 + x / (3 * area), y0 + y / (3 * area)] : corners[0];
}

/** All points of loads that can be taken hold of: { key, kind, name, link, point, path }. */
export function loadPoints(document) {
  const { loads } = document, centre = centreOf(document);
  return [
    ...(centre ? [{ key: "centre", kind: "centre", name: "Centre of mass of the body", link: "body", point: centre, path: ["loads", "body", "center"] }] : []),
    ...(loads?.hand?.at ? [{ key: "hand", kind: "hand", name: "Point of the hand", link: "body", point: loads.hand.at, path: ["loads", "hand", "at"] }] : []),
    ...forcesOf(document).map(({ at }, k) => ({ key: `force ${k}`, kind: "force", name: `Point of force ${k + 1}`, link: "body", point: at, path: ["loads", "force", k, "at"] })),
    ...springsOf(document).flatMap((spring, k) => sidesOf(spring).map((side) => {
      const end = endOf(spring, side);
      return { key: `spring ${k} ${side}`, kind: "spring", name: `End of spring ${k + 1} on the ${end.link}`, ...end, path: ["springs", k, ...end.path] };
    })),
  ];
}
