// The constraint manifold of a dyad as a quadric of a box of image space: the numbers of
// burmester/web/image_space.py, for dyads that are followed.

import { radians } from "../widget/numbers.mjs";

/** The eight coefficients of a dyad in a chart: its origin in F, the middle angle of M, its unit length. */
function coefficients(dyad, { origin, angle, length }) {
  const c = Math.cos(angle), d = Math.sin(angle);
  const hand = dyad.moving_pivot && [(c * dyad.moving_pivot[0] - d * dyad.moving_pivot[1]) / length, (d * dyad.moving_pivot[0] + c * dyad.moving_pivot[1]) / length];
  const foot = dyad.fixed_pivot && dyad.fixed_pivot.map((value, k) => (value - origin[k]) / length);
  if (dyad.kind === "RR") {
    const [x, y] = hand, [xc, yc] = foot, squared = (dyad.radius / length) ** 2 / 4;
    const s1 = -(x + xc) / 2, s2 = -(y + yc) / 2, t1 = -(y - yc) / 2, t2 = (x - xc) / 2;
    return [1, s1 * s1 + s2 * s2 - squared, 2 * s1, 2 * s2, 2 * t1, 2 * t2, 2 * (s1 * t1 + s2 * t2), t1 * t1 + t2 * t2 - squared];
  }
  const normal = radians(dyad.line.normal_deg);
  if (dyad.kind === "PR") {
    const n = [Math.cos(normal), Math.sin(normal)];
    return line(normal, (dyad.line.offset - n[0] * origin[0] - n[1] * origin[1]) / length, hand);
  }
  // RP: the same of the inverse motion, whose image points have the first three signs turned round.
  return line(normal + angle, dyad.line.offset / length, foot).map((value, k) => (k >= 4 && k < 7 ? -value : value));
}

function line(normal, offset, [x, y]) {
  const n1 = Math.cos(normal), n2 = Math.sin(normal), along = n1 * x + n2 * y, across = n2 * x - n1 * y;
  return [0, -along - offset, 2 * n1, 2 * n2, -2 * n2, 2 * n1, 2 * across, along - offset];
}

/** The symmetric 4 x 4 matrix of a manifold in the chart, row by row. */
function matrixOf(dyad, chart) {
  if (dyad.kind === "PP") { // a double plane has no gradient on itself: the plane alone
    const half = (radians(dyad.angle_deg) - chart.angle) / 2;
    return [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, Math.cos(half) / 2, 0, 0, Math.cos(half) / 2, -Math.sin(half)];
  }
  const [p1, p2, p3, p4, p5, p6, p7, p8] = coefficients(dyad, chart);
  return [p1, 0, p3 / 2, p5 / 2, 0, p1, p4 / 2, p6 / 2, p3 / 2, p4 / 2, p2, p7 / 2, p5 / 2, p6 / 2, p7 / 2, p8];
}

/** The matrix of a dyad's manifold in a box, row by row, its greatest number 1.
 * @param {object} dyad @param {{origin: number[], angle: number, length: number}} chart
 * @param {{centre: number[], half: number[]}} box
 * @returns {number[]} */
export function quadricOf(dyad, chart, { centre, half }) {
  const c = matrixOf(dyad, chart), to = (r, k) => (r === k ? (k < 3 ? half[k] : 1) : k === 3 ? centre[r] : 0);
  const out = new Array(16).fill(0);
  for (let i = 0; i < 4; i += 1) {
    for (let j = 0; j < 4; j += 1) {
      for (let r = 0; r < 4; r += 1) for (let k = 0; k < 4; k += 1) out[4 * i + j] += to(r, i) * c[4 * r + k] * to(k, j);
    }
  }
  const greatest = Math.max(...out.map(Math.abs));
  return out.map((value) => value / greatest);
}
