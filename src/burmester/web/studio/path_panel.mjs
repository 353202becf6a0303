// What points and paths say beside their places: closed or open, and how far they may be missed.

import { give, h, say } from "../widget/dom.mjs";
import { isOfPoints, isPath, setPath, setUsual } from "./document.mjs";
import { NumberField, labelled, tick } from "./fields.mjs";

export class PathPanel {
  constructor(store, scene) {
    this.store = store;
    this.title = h("h3", {});
    this.closed = tick("closed: the last point leads back to the first", (on) => store.edit((document) => setPath(document, { closed: on })), { "data-key": "path-closed" });
    this.fields = ["x", "y"].map((key) => ({
      key,
      field: new NumberField({
        label: `how far points may be missed in ${key}`, options: () => ({ kind: "length", unit: store.document.length_unit, optional: true, least: 0 }), step: () => scene.step / 10,
        commit: (value) => store.edit((document) => setUsual(document, key, value)), attributes: { "data-key": `usual-${key}`, placeholder: "–" },
      }),
    }));
    this.hint = h("p", { class: "bs-hint" });
    this.element = h("div", { class: "bs-path-panel", "data-details": "path" }, this.title, this.closed.element,
      h("div", { class: "bs-row" }, h("span", { class: "bs-label" }, "Points may be missed by"), this.fields.map(({ key, field }) => labelled(key, field.element))), this.hint);
    store.on("document", () => this.draw());
    this.draw();
  }

  draw() {
    const { document } = this.store, count = document.poses.length, path = isPath(document), timed = document.path?.crank_deg;
    give(this.element, "hidden", !isOfPoints(document));
    if (this.element.hidden) return;
    say(this.title, path ? `A path of ${count} points${timed ? ", timed by the crank" : ""}` : `${count} point${count === 1 ? "" : "s"}`);
    give(this.closed.box, "checked", Boolean(document.path?.closed));
    for (const { key, field } of this.fields) field.show(document.tolerance?.[key] || undefined);
    say(this.hint, path
      ? "Blank: as near as possible, and of what is about as near the one that transmits best."
      : "Nine points are met exactly by finitely many linkages, all of which are found; more are a path, which is met as nearly as possible.");
  }
}
