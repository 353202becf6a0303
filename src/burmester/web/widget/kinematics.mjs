// Where a linkage is: points of F and M, the constraint of each dyad, and places between the
// frames of a branch.
//
// A place is { x, y, a }: the origin of M in F, and the angle of M in radians.

import { clamp, radians } from "./numbers.mjs";

/** @typedef {import("./types").Dyad} Dyad @typedef {import("./types").Place} Place
 * @typedef {import("./types").Values} Values @typedef {import("./types").Way} Way */

/** A point of M, seen in F.
 * @param {Place} place @param {number[]} point */
export function act(place, [x, y]) {
  const c = Math.cos(place.a), d = Math.sin(place.a);
  return [place.x + c * x - d * y, place.y + d * x + c * y];
}

/** A point of F, seen in M.
 * @param {Place} place @param {number[]} point */
export function back(place, [x, y]) {
  const c = Math.cos(place.a), d = Math.sin(place.a);
  return [c * (x - place.x) + d * (y - place.y), -d * (x - place.x) + c * (y - place.y)];
}

/** The unit normal of a slider's line.
 * @param {Dyad} dyad */
export const normalOf = (dyad) => {
  const angle = radians(dyad.line.normal_deg);
  return [Math.cos(angle), Math.sin(angle)];
};

/** The constraint of a dyad at a place: its residual, and the derivatives by x, y and the angle.
 * @param {Dyad} dyad @param {Place} place */
function constraint(dyad, place) {
  if (dyad.kind === "PP") {
    const away = place.a - radians(dyad.angle_deg);
    return [away - 2 * Math.PI * Math.round(away / (2 * Math.PI)), 0, 0, 1];
  }
  if (dyad.kind === "RP") {
    const [nx, ny] = normalOf(dyad);
    const c = Math.cos(place.a), d = Math.sin(place.a);
    const tx = c * nx - d * ny, ty = d * nx + c * ny;
    const ax = dyad.fixed_pivot[0] - place.x, ay = dyad.fixed_pivot[1] - place.y;
    return [tx * ax + ty * ay - dyad.line.offset, -tx, -ty, tx * ay - ty * ax];
  }
  const [x, y] = act(place, dyad.moving_pivot);
  let nx, ny, residual;
  if (dyad.kind === "RR") {
    const ax = x - dyad.fixed_pivot[0], ay = y - dyad.fixed_pivot[1];
    const size = Math.hypot(ax, ay) || 1;
    [nx, ny, residual] = [ax / size, ay / size, size - dyad.radius];
  } else {
    [nx, ny] = normalOf(dyad);
    residual = nx * x + ny * y - dyad.line.offset;
  }
  return [residual, nx, ny, (x - place.x) * ny - (y - place.y) * nx];
}

/** The derivatives of a dyad's constraint by x, y and the angle: the force that it can bear.
 * @param {Dyad} dyad @param {Place} place */
export const gradient = (dyad, place) => constraint(dyad, place).slice(1);

/** The nearest place of a linkage, by Newton steps of least norm; `length` weighs the angle.
 * @param {Dyad[]} dyads @param {Place} place @param {number} length
 * @returns {Place} */
export function project(dyads, place, length) {
  let { x, y, a } = place;
  for (let step = 0; step < 4; step += 1) {
    const [f, ...p] = constraint(dyads[0], { x, y, a });
    const [g, ...q] = constraint(dyads[1], { x, y, a });
    p[2] /= length;
    q[2] /= length;
    const pp = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
    const pq = p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    const qq = q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
    const det = pp * qq - pq * pq;
    if (!(det > 1e-9 * pp * qq)) return { x, y, a }; // at a change point: as it is
    const u = (f * qq - g * pq) / det, v = (g * pp - f * pq) / det;
    x -= u * p[0] + v * q[0];
    y -= u * p[1] + v * q[1];
    a -= (u * p[2] + v * q[2]) / length;
    if (Math.abs(f) + Math.abs(g) < 1e-14 * length) break;
  }
  return { x, y, a };
}

/** Values between frames i and i + 1 by Catmull and Rom's cubic; `round`: the last frame is the first.
 * @param {Values} values @param {number} i @param {number} share @param {boolean} round */
export function catmullRom(values, i, share, round) {
  const last = values.length - 1;
  const at = (/** @type {number} */ k) => {
    if (k >= 0 && k <= last) return values[k];
    if (!round) return k < 0 ? 2 * values[0] - values[-k] : 2 * values[last] - values[2 * last - k];
    const wrap = k < 0 ? k + last : k - last; // a turn of the angle is kept
    return values[wrap] + (k < 0 ? -1 : 1) * (values[last] - values[0]);
  };
  const [p, q, r, t] = [at(i - 1), at(i), at(i + 1), at(i + 2)];
  return q + (share / 2) * (r - p + share * (2 * p - 5 * q + 4 * r - t + share * (3 * (q - r) + t - p)));
}

/** The place of the coupler at frame u of a branch, which may be a fraction; exactly on the linkage.
 * @param {import("./types").Moved} linkage @param {Way} way @param {number} u @param {number} length
 * @returns {Place} */
export function placeAt(linkage, way, u, length) {
  if (way.joints) return placeOfJoints(linkage, way, way.joints, u);
  const stop = linkage.pose_errors.find((row) => row.at === way && Math.abs(row.frame - u) < 1e-6);
  if (stop) return { x: stop.x, y: stop.y, a: radians(stop.angle_deg) };
  const i = clamp(Math.floor(u), 0, way.x.length - 2), share = u - i;
  const place = {
    x: catmullRom(way.x, i, share, way.round),
    y: catmullRom(way.y, i, share, way.round),
    a: catmullRom(way.angle, i, share, way.round),
  };
  return project(linkage.led, place, length);
}

/** The same with all joints, of a branch that has these: a polynomial goes through the six frames around u.
 * @param {import("./types").Moved} linkage @param {Way} way @param {Record<string, [Values, Values]>} moving @param {number} u
 * @returns {Place} */
function placeOfJoints({ ground }, way, moving, u) {
  const at = (/** @type {Values} */ values) => smooth(values, u), joints = { ...ground };
  for (const [name, [x, y]] of Object.entries(moving)) joints[name] = [at(x), at(y)];
  return { x: at(way.x), y: at(way.y), a: at(way.angle), joints };
}

/** A value at frame u of the polynomial through the six frames around it.
 * @param {Values} values @param {number} u */
export function smooth(values, u) {
  const count = Math.min(6, values.length), first = clamp(Math.floor(u) - 2, 0, values.length - count);
  let sum = 0;
  for (let j = 0; j < count; j += 1) {
    let weight = 1;
    for (let k = 0; k < count; k += 1) if (k !== j) weight *= (u - first - k) / (j - k);
    sum += weight * values[first + j];
  }
  return sum;
}

/** A value at frame u, linear between frames; null beside a value that is missing.
 * @param {ArrayLike<number | null>} values @param {number} u */
export function linear(values, u) {
  const i = clamp(Math.floor(u), 0, values.length - 2), share = u - i;
  const before = values[i], after = values[i + 1];
  if (before === null || after === null) return null;
  const value = before + share * (after - before);
  return Number.isNaN(value) ? null : value;
}

/** The value of a curve { x, y } at a place along x; null beyond its ends, and of single points between them.
 * @param {{ x: number[], y: (number | null)[], stems?: boolean }} curve @param {number | null} at */
export function valueAt({ x, y, stems = false }, at) {
  if (at === null) return null;
  const here = x.findIndex((each) => Math.abs(each - at) < 1e-6);
  if (here >= 0) return y[here];
  return stems || !(at > x[0] && at < x[x.length - 1]) ? null : linear(y, frameAt(x, at));
}

/** The frame at which rising values reach `wanted`.
 * @param {Values} values @param {number} wanted */
export function frameAt(values, wanted) {
  let low = 0, high = values.length - 1;
  if (wanted <= values[low]) return low;
  if (wanted >= values[high]) return high;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (values[middle] <= wanted) low = middle;
    else high = middle;
  }
  const step = values[high] - values[low];
  return low + (step > 0 ? (wanted - values[low]) / step : 0);
}
