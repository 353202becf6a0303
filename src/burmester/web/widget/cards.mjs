// The ranked linkages as cards: one is chosen, arrows go from one to the next.

import { h } from "./dom.mjs";
import { clamp } from "./numbers.mjs";

/** A card for each linkage; `choose` is called with its index: `element` holds them, `mark` shows which one is chosen. */
export class Cards {
  constructor(linkages, choose) {
    const cards = (this.cards = linkages.map((each, k) => cardOf(each, () => choose(k))));
    this.element = h(
      "nav",
      { class: "bm-list", "aria-label": "Linkages, best first" },
      h("h2", {}, `${cards.length} linkage${cards.length === 1 ? "" : "s"}`),
      h("div", { class: "bm-choices" }, this.cards),
    );
    this.element.addEventListener("keydown", (event) => {
      const step = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 }[event.key];
      const at = this.cards.indexOf(document.activeElement);
      if (!step || at < 0) return;
      event.preventDefault();
      this.cards[clamp(at + step, 0, this.cards.length - 1)].focus();
    });
  }

  mark(index) {
    this.cards.forEach((each, k) => each.setAttribute("aria-pressed", String(k === index)));
  }
}

const SIGNS = { "bm-detail bm-links": " " }; // what stands between several texts of a fact; else a comma

/** A card: the linkage with its verdict, facts in rows of a list, and what is said below them. */
function cardOf({ id, type, usable, card: { verdict, facts, quiet, reason } }, onclick) {
  const parts = (text, kind) => (Array.isArray(text) ? text.map((each, k) => [k ? SIGNS[kind] ?? ", " : "", h("span", { class: "bm-whole-word" }, each)]) : text);
  return h(
    "button",
    { type: "button", class: `bm-choice ${usable ? "bm-good" : "bm-bad"}`, "aria-pressed": "false", "data-linkage": id, onclick },
    h("span", { class: "bm-choice-head" }, h("b", {}, id), " ", h("span", { class: "bm-type" }, type)),
    h("span", { class: "bm-verdict" }, verdict),
    h("dl", {}, facts.map(([name, text, kind = null]) => [h("dt", { class: kind }, name), h("dd", { class: kind }, parts(text, kind))])),
    quiet ? h("span", { class: "bm-quiet" }, quiet) : null,
    reason ? h("span", { class: "bm-reason" }, reason) : null,
  );
}
