// The ways of a linkage to choose from: its assemblies, and their branches.

import { give, h } from "./dom.mjs";
import { wayName } from "./tables.mjs";
import { wayStory } from "./words.mjs";

/** `element` holds a button for each way; `take` is called with its index. */
export class Assemblies {
  constructor(data, take) {
    this.data = data;
    this.take = take;
    this.name = `bm-way-${Math.random().toString(36).slice(2)}`; // a page may hold several reports
    this.element = h("fieldset", { class: "bm-ways" });
  }

  build(linkage, index) {
    const one = (way, k) =>
      h(
        "label",
        {},
        h("input", { type: "radio", name: this.name, value: k, checked: k === index, onchange: () => this.take(k) }),
        h("span", {}, h("b", {}, wayName(way, linkage).replace("assembly ", "")), ` ${wayStory(way, this.data.poses)}`),
      );
    this.element.replaceChildren(h("legend", {}, "Assembly"), ...linkage.ways.map(one));
    give(this.element, "hidden", !linkage.ways.length || Boolean(this.data.whole)); // where all is shown there is one
  }
}
