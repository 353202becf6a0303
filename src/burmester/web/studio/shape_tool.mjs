// The tool that draws a shape by clicks: a point, two points or corners, or a polygon.

import { put, s } from "../widget/dom.mjs";
import { act, back } from "../widget/kinematics.mjs";
import { px } from "../widget/numbers.mjs";
import { pathOf } from "./shape_handles.mjs";

const CLOSE = 12; // pixels from the first corner that close a polygon
const PAIRS = new Set(["segment", "line", "box"]);
const HINTS = {
  point: "Click the point. Enter puts it in the middle, Escape gives up.",
  segment: "Click both ends. Enter puts one in the middle, Escape gives up.",
  line: "Click two points of the line. Enter puts one in the middle, Escape gives up.",
  box: "Drag from corner to corner, or click both. Enter puts one in the middle, Escape gives up.",
  polygon: "Click the corners; Enter or a click on the first one closes. Backspace takes the last one back, Escape gives up.",
};
const MIDDLE = { point: [[0, 0]], segment: [[-1, 0], [1, 0]], line: [[-1, 0], [1, 0]], box: [[-1, -1], [1, 1]], polygon: [[-1, -1], [1, -1], [0, 1]] };
const SHARE = 0.12; // of the picture: half the size of a shape that is put in its middle

const ordered = ([[a, b], [c, d]]) => [[Math.min(a, c), Math.min(b, d)], [Math.max(a, c), Math.max(b, d)]];
/** @type {(points: number[][]) => boolean} */
const isFlat = ([[a, b], [c, d]]) => a === c && b === d;

/** shape: what is drawn; place: of the frame that its points are in, a function; done(points); at: of what belongs to the body where it is drawn, in words. */
export class ShapeTool {
  constructor(scene, { shape, place, done, name, at = "" }) {
    this.scene = scene;
    this.shape = shape;
    this.place = place;
    this.done = done;
    this.name = name;
    this.points = [];
    this.next = null;
    this.hint = at ? `${at}. ${HINTS[shape]}` : HINTS[shape];
    this.isOfBody = Boolean(at);
    this.path = s("path", { class: "bs-draft" });
    this.dots = s("g");
    this.element = s("g", {}, this.path, this.dots);
    scene.layer("tool").append(this.element);
  }

  point({ x, y }, event) {
    const place = this.place(), last = this.points.at(-1), at = this.scene.snap.point([x, y], { event, from: last && act(place, last) });
    return place.x || place.y || place.a ? back(place, at).map((each) => this.scene.rounded(each)) : at;
  }

  click(point, event) {
    const next = this.point(point, event);
    if (this.shape === "polygon") {
      if (this.points.length > 2 && (this.isFirst(point) || event?.detail > 1)) return this.finish(this.points);
      if (this.points.length && isFlat([this.points.at(-1), next])) return undefined;
    }
    this.points.push(next);
    if (this.shape === "point" || (PAIRS.has(this.shape) && this.points.length === 2)) return this.finish(this.points);
    return this.draw();
  }

  isFirst({ X, Y }) {
    const [x, y] = act(this.place(), this.points[0]), { view } = this.scene;
    return Math.hypot(view.X(x) - X, view.Y(y) - Y) < CLOSE;
  }

  hover(point, event) {
    this.next = point && this.point(point, event);
    this.draw();
  }

  /** Two points are drawn by a drag as well; of a polygon a drag moves the plane. */
  drag(point, held, event) {
    if (!PAIRS.has(this.shape) || this.points.length) return false;
    this.dragging = [this.point(this.inPlane(held.from), event), this.point(point, event)];
    this.draw();
    return true;
  }

  inPlane({ X, Y }) {
    return { x: this.scene.view.x(X), y: this.scene.view.y(Y) };
  }

  /** A shape in the middle of the picture, to be moved by keys. */
  inMiddle() {
    const { width, height } = this.scene.size, half = SHARE * Math.min(width, height);
    return MIDDLE[this.shape].map(([x, y]) => this.point(this.inPlane({ X: width / 2 + half * x, Y: height / 2 - half * y })));
  }

  release() {
    if (!this.dragging) return;
    const pair = this.dragging;
    this.dragging = null;
    this.finish(pair);
  }

  finish(points) {
    if (PAIRS.has(this.shape) && isFlat(points)) {
      this.points = points.slice(0, 1);
      return this.draw();
    }
    this.scene.use(null);
    return this.done(this.shape === "box" ? ordered(points) : points);
  }

  key(event) {
    if (event.key === "Escape") this.scene.use(null);
    else if (event.key === "Backspace") this.points.pop();
    else if (event.key === "Enter" && !this.points.length) this.finish(this.inMiddle());
    else if (event.key === "Enter" && this.points.length > 2) this.finish(this.points);
    else return false;
    this.draw();
    return true;
  }

  draw() {
    const { scene: { view }, shape } = this, shown = this.dragging ?? [...this.points, ...(this.next ? [this.next] : [])];
    const place = this.place(), whole = shape === "polygon" ? "open polygon" : shape;
    const complete = shown.length > 1 || shape === "point";
    put(this.path, "d", complete && shown.length ? pathOf(whole, shown, place, view) : "");
    this.dots.replaceChildren(
      ...(this.dragging ?? this.points).map((point) => act(place, point)).map(([x, y], k) => s("circle", { class: k ? "bs-draft-dot" : "bs-draft-dot bs-first", r: 4, cx: px(view.X(x)), cy: px(view.Y(y)) })),
    );
  }

  end() {
    this.element.remove();
  }
}
