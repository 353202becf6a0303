// The whole task moved, turned, mirrored and scaled: whatever it says of F and of M goes along, so that its answers do.
//
// A similarity is { turn, scale, mirror, x, y }: p goes to scale * R(turn) * p + (x, y), where a mirror changes the sign
// of p's y first; turn is in degrees.  Forces, masses and times stay, so moments grow with lengths.

import { radians } from "../widget/numbers.mjs";
import { standing, withKeys } from "./document.mjs";
import { tidy } from "./quantities.mjs";
import { boxCorners } from "./region_geometry.mjs";

const GRAVITY = 9.80665; // m/s²
const SCALED = ["free_length", "greatest_length", "least_length", "length", "stroke", "rate_Nm_per_deg"]; // numbers of springs

/** The similarity that leaves a point where it is.
 * @param {number[]} point @param {{ turn?: number, scale?: number, mirror?: boolean }} how */
export function about([x, y], { turn = 0, scale = 1, mirror = false }) {
  const [u, v] = linear({ turn, scale, mirror }, [x, y]);
  return { turn, scale, mirror, x: x - u, y: y - v };
}

/** Quarter turns that a similarity makes, 0 to 3; NaN where it turns by something else. */
const quarters = ({ turn }) => (Number.isInteger(turn / 90) ? (((turn / 90) % 4) + 4) % 4 : NaN);

/** A vector turned, mirrored and scaled.
 * @param {any} by @param {number[]} vector */
function linear(by, [x, y]) {
  const q = quarters(by), a = radians(by.turn), [c, s] = Number.isNaN(q) ? [Math.cos(a), Math.sin(a)] : [[1, 0], [0, 1], [-1, 0], [0, -1]][q];
  const v = by.mirror ? -y : y;
  return [by.scale * (c * x - s * v), by.scale * (s * x + c * v)];
}

/** Where a similarity takes a point.
 * @param {any} by @param {number[]} point */
export function moved(by, point) {
  const [x, y] = linear(by, point);
  return [tidy(x + by.x), tidy(y + by.y)];
}

/** What two similarities do, one after the other. */
export function composed(by, before) {
  const [x, y] = moved(by, [before.x, before.y]);
  return { turn: direction(by, before.turn), scale: by.scale * before.scale, mirror: by.mirror !== before.mirror, x, y };
}

const direction = (by, angle) => tidy(by.turn + (by.mirror ? -angle : angle));

/** What a similarity does to the frame M of the body. */
const inBody = ({ scale, mirror }) => ({ turn: 0, scale, mirror, x: 0, y: 0 });

/** A table whose keys are changed by functions, where it has them. */
const changed = (table, changes) => table && withKeys(table, Object.fromEntries(Object.entries(changes).filter(([key]) => table[key] !== undefined).map(([key, change]) => [key, change(table[key])])));

/** A table or a list of them. */
const each = (list, change) => (list === undefined ? undefined : Array.isArray(list) ? list.map(change) : change(list));

/** A region { shape: points } and what else its table says; a box that is turned aslant is a polygon. */
function movedRegion(by, region) {
  const [shape] = ["point", "line", "segment", "box", "polygon"].filter((key) => region[key]);
  if (shape === "point") return { ...region, point: moved(by, region.point) };
  const points = region[shape].map((point) => moved(by, point));
  if (shape === "polygon") return { ...region, polygon: by.mirror ? points.reverse() : points };
  if (shape !== "box") return { ...region, [shape]: points };
  const [[a, b], [c, d]] = region.box, all = (k) => points.map((point) => point[k]);
  if (!Number.isNaN(quarters(by))) return { ...region, box: [[Math.min(...all(0)), Math.min(...all(1))], [Math.max(...all(0)), Math.max(...all(1))]] };
  if (a === c && b === d) return withKeys(region, { box: undefined, point: points[0] });
  if (a === c || b === d) return withKeys(region, { box: undefined, segment: points });
  return withKeys(region, { box: undefined, polygon: boxCorners(region.box).map((point) => moved(by, point)) });
}

/** x and y are exchanged by an odd quarter turn. */
const swapped = (by, key) => (quarters(by) % 2 === 1 ? { x: "y", y: "x" }[key] ?? key : key);

function movedTolerance(by, stated) {
  const size = (bound) => (typeof bound === "number" ? tidy(by.scale * bound) : bound), fixed = stated.axes !== "body";
  const bounds = ["x", "y"].filter((key) => stated[key] !== undefined).map((key) => [fixed ? swapped(by, key) : key, size(stated[key])]);
  return { ...withKeys(stated, { x: undefined, y: undefined }), ...Object.fromEntries(bounds) };
}

/** A pose taken along; what it does not state stays unstated. */
export function movedPose(by, pose) {
  const [x, y] = moved(by, [pose.x ?? 0, pose.y ?? 0]);
  const there = { x, y, ...(pose.angle === undefined ? {} : { angle: direction(by, pose.angle) }) };
  for (const key of ["x", "y"]) if (pose[key] === undefined) delete there[swapped(by, key)];
  return { ...withKeys(pose, { x: undefined, y: undefined, angle: undefined }), ...there, ...changed({ free: pose.free, tolerance: pose.tolerance }, {
    free: (keys) => keys.map((key) => swapped(by, key)), tolerance: (stated) => movedTolerance(by, stated),
  }) };
}

/** Some poses moved as one body; null where a pose cannot be turned so, for what it leaves free. */
export function withPosesMoved(document, indices, by) {
  const chosen = new Set(indices);
  if (aslant({ poses: document.poses.filter((_, k) => chosen.has(k)), tolerance: document.tolerance }, by)) return null;
  return withKeys(document, { poses: document.poses.map((pose, k) => (chosen.has(k) ? movedPose(by, pose) : pose)) });
}

/** Why a task cannot be turned so: a tolerance or a freedom along the axes of the ground has no other axes; or "". */
export function aslant({ poses, tolerance }, by) {
  if (!Number.isNaN(quarters(by))) return "";
  const differs = (stated) => stated && stated.axes !== "body" && Boolean(stated.x || stated.y) && !(stated.x === "free" && stated.y === "free");
  const index = poses.findIndex((pose) => (pose.free ?? []).filter((key) => key !== "angle").length === 1 || differs(pose.tolerance));
  const which = index >= 0 ? `pose ${index + 1}` : differs(tolerance) ? "the poses" : "";
  return which && `Only quarter turns are possible: ${which} may be missed along the axes of the ground, and they have no others.`;
}

function movedSpring(by, spring) {
  const body = inBody(by), end = ({ link = "ground", point = [0, 0] }) => ({ link, point: moved(link === "ground" ? by : body, point) });
  const lengths = Object.fromEntries(SCALED.map((key) => [key, (value) => tidy(by.scale * value)]));
  const [from, to] = [spring.from?.link ?? "ground", spring.to?.link ?? (spring.ground_point ? "body" : "ground")], turned = Number(from === "ground") - Number(to === "ground");
  return changed(spring, {
    ...lengths, ground_point: (point) => moved(by, point), body_point: (point) => moved(body, point), from: end, to: end,
    rate_N_per_mm: (rate) => tidy(rate / by.scale), free_deg: (angle) => tidy((by.mirror ? -angle : angle) + turned * by.turn),
  });
}

function movedLoads(by, loads) {
  const body = inBody(by), turned = (frame, vector) => linear({ ...frame, scale: 1 }, vector).map(tidy), { gravity = "down" } = loads;
  const pull = gravity === "none" ? gravity : turned(by, gravity === "down" ? [0, -GRAVITY] : gravity), isDown = pull[0] === 0 && pull[1] === -GRAVITY;
  return withKeys(changed(loads, {
    body: (mass) => changed(mass, { center: (point) => moved(body, point), inertia_kgm2: (value) => tidy(by.scale ** 2 * value) }),
    links: (links) => changed(links, links.plate === undefined ? {} : { width: (value) => tidy(by.scale * value) }),
    force: (list) => each(list, (force) => ({ ...force, at: moved(body, force.at), force_N: turned(force.frame === "M" ? body : by, force.force_N) })),
    torque_Nm: (torque) => tidy((by.mirror ? -1 : 1) * by.scale * torque),
    hand: (hand) => ({ ...hand, at: moved(body, hand.at) }),
  }), { gravity: isDown ? undefined : pull });
}

/** A task with everything that it says taken along.
 *
 * sigma: { position, angle_deg }, how exactly its poses are known, where that is known; turned numbers have more digits than that.
 */
export function transformed(document, by, sigma = document.pose_sigma) {
  const body = inBody(by), size = (value) => tidy(by.scale * value), cranked = (angle) => tidy((by.mirror ? -angle : angle) + (document.crank?.absolute ? by.turn : 0));
  const line = (frame) => (rail) => changed(rail, { direction_deg: (angle) => direction(frame, angle), through: (region) => movedRegion(frame, region), travel: (region) => movedRegion(frame, region) });
  const limits = (table) => changed(table, {
    fixed_pivot: (region) => movedRegion(by, region), moving_pivot: (region) => movedRegion(body, region), rail: line(by), slot: line(body),
    length: (range) => changed(range, { least: size, most: size }),
  });
  const poses = document.poses.map((pose) => changed(movedPose(by, pose), { crank_deg: cranked }));
  const isLoaded = document.loads ?? document.springs ?? document.drive;
  const loads = isLoaded && movedLoads(by, document.loads ?? {});
  return withKeys(changed(document, {
    tolerance: (stated) => movedTolerance(by, stated), path: (path) => changed(path, { crank_deg: (list) => list.map(cranked) }),
    body: (corners) => (Array.isArray(corners) ? movedRegion(body, { polygon: corners }).polygon : corners),
    keep_out: (list) => each(list, (region) => (region.file ? region : movedRegion(by, region))),
    surroundings: (table) => changed(table, { link_width: size, margin: size }),
    limits: (list) => each(list, limits),
    requirements: (table) => changed(table, { footprint: (region) => movedRegion(by, region), within: size, driver_torque_Nm: size, body_speed: size, body_acceleration: size }),
    springs: (list) => each(list, (spring) => movedSpring(by, spring)),
  }), {
    poses, loads: loads && Object.keys(loads).length ? loads : undefined,
    pose_sigma: sigma && (sigma.position || sigma.angle_deg) ? { ...sigma, position: size(sigma.position) } : document.pose_sigma,
  });
}

/** The middle of what the poses span. */
export function middleOfPoses(document) {
  const places = document.poses.map((_, k) => standing(document, k)), middle = (key) => (Math.min(...places.map((each) => each[key])) + Math.max(...places.map((each) => each[key]))) / 2;
  return places.length ? [middle("x"), middle("y")] : [0, 0];
}
