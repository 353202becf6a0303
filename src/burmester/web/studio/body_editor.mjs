// The body: its ghosts at every pose, and its outline to edit where one of them stands.

import { put, s } from "../widget/dom.mjs";
import { transform } from "../widget/drawing.mjs";
import { hasGhost } from "../widget/outlines.mjs";
import { px, radians } from "../widget/numbers.mjs";
import { bodyOf, isOnBody, limitRegions, poseName, setBody, standing } from "./document.mjs";
import { isOther } from "./pacing.mjs";
import { Kept } from "./scene.mjs";
import { ShapeHandles } from "./shape_handles.mjs";
import { ShapeTool } from "./shape_tool.mjs";

const PALEST = 0.4; // how strong the first ghost is, of the last one

/** The place of M at the pose at which it is drawn on. */
export function referencePlace(store) {
  const k = store.referenceIndex;
  if (k < 0) return { x: 0, y: 0, a: 0 };
  const { x, y, angle } = standing(store.document, k);
  return { x, y, a: radians(angle) };
}

/** Where what belongs to the body is drawn, in words. */
export const atReference = (store) => `Drawn at pose ${poseName(store.document, Math.max(0, store.referenceIndex))}`;

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
    store.on("document selection reference", () => this.draw());
    scene.on("view", () => this.draw());
    store.on("document selection", () => this.watch());
    scene.on("tool", () => this.watch());
    this.draw();
  }

  /** While something of the body is drawn, or has its handles, the pose where that is stands out. */
  watch() {
    const { store, scene } = this, { selection, document } = store;
    const isOfBody = selection?.kind === "body" || (selection?.kind === "limit" && isOnBody(limitRegions(document)[selection.index]?.key ?? "")), isOn = Boolean(scene.tool?.isOfBody || isOfBody);
    if (isOn === store.isOnBody) return;
    store.isOnBody = isOn;
    scene.svg.classList.toggle("bs-on-body", isOn);
    store.emit("reference");
  }

  /** Of many poses the first, the last and the selected ones have a ghost, and the one that is drawn at; the body itself moves with the linkage. */
  indices() {
    const { document: { poses }, selectedPoses, referenceIndex } = this.store;
    return poses.map((_, k) => k).filter((k) => hasGhost(k, poses.length) || selectedPoses.includes(k) || (k === referenceIndex && this.store.isOnBody));
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
    path.classList.toggle("bs-reference", k === this.store.referenceIndex);
    if (!isOther(path, [view, x, y, angle, k / last, this.path])) return;
    put(path, "d", this.path);
    put(path, "opacity", (PALEST + ((1 - PALEST) * k) / last).toFixed(3));
    put(path, "transform", transform(view.X(x), view.Y(y), radians(angle)));
  }

  /** Draw an outline by clicks, at the pose that was chosen for it. */
  tool() {
    return new ShapeTool(this.scene, {
      shape: "polygon", name: "body", place: () => referencePlace(this.store), at: atReference(this.store),
      done: (points) => {
        this.store.edit((document) => setBody(document, points));
        this.store.select({ kind: "body", index: 0 });
      },
    });
  }
}
