// The map of the price of each fixed pivot, with the pivots of the linkage on it: a press takes the nearest one there.

import { h, put, s } from "../widget/dom.mjs";
import { px } from "../widget/numbers.mjs";
import { PivotMap } from "../widget/pivot_map.mjs";
import { Pace, isSeen, watch } from "./pacing.mjs";

const GRASP = 26; // pixels: how near a pointer takes hold of a pivot
const STILL = 3; // pixels: a pointer on a pivot that moves no farther leaves it

export class PivotMapPanel {
  /** @type {any} */ map;

  /** hand: the pivots that can be taken hold of: pivot, take, put, drop and release, as PivotSurface has them. */
  constructor(answers, playing, hand) {
    this.answers = answers;
    this.playing = playing;
    this.hand = hand;
    this.map = null;
    this.handles = null;
    this.element = h("div", { class: "bm-fill" });
    this.pace = new Pace(() => this.build(), () => isSeen(this.element));
    playing.on("shape", () => this.pace.ask());
    new ResizeObserver(() => this.pace.ask()).observe(this.element);
    watch(this.element, () => this.pace.ask());
  }

  /** The map that the whole search brought, if it is another one. */
  renew() {
    const { data } = this.answers;
    if (this.shown === data.pivot_map) return;
    this.shown = data.pivot_map;
    this.element.replaceChildren();
    this.map = data.pivot_map ? new PivotMap(data, this.element) : null;
    if (this.map) this.listen();
    this.pace.ask();
  }

  build() {
    if (!this.map) return;
    this.map.build(this.answers.shown);
    this.handles = [0, 1].map((k) => s("g", { class: `bs-pivot bs-map-pivot bm-side${k}` }, s("circle", { class: "bs-pivot-ring", r: 8 })));
    this.map.svg.append(...this.handles);
    this.drawHandles();
  }

  drawHandles() {
    if (!this.handles || !this.map?.view) return;
    const { view } = this.map;
    this.handles.forEach((element, k) => {
      const pivot = this.hand.pivot(k, "F");
      put(element, "display", pivot ? "inline" : "none");
      if (!pivot) return;
      put(element, "transform", `translate(${px(view.X(pivot.at[0]))} ${px(view.Y(pivot.at[1]))})`);
      element.dataset.mapPivot = pivot.id;
    });
  }

  /** The fixed pivot nearest to a point: { k, away } in pixels of the map; Infinity where there is none.
   * @param {number[]} point */
  nearest([x, y]) {
    const { view } = this.map;
    const away = [0, 1].map((k) => {
      const pivot = this.hand.pivot(k, "F");
      return pivot ? Math.hypot(view.X(pivot.at[0]) - view.X(x), view.Y(pivot.at[1]) - view.Y(y)) : Infinity;
    });
    const k = away[1] < away[0] ? 1 : 0;
    return { k, away: away[k] };
  }

  /** A press takes the nearest fixed pivot, and puts it where the pointer is; Enter puts it to the cursor of the keys. */
  listen() {
    const { hand } = this, { svg } = this.map;
    const at = (event) => {
      const box = svg.getBoundingClientRect(), { low, high } = this.answers.data.pivot_map;
      const u = (event.clientX - box.left) / box.width, v = 1 - (event.clientY - box.top) / box.height;
      return [low[0] + u * (high[0] - low[0]), low[1] + v * (high[1] - low[1])];
    };
    let pointer = null, start = null;
    const end = (event) => {
      if (event.pointerId !== pointer) return;
      pointer = null;
      hand.drop();
    };
    svg.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      const point = at(event), { k, away } = this.nearest(point);
      if (!Number.isFinite(away) || !hand.take(k, "F")) return;
      event.preventDefault();
      pointer = event.pointerId;
      start = { near: away <= GRASP, X: event.clientX, Y: event.clientY };
      svg.setPointerCapture(pointer);
      this.playing.player.play(false);
      if (!start.near) hand.put(point);
    });
    svg.addEventListener("pointermove", (event) => {
      if (event.pointerId !== pointer) return;
      if (start.near && Math.hypot(event.clientX - start.X, event.clientY - start.Y) < STILL) return;
      start.near = false;
      hand.put(at(event));
    });
    svg.addEventListener("pointerup", end);
    svg.addEventListener("pointercancel", end);
    svg.addEventListener("keydown", (event) => {
      if (event.key === "Escape" && hand.pivots) hand.release();
      if (event.key !== "Enter" || !this.map.cursor) return;
      const point = this.map.placeAt(this.map.cursor), { k } = this.nearest(point);
      if (!hand.take(k, "F")) return;
      event.preventDefault();
      hand.put(point);
      hand.drop();
    });
  }
}
