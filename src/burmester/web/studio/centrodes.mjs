// The instant centre of the body, and the two curves that roll on each other: its paths in F and in M.

import { h, put, s } from "../widget/dom.mjs";
import { transform } from "../widget/drawing.mjs";
import { centrodePoint, instantCentre } from "../widget/instantaneous.mjs";
import { fixed, px } from "../widget/numbers.mjs";
import { decimalsOf } from "../widget/tables.mjs";
import { framesOf } from "./live_linkage.mjs";

const FARTHEST = 30; // scenes from the first pose: beyond that a centrode is cut
const JUMP = 2; // scenes between two frames: it went through infinity

/** Both centrodes of a way in pieces: { fixed, moving } lists of points, null where the curve is cut.
 * @param {object} linkage @param {object} way @param {number} scene @param {number[]} near a point that the curve is cut around */
export function centrodesOf(linkage, way, scene, near) {
  let before = null;
  const points = framesOf(way).map((place) => {
    const point = centrodePoint(linkage.led, place);
    const far = !point || Math.hypot(point.fixed[0] - near[0], point.fixed[1] - near[1]) > FARTHEST * scene;
    const cut = far || (before && Math.hypot(point.fixed[0] - before[0], point.fixed[1] - before[1]) > JUMP * scene);
    before = far ? null : point.fixed;
    return { point: far ? null : point, cut };
  });
  const pieces = (key) => points.flatMap(({ point, cut }) => (cut ? [null, point && point[key]] : [point?.[key]]));
  return { fixed: pieces("fixed"), moving: pieces("moving") };
}

const path = (points, X, Y) => {
  let d = "", pen = "M";
  for (const point of points) {
    if (point) d += `${pen}${px(X(point[0]))} ${px(Y(point[1]))}`;
    pen = point ? "L" : "M";
  }
  return d;
};

export class Centrodes {
  constructor(answers, playing, scene) {
    this.answers = answers;
    this.playing = playing;
    this.scene = scene;
    this.fixed = s("path", { class: "bs-centrode bs-fixed-centrode" });
    this.moving = s("path", { class: "bs-centrode bs-moving-centrode" });
    this.mark = s("g", { class: "bs-instant-centre" }, s("circle", { r: 5 }), s("path", { d: "M-9 0H9M0 -9V9" }));
    this.rays = s("path", { class: "bs-rays" });
    this.group = s("g", { class: "bs-centrodes", visibility: "hidden", "aria-hidden": "true" }, this.fixed, this.moving, this.rays, this.mark);
    scene.layer("curves").append(this.group);
    this.box = h("input", { type: "checkbox", "data-tool": "centrodes", onchange: () => this.shape() });
    this.readout = h("output", { class: "bs-quiet" });
    this.element = h("div", { class: "bs-tool" }, h("label", {}, this.box, " Instant centre and centrodes"), " ", this.readout);
    playing.on("shape", () => this.shape());
    playing.on("place", ({ place }) => this.show(place));
    scene.on("view", () => this.shape());
  }

  get on() {
    return this.box.checked && Boolean(this.playing.path) && !this.playing.linkage.gone && !this.playing.linkage.drawn; // of two dyads
  }

  shape() {
    put(this.group, "visibility", this.on ? "visible" : "hidden");
    if (!this.on) {
      this.readout.textContent = "";
      return;
    }
    const { data } = this.answers, { linkage, path: way } = this.playing, { view } = this.scene;
    const [pose] = data.poses, both = centrodesOf(linkage, way, data.scene, pose ? [pose.x, pose.y] : [0, 0]);
    put(this.fixed, "d", path(both.fixed, view.X, view.Y));
    put(this.moving, "d", path(both.moving, (x) => view.scale * x, (y) => -view.scale * y));
    if (this.playing.here) this.show(this.playing.here.place);
  }

  show(place) {
    if (!this.on) return;
    const { view } = this.scene, { led } = this.playing.linkage, centre = instantCentre(led, place);
    put(this.moving, "transform", transform(view.X(place.x), view.Y(place.y), place.a));
    const there = centre && Math.hypot(centre[0] - place.x, centre[1] - place.y) < FARTHEST * this.answers.data.scene;
    put(this.mark, "visibility", there ? "inherit" : "hidden");
    put(this.rays, "visibility", there ? "inherit" : "hidden");
    const digits = decimalsOf(this.answers.data), unit = this.answers.data.unit ? ` ${this.answers.data.unit}` : "";
    this.readout.textContent = centre ? `at (${centre.map((value) => fixed(value, digits)).join(", ")})${unit}` : "at infinity: the body only shifts";
    if (!there) return;
    const [x, y] = [view.X(centre[0]), view.Y(centre[1])];
    put(this.mark, "transform", `translate(${px(x)} ${px(y)})`);
    const ends = led.filter((dyad) => dyad.fixed_pivot).map((dyad) => `M${px(view.X(dyad.fixed_pivot[0]))} ${px(view.Y(dyad.fixed_pivot[1]))}L${px(x)} ${px(y)}`);
    put(this.rays, "d", ends.join(""));
  }
}
