// A search for the spring that makes the chosen linkage light: `burmester balance`, and its springs to choose from.

import { h, say } from "../widget/dom.mjs";
import { button, labelled, textField, tick } from "./fields.mjs";
import { Look } from "./look.mjs";
import { setAt, springsOf } from "./loads.mjs";

const newtons = (value) => Number(value.toPrecision(3));

/** What is looked for, and the springs that were found. */
export class SpringSearch {
  /** @param {any} store @param {{ judge: Function }} surface what judges a linkage whose pivots were moved */
  constructor(store, surface) {
    this.store = store;
    this.surface = surface;
    this.list = h("ul", { class: "bs-found-springs" });
    this.wanted = {};
    this.put = null; // the spring that was put in last: the next one takes its place
    this.look = new Look(store, "balance", () => ({ linkage: store.chosen, ...this.wanted }));
    const want = (key) => (value) => (this.wanted[key] = (typeof value === "string" ? value.trim() : value) || undefined);
    const box = (key, label) => labelled(label, textField(label, want(key), { "data-balance": key, placeholder: "usual; or 0,0:80,40" }));
    const file = h("input", { type: "file", accept: ".csv", "data-balance": "springs", onchange: async () => (this.wanted.springs = await file.files[0]?.text()) });
    this.element = h("div", {},
      h("details", { "data-section": "balance" }, h("summary", {}, "Which springs, and where"),
        h("div", { class: "bs-grid" }, labelled("springs of a list (CSV)", file), tick("two of each, one on either side", want("pairs"), { "data-balance": "pairs" }).element,
          box("ground", "ends on the ground, X,Y:X,Y"), box("on_body", "ends on the body, X,Y:X,Y"), tick("move the pivots, too", want("with_linkage"), { "data-balance": "with_linkage" }).element),
        h("p", { class: "bs-hint" }, "Then Find a spring once more.")),
      this.look.element, this.list);
  }

  async run() {
    const { store, look, list } = this;
    list.replaceChildren();
    this.put = null;
    const found = await look.run();
    if (!found) return;
    if (!found.springs.length) say(look.note, "No spring of the list fits between the ground and the body.");
    else say(look.note, `For ${store.chosen}, the best first. That none is better is not proved.`);
    list.replaceChildren(...found.springs.map((each) => this.row(each)));
  }

  row({ name, greatest, greatest_without: before, keeps_all: keeps, loads, spring, dyads }) {
    const unit = loads.hand_force_N || !loads.driver_torque_Nm ? "N" : "N·m", text = `${name}: ${newtons(greatest)} ${unit} at most, ${newtons(before)} ${unit} without it`;
    const moved = dyads ? " with moved pivots, which are then judged by hand;" : "";
    return h("li", {}, button(text, () => this.take(spring, dyads), { "data-spring-name": name, "data-moved": dyads ? "" : null, title: "Put it into the task" }), h("span", { class: "bs-hint" }, `${moved}${keeps ? " keeps all that is asked" : " does not keep all that is asked"}`));
  }

  take(spring, dyads) {
    const { store } = this, springs = springsOf(store.document), at = this.put ? springs.indexOf(this.put) : -1;
    this.put = spring;
    store.edit((document) => setAt(document, ["springs", at < 0 ? springs.length : at], spring));
    if (dyads?.every(({ kind }) => kind === "RR")) this.surface.judge(dyads.map(({ fixed_pivot, moving_pivot, radius }) => ({ fixed_pivot, moving_pivot, radius })));
  }
}
