// The Burmester curves of four poses in the drawing: they go along with the poses, and pivots slide along them.

import { give, h, put, s } from "../widget/dom.mjs";
import { transform } from "../widget/drawing.mjs";
import { FamilyPairs } from "../widget/family_pairs.mjs";
import { curvePaths, curvesOf, nearestOnCurve, ontoCurve, worthOf } from "./burmester_curves.mjs";

const LONGEST_STEP = 0.5; // scenes between two samples of a curve: a longer one goes through infinity
const STROKES = ["plain", "fails", "outside", "works"]; // of a curve, from below

export class FamilyCurves {
  constructor(store, answers, playing, scene) {
    this.store = store;
    this.answers = answers;
    this.playing = playing;
    this.scene = scene;
    this.known = null;
    this.live = null;
    this.asking = false;
    this.curves = ["F", "M"].map((plane) => s("g", { class: `bs-curve bs-curve-${plane}` }, STROKES.map((name) => s("path", { class: `bs-curve-${name}` }))));
    this.group = s("g", { class: "bs-burmester", visibility: "hidden", "aria-hidden": "true" }, this.curves);
    scene.layer("curves").append(this.group);
    this.box = h("input", { type: "checkbox", checked: true, "data-tool": "burmester-curves", onchange: () => this.draw() });
    this.label = h("label", { hidden: true }, this.box, " Burmester curves of the four poses, in the drawing");
    this.legend = h("p", { class: "bm-legend", hidden: true }, h("span", { class: "bs-key-works" }), " works with a partner; ", h("span", { class: "bs-key-outside" }), " works outside limits or standard; ", h("span", { class: "bs-key-fails" }), " no partner works. Solid: centre points in F; dashed: circle points in M, where the body is now.");
    answers.on("poses", () => (answers.data.poses.length === 4 ? this.ask() : this.draw())); // fewer or more have no curves
    playing.on("place", () => this.move());
    scene.on("view", () => this.draw());
  }

  /** The curves of the four poses as they are now: { fixed, moving, loops, worth }, or null. */
  get family() {
    const { data, isOld } = this.answers;
    if (data.poses.length !== 4) return null;
    if (this.live && (isOld || !this.known)) return this.live;
    return this.known;
  }

  /** The curves that the whole search brought, where the task has some. */
  renew() {
    const { data } = this.answers, map = data.family_map;
    this.known = map?.kind === "curve" ? { ...map, worth: worthOf(new FamilyPairs(data)) } : null;
    this.live = null;
    if (!this.known) this.ask();
    give(this.label, "hidden", data.poses.length !== 4);
    this.draw();
  }

  /** The curves go along with the poses: one question at a time, the newest wins. */
  async ask() {
    const { store, answers } = this, { document, options } = store;
    if (document.poses.length !== 4 || !this.box.checked || this.asking || !store.connection?.isOpen) return;
    this.asking = true;
    try {
      const answer = await store.connection.ask({ do: "curve", document, options, judged: store.state !== "dragging" });
      if (answer.kind === "curve" && store.document.poses.length === 4) {
        this.live = curvesOf(answer);
        this.draw();
      }
    } catch {
      // the connection ended: it says so itself
    }
    this.asking = false;
    if (store.document !== document && answers.isOld) this.ask();
  }

  get widest() {
    return LONGEST_STEP * this.answers.data.scene;
  }

  /** The place on the curve of a plane that is nearest to a point; null where pivots have no curve to slide along. */
  onto(plane, point) {
    const map = this.family, { poses, scene } = this.answers.data;
    if (!map || !this.box.checked) return null;
    const near = nearestOnCurve(plane === "F" ? map.fixed : map.moving, map.loops, point, this.widest);
    return near ? ontoCurve(poses, plane, near.at, scene) : point;
  }

  draw() {
    const map = this.family, on = Boolean(map) && this.box.checked;
    put(this.group, "visibility", on ? "visible" : "hidden");
    give(this.legend, "hidden", !on);
    if (!on) return;
    const { view } = this.scene, planes = [[map.fixed, view.X, view.Y], [map.moving, (x) => view.scale * x, (y) => -view.scale * y]];
    planes.forEach(([points, X, Y], n) => {
      const paths = curvePaths(points, map.loops, map.worth, X, Y, this.widest);
      [...this.curves[n].children].forEach((path, k) => put(path, "d", paths[STROKES[k]]));
    });
    this.move();
  }

  /** Circle points are on the body, and go along with it. */
  move() {
    const { view } = this.scene, place = this.playing.here?.place;
    if (place && this.family) put(this.curves[1], "transform", transform(view.X(place.x), view.Y(place.y), place.a));
  }
}
