// Where a six-bar is: links on links, turned until the joints meet that close its loops.
//
// Points are [x, y], and are multiplied as complex numbers: a turned link is a product.  Angles of
// the driver are in degrees, in F; those of links in radians.

import { catmullRom, frameAt, linear } from "./kinematics.mjs";
import { degrees, radians } from "./numbers.mjs";

const FRAMES = 360; // along a way, for each turn of the driver
const STEPS = 4; // of Newton's method
const LOCKED = 1e-7; // of the size of a step's equations: what is smaller is a dead point

const plus = (p, q) => [p[0] + q[0], p[1] + q[1]];
const minus = (p, q) => [p[0] - q[0], p[1] - q[1]];
const times = (p, q) => [p[0] * q[0] - p[1] * q[1], p[0] * q[1] + p[1] * q[0]];
const cross = (p, q) => p[0] * q[1] - p[1] * q[0];
const turned = (angle) => [Math.cos(angle), Math.sin(angle)];
const NOWHERE = [0, 0];

/** The angle between two lines, from 0° to 90°. */
const acute = (p, q) => degrees(Math.atan2(Math.abs(cross(p, q)), Math.abs(p[0] * q[0] + p[1] * q[1])));

/** All joints where links have angles, how far those that close loops are apart, and how this changes by the angles. */
function placed({ ground, links, closures }, angles) {
  const joints = { ...ground }, at = {}, rates = {}, pins = {};
  const rateOf = (name, point) => links.map((link, k) => (link.name === name ? times([0, 1], minus(point, pins[name])) : rates[name]?.[k] ?? NOWHERE));
  links.forEach(({ name, on, pin, joints: own }, k) => {
    const turn = turned(angles[k]);
    pins[name] = at[on]?.[pin] ?? ground[pin];
    at[name] = {};
    for (const joint of Object.keys(own)) {
      at[name][joint] = plus(pins[name], times(turn, minus(own[joint], own[pin])));
      joints[joint] ??= at[name][joint];
    }
    rates[name] = at[on] ? rateOf(on, pins[name]) : links.map(() => NOWHERE);
  });
  const off = [], change = [];
  for (const [joint, one, other] of closures) {
    const [p, q] = [one, other].map((name) => at[name][joint]), [a, b] = [rateOf(one, p), rateOf(other, q)];
    for (const axis of [0, 1]) {
      off.push(p[axis] - q[axis]);
      change.push(a.map((rate, k) => rate[axis] - b[k][axis]));
    }
  }
  return { joints, off, change };
}

/** What solves a few linear equations; null where they are nearly one. */
function solved(rows, right) {
  const size = rows.length, all = rows.map((row, k) => [...row, right[k]]), most = Math.max(...rows.flat().map(Math.abs));
  for (let k = 0; k < size; k += 1) {
    const best = all.reduce((i, row, j) => (j > k && Math.abs(row[k]) > Math.abs(all[i][k]) ? j : i), k);
    [all[k], all[best]] = [all[best], all[k]];
    if (!(Math.abs(all[k][k]) > LOCKED * most)) return null;
    for (let j = k + 1; j < size; j += 1) {
      const share = all[j][k] / all[k][k];
      for (let i = k; i <= size; i += 1) all[j][i] -= share * all[k][i];
    }
  }
  const out = Array(size).fill(0);
  for (let k = size - 1; k >= 0; k -= 1) out[k] = (all[k][size] - all[k].reduce((sum, each, i) => (i > k && i < size ? sum + each * out[i] : sum), 0)) / all[k][k];
  return out;
}

/** The transmission angle where two links meet; where three carry one, the least to the meeting point of the other two. */
function transmitted(legs, joints) {
  const ways = legs.map(([from, to]) => minus(joints[to], joints[from])), tips = legs.map(([, to]) => joints[to]);
  if (legs.length === 2) return acute(...ways);
  return Math.min(
    ...ways.map((way, k) => {
      const [i, j] = [0, 1, 2].filter((each) => each !== k);
      const off = cross(minus(tips[j], tips[i]), ways[j]), across = cross(ways[i], ways[j]), from = minus(tips[i], tips[k]);
      return acute(way, [0, 1].map((axis) => across * from[axis] + off * ways[i][axis]));
    }),
  );
}

/** The place of the body at frame u of a way, with all joints and the transmission angles. */
export function sixBarAt(sixBar, { drive, angles, round }, u) {
  const { links, driver, carries, legs } = sixBar, last = angles[0].length - 1;
  const along = (u / (drive.length - 1)) * last, i = Math.min(last - 1, Math.max(0, Math.floor(along)));
  const crank = links.findIndex(({ name }) => name === driver), now = angles.map((values) => catmullRom(values, i, along - i, round));
  now[crank] = angles[crank][0] + radians(linear(drive, u) - drive[0]);
  let at = placed(sixBar, now);
  const free = now.map((_, k) => k).filter((k) => k !== crank);
  for (let step = 0; step < STEPS; step += 1) {
    const by = solved(at.change.map((row) => free.map((k) => row[k])), at.off);
    if (!by) break; // at a dead point: as it is
    free.forEach((k, n) => (now[k] -= by[n]));
    at = placed(sixBar, now);
  }
  const body = links.findIndex(({ name }) => name === carries), { pin, joints: own } = links[body];
  const [x, y] = minus(at.joints[pin], times(turned(now[body]), own[pin])), loops = legs.map((each) => transmitted(each, at.joints));
  return { x, y, a: now[body], joints: at.joints, loops, transmission: Math.min(...loops) };
}

/** All that the driver reaches, as frames; they lie closer where it comes to rest at a dead point. */
function wayOf(sixBar) {
  const [low, high] = sixBar.ends_deg, round = sixBar.turns_fully, frames = FRAMES * Math.max(1, Math.ceil((high - low) / 360 - 1e-9));
  const share = (k) => (round ? k / frames : (1 - Math.cos((Math.PI * k) / frames)) / 2);
  const drive = Array.from({ length: frames + 1 }, (_, k) => low + (high - low) * share(k));
  const way = { drive, angles: sixBar.links.map(({ name }) => sixBar.angles[name]), round };
  const places = drive.map((_, k) => sixBarAt(sixBar, way, k));
  const column = (value) => places.map(value);
  return {
    ...way, circuit: 1, branch: 1, branches: 1, dead: [!round, !round], poses: sixBar.drive_deg.map((_, k) => k + 1),
    x: column((at) => at.x), y: column((at) => at.y), angle: column((at) => at.a),
    transmission: column((at) => at.transmission), loops: sixBar.legs.map((_, k) => column((at) => at.loops[k])),
  };
}

/** A six-bar with its one way, its cranks (the driver first), and where it is at the poses. */
export function moving(sixBar, poses) {
  const way = wayOf(sixBar), grounded = sixBar.links.filter(({ pin }) => pin in sixBar.ground);
  const cranks = grounded.map(({ name, pin, joints }) => ({ id: pin + Object.keys(joints).find((joint) => joint !== pin), name, kind: "crank", fixed_pivot: sixBar.ground[pin] }));
  return {
    ...sixBar,
    ways: [way],
    led: cranks.sort((a, b) => (b.name === sixBar.driver) - (a.name === sixBar.driver)),
    pose_errors: sixBar.drive_deg.map((drive, k) => {
      const frame = frameAt(way.drive, drive), at = sixBarAt(sixBar, way, frame);
      return {
        x: at.x, y: at.y, angle_deg: degrees(at.a), way: 0, frame, drive_deg: drive, joints: at.joints, loops: at.loops,
        position: Math.hypot(at.x - poses[k].x, at.y - poses[k].y), transmission_deg: at.transmission,
        said: { position: sixBar.said.errors?.[k][0] ?? "exact", turned: sixBar.said.errors?.[k][1] ?? "exact" },
      };
    }),
  };
}
