// The pairs of a family's map: what becomes of each, and its dyads.

export const CLASSES = 7; // see PairClass of burmester/families/pair_verdicts.py
export const OUTSIDE = 2; // the first class that does not work
export const SHARES = [0, 0.25, 0.5, 0.75]; // places along a loop that pictures mark

export class FamilyPairs {
  constructor(data) {
    this.data = data;
    this.map = data.family_map;
    this.isCurve = this.map.kind === "curve";
    this.columns = this.isCurve ? this.map.fixed.length : this.map.columns;
    this.rows = this.isCurve ? this.columns : this.map.rows;
    this.starts = []; // of the loops of a curve
    (this.map.loops ?? []).reduce((start, size) => (this.starts.push(start), start + size), 0);
  }

  /** The letter of a loop, where there are several. */
  letter(loop) {
    return this.starts.length > 1 ? `${"ABCDEFGH"[loop]} ` : "";
  }

  /** The pair at column i and row j: its class, its driver (0 or 1) and whole degrees. */
  pair([i, j]) {
    const { cells } = this.map;
    if (!this.isCurve) return this.decoded(cells[j * this.columns + i]);
    if (i === j) return { kind: CLASSES - 1, driver: 0, degrees: 0 };
    const [a, b] = [Math.min(i, j), Math.max(i, j)], n = this.columns;
    const pair = this.decoded(cells[a * n - (a * (a + 1)) / 2 + b - a - 1]);
    return i < j ? pair : { ...pair, driver: 1 - pair.driver };
  }

  decoded(code) {
    const rest = Math.floor(code / CLASSES);
    return { kind: code % CLASSES, driver: rest % 2, degrees: Math.floor(rest / 2) };
  }

  /** The best pair that a dyad of the curve makes. */
  bestPartner(i) {
    let best = { kind: CLASSES - 1, degrees: 0 };
    for (let j = 0; j < this.columns; j += 1) {
      const pair = this.pair([i, j]);
      if (pair.kind < best.kind || (pair.kind === best.kind && pair.degrees > best.degrees)) best = pair;
    }
    return best;
  }

  /** The name of a place along the curve: its share of its loop, after the loop's letter. */
  placeName(k) {
    const loop = this.starts.findLastIndex((start) => start <= k), size = this.map.loops[loop];
    return `${this.letter(loop)}${((k - this.starts[loop] + 0.5) / size).toFixed(2)}`;
  }

  /** The cell of a fixed pivot in the plane of three poses. */
  cellOf(pivot) {
    if (!pivot) return null;
    const { low, high } = this.map, many = [this.columns, this.rows];
    const at = pivot.map((v, k) => Math.round(((v - low[k]) / (high[k] - low[k])) * (many[k] - 1)));
    return at.every((v, k) => v >= 0 && v < many[k]) ? at : null;
  }

  /** The fixed pivot of a cell in the plane of three poses. */
  pivotOf(cell) {
    const { low, high } = this.map, many = [this.columns, this.rows];
    return cell.map((v, k) => low[k] + (v / (many[k] - 1)) * (high[k] - low[k]));
  }

  /** Both dyads of a pair: fixed pivots in F, moving ones in M, lengths. */
  dyadsOf(cell) {
    const { map } = this;
    if (this.isCurve) return cell.map((k) => ({ fixed: map.fixed[k], moving: map.moving[k], length: map.length[k] }));
    return [map.chosen, dyadOfThree(this.data.poses, this.pivotOf(cell))];
  }

  /** The pivots of a pair in F, at pose 1. */
  pinsOf(cell) {
    if (!cell) return [];
    return this.dyadsOf(cell).flatMap((each) => [...(each.fixed ? [each.fixed] : []), ...(each.moving ? [this.seen(each.moving)] : [])]);
  }

  /** A point of the body in F, at pose 1. */
  seen([x, y]) {
    const [pose] = this.data.poses, turn = (pose.angle_deg * Math.PI) / 180, [cos, sin] = [Math.cos(turn), Math.sin(turn)];
    return [pose.x + cos * x - sin * y, pose.y + sin * x + cos * y];
  }
}

/** The dyad of three poses with a fixed pivot: seen from the body, the pivot runs on a circle. */
function dyadOfThree(poses, pivot) {
  const [a, b, c] = poses.map((pose) => {
    const turn = (-pose.angle_deg * Math.PI) / 180, [x, y] = [pivot[0] - pose.x, pivot[1] - pose.y];
    return [Math.cos(turn) * x - Math.sin(turn) * y, Math.sin(turn) * x + Math.cos(turn) * y];
  });
  const u = [b[0] - a[0], b[1] - a[1]], v = [c[0] - a[0], c[1] - a[1]];
  const cross = 2 * (u[0] * v[1] - u[1] * v[0]), uu = u[0] ** 2 + u[1] ** 2, vv = v[0] ** 2 + v[1] ** 2;
  const arm = [(uu * v[1] - vv * u[1]) / cross, (vv * u[0] - uu * v[0]) / cross];
  return { fixed: pivot, moving: [a[0] + arm[0], a[1] + arm[1]], length: Math.hypot(...arm) };
}
