// Image space: the surfaces that two dyads allow, the motion they share, and the poses.

import { h, rgb, s } from "./dom.mjs";
import { Labels } from "./labels.mjs";
import { angleTicks, clamp, degrees, px, radians } from "./numbers.mjs";
import { drawStill } from "./ray_casting.mjs";
import { Shader } from "./shader.mjs";
import { isNamed, isPoint } from "./tables.mjs";
import { cross, dot, intersections, plus, scaled, unit } from "./vectors.mjs";

const FOCAL_LENGTH = 2.3; // halves of the box's edge, for zoom 1: the larger, the flatter
const EYE_DISTANCE = 4.6; // halves of the box's edge, from its middle
const START = { around: -0.62, above: 0.38, zoom: 1 }; // radians of the camera about the box
const MANY_POSES = 40; // above this number points have no names

const inside = (point) => point.every((value) => Math.abs(value) <= 1.0001); // of the box

/** A picture of a box of image space in `parent`, which can be turned. */
export class ImageSpace {
  /** @type {any} */ waiting;
  /** @type {any} */ space;
  /** @type {any} */ marks;
  /** @type {any} */ view;
  /** @type {any} */ width;
  /** @type {any} */ height;

  constructor(data, parent, webgl) {
    this.data = data;
    this.parent = parent;
    this.turn = { ...START };
    this.canvas = h("canvas", { "aria-hidden": "true" });
    this.svg = s("svg", { "aria-hidden": "true" });
    this.note = h("p", { class: "bm-readout" });
    this.box = h("div", {
      class: "bm-space", role: "img", tabindex: "0",
      "aria-label": "Image space: two surfaces and the curve they meet in. Arrow keys turn it, plus and minus zoom.",
    }, this.canvas, this.svg);
    parent.append(this.box, this.note);
    this.shader = webgl ? Shader.on(this.canvas, () => this.withoutGl()) : null;
    this.explain();
    this.listen();
  }

  explain() {
    this.canvas.dataset.drawn = this.shader ? "webgl" : "still";
    this.note.textContent = this.shader
      ? "Drag it, or turn it with the arrow keys; + and − zoom, 0 goes back."
      : "A still picture, for fast WebGL 2 is missing here; it can be turned all the same, by dragging or with the arrow keys.";
  }

  /** Go on without WebGL, on a fresh canvas: the old one can hold nothing else. */
  withoutGl() {
    const fresh = this.canvas.cloneNode();
    this.canvas.replaceWith(fresh);
    this.canvas = fresh;
    this.shader = null;
    this.explain();
    if (this.space) this.draw(false);
  }

  listen() {
    const { box } = this;
    let grip = null;
    box.addEventListener("pointerdown", (event) => {
      grip = [event.clientX, event.clientY];
      box.setPointerCapture(event.pointerId);
    });
    box.addEventListener("pointermove", (event) => {
      if (!grip) return;
      this.turn.around -= 0.008 * (event.clientX - grip[0]);
      this.turn.above += 0.008 * (event.clientY - grip[1]);
      grip = [event.clientX, event.clientY];
      this.redraw(true);
    });
    for (const end of ["pointerup", "pointercancel"]) {
      box.addEventListener(end, () => {
        if (grip) this.redraw(false);
        grip = null;
      });
    }
    box.addEventListener("keydown", (event) => {
      const { turn } = this;
      const step = {
        ArrowLeft: () => (turn.around += 0.1),
        ArrowRight: () => (turn.around -= 0.1),
        ArrowUp: () => (turn.above += 0.1),
        ArrowDown: () => (turn.above -= 0.1),
        "+": () => (turn.zoom *= 1.15),
        "=": () => (turn.zoom *= 1.15),
        "-": () => (turn.zoom /= 1.15),
        0: () => Object.assign(turn, START),
      }[event.key];
      if (!step || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      event.stopPropagation();
      step();
      this.redraw(false);
    });
  }

  redraw(turning) {
    this.turn.above = clamp(this.turn.above, -1.5, 1.5);
    this.turn.zoom = clamp(this.turn.zoom, 0.6, 4);
    cancelAnimationFrame(this.waiting);
    this.waiting = requestAnimationFrame(() => this.draw(turning));
  }

  /** The point of the box that is a place of the body. */
  point(place) {
    const { chart } = this.data, { centre, half } = this.space;
    const x = (place.x - chart.origin[0]) / chart.length, y = (place.y - chart.origin[1]) / chart.length;
    const t = Math.tan((place.a - chart.angle) / 2);
    return [(x * t - y) / 2, (x + y * t) / 2, t].map((value, k) => (value - centre[k]) / half[k]);
  }

  /** A linkage on its way `index`; quick: coarsely, for more changes follow. */
  build(linkage, index, quick = false) {
    this.linkage = linkage;
    this.space = linkage?.space ?? this.data.space;
    this.poses = this.data.poses.map((pose, k) => {
      const at = isPoint(pose) ? linkage?.pose_errors[k] : pose; // a point of the body is no point here before a linkage turns it
      return at && at.x !== null ? this.point({ x: at.x, y: at.y, a: radians(at.angle_deg) }) : null;
    });
    this.curves = (linkage?.ways ?? []).map((way, k) => ({
      here: k === index,
      points: Array.from(way.x, (x, i) => this.point({ x, y: way.y[i], a: way.angle[i] })),
    }));
    const { centre, half } = this.space;
    const angleOf = (q) => degrees(2 * Math.atan(centre[2] + half[2] * q) + this.data.chart.angle);
    this.marks = angleTicks(angleOf(-1), angleOf(1), 7);
    const width = Math.max(240, this.parent.clientWidth);
    this.width = width;
    this.height = Math.round(clamp(0.8 * width, 240, 520));
    this.svg.setAttribute("viewBox", `0 0 ${width} ${this.height}`);
    this.box.style.height = `${this.height}px`;
    this.draw(quick);
  }

  camera() {
    const { around, above, zoom } = this.turn;
    const ahead = [
      -Math.cos(above) * Math.sin(around), Math.cos(above) * Math.cos(around), -Math.sin(above),
    ];
    const right = [Math.cos(around), Math.sin(around), 0];
    const up = cross(right, ahead);
    const eye = scaled(ahead, -EYE_DISTANCE);
    const least = Math.min(this.width, this.height);
    const focal = (least / 2) * FOCAL_LENGTH * zoom * 1.02;
    return { ahead, right, up, eye, focal, reach: [this.width / 2 / focal, this.height / 2 / focal] };
  }

  draw(turning) {
    this.view = this.camera();
    const scene = this.sceneOf(this.view);
    if (this.shader) this.shader.draw(scene, this, turning);
    else drawStill(this.canvas, scene, this, turning);
    this.overlay();
    if (this.place) this.show(this.place);
  }

  /** What is drawn: the camera, the quadrics, their colours (0 to 1) and the lines of equal angle. */
  sceneOf(camera) {
    const style = getComputedStyle(this.parent);
    const paint = ["--bm-driver-solid", "--bm-follower-solid"].map((name) => rgb(style.getPropertyValue(name)).map((v) => v / 255));
    return { ...camera, paint, quadrics: this.space.quadrics, angles: this.angles() };
  }

  /** Of M: Z3 in the middle of the box and half its height, middle angle, step of the lines. */
  angles() {
    const { centre, half } = this.space, { marks } = this;
    const step = marks.length > 1 ? radians(marks[1].at - marks[0].at) : Math.PI;
    return [centre[2], half[2], this.data.chart.angle, step];
  }

  /** From the box to pixels, as the camera sees it. */
  project(point) {
    const { eye, ahead, right, up, focal } = this.view;
    const to = [0, 1, 2].map((k) => point[k] - eye[k]), depth = dot(to, ahead);
    return [this.width / 2 + (focal * dot(to, right)) / depth, this.height / 2 - (focal * dot(to, up)) / depth];
  }

  /** The number of sheets of the surfaces between a point and the eye. */
  sheetsBefore(point) {
    const to = plus(this.view.eye, scaled(point, -1)), d = unit(to);
    let leave = Infinity;
    for (let k = 0; k < 3; k += 1) leave = Math.min(leave, ((d[k] > 0 ? 1 : -1) - point[k]) / d[k]);
    let count = 0;
    for (const c of this.space.quadrics) for (const t of intersections(c, point, d)) if (t > 0.02 && t < leave) count += 1;
    return count;
  }

  /** Lines, points and names over the surfaces. */
  overlay() {
    const { svg } = this;
    // The corner of the box that is farthest from the eye.
    const back = this.view.ahead.map((value) => (value > 0 ? 1 : -1));
    svg.replaceChildren(...this.edges(back), ...this.axisNames(back), ...this.angleMarks(), ...this.motions());
    this.images();
    this.runner = s("circle", { class: "bm-runner", r: 6, visibility: "hidden" });
    svg.append(this.runner);
  }

  /** Edges of the box; those at the farthest corner are behind everything. */
  edges(back) {
    let front = "", behind = "";
    for (let axis = 0; axis < 3; axis += 1) {
      for (const [b, c] of [[-1, -1], [-1, 1], [1, -1], [1, 1]]) {
        const one = [0, 0, 0], [j, k] = [(axis + 1) % 3, (axis + 2) % 3];
        [one[j], one[k], one[axis]] = [b, c, -1];
        const other = [...one];
        other[axis] = 1;
        const d = `M${this.project(one).map(px).join(" ")}L${this.project(other).map(px).join(" ")}`;
        if (b === back[j] && c === back[k]) behind += d;
        else front += d;
      }
    }
    return [s("path", { class: "bm-box bm-behind", d: behind }), s("path", { class: "bm-box", d: front })];
  }

  /** Names at the middle of edges that are in sight. */
  axisNames(back) {
    const name = (point, text) => {
      const [x, y] = this.project(point), [cx, cy] = [x - this.width / 2, y - this.height / 2];
      const size = Math.hypot(cx, cy) || 1;
      return s("text", { class: "bm-axis", x: px(x + (14 * cx) / size), y: px(y + (14 * cy) / size + 4), "text-anchor": "middle" }, text);
    };
    const base = this.turn.above >= 0 ? -1 : 1;
    return [name([0, -back[1], base], "Z1"), name([-back[0], 0, base], "Z2")];
  }

  /** The third coordinate, as the angle of M, at the edge farthest to the left. */
  angleMarks() {
    const upright = [[-1, -1], [-1, 1], [1, -1], [1, 1]].map(([a, b]) => ({ a, b, x: this.project([a, b, 0])[0] }));
    const edge = upright.reduce((one, other) => (other.x < one.x ? other : one));
    const { centre, half } = this.space;
    return this.marks.flatMap(({ at, text }) => {
      const t = Math.tan((radians(at) - this.data.chart.angle) / 2), q = (t - centre[2]) / half[2];
      const [x, y] = this.project([edge.a, edge.b, q]);
      return [
        s("path", { class: "bm-box", d: `M${px(x)} ${px(y)}h-5` }),
        s("text", { class: "bm-axis", x: px(x - 8), y: px(y + 4), "text-anchor": "end" }, text),
      ];
    });
  }

  /** The motions of the coupler, in two paths each: behind a surface and before them. */
  motions() {
    return this.curves.flatMap(({ here, points }) => {
      const paths = ["", ""];
      let last = null;
      for (let k = 0; k < points.length; k += 1) {
        const p = points[k];
        if (!inside(p) || (k && Math.hypot(...plus(p, scaled(points[k - 1], -1))) > 0.6)) last = null;
        if (!inside(p)) continue;
        const at = this.project(p), hidden = this.sheetsBefore(p) > 0 ? 1 : 0;
        if (last) paths[hidden] += `M${last.map(px).join(" ")}L${at.map(px).join(" ")}`;
        last = at;
      }
      const kind = here ? "bm-here" : "bm-other";
      return [
        s("path", { class: `bm-motion bm-hidden ${kind}`, d: paths[1] }),
        s("path", { class: `bm-motion ${kind}`, d: paths[0] }),
      ];
    });
  }

  /** The image points of the poses, with their names. */
  images() {
    const { svg, data } = this;
    const labels = new Labels({ width: this.width, height: this.height });
    const shown = this.poses.map((point, k) => ({ point, k })).filter(({ point }) => point && inside(point));
    for (const { point } of shown) {
      const [x, y] = this.project(point);
      labels.block(x, y, 10, 10);
    }
    for (const { point, k } of shown) {
      const [x, y] = this.project(point), hidden = this.sheetsBefore(point) > 0;
      svg.append(s("circle", { class: `bm-image-point${hidden ? " bm-hidden" : ""}`, cx: px(x), cy: px(y), r: 4 }));
      if (shown.length <= MANY_POSES && isNamed(data, k)) svg.append(labels.put(x, y, data.poses[k].label, 12, { class: "bm-image-name" }));
    }
  }

  /** No place of the body is known. */
  hide() {
    this.place = null;
    this.runner.setAttribute("visibility", "hidden");
  }

  show(place) {
    this.place = place;
    const point = this.point(place);
    const inside = point.every((value) => Math.abs(value) <= 1.02);
    this.runner.setAttribute("visibility", inside ? "visible" : "hidden");
    if (!inside) return;
    const [x, y] = this.project(point);
    this.runner.setAttribute("transform", `translate(${px(x)} ${px(y)})`);
  }
}
