// Where a six-bar of Watt's first kind is: two loops of four links, each closed by two circles that meet.
//
// Points are [x, y], and are multiplied as complex numbers: a turned link is a product.  Angles of
// the driver are in degrees, in F.

import { frameAt } from "./kinematics.mjs";
import { degrees, radians } from "./numbers.mjs";

const FRAMES = 361; // along a way

const plus = (p, q) => [p[0] + q[0], p[1] + q[1]];
const minus = (p, q) => [p[0] - q[0], p[1] - q[1]];
const times = (p, q) => [p[0] * q[0] - p[1] * q[1], p[0] * q[1] + p[1] * q[0]];
const scaled = (p, k) => [k * p[0], k * p[1]];
const size = (p) => Math.hypot(p[0], p[1]);
const over = (p, q) => scaled(times(p, [q[0], -q[1]]), 1 / (q[0] * q[0] + q[1] * q[1]));

/** Where two circles meet, to the left (side 1) or right (-1) of the line between their centres; at a dead point they touch. */
function meeting(centre, radius, other, otherRadius, side) {
  const way = minus(other, centre), squared = size(way) ** 2;
  const along = (squared + radius ** 2 - otherRadius ** 2) / (2 * squared);
  return plus(centre, times(way, [along, side * Math.sqrt(Math.max(0, radius ** 2 / squared - along ** 2))]));
}

/** The angle between two lines, from 0° to 90°. */
function acute(p, q) {
  const [across, around] = times(p, [q[0], -q[1]]);
  return degrees(Math.atan2(Math.abs(around), Math.abs(across)));
}

/** The place of the body where the driver stands at an angle, with all joints and the transmission angle of each loop. */
export function sixBarAt(sixBar, drive) {
  const { ground, coupler, body } = sixBar, { A, B } = ground, isFirst = sixBar.driver === "first";
  const arm = (length) => [length * Math.cos(radians(drive)), length * Math.sin(radians(drive))];
  const bar = size(coupler.D);
  let C, D;
  if (isFirst) {
    C = plus(A, arm(sixBar.first_crank));
    D = meeting(C, bar, B, sixBar.second_crank, sixBar.sides[0]);
  } else {
    D = plus(B, arm(sixBar.second_crank));
    C = meeting(D, bar, A, sixBar.first_crank, sixBar.sides[0]);
  }
  const E = plus(C, times(over(minus(D, C), coupler.D), coupler.E));
  const G = plus(B, times(scaled(minus(D, B), 1 / sixBar.second_crank), sixBar.crank_joint));
  const held = minus(body.H, body.E);
  const H = meeting(G, sixBar.floating_link, E, size(held), sixBar.sides[1]);
  const turn = over(minus(H, E), held), [x, y] = minus(E, times(turn, body.E));
  const first = isFirst ? acute(minus(C, D), minus(B, D)) : acute(minus(D, C), minus(A, C));
  const loops = [first, acute(minus(G, H), minus(E, H))];
  return { x, y, a: Math.atan2(turn[1], turn[0]), joints: { A, B, C, D, E, G, H }, loops, transmission: Math.min(...loops) };
}

/** All that the driver reaches, as frames; they lie closer where it comes to rest at a dead point. */
function wayOf(sixBar) {
  const [low, high] = sixBar.ends_deg, round = sixBar.turns_fully;
  const share = (k) => (round ? k / (FRAMES - 1) : (1 - Math.cos((Math.PI * k) / (FRAMES - 1))) / 2);
  const drive = Array.from({ length: FRAMES }, (_, k) => low + (high - low) * share(k));
  const places = drive.map((each) => sixBarAt(sixBar, each));
  const column = (value) => places.map(value);
  return {
    circuit: 1, branch: 1, branches: 1, round, dead: [!round, !round], poses: sixBar.drive_deg.map((_, k) => k + 1), drive,
    x: column((at) => at.x), y: column((at) => at.y), angle: column((at) => at.a),
    transmission: column((at) => at.transmission), loops: [0, 1].map((k) => column((at) => at.loops[k])),
  };
}

/** A six-bar with its one way, its cranks (the driver first), and where it is at the poses. */
export function moving(sixBar, poses) {
  const way = wayOf(sixBar), { A, B } = sixBar.ground;
  const cranks = [{ id: "AC", kind: "crank", fixed_pivot: A }, { id: "BD", kind: "crank", fixed_pivot: B }];
  return {
    ...sixBar,
    ways: [way],
    led: sixBar.driver === "first" ? cranks : cranks.reverse(),
    pose_errors: sixBar.drive_deg.map((drive, k) => {
      const at = sixBarAt(sixBar, drive);
      return {
        x: at.x, y: at.y, angle_deg: degrees(at.a), way: 0, frame: frameAt(way.drive, drive), drive_deg: drive, joints: at.joints, loops: at.loops,
        position: Math.hypot(at.x - poses[k].x, at.y - poses[k].y), transmission_deg: at.transmission,
        said: { position: sixBar.said.errors?.[k][0] ?? "exact", turned: sixBar.said.errors?.[k][1] ?? "exact" },
      };
    }),
  };
}
