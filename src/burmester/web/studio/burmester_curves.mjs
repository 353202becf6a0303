// The curves of four poses: centre points in F and circle points in M, in colours of what works with them.

import { OUTSIDE } from "../widget/family_pairs.mjs";
import { act, back } from "../widget/kinematics.mjs";
import { radians } from "../widget/numbers.mjs";

const NEWTON_STEPS = 6;
const FARTHEST_STEP = 0.1; // scenes: a point that moved farther has left its place on the curve

/** The nearest place on a sampled curve to a point: { k, share, at, away }, between samples k and the next of its loop.
 *
 * @param {number[][]} points the samples, all loops one behind the other @param {number[]} loops how many each has
 * @param {number[]} wanted @param {number} widest steps longer than that go through infinity, and are left out */
export function nearestOnCurve(points, loops, wanted, widest) {
  let best = null, start = 0;
  for (const size of loops) {
    for (let i = 0; i < size; i += 1) {
      const j = (i + 1) % size, a = points[start + i], b = points[start + j];
      const d = [b[0] - a[0], b[1] - a[1]], squared = d[0] * d[0] + d[1] * d[1];
      if (squared > widest * widest) continue;
      const t = squared > 0 ? Math.min(1, Math.max(0, ((wanted[0] - a[0]) * d[0] + (wanted[1] - a[1]) * d[1]) / squared)) : 0;
      const at = [a[0] + t * d[0], a[1] + t * d[1]], away = Math.hypot(at[0] - wanted[0], at[1] - wanted[1]);
      if (!best || away < best.away) best = { k: start + i, next: start + j, share: t, at, away };
    }
    start += size;
  }
  return best;
}

/** How far four points are from lying on one circle: a determinant that is zero where they do. */
/** @param {number[][]} points */
function circleDeterminant([o, ...others]) {
  const [a, b, c] = others.map(([x, y]) => [x - o[0], y - o[1]]).map(([x, y]) => [x, y, x * x + y * y]);
  return a[2] * (b[0] * c[1] - b[1] * c[0]) - b[2] * (a[0] * c[1] - a[1] * c[0]) + c[2] * (a[0] * b[1] - a[1] * b[0]);
}

/** The point of a Burmester curve next to a point near it, by Newton's steps across the curve.
 *
 * A centre point of F sees four places of itself from the body, a circle point of M four places in F; on the curve
 * they lie on one circle.
 * @param {object[]} poses four, as a report has them @param {"F" | "M"} plane @param {number[]} point @param {number} scene */
export function ontoCurve(poses, plane, point, scene) {
  const places = poses.map((pose) => ({ x: pose.x, y: pose.y, a: radians(pose.angle_deg) }));
  const value = (at) => circleDeterminant(places.map((place) => (plane === "F" ? back(place, at) : act(place, at))));
  const step = 1e-6 * scene;
  let at = point;
  for (let k = 0; k < NEWTON_STEPS; k += 1) {
    const slope = [0, 1].map((axis) => {
      const [up, down] = [1, -1].map((sense) => value(at.map((each, n) => each + (n === axis ? sense * step : 0))));
      return (up - down) / (2 * step);
    });
    const squared = slope[0] ** 2 + slope[1] ** 2, here = value(at);
    if (!(squared > 0)) return at;
    at = at.map((each, n) => each - (here * slope[n]) / squared);
  }
  return Math.hypot(at[0] - point[0], at[1] - point[1]) < FARTHEST_STEP * scene ? at : point;
}

/** What each sample is worth: "works", "outside" (limits or standard), or "fails", by the best partner that it has. */
export const worthOf = (pairs) => Array.from({ length: pairs.columns }, (_, k) => worth(pairs.bestPartner(k).kind));

const worth = (kind) => (kind < OUTSIDE ? "works" : kind === OUTSIDE ? "outside" : "fails");

/** The server's answer on the curves as the samples of a report's map, all loops one behind the other; places at infinity
 * are left out.  Without a judgement nothing is said of what works.
 * @param {{ loops: object[] }} answer */
export function curvesOf({ loops }) {
  /** @type {{ fixed: number[][], moving: number[][], loops: number[], worth: string[] }} */
  const curves = { fixed: [], moving: [], loops: [], worth: [] };
  for (const loop of loops) {
    const kept = loop.fixed.map((_, k) => k).filter((k) => [...loop.fixed[k], ...loop.moving[k]].every(Number.isFinite));
    curves.loops.push(kept.length);
    for (const k of kept) {
      curves.fixed.push(loop.fixed[k]);
      curves.moving.push(loop.moving[k]);
      curves.worth.push(loop.class ? worth(loop.class[k]) : "plain");
    }
  }
  return curves;
}

/** Paths of a curve, one for each worth: pieces from half a step before each sample to half a step behind it. */
export function curvePaths(points, loops, worth, X, Y, widest) {
  const paths = { works: "", outside: "", fails: "", plain: "" };
  const near = (p, q) => Math.hypot(p[0] - q[0], p[1] - q[1]) <= widest;
  const text = ([x, y]) => `${Math.round(X(x) * 100) / 100} ${Math.round(Y(y) * 100) / 100}`;
  const between = (p, q) => [(p[0] + q[0]) / 2, (p[1] + q[1]) / 2];
  let start = 0;
  for (const size of loops) {
    for (let i = 0; i < size; i += 1) {
      const [a, b, c] = [-1, 0, 1].map((step) => points[start + ((i + step + size) % size)]);
      const list = [...(near(a, b) ? [between(a, b)] : []), b, ...(near(b, c) ? [between(b, c)] : [])];
      if (list.length > 1) paths[worth[start + i]] += `M${list.map(text).join("L")}`;
    }
    start += size;
  }
  return paths;
}
