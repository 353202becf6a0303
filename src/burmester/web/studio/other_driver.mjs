// The same linkage driven by its other dyad: the body's motion stays, but dead points and ways are
// those of the other input.

import { placeAt } from "../widget/kinematics.mjs";
import { driveOf, transmissionOf } from "../widget/instantaneous.mjs";
import { degrees } from "../widget/numbers.mjs";

const APART = 3; // steps between frames: ends of two ways farther apart are not the same dead point
const GOLDEN = 0.381966011250105;
const HALVINGS = 24; // steps towards a dead point between two frames

/** A linkage whose ways are those of its other driver; poses keep their places.
 *
 * Dead points are found between the frames of its ways to the precision of a drawing.
 * @param {object} linkage as a report has it, `pose_errors` with `at`
 * @param {number} length the unit length that weighs angles
 */
export function drivenByOther(linkage, length) {
  const led = [linkage.led[1], linkage.led[0]];
  if (led[0].kind === "PP" || !linkage.ways.length) return { ...linkage, led, loads: null, ways: [], pose_errors: linkage.pose_errors.map((row) => ({ ...row, way: null, frame: null, at: null })) };
  const ways = /** @type {any[]} */ ([]), places = Array(linkage.pose_errors.length).fill(null); // of every pose its way and frame
  for (const chain of chainsOf(linkage.ways)) {
    for (const piece of piecesOf(linkage, led[0], chain, length)) {
      const way = wayOf(linkage, led, piece, chain, length);
      const number = ways.push(way) - 1;
      linkage.pose_errors.forEach((row, k) => {
        const frame = places[k] || row.way === null ? null : frameIn(piece, row, linkage.ways[row.way].x.length - 1);
        if (frame === null) return;
        places[k] = [number, way.falls ? piece.stations.length - 1 - frame : frame];
        way.poses.push(k + 1);
      });
    }
  }
  const named = new Map();
  for (const way of ways) {
    way.branches = ways.filter((each) => each.circuit === way.circuit).length;
    named.set(way.circuit, (named.get(way.circuit) ?? 0) + 1);
    way.branch = named.get(way.circuit);
  }
  const pose_errors = linkage.pose_errors.map((row, k) => ({
    ...row, way: places[k]?.[0] ?? null, frame: places[k]?.[1] ?? null, at: places[k] ? ways[places[k][0]] : null,
    transmission_deg: row.x === null ? null : transmissionOf(led[0], led[1], { x: row.x, y: row.y, a: (row.angle_deg * Math.PI) / 180 }),
  }));
  return { ...linkage, led, loads: null, ways, pose_errors }; // what the other driver bears is not known
}

/** The ways of each circuit one behind the other: stations { way, u }, and whether they close. */
function chainsOf(ways) {
  const chains = [];
  for (const circuit of new Set(ways.map((way) => way.circuit))) {
    const own = ways.map((way, number) => ({ way, number })).filter(({ way }) => way.circuit === circuit);
    const stations = ({ way, number }, turned) => {
      const all = Array.from(way.x, (_, u) => ({ way: number, u }));
      return turned ? all.reverse() : all;
    };
    const [one, other] = own;
    const joined = (end, start) => other && one.way.dead[end] && other.way.dead[start] && near(one.way, end, other.way, start);
    if (!other || !(joined(0, 0) || joined(1, 1))) {
      for (const each of own) chains.push({ circuit, closed: each.way.round, stations: stations(each, false) });
      continue;
    }
    const closed = joined(0, 0) && joined(1, 1), high = joined(1, 1);
    // Through the dead point that both share: its frame stands once.
    const through = [...stations(one, !high), ...stations(other, high).slice(1)];
    chains.push({ circuit, closed, stations: through });
  }
  return chains;
}

/** Whether an end of one way is the place where another one ends. */
function near(one, end, other, start) {
  const at = (way, k) => [way.x[k], way.y[k]], last = (way, k) => (k ? way.x.length - 1 : 0);
  const [i, j] = [last(one, end), last(other, start)], inner = end ? i - 1 : 1;
  const step = Math.hypot(...at(one, i).map((v, k) => v - at(one, inner)[k]));
  const away = Math.hypot(...at(one, i).map((v, k) => v - at(other, j)[k]));
  return away <= APART * step + 1e-9 * Math.hypot(...at(one, i));
}

/** Parts of a chain along which the other input only rises or falls, cut at its dead points. */
function piecesOf(linkage, driver, { circuit, closed, stations }, length) {
  const placeOf = ({ way, u }) => placeAt(linkage, linkage.ways[way], u, length);
  const slides = driver.kind === "PR";
  let before = null;
  const driveAt = (station) => {
    let drive = driveOf(driver, placeOf(station));
    if (!slides && before !== null) drive -= 2 * Math.PI * Math.round((drive - before) / (2 * Math.PI));
    return drive;
  };
  const drives = stations.map((station) => (before = driveAt(station)));
  const count = stations.length - 1, sense = (k) => Math.sign(drives[k + 1] - drives[k]);
  const cuts = [];
  for (let k = 1; k < count; k += 1) if (sense(k) * sense(k - 1) < 0) cuts.push(k);
  if (closed && sense(0) * sense(count - 1) < 0) cuts.push(0);
  if (!cuts.length) return [{ circuit, round: closed, dead: [false, false], stations }];
  const dead = new Map(cuts.map((k) => [k, extreme(k)]));

  /** The dead point near frame k: where the input is greatest, or least. */
  function extreme(k) {
    const here = stations[k], up = drives[k] > drives[k === 0 ? 1 : k - 1] ? 1 : -1;
    before = drives[k];
    const sides = [k > 0 ? k - 1 : count - 1, k + 1].map((at) => {
      const there = stations[at];
      if (there.way === here.way && Math.abs(there.u - here.u) < 1.5) return [here.way, here.u, there.u];
      // Across the end of a way: the same place is an end of the other one.
      return [there.way, there.u, there.u < 1.5 ? 0 : there.u + 1];
    });
    const value = (way, u) => up * driveAt({ way, u });
    let best = { station: here, value: value(here.way, here.u) };
    for (const [way, u, v] of sides) {
      let [low, high] = [Math.min(u, v), Math.max(u, v)];
      for (let step = 0; step < HALVINGS; step += 1) {
        const [a, b] = [low + GOLDEN * (high - low), high - GOLDEN * (high - low)];
        if (value(way, a) < value(way, b)) low = a;
        else high = b;
      }
      const station = { way, u: (low + high) / 2 }, found = value(way, station.u);
      if (found > best.value) best = { station, value: found };
    }
    return best.station;
  }

  const part = (from, to) => {
    const inner = [];
    for (let k = from + 1; k < to; k += 1) inner.push(stations[closed ? k % count : k]);
    const ends = [from, to].map((k) => dead.get(closed ? k % count : k) ?? stations[k]);
    return [ends[0], ...inner.filter((each) => !ends.some((end) => end.way === each.way && Math.abs(end.u - each.u) < 1e-3)), ends[1]];
  };
  cuts.sort((a, b) => a - b);
  if (closed) {
    const at = [...cuts, cuts[0] + count];
    return at.slice(1).map((to, k) => ({ circuit, round: false, dead: [true, true], stations: part(at[k], to) }));
  }
  const at = [0, ...cuts, count];
  return at.slice(1).map((to, k) => ({ circuit, round: false, dead: [k > 0, to < count], stations: part(at[k], to) }));
}

/** A way through the stations of a piece, its drive rising. */
function wayOf(linkage, led, piece, chain, length) {
  const slides = led[0].kind === "PR", places = piece.stations.map(({ way, u }) => ({ ...placeAt(linkage, linkage.ways[way], u, length) }));
  const drive = [];
  places.forEach((place, k) => {
    let value = driveOf(led[0], place);
    if (!slides && k) value -= 2 * Math.PI * Math.round((value - drive[k - 1]) / (2 * Math.PI));
    if (k) place.a -= 2 * Math.PI * Math.round((place.a - places[k - 1].a) / (2 * Math.PI));
    drive.push(value);
  });
  const falls = drive[drive.length - 1] < drive[0];
  if (falls) [drive, places].forEach((each) => each.reverse());
  const turns = slides ? 0 : 2 * Math.PI * Math.round((drive[0] + drive[drive.length - 1]) / (4 * Math.PI));
  return {
    circuit: chain.circuit, round: piece.round, dead: falls ? [...piece.dead].reverse() : piece.dead, poses: /** @type {number[]} */ ([]), falls,
    drive: drive.map((value) => (slides ? value : degrees(value - turns))),
    x: places.map(({ x }) => x), y: places.map(({ y }) => y), angle: places.map(({ a }) => a),
    transmission: places.map((place) => transmissionOf(led[0], led[1], place)),
  };
}

/** Where on a piece, in its own frames, a pose stands; null where it is not on it.  last: of the frames of its way. */
function frameIn({ stations }, { way, frame }, last) {
  for (let k = 0; k + 1 < stations.length; k += 1) {
    const [a, b] = [stations[k], stations[k + 1]];
    if (a.way !== way || b.way !== way) {
      if (a.way === way && Math.abs(a.u - frame) < 1e-9) return k;
      if (b.way === way && Math.abs(b.u - frame) < 1e-9) return k + 1;
      continue;
    }
    // Where a turn is cut open its last frame is its first.
    const [u, v] = Math.abs(b.u - a.u) > last / 2 ? [a, b].map((each) => each.u + (each.u < last / 2 ? last : 0)) : [a.u, b.u];
    for (const at of [frame, frame + last]) {
      if (at >= Math.min(u, v) - 1e-9 && at <= Math.max(u, v) + 1e-9) return u === v ? k : k + (at - u) / (v - u);
      if (Math.max(u, v) <= last) break;
    }
  }
  return null;
}
