// A path in the plane: the curve through its points, closed or open, and the tool that draws one by hand.

import { put, s } from "../widget/dom.mjs";
import { clamp, px } from "../widget/numbers.mjs";
import { isPath, pathDocument } from "./document.mjs";

const POINTS = [12, 40]; // least and most points of a curve that was drawn by hand
const APART = 26; // pixels from one of them to the next, where that leaves so many
const MEETS = 16; // pixels, or a share of the curve's size: ends that are so near to each other close it
const SHARE = 0.08;
const LEAST_LENGTH = 40; // pixels; a shorter stroke is a slip
const SMOOTHED = 9; // pixels of the stroke over which the trembling of a hand is averaged
const OVAL = 16; // points of the curve that a key draws

/** The points of a task as a line in pixels. */
export function lineOf({ poses, path }, view) {
  const points = poses.filter(({ x, y }) => Number.isFinite(x) && Number.isFinite(y)).map(({ x, y }) => `${px(view.X(x))} ${px(view.Y(y))}`);
  return points.length ? `M${points.join("L")}${path?.closed ? "Z" : ""}` : "";
}

export class PathCurve {
  constructor(store, scene) {
    this.store = store;
    this.scene = scene;
    this.line = s("path", { class: "bs-path", "aria-hidden": "true" });
    scene.layer("regions").append(this.line);
    store.on("document", () => this.draw());
    scene.on("view", () => this.draw());
    this.draw();
  }

  draw() {
    const { store: { document }, scene: { view } } = this;
    put(this.line, "d", isPath(document) ? lineOf(document, view) : "");
    put(this.line, "data-path", isPath(document) ? (document.path?.closed ? "closed" : "open") : null);
  }
}

/** Points at even steps along a stroke [[x, y], ...], and whether it closes; lengths in its unit. */
export function resampled(stroke, { meets, apart, smooth = 0 }) {
  const gap = Math.hypot(stroke[0][0] - stroke.at(-1)[0], stroke[0][1] - stroke.at(-1)[1]);
  const size = Math.hypot(...[0, 1].map((k) => Math.max(...stroke.map((each) => each[k])) - Math.min(...stroke.map((each) => each[k]))));
  let length = 0;
  for (let k = 1; k < stroke.length; k += 1) length += Math.hypot(stroke[k][0] - stroke[k - 1][0], stroke[k][1] - stroke[k - 1][1]);
  const closed = gap < Math.max(meets, SHARE * size) && length > 3 * gap + size;
  const line = closed ? [...stroke, stroke[0]] : stroke, along = [0];
  for (let k = 1; k < line.length; k += 1) along.push(along[k - 1] + Math.hypot(line[k][0] - line[k - 1][0], line[k][1] - line[k - 1][1]));
  const whole = along[along.length - 1], count = clamp(Math.round(whole / apart), POINTS[0], POINTS[1]);
  const at = (wanted) => {
    const u = closed ? ((wanted % whole) + whole) % whole : clamp(wanted, 0, whole);
    let k = 1;
    while (k < line.length - 1 && along[k] < u) k += 1;
    const t = along[k] > along[k - 1] ? (u - along[k - 1]) / (along[k] - along[k - 1]) : 0;
    return [0, 1].map((axis) => line[k - 1][axis] + t * (line[k][axis] - line[k - 1][axis]));
  };
  const near = (u, k) => {
    const half = closed ? smooth : Math.min(smooth, u, whole - u); // the ends stay where they are
    const parts = [-1, -0.5, 0, 0.5, 1].map((share) => at(u + share * half));
    return [0, 1].map((axis) => parts.reduce((sum, each) => sum + each[axis], 0) / parts.length);
  };
  return { closed, points: Array.from({ length: count }, (_, k) => near((whole * k) / (closed ? count : count - 1), k)) };
}

/** Draw a path: press, move, let go. */
export class PathTool {
  constructor(store, scene, done) {
    this.store = store;
    this.scene = scene;
    this.done = done;
    this.name = "path";
    this.stroke = null;
    this.hint = "Press, draw the curve that a point of the body is to trace, and let go; where the ends meet it closes. Enter puts an oval in the middle, Escape gives up.";
    this.line = s("path", { class: "bs-draft bs-draft-path" });
    scene.layer("tool").append(this.line);
  }

  click() {} // a press that does not move draws nothing

  drag(point, held) {
    this.stroke ??= [[held.from.X, held.from.Y]];
    this.stroke.push([point.X, point.Y]);
    put(this.line, "d", `M${this.stroke.map((each) => each.map(px).join(" ")).join("L")}`);
    return true;
  }

  release() {
    const { stroke } = this;
    this.stroke = null;
    put(this.line, "d", "");
    const length = stroke?.slice(1).reduce((sum, [x, y], k) => sum + Math.hypot(x - stroke[k][0], y - stroke[k][1]), 0);
    if (length > LEAST_LENGTH) this.finish(resampled(stroke, { meets: MEETS, apart: APART, smooth: SMOOTHED }));
  }

  /** The drawn curve becomes the task: what stands beside a path before it stays, beside other tasks it goes. */
  finish({ points, closed }) {
    const { store, scene } = this, { view } = scene;
    const there = points.map(([X, Y]) => [scene.rounded(view.x(X)), scene.rounded(view.y(Y))]);
    const { document, options } = store;
    const { picture } = store; // which may be what was drawn over
    if (isPath(document)) store.replace({ document: pathDocument(document, there, closed), options, picture });
    else store.replace({ picture, document: pathDocument({ length_unit: document.length_unit, angle_unit: "deg", poses: [] }, there, closed), options, name: "path" });
    store.select(null);
    scene.use(null);
    this.done?.(points.length, closed);
  }

  key(event) {
    if (event.key === "Escape") this.scene.use(null);
    else if (event.key === "Enter") this.finish(this.oval());
    else return false;
    return true;
  }

  /** A curve for those who draw by keys: its points are moved by arrow keys then. */
  oval() {
    const { width, height } = this.scene.size, size = 0.2 * Math.min(width, height);
    const points = Array.from({ length: OVAL }, (_, k) => (2 * Math.PI * k) / OVAL).map((a) => [width / 2 + 1.5 * size * Math.cos(a), height / 2 - size * Math.sin(a)]);
    return { points, closed: true };
  }

  end() {
    this.line.remove();
  }
}
