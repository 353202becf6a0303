// The body: its ghosts at every pose, and its outline to edit where one of them stands.

import { put, s } from "../widget/dom.mjs";
import { transform } from "../widget/drawing.mjs";
import { hasGhost } from "../widget/outlines.mjs";
import { px, radians } from "../widget/numbers.mjs";
import { bodyOf, setBody, standing } from "./document.mjs";
import { isOther } from "./pacing.mjs";
import { Kept } from "./scene.mjs";
import { ShapeHandles } from "./shape_handles.mjs";
import { ShapeTool } from "./shape_tool.mjs";

const PALEST = 0.4; // how strong the first ghost is, of the last one

/** The pose at which frame M is drawn on: the selected one, or the first. */
export function referenceIndex(store) {
  const { selection, document } = store;
  if (selection?.kind === "pose" && selection.index < document.poses.length) store.reference = selection.index;
  return Math.min(store.reference ?? 0, document.poses.length - 1);
}

/** The place of M at that pose. */
export function referencePlace(store) {
  const k = referenceIndex(store);
  if (k < 0) return { x: 0, y: 0, a: 0 };
  const { x, y, angle } = standing(store.document, k);
  return { x, y, a: radians(angle) };
}

export class BodyEditor {
  constructor(store, scene) {
    this.store = store;
    this.scene = scene;
    this.ghosts = new Kept(s("g", { class: "bs-ghosts", "aria-hidden": "true" }), () => s("path", { class: "bs-ghost" }), (path, item) => this.showGhost(path, item));
    scene.layer("ghosts").append(this.ghosts.group);
    this.handles = new ShapeHandles(scene, {
      className: "bs-body-shape",
      what: () => ({ shape: "polygon", points: bodyOf(store.document), place: referencePlace(store), name: "Outline of the body", selected: store.selection?.kind === "body", data: { body: "" } }),
      set: (points, gesture) => store.edit((document) => setBody(document, points), { gesture }),
      remove: () => store.edit((document) => setBody(document, [])),
      select: () => store.select({ kind: "body", index: 0 }),
      abandon: (gesture) => store.abandon(gesture),
    });
    store.on("document selection", () => this.draw());
    scene.on("view", () => this.draw());
    this.draw();
  }

  /** Of many poses the first, the last and the selected one have a ghost; the body itself moves with the linkage. */
  indices() {
    const { document: { poses }, selection } = this.store, chosen = selection?.kind === "pose" ? selection.index : null;
    return poses.map((_, k) => k).filter((k) => hasGhost(k, poses.length) || k === chosen);
  }

  draw() {
    const body = bodyOf(this.store.document), { scale } = this.scene.view;
    this.path = body.length ? `M${body.map(([x, y]) => `${px(scale * x)} ${px(-scale * y)}`).join("L")}Z` : "";
    this.ghosts.draw(body.length ? this.indices().map((k) => [k, k]) : []);
    if (!body.length || !this.store.document.poses.length) return this.handles.clear();
    if (!this.handles.element.parentNode) this.scene.layer("ghosts").append(this.handles.element);
    return this.handles.draw();
  }

  showGhost(path, k) {
    const { view } = this.scene, { x, y, angle } = standing(this.store.document, k), last = Math.max(1, this.store.document.poses.length - 1);
    if (!isOther(path, [view, x, y, angle, k / last, this.path])) return;
    put(path, "d", this.path);
    put(path, "opacity", (PALEST + ((1 - PALEST) * k) / last).toFixed(3));
    put(path, "transform", transform(view.X(x), view.Y(y), radians(angle)));
  }

  /** Draw an outline by clicks, at the pose that is selected or the first one. */
  tool() {
    return new ShapeTool(this.scene, {
      shape: "polygon", name: "body", place: () => referencePlace(this.store),
      done: (points) => {
        this.store.edit((document) => setBody(document, points));
        this.store.select({ kind: "body", index: 0 });
      },
    });
  }
}
