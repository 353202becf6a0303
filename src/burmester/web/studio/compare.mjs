// The two linkages that are pinned, side by side: they move together, and their numbers stand beside each other.

import { give, h } from "../widget/dom.mjs";
import { fixed } from "../widget/numbers.mjs";
import { Portrait } from "../widget/portrait.mjs";
import { sizeOf } from "../widget/cards.mjs";
import { Pace, isSeen, watch } from "./pacing.mjs";
import { liveFigures } from "./result_card.mjs";
import { frameAtStage, stageOf } from "./together.mjs";

/** Rows of numbers of two linkages: a name, both texts, and which of them is better (0, 1 or null). */
export function comparison(one, other, data) {
  const both = [one, other];
  const least = (values) => (values.every(Number.isFinite) && values[0] !== values[1] ? (values[0] < values[1] ? 0 : 1) : null);
  const value = { worst: (each) => each.worst, least: (each) => -(each.least ?? NaN), size: (each) => sizeOf(each, data), sensitivity: (each) => each.quality?.sensitivity };
  const figures = both.map((each) => liveFigures(each, data));
  return [
    { name: "verdict", texts: both.map((each) => (each.gone ? "gone" : each.usable ? "usable" : "not usable")), better: least(both.map((each) => (each.usable ? 0 : 1))) },
    ...figures[0].map(([key, name, text], k) => ({ name, texts: [text, figures[1][k][2]], better: least(both.map((each) => value[key](each) ?? NaN)) })),
  ];
}

export class Compare {
  constructor(store, answers, playing) {
    this.store = store;
    this.answers = answers;
    this.playing = playing;
    this.portraits = [0, 1].map(() => new Portrait());
    this.names = [0, 1].map(() => h("h3", {}));
    this.places = [0, 1].map(() => h("p", { class: "bs-quiet" }));
    this.table = h("div", { class: "bm-scroll", tabindex: 0, role: "region", "aria-label": "Both linkages in numbers" });
    this.button = h("button", { type: "button", class: "bm-button", onclick: () => playing.player.play(!playing.player.playing) }, "Play both");
    this.finish = h("button", { type: "button", class: "bs-small", onclick: () => this.pair.forEach(({ id }) => store.pin(id)) }, "End the comparison");
    this.element = h("div", { class: "bs-compare", hidden: true, "aria-label": "The two that are pinned", role: "group" },
      h("div", { class: "bs-beside" }, [0, 1].map((k) => h("div", {}, this.names[k], this.portraits[k].svg, this.places[k]))), h("div", { class: "bs-tool" }, this.button, " ", this.finish), this.table);
    this.pace = new Pace(() => this.build(), () => isSeen(this.element));
    answers.on("answers moved", () => this.pace.ask());
    store.on("pinned", () => this.build());
    playing.on("place", () => this.show());
    watch(this.element, () => this.pace.ask());
  }

  /** The first two that are pinned, or none. */
  get pair() {
    const there = [...this.store.pinned].map((id) => this.answers.get(id)).filter((each) => each?.ways.length);
    return there.length > 1 ? there.slice(0, 2) : [];
  }

  build() {
    const { pair, answers: { data } } = this;
    give(this.element, "hidden", !pair.length);
    if (!pair.length) return;
    pair.forEach((each, k) => {
      this.names[k].textContent = `${each.id}: ${each.type}`;
      this.portraits[k].draw(data, each);
    });
    this.buildTable(comparison(pair[0], pair[1], data));
    this.show();
  }

  buildTable(rows) {
    const old = this.answers.isOld ? "bs-old" : null;
    this.table.replaceChildren(
      h("table", { class: "bs-compared" }, h("caption", {}, "Both linkages in numbers; the better one of each row is bold"),
        h("thead", {}, h("tr", {}, h("th", { scope: "col" }, ""), this.pair.map(({ id }) => h("th", { scope: "col" }, id)))),
        h("tbody", {}, rows.map(({ name, texts, better }) => h("tr", { class: /size|error/.test(name) ? old : null }, h("th", { scope: "row" }, name), texts.map((text, k) => h("td", { class: "bm-words" }, better === k ? h("b", {}, text) : text)))))),
    );
  }

  /** Both at the stage of the linkage that plays. */
  show() {
    const { playing: { linkage, player } } = this;
    if (this.element.hidden || !linkage || !isSeen(this.element)) return;
    const stage = stageOf(linkage, player.way, player.u);
    this.pair.forEach((each, k) => {
      const at = frameAtStage(each, stage), transmission = at ? each.ways[at.way].transmission[Math.round(at.u)] : null;
      this.portraits[k].show(at);
      this.portraits[k].svg.classList.toggle("bs-old", !at);
      this.places[k].textContent = at ? `transmission angle ${Number.isFinite(transmission) ? `${fixed(transmission, 1)}°` : "–"}` : "It does not reach this pose.";
    });
  }
}
