// Two linkages at the same stage of their motion: between the same two poses, at the same share of the way.

/** @typedef {import("../widget/types").Moved} Moved @typedef {import("../widget/types").AtPose} AtPose */

/** The poses of a way in their order along it: { k, frame } each.
 * @param {Moved} linkage @param {number} index */
const stopsOf = (linkage, index) =>
  linkage.pose_errors.map((row, k) => ({ k, way: row.way, frame: row.frame })).filter((stop) => stop.way === index).sort((a, b) => a.frame - b.frame);

/** Where frame u of a way is: between poses `from` and `to`, at a share from 0 to 1; null on a way without poses.
 *
 * Before the first pose and behind the last one the share is outside, in steps between these two, but no farther
 * than one of them.
 * @param {Moved} linkage @param {number} index @param {number} u
 * @returns {{ from: number, to: number, share: number } | null} */
export function stageOf(linkage, index, u) {
  const stops = stopsOf(linkage, index);
  if (!stops.length) return null;
  if (stops.length === 1) return { from: stops[0].k, to: stops[0].k, share: 0 };
  let at = 0;
  while (at + 2 < stops.length && stops[at + 1].frame <= u) at += 1;
  const [a, b] = [stops[at], stops[at + 1]], step = b.frame - a.frame;
  const share = step > 0 ? (u - a.frame) / step : 0;
  return { from: a.k, to: b.k, share: Math.min(Math.max(share, -1), 2) };
}

/** @param {AtPose} row @returns {row is AtPose & { way: number }} */
const there = (row) => Boolean(row) && row.way !== null;

/** The way and the frame at which a linkage is at a stage; null where it reaches neither of the poses.
 *
 * Where the poses are on different ways, it stands at the nearer one of them.
 * @param {Moved} linkage @param {{ from: number, to: number, share: number } | null} stage
 * @returns {{ way: number, u: number } | null} */
export function frameAtStage(linkage, stage) {
  if (!stage) return null;
  const [a, b] = [stage.from, stage.to].map((k) => linkage.pose_errors[k]);
  if (!there(a) || !there(b) || a.way !== b.way) {
    const [near, other] = stage.share < 0.5 ? [a, b] : [b, a];
    const row = there(near) ? near : there(other) ? other : null;
    return row && { way: row.way, u: row.frame };
  }
  const way = linkage.ways[a.way], last = way.x.length - 1;
  let step = b.frame - a.frame;
  if (way.round && Math.abs(step) > last / 2) step -= Math.sign(step) * last; // the shorter way round
  const u = a.frame + stage.share * step;
  return { way: a.way, u: way.round ? ((u % last) + last) % last : Math.min(Math.max(u, 0), last) };
}
