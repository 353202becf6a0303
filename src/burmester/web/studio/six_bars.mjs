// Six-bars for the same poses: looked for when asked, as cards below the four-bars'.

import { give, h, say } from "../widget/dom.mjs";
import { Cards } from "../widget/cards.mjs";
import { linked } from "./answers.mjs";
import { button, choice } from "./fields.mjs";
import { Look } from "./look.mjs";

export class SixBars {
  /** @type {any} */ found;
  /** @type {any} */ cards;

  /** @param {any} store @param {import("./answers.mjs").Answers} answers */
  constructor(store, answers) {
    this.store = store;
    this.answers = answers;
    const chains = choice("How many chains are looked at", [["2000", "a quick look"], ["20000", "as usual"], ["100000", "a thorough search"]], () => {}, { "data-key": "chains" });
    chains.value = "20000";
    this.look = new Look(store, "six_bars", () => ({ chains: Number(chains.value) }));
    this.start = button("Look for six-bars", () => this.run(), { "data-do": "six-bars", title: "A six-bar may work where no four-bar does" });
    this.story = h("p", { class: "bs-hint" });
    this.place = h("div", {});
    this.element = h("section", { class: "bs-six-bars", "aria-label": "Six-bars" }, h("div", { class: "bs-row" }, this.start, chains), this.look.element, this.story, this.place);
    store.on("document", () => this.forget());
    store.on("chosen", () => this.mark());
    store.on("solved document", () => this.show());
    this.show();
  }

  async run() {
    const { store, answers } = this, { document } = store;
    this.forget(null);
    const found = await this.look.run();
    if (!found || document !== store.document) return;
    this.found = { document, linkages: found.linkages.map(linked) };
    for (const each of this.found.linkages) answers.others.set(each.id, each);
    const { message, why, help } = found.outcome;
    say(this.story, `${[found.best.join(" ") || message, why, help && `What helps: ${help}`].filter(Boolean).map((each) => each.replace(/\.$/, "")).join(". ")}.`);
    this.cards = new Cards(found, this.found.linkages, (k) => store.choose(this.found.linkages[k].id));
    this.place.replaceChildren(this.cards.element);
    if (this.found.linkages.length) store.choose(this.found.linkages[0].id);
  }

  /** Six-bars of other poses say nothing of these. */
  forget(document = this.store.document) {
    if (!this.found || this.found.document === document) return;
    const { store, answers } = this, isShown = answers.others.has(store.chosen);
    this.found = this.cards = null;
    answers.others.clear();
    this.place.replaceChildren();
    say(this.story, "");
    if (isShown) store.choose(answers.linkages[0]?.id ?? null);
  }

  mark() {
    this.cards?.mark(this.found.linkages.findIndex(({ id }) => id === this.store.chosen));
  }

  show() {
    const { solved, isEmpty } = this.store, none = Boolean(solved) && !solved.linkages.some(({ usable }) => usable);
    give(this.start, "hidden", isEmpty);
    this.start.classList.toggle("bm-primary", none);
  }
}
