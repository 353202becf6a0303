// Points of loads to take hold of: the centre of mass, the hand, where forces act, and the ends of springs.

import { put, s } from "../widget/dom.mjs";
import { act, back } from "../widget/kinematics.mjs";
import { px } from "../widget/numbers.mjs";
import { referencePlace } from "./body_editor.mjs";
import { standing } from "./document.mjs";
import { stepOf, stepped } from "./fields.mjs";
import { endOf, forcesOf, linkPlace, loadPoints, setAt } from "./loads.mjs";
import { Kept } from "./scene.mjs";
import { ARROWS } from "./shape_handles.mjs";

const ARROW = 46; // pixels: of a force, however strong
const NEAR = 14, BESIDE = [24, -24]; // pixels: of a pose, whose handle lies over a point; where the point's own is then
const MARKS = { // pixels, about the point
  centre: "M-8 0a8 8 0 0 1 8 -8v16a8 8 0 0 0 8 -8zM-8 0a8 8 0 1 0 16 0a8 8 0 1 0 -16 0",
  hand: "M-6 0a6 6 0 1 0 12 0a6 6 0 1 0 -12 0M-2 0h4M0 -2v4", force: "M-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0", spring: "M-6 0L0 -6L6 0L0 6Z",
};

export class LoadHandles {
  /** @type {any} */ items;
  /** @type {any} */ keyed;

  constructor(store, scene, playing) {
    this.store = store;
    this.scene = scene;
    this.playing = playing;
    const group = s("g", { class: "bs-load-points" });
    scene.layer("pivots").append(group);
    this.kept = new Kept(group, (key, item) => this.make(item), (element, item) => this.show(element, item));
    store.on("document selection", () => this.draw());
    playing.on("place shape", () => this.draw());
    scene.on("view", () => this.draw());
    this.draw();
  }

  /** Where a link is now; null where that is not known. */
  placeOf(link) {
    const { here, linkage } = this.playing, there = linkage && !linkage.gone;
    return linkPlace(link, (there && here?.place) || referencePlace(this.store), there ? linkage : null);
  }

  draw() {
    const { document } = this.store;
    this.items = new Map(document.poses.length ? loadPoints(document).map((item) => [item.key, item]) : []);
    this.kept.draw(this.items);
  }

  make({ key, kind }) {
    const element = s("g", { class: `bs-load-point bs-load-${kind}`, "data-load": key, tabindex: 0, role: "button" }, s("path", { class: "bs-load-leader" }), s("circle", { class: "bs-hold", r: 12 }), s("path", { class: "bs-load-arrow" }), s("path", { class: "bs-load-mark", d: MARKS[kind] }));
    let gesture, place, from, off;
    this.scene.drag(element, {
      start: ({ x, y }) => {
        const { link, point } = this.items.get(key);
        gesture = Symbol(key);
        place = this.placeOf(link);
        if (!place) return false;
        this.playing.player.play(false);
        from = act(place, point);
        off = this.beside(from) ? [from[0] - x, from[1] - y] : [0, 0];
        return true;
      },
      move: ({ x, y }, event) => {
        const at = this.scene.snap.point([x + off[0], y + off[1]], { event, from });
        this.put(key, back(place, at).map((each) => this.scene.rounded(each)), gesture);
      },
      cancel: () => this.store.abandon(gesture),
    });
    element.addEventListener("keydown", (event) => this.keys(event, key));
    return element;
  }

  show(element, { name, link, point, key }) {
    const { view } = this.scene, place = this.placeOf(link), [mark] = element.getElementsByClassName("bs-load-arrow");
    put(element, "display", place ? "inline" : "none");
    if (!place) return;
    const [x, y] = act(place, point), [dx, dy] = this.beside([x, y]) ? BESIDE : [0, 0];
    put(element, "transform", `translate(${px(view.X(x) + dx)} ${px(view.Y(y) + dy)})`);
    put(element.firstElementChild, "d", dx ? `M0 0L${-dx} ${-dy}` : "");
    put(element, "aria-label", `${name} at (${point.map((each) => Number(each.toPrecision(6))).join(", ")}). Drag it, or use the arrow keys.`);
    const force = key.startsWith("force") ? forcesOf(this.store.document)[Number(key.slice(6))] : null;
    put(mark, "d", force ? arrow(force, place) : "");
  }

  /** Whether a point of F is so near to a pose that its handle has to stand beside it.
   * @param {number[]} point
   */
  beside([x, y]) {
    const { scale } = this.scene.view, { document } = this.store;
    return document.poses.some((_, k) => {
      const pose = standing(document, k);
      return scale * Math.hypot(pose.x - x, pose.y - y) < NEAR;
    });
  }

  put(key, point, gesture) {
    this.store.edit((document) => setAt(document, this.items.get(key).path, point), { gesture });
  }

  keys(event, key) {
    const way = ARROWS[event.key];
    if (!way || event.ctrlKey || event.metaKey) return;
    if (!event.repeat) this.keyed = Symbol("keys");
    const by = stepOf(event, this.scene.step);
    this.put(key, this.items.get(key).point.map((value, axis) => stepped(value, by * way[axis])), this.keyed);
    event.preventDefault();
    event.stopPropagation();
  }

  /** The same point of the plane on another link, as a point of that. */
  moved(spring, side, link) {
    const end = endOf(spring, side), from = this.placeOf(end.link), to = this.placeOf(link);
    return from && to ? back(to, act(from, end.point)).map((each) => this.scene.rounded(each)) : end.point;
  }
}

/** A force as an arrow from its point, in pixels. */
function arrow({ force_N: [u, v], frame }, { a }) {
  const angle = Math.atan2(v, u) + (frame === "M" ? a : 0), c = Math.cos(angle), d = -Math.sin(angle), at = (along, across) => `${px(along * c - across * d)} ${px(along * d + across * c)}`;
  return u || v ? `M0 0L${at(ARROW, 0)}M${at(ARROW - 9, 5)}L${at(ARROW, 0)}L${at(ARROW - 9, -5)}` : "";
}
