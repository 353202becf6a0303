// The points of a shape as fields, two for each.

import { give, h, say } from "../widget/dom.mjs";
import { NumberField } from "./fields.mjs";

const FEW = 40; // points that have fields

export class PointFields {
  /** options and step: as a NumberField of a length takes them; set(change): change goes from points to points. */
  constructor({ name, options, step, set }) {
    this.name = name;
    this.options = options;
    this.step = step;
    this.set = set;
    this.fields = [];
    this.shape = h("span", { class: "bs-hint" });
    this.more = h("p", { class: "bs-hint" });
    this.pairs = h("div", { class: "bs-coordinates" });
    this.element = h("div", { class: "bs-point-fields" }, this.shape, this.pairs, this.more);
  }

  /** Show a shape; text that is no number stays where it is, as long as its point does. */
  show(shape, points) {
    const count = Math.min(points.length, FEW);
    if (shape !== this.shape.textContent) this.fields = [];
    say(this.shape, shape);
    while (this.fields.length < count) this.fields.push(this.make(this.fields.length));
    this.fields.length = count;
    const wanted = this.fields.map((each) => each.element);
    if (wanted.length !== this.pairs.children.length || wanted.some((each, k) => each !== this.pairs.children[k])) this.pairs.replaceChildren(...wanted);
    this.fields.forEach(({ pair }, k) => pair.forEach((field, i) => field.show(points[k][i])));
    give(this.more, "hidden", points.length <= FEW);
    say(this.more, `and ${points.length - FEW} more, to drag in the plane`);
  }

  make(k) {
    const pair = ["x", "y"].map((axis, i) =>
      new NumberField({
        label: `${axis} of point ${k + 1} of ${this.name}`,
        options: () => ({ ...this.options(), optional: false }), step: this.step,
        commit: (value) => this.set((points) => points.map((point, j) => (j === k ? point.map((old, m) => (m === i ? value : old)) : point))),
      }));
    return { pair, element: h("span", { class: "bs-pair" }, pair.map((field) => field.element)) };
  }
}
