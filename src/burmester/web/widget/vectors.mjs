// Points and directions of space, and quadrics as symmetric 4 x 4 matrices, row by row.

/** @typedef {import("./types").Vector} Vector */

/** @param {Vector} a @param {Vector} b */
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
/** @param {Vector} a @param {number} k */
export const scaled = (a, k) => [a[0] * k, a[1] * k, a[2] * k];
/** @param {Vector} a @param {Vector} b */
export const plus = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
/** @param {Vector} a @param {Vector} b */
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
/** @param {Vector} a */
export const unit = (a) => scaled(a, 1 / Math.hypot(...a));

/** c times (p, w).
 * @param {Vector} c @param {Vector} p @param {number} w */
const times = (c, p, w) =>
  [0, 4, 8, 12].map((r) => c[r] * p[0] + c[r + 1] * p[1] + c[r + 2] * p[2] + c[r + 3] * w);

/** Parameters t at which the line o + t d meets a quadric c.
 * @param {Vector} c @param {Vector} o @param {Vector} d */
export function intersections(c, o, d) {
  const cd = times(c, d, 0), co = times(c, o, 1);
  const a = dot(d, cd), b = dot(o, cd) + cd[3], e = dot(o, co) + co[3];
  const root = b * b - a * e;
  if (root < 0) return [];
  const q = -(b + (b < 0 ? -1 : 1) * Math.sqrt(root));
  const roots = [];
  if (Math.abs(a) > 1e-12 * Math.abs(q)) roots.push(q / a);
  if (q !== 0) roots.push(e / q);
  return roots;
}
