// Springs, counterweights, the arrow of a hand and the forces of pins, beside a linkage that moves.

import { put, s } from "./dom.mjs";
import { act, valueAt } from "./kinematics.mjs";
import { px } from "./numbers.mjs";

const COILS = 9, LEAD = 0.15; // of a coil spring: its coils, and the straight part at each end
const BARREL = 0.6; // of a gas spring's length: its cylinder
const HALF_WIDTH = 6; // pixels
const LEAST_ARROW = 16, LONGEST_ARROW = 62; // pixels: of a hand that does nothing, and of one at its strongest
const RADIUS = 11, TURNS = 2.25; // pixels: of a torsion spring, a spiral of so many turns, and of a counterweight
const LONGEST_FORCE = 90, LEAST_FORCE = 2; // pixels: of the greatest force of all pins; a shorter one is not drawn
const BARB = [9, 4.5]; // pixels: along and across an arrow

/** A spring from one point in pixels to another one: a zigzag, a cylinder with its rod, or a straight line.
 * @param {string} kind @param {any} one @param {any} other */
export function springPath(kind, [x, y], [u, v]) {
  const length = Math.hypot(u - x, v - y) || 1, across = [(-HALF_WIDTH * (v - y)) / length, (HALF_WIDTH * (u - x)) / length];
  const at = (share, side) => `${px(x + share * (u - x) + side * across[0])} ${px(y + share * (v - y) + side * across[1])}`;
  if (kind === "constant") return `M${at(0, 0)}L${at(1, 0)}`;
  if (kind === "gas") return `M${at(0, 1)}L${at(BARREL, 1)}L${at(BARREL, -1)}L${at(0, -1)}ZM${at(BARREL, 0)}L${at(1, 0)}`;
  const teeth = Array.from({ length: 2 * COILS + 1 }, (_, k) => at(LEAD + ((1 - 2 * LEAD) * k) / (2 * COILS), k % (2 * COILS) ? (k % 2 ? 1 : -1) : 0));
  return `M${[at(0, 0), ...teeth, at(1, 0)].join("L")}`;
}

/** A spiral, or a disc with a cross, around a point in pixels.
 * @param {string} kind @param {any} middle */
export function roundPath(kind, [x, y]) {
  if (kind !== "torsion") return `M${px(x - RADIUS)} ${px(y)}a${RADIUS} ${RADIUS} 0 1 0 ${2 * RADIUS} 0a${RADIUS} ${RADIUS} 0 1 0 ${-2 * RADIUS} 0h${2 * RADIUS}M${px(x)} ${px(y - RADIUS)}v${2 * RADIUS}`;
  const points = Array.from({ length: 55 }, (_, k) => [(k / 54) * RADIUS, (k / 54) * 2 * Math.PI * TURNS]);
  return `M${points.map(([r, turn]) => `${px(x + r * Math.cos(turn))} ${px(y - r * Math.sin(turn))}`).join("L")}`;
}

/** Where springs and the hand are while the body is at places: points of F. */
export function markPoints({ loads }, places) {
  if (!loads) return [];
  const ends = loads.springs.flatMap((spring) => spring.ends), on = (name) => ends.filter(({ link }) => link === name).map(({ point }) => point);
  return [...on("ground"), ...places.flatMap((place) => [...on("body"), ...(loads.hand ? [loads.hand] : [])].map((point) => act(place, point)))];
}

/** An arrow from a point in pixels in a direction of F.
 * @param {any} point @param {number} angle @param {number} length */
function arrowPath([x, y], angle, length) {
  const c = Math.cos(angle), d = -Math.sin(angle), tip = [x + length * c, y + length * d];
  const barb = (side) => `${px(tip[0] - BARB[0] * c - side * BARB[1] * d)} ${px(tip[1] - BARB[0] * d + side * BARB[1] * c)}`;
  return `M${px(x)} ${px(y)}L${tip.map(px).join(" ")}M${barb(1)}L${tip.map(px).join(" ")}L${barb(-1)}`;
}

/** `group` holds what is drawn; `shape` says of which linkage, `show` at which place and drive. */
export class LoadMarks {
  constructor() {
    this.springs = s("g", { class: "bm-springs" });
    this.hand = s("path", { class: "bm-hand" });
    this.forces = s("g", { class: "bm-pin-forces" });
    this.group = s("g", { class: "bm-loads" }, this.springs, this.hand, this.forces);
  }

  /** @param {any} data @param {any} linkage @param {import("./types").View} view */
  shape(data, linkage, view) {
    this.view = view;
    this.loads = data.loads ?? null;
    this.known = (linkage.followed ? null : linkage.loads) ?? null; // while a hand drags they are those of before
    const springs = this.loads?.springs ?? [];
    while (this.springs.children.length > springs.length) this.springs.lastChild?.remove();
    while (this.springs.children.length < springs.length) this.springs.append(s("g", {}, s("path", { class: "bm-spring" }), s("circle", { class: "bm-spring-end", r: 2.6 }), s("circle", { class: "bm-spring-end", r: 2.6 })));
    springs.forEach(({ kind, ends }, k) => {
      const [, ...marks] = this.springs.children[k].children;
      put(this.springs.children[k], "data-spring", kind);
      for (const mark of marks) put(mark, "visibility", ends.length > 1 ? "inherit" : "hidden");
    });
    const pins = this.known?.pins ?? [];
    this.greatest = Math.max(0, ...pins.flatMap(({ force: [x, y] }) => x.map((each, i) => (each === null || y[i] === null ? 0 : Math.hypot(each, y[i])))));
    this.forces.replaceChildren(...pins.map(({ name }) => s("g", { "data-pin": name }, s("path", { class: "bm-pin-force" }), s("text", { class: "bm-pin-newtons" }))));
  }

  /** @param {import("./types").Place} place @param {number | null} drive */
  show(place, drive) {
    const { loads, view } = this;
    if (!loads || !view) {
      put(this.hand, "d", "");
      return;
    }
    loads.springs.forEach(({ kind, ends }, k) => {
      const at = ends.map((end, j) => this.endOf(end, k, j, place, drive)), group = this.springs.children[k];
      put(group, "visibility", at.every(Boolean) ? "inherit" : "hidden");
      if (!at.every(Boolean)) return;
      put(group.children[0], "d", at.length > 1 ? springPath(kind, at[0], at[1]) : roundPath(kind, at[0]));
      at.forEach(([x, y], j) => {
        put(group.children[j + 1], "cx", px(x));
        put(group.children[j + 1], "cy", px(y));
      });
    });
    (this.known?.pins ?? []).forEach((pin, k) => this.showForce(this.forces.children[k], pin, drive));
    const pushes = this.known?.hand, angle = pushes && drive !== null ? valueAt(pushes, drive) : null;
    if (!loads.hand || angle === null) put(this.hand, "d", "");
    else {
      const force = valueAt({ x: pushes.x, y: pushes.force }, drive) ?? 0, size = LEAST_ARROW + (LONGEST_ARROW - LEAST_ARROW) * Math.abs(force);
      put(this.hand, "d", arrowPath(this.seen(act(place, loads.hand)), force < 0 ? angle + Math.PI : angle, size));
    }
  }

  /** The force of a pin at a drive: an arrow, the longest of which is that of the greatest force, and its newtons. */
  showForce(group, { at, force }, drive) {
    const place = drive === null ? [null] : at.map((each) => valueAt(each, drive)), [x, y] = drive === null ? [null, null] : force.map((each) => valueAt({ x: at[0].x, y: each }, drive));
    const known = place.every((each) => each !== null) && x !== null && y !== null, size = known ? Math.hypot(x, y) : 0, long = this.greatest ? (LONGEST_FORCE * size) / this.greatest : 0;
    put(group, "visibility", long > LEAST_FORCE ? "inherit" : "hidden");
    if (!(long > LEAST_FORCE)) return;
    const from = this.seen(place), c = x / size, d = y / size;
    put(group.children[0], "d", arrowPath(from, Math.atan2(y, x), long));
    put(group.children[1], "x", px(from[0] + (long + 6) * c));
    put(group.children[1], "y", px(from[1] - (long + 6) * d + 4));
    put(group.children[1], "text-anchor", c < -0.3 ? "end" : c > 0.3 ? "start" : "middle");
    group.children[1].textContent = `${group.dataset.pin} ${Number(size.toPrecision(3))} N`;
  }

  /** A point of F in pixels.
   * @param {any} point */
  seen([x, y]) {
    const { view } = this;
    return view ? [view.X(x), view.Y(y)] : [0, 0];
  }

  /** An end of a spring in pixels; null where it is not known: on another link beyond the poses. */
  endOf({ link, point }, spring, end, place, drive) {
    if (link === "ground") return this.seen(point);
    if (link === "body") return this.seen(act(place, point));
    const known = this.known?.moved.find((each) => each.spring === spring && each.end === end);
    const at = known && drive !== null ? known.at.map((each) => valueAt(each, drive)) : [null];
    return at.some((each) => each === null) ? null : this.seen(at);
  }
}
