// Numbers beside a handle: what a hand sets is typed there, with a unit, while it is held and afterwards.

import { give, h } from "../widget/dom.mjs";
import { NumberField } from "./fields.mjs";

const OFF = [16, 20]; // pixels from the handle

export class HandleField {
  /** @type {any} */ what = null;

  constructor(store, scene) {
    this.store = store;
    this.scene = scene;
    this.element = h("div", { class: "bs-handle-field", role: "group", hidden: true });
    scene.element.append(this.element);
    store.on("document selection", () => this.draw());
    scene.on("view", () => this.draw());
    scene.svg.addEventListener("pointerdown", (event) => scene.dragged || (event.button === 0 && this.close()));
    scene.svg.addEventListener("keydown", (event) => this.begin(event));
    this.element.addEventListener("keydown", (event) => {
      if (event.key !== "Escape" && event.key !== "Enter") return;
      this.close();
      scene.svg.focus({ preventScroll: true });
      event.stopPropagation();
    });
  }

  /** Show numbers: { name, kind, at(): a point of F, fields: [[key, label, kind of quantity], ...], values(), set(changes) }; kind: of selection. */
  open(what) {
    this.what = what;
    this.fields = what.fields.map(([key, label, kind]) => new NumberField({
      label: `${label} of ${what.name}`, commit: (value) => what.set({ [key]: value }), options: () => ({ kind, unit: this.store.document.length_unit, ...what.options }),
      step: () => (kind === "angle" ? 1 : this.scene.step), attributes: { "data-key": key, title: label },
    }));
    this.element.replaceChildren(...this.fields.map((field, k) => h("label", {}, h("span", {}, what.fields[k][1]), field.element)));
    this.element.setAttribute("aria-label", what.name);
    give(this.element, "hidden", false);
    this.draw();
  }

  close() {
    if (!this.what) return;
    this.what = null;
    give(this.element, "hidden", true);
  }

  draw() {
    const { what, store, scene: { view } } = this, at = what?.kind === store.selection?.kind && what?.at();
    if (!at) return this.close();
    const values = what.values(), width = this.element.offsetWidth, height = this.element.offsetHeight, [X, Y] = [view.X(at[0]), view.Y(at[1])];
    this.fields.forEach((field, k) => field.show(values[what.fields[k][0]]));
    this.element.style.left = `${X + OFF[0] + width > view.width ? X - OFF[0] - width : X + OFF[0]}px`;
    this.element.style.top = `${Math.max(0, Y + OFF[1] + height > view.height ? Y - OFF[1] - height : Y + OFF[1])}px`;
    return undefined;
  }

  /** A digit that is typed at a handle begins its first number. */
  begin(event) {
    if (!this.what || event.target === this.scene.svg || !/^[\d.,\-−]$/.test(event.key) || event.ctrlKey || event.metaKey || event.altKey) return;
    const [{ input }] = this.fields;
    input.focus();
    input.select();
  }
}
