// What a hand snaps to: pivots, corners, poses and their axes, the grid; and the mark that says so.
//
// Alt frees a hand, Shift holds an axis, or steps of an angle.

import { put, s, say } from "../widget/dom.mjs";
import { act } from "../widget/kinematics.mjs";
import { px, radians, ticks } from "../widget/numbers.mjs";
import { currentLinkage } from "./conditions.mjs";
import { bodyOf, limitRegions, poseName, regionsOf, standing } from "./document.mjs";
import { outlineOf } from "./region_geometry.mjs";

const POINT = 9, LINE = 6, GRID = 4; // pixels within which each of them attracts
const FINER = 5; // the grid that attracts, to the one that is drawn
const STEP = 15, NEAR = 2.2, PARALLEL = 1; // degrees
const MOST = 40; // poses that attract

const tenths = (angle) => Number(angle.toFixed(1)) + 0;

export class Snapping {
  isOn = true;

  constructor(store, scene) {
    this.store = store;
    this.scene = scene;
    this.text = s("text", { class: "bs-snap-name" });
    this.mark = s("path", { class: "bs-snap-mark" });
    this.element = s("g", { class: "bs-snap", "aria-hidden": "true" }, this.mark, this.text);
    for (const name of ["dropped", "tool"]) scene.on(name, () => this.clear());
  }

  clear() {
    this.element.remove();
  }

  /** Say what a point of F snapped to.
   * @param {number[]} point @param {string} name */
  show(point, name) {
    const [x, y] = point;
    const { view } = this.scene, X = view.X(x), Y = view.Y(y);
    put(this.mark, "d", `M${px(X)} ${px(Y)}m-7 0h14m-7 -7v14`);
    put(this.text, "x", px(X + 10));
    put(this.text, "y", px(Y - 10));
    say(this.text, name);
    this.scene.layer("tool").append(this.element);
  }

  place(k) {
    const { x, y, angle } = standing(this.store.document, k);
    return { x, y, a: radians(angle) };
  }

  /** What attracts: { at, name, of } points of F, and { at, along, name, of } lines; of: what it belongs to. */
  targets() {
    const { store } = this, { document } = store, poses = [...document.poses.keys()].slice(0, MOST), points = [], lines = [];
    const corners = (list, name, of, place = { x: 0, y: 0, a: 0 }) => points.push(...list.map((point) => ({ at: act(place, point), name: `corner of ${name}`, of, isStated: !place.x && !place.y && !place.a })));
    for (const dyad of currentLinkage(store)?.led ?? []) {
      if (dyad.fixed_pivot) points.push({ at: dyad.fixed_pivot, name: `fixed pivot of ${dyad.id}`, of: "linkage" });
      if (dyad.moving_pivot && poses.length) points.push({ at: act(this.place(store.referenceIndex), dyad.moving_pivot), name: `moving pivot of ${dyad.id}`, of: "linkage" });
    }
    regionsOf(document).forEach((region, k) => (region.box || region.polygon) && corners(region.polygon ?? outlineOf("box", region.box), region.name ?? `region ${k + 1}`, `region ${k}`));
    limitRegions(document).forEach(({ key, shape, points: list }, k) => key === "fixed_pivot" && corners(outlineOf(shape, list), "the limit", `limit ${k}`));
    for (const k of poses) {
      const { x, y, a } = this.place(k), name = `pose ${poseName(document, k)}`, of = `pose ${k}`;
      points.push({ at: [x, y], name, of, isStated: true });
      if (document.poses[k].angle !== undefined) for (const turn of [0, 90]) lines.push({ at: [x, y], along: [Math.cos(a + radians(turn)), Math.sin(a + radians(turn))], name: `${turn ? "y" : "x"} axis of ${name}`, of });
      corners(bodyOf(document), `the body at ${name}`, `body ${of}`, { x, y, a });
    }
    return { points, lines };
  }

  /** Where a hand at a point of F puts something.
   *
   * from: where it was; skip(of): whether a target is what is moved itself.
   * @param {number[]} point @param {{ event?: any, from?: number[] | null, skip?: (of: string) => boolean }} how
   */
  point([x, y], { event, from = null, skip = () => false } = {}) {
    const { scene } = this, { scale } = scene.view, rounded = (pair) => pair.map((value) => scene.rounded(value));
    this.clear();
    if (event?.shiftKey && from) {
      const across = Math.abs(x - from[0]) >= Math.abs(y - from[1]), at = across ? [scene.rounded(x), from[1]] : [from[0], scene.rounded(y)];
      this.show(at, across ? "horizontal" : "vertical");
      return at;
    }
    if (!this.isOn || event?.altKey) return rounded([x, y]);
    const { points, lines } = this.targets();
    const away = ({ at, along }) => scale * (along ? Math.abs((x - at[0]) * along[1] - (y - at[1]) * along[0]) : Math.hypot(x - at[0], y - at[1]));
    const nearest = (list, most) => list.filter(({ of }) => !skip(of)).map((each) => ({ ...each, away: away(each) })).filter((each) => each.away < most).sort((a, b) => a.away - b.away)[0];
    const onPoint = nearest(points, POINT), onLine = onPoint ? null : nearest(lines, LINE);
    if (onPoint) {
      this.show(onPoint.at, onPoint.name);
      return onPoint.isStated ? onPoint.at : rounded(onPoint.at); // more digits would say that a pose is known so well
    }
    if (onLine) {
      const { at, along } = onLine, share = (x - at[0]) * along[0] + (y - at[1]) * along[1], foot = [at[0] + share * along[0], at[1] + share * along[1]];
      this.show(foot, onLine.name);
      return rounded(foot);
    }
    const step = this.gridStep, found = [x, y].map((value) => {
      const line = Number((Math.round(value / step) * step).toPrecision(12));
      return scale * Math.abs(line - value) < GRID ? line : null;
    });
    const at = rounded([x, y]).map((value, k) => found[k] ?? value);
    if (found.some((value) => value !== null)) this.show(at, found.includes(null) ? `grid, ${found[0] === null ? "y" : "x"} ${found[0] ?? found[1]}` : "grid");
    return at;
  }

  get gridStep() {
    const { view } = this.scene, [one, other] = ticks(view.x(0), view.x(view.width), view.width / 110);
    return (other ? other.at - one.at : 10 ** Math.round(Math.log10(100 / view.scale))) / FINER;
  }

  /** The angle in degrees that a hand turns something to, about a point of F. */
  angle(angle, at, { event, skip = -1 }) {
    this.clear();
    const step = STEP * Math.round(angle / STEP);
    if (event?.altKey || (!this.isOn && !event?.shiftKey)) return tenths(angle);
    if (event?.shiftKey || Math.abs(step - angle) < NEAR) {
      this.show(at, `${step}°`);
      return step;
    }
    const { document } = this.store, off = (pose) => Math.abs(((pose.angle - angle + 540) % 360) - 180);
    const k = document.poses.slice(0, MOST).findIndex((pose, k) => k !== skip && pose.angle !== undefined && off(pose) < PARALLEL);
    if (k < 0) return tenths(angle);
    const same = document.poses[k].angle;
    this.show(at, `parallel to pose ${poseName(document, k)}`);
    return same + 360 * Math.round((angle - same) / 360);
  }
}
