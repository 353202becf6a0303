// A shape in the plane to take hold of: its corners, the middles of its edges, and all of it.

import { put, s, say } from "../widget/dom.mjs";
import { act, back } from "../widget/kinematics.mjs";
import { px } from "../widget/numbers.mjs";
import { stepOf, stepped } from "./fields.mjs";
import { boxCorners, outlineOf } from "./region_geometry.mjs";
import { Kept } from "./scene.mjs";

export const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const LEAST_CORNERS = 3;
const CLOSED = new Set(["box", "polygon"]);
export const GROUND = { x: 0, y: 0, a: 0 }; // the place of F in F

/** The path of a shape in pixels; a line goes on beyond its two points. */
export function pathOf(shape, points, place, view) {
  const seen = outlineOf(shape, points).map((point) => act(place, point)).map(([x, y]) => [view.X(x), view.Y(y)]);
  if (shape === "point") return `M${px(seen[0][0] - 7)} ${px(seen[0][1])}h14m-7 -7v14`;
  if (shape === "line") {
    const [[a, b], [c, d]] = seen, size = Math.hypot(c - a, d - b) || 1, far = view.width + view.height + Math.hypot(a, b);
    const [u, v] = [(far * (c - a)) / size, (far * (d - b)) / size];
    return `M${px(a - u)} ${px(b - v)}L${px(c + u)} ${px(d + v)}`;
  }
  return `M${seen.map((point) => point.map(px).join(" ")).join("L")}${CLOSED.has(shape) ? "Z" : ""}`;
}

/** A corner of a shape moved; a box stays a box. */
function withCorner(shape, points, k, to) {
  if (shape !== "box") return points.map((point, i) => (i === k ? to : point));
  const opposite = boxCorners(points)[(k + 2) % 4];
  return [[Math.min(to[0], opposite[0]), Math.min(to[1], opposite[1])], [Math.max(to[0], opposite[0]), Math.max(to[1], opposite[1])]];
}

/** One shape; `what` is a function that says what it is now:
 * { shape, points, place, name, selected, state: "met" | "broken" | "", data }; set(points, gesture) changes it, remove() deletes it, select() chooses it.
 */
export class ShapeHandles {
  constructor(scene, { what, set, remove, select, abandon, className = "" }) {
    this.scene = scene;
    this.what = what;
    this.set = set;
    this.remove = remove;
    this.select = select;
    this.abandon = abandon;
    this.title = s("title");
    this.area = s("path", { class: "bs-shape-area", tabindex: 0, role: "button" }, this.title);
    this.line = s("path", { class: "bs-shape-line" });
    this.element = s("g", { class: `bs-shape ${className}` }, this.line, this.area);
    this.middles = new Kept(s("g"), (key, k) => this.makeMiddle(k), (element, k) => this.showMiddle(element, k));
    this.corners = new Kept(s("g"), (key, k) => this.makeCorner(k), (element, k) => this.showCorner(element, k));
    this.handles = s("g", { class: "bs-corners" }, this.middles.group, this.corners.group); // above all that is drawn
    this.dragWhole();
    this.area.addEventListener("focus", () => this.select());
    this.area.addEventListener("keydown", (event) => this.keys(event, (points, by) => points.map(([x, y]) => [stepped(x, by[0]), stepped(y, by[1])]), () => this.remove()));
  }

  draw() {
    const { shape, points, place, name, selected, state, data } = (this.now = this.what());
    const d = pathOf(shape, points, place, this.scene.view);
    put(this.line, "d", d);
    put(this.area, "d", d);
    this.area.classList.toggle("bs-open", !CLOSED.has(shape));
    put(this.area, "aria-label", `${name}${state ? `, ${state} by the chosen linkage` : ""}. Drag, or use the arrow keys; Delete removes it.`);
    put(this.area, "aria-pressed", Boolean(selected));
    say(this.title, name);
    for (const [key, value] of Object.entries({ ...data, shape })) put(this.element, `data-${key}`, value);
    this.element.classList.toggle("bs-selected", Boolean(selected));
    this.element.classList.toggle("bs-met", state === "met");
    this.element.classList.toggle("bs-broken", state === "broken");
    const [[key, value]] = Object.entries(data);
    put(this.handles, "data-handles", `${key} ${value}`.trim());
    if (!this.handles.parentNode) this.scene.layer("tool").append(this.handles);
    const count = selected ? outlineOf(shape, points).length : 0, edges = shape === "polygon" ? count : 0;
    this.corners.draw([...Array(count).keys()].map((k) => [k, k]));
    this.middles.draw([...Array(edges).keys()].map((k) => [k, k]));
  }

  /** Where the shape is no more. */
  clear() {
    this.element.remove();
    this.handles.remove();
  }

  at([x, y]) {
    const [u, v] = act(this.now.place, [x, y]);
    return { cx: px(this.scene.view.X(u)), cy: px(this.scene.view.Y(v)) };
  }

  /** A point of an event in the frame of the shape, as a hand sets it; from: where it was in that frame. */
  point({ x, y }, event, from) {
    const { place } = this.now, of = this.handles.dataset.handles ?? "", at = this.scene.snap.point([x, y], { event, from: from && act(place, from), skip: (each) => each.startsWith(of) });
    return this.inFrame(at);
  }

  /** A point of F in the frame of the shape; of that of the body to what a pixel tells. */
  inFrame(at) {
    const { place } = this.now;
    return place.x || place.y || place.a ? back(place, at).map((each) => this.scene.rounded(each)) : at;
  }

  /** The numbers of a corner beside it. */
  openField(k) {
    const { now: { name, place } } = this, corner = () => outlineOf(this.now.shape, this.now.points)[k];
    this.scene.field.open({
      name: `corner ${k + 1} of ${name}`, kind: this.scene.store.selection?.kind, fields: [["x", "x", "length"], ["y", "y", "length"]],
      at: () => corner() && this.element.isConnected && act(place, corner()), values: () => ({ x: corner()[0], y: corner()[1] }),
      set: ({ x = corner()[0], y = corner()[1] }) => this.set(withCorner(this.now.shape, this.now.points, k, [x, y]), null),
    });
  }

  dragWhole() {
    let gesture, off, before, corner;
    this.scene.drag(this.area, {
      start: (point) => {
        const away = (each) => Math.hypot(...act(this.now.place, each).map((value, k) => value - [point.x, point.y][k]));
        gesture = Symbol("move a shape");
        before = this.now.points;
        corner = before.reduce((one, other) => (away(other) < away(one) ? other : one)); // it snaps, and the others go along
        const [x, y] = act(this.now.place, corner);
        off = [x - point.x, y - point.y];
      },
      move: (point, event) => {
        const to = this.point({ x: point.x + off[0], y: point.y + off[1] }, event, corner), by = [to[0] - corner[0], to[1] - corner[1]];
        this.set(before.map(([x, y]) => [stepped(x, by[0]), stepped(y, by[1])]), gesture);
      },
      cancel: () => this.abandon(gesture),
      click: () => this.select(),
    });
  }

  makeCorner(k) {
    const circle = s("circle", { class: "bs-corner", r: 6, tabindex: 0, role: "button", "data-corner": k + 1 });
    let gesture, from;
    this.scene.drag(circle, {
      start: () => {
        gesture = Symbol("move a corner");
        from = outlineOf(this.now.shape, this.now.points)[k];
        this.openField(k);
      },
      move: (point, event) => this.set(withCorner(this.now.shape, this.now.points, k, this.point(point, event, from)), gesture),
      cancel: () => this.abandon(gesture),
      click: () => this.openField(k),
    });
    circle.addEventListener("keydown", (event) =>
      this.keys(event, (points, by) => {
        const [x, y] = outlineOf(this.now.shape, points)[k];
        return withCorner(this.now.shape, points, k, [stepped(x, by[0]), stepped(y, by[1])]);
      }, () => this.removeCorner(k)));
    return circle;
  }

  removeCorner(k) {
    const { shape, points } = this.now;
    if (shape !== "polygon" || points.length <= LEAST_CORNERS) return;
    this.set(points.filter((_, i) => i !== k), null);
  }

  /** The middle of an edge makes a corner when it is dragged. */
  makeMiddle(k) {
    const circle = s("circle", { class: "bs-middle", r: 4.5, "data-edge": k + 1 });
    let gesture;
    this.scene.drag(circle, {
      start: () => {
        gesture = Symbol("add a corner");
        this.set([...this.now.points.slice(0, k + 1), this.now.points[k], ...this.now.points.slice(k + 1)], gesture);
      },
      move: (point, event) => this.set(withCorner("polygon", this.now.points, k + 1, this.point(point, event)), gesture),
      cancel: () => this.abandon(gesture),
    });
    return circle;
  }

  showCorner(element, k) {
    const corner = outlineOf(this.now.shape, this.now.points)[k];
    for (const [name, value] of Object.entries(this.at(corner))) put(element, name, value);
    put(element, "aria-label", `Corner ${k + 1} of ${this.now.name}: ${corner.join(", ")}`);
  }

  showMiddle(element, k) {
    const { points } = this.now, next = points[(k + 1) % points.length];
    const middle = this.at([(points[k][0] + next[0]) / 2, (points[k][1] + next[1]) / 2]);
    for (const [name, value] of Object.entries(middle)) put(element, name, value);
  }

  keys(event, moved, remove) {
    if (event.ctrlKey || event.metaKey) return;
    const arrow = ARROWS[event.key];
    if (arrow) {
      if (!event.repeat) this.keyed = Symbol("keys");
      const by = stepOf(event, this.scene.step);
      this.set(moved(this.now.points, [by * arrow[0], by * arrow[1]]), this.keyed);
    } else if (event.key === "Delete" || event.key === "Backspace") {
      remove();
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
  }
}
