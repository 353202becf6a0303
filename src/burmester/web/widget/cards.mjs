// The ranked linkages as cards: one is chosen, arrows go from one to the next.

import { h } from "./dom.mjs";
import { clamp } from "./numbers.mjs";
import { missOf, verdictOf } from "./tables.mjs";

/** Cards of linkages: `element` holds them, `mark` shows which one is chosen. */
export class CardList {
  constructor(cards) {
    this.cards = cards;
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

/** A card for each linkage; `choose` is called with its index. */
export class Cards extends CardList {
  constructor(data, linkages, choose) {
    const unit = data.unit ? ` ${data.unit}` : "";
    super(linkages.map((each, k) => card(each, unit, () => choose(k))));
  }
}

function card(linkage, unit, onclick) {
  const { said } = linkage;
  const fact = (name, value, kind = null) => [h("dt", { class: kind }, name), h("dd", { class: kind }, value)];
  const links = said.links ? Object.values(said.links) : [];
  return h(
    "button",
    { type: "button", class: `bm-choice ${linkage.usable ? "bm-good" : "bm-bad"}`, "aria-pressed": "false", "data-linkage": linkage.id, onclick },
    h("span", { class: "bm-choice-head" }, h("b", {}, linkage.id), " ", h("span", { class: "bm-type" }, linkage.type)),
    h("span", { class: "bm-verdict" }, verdictOf(linkage)),
    h(
      "dl",
      {},
      fact("worst miss", missOf(said.worst, said.angle, unit).split(" and ").map((part, k) => [k ? ", " : "", h("span", { class: "bm-whole-word" }, part)])),
      fact("transmission", said.transmission === "-" ? "–" : said.transmission === "0°" ? "down to 0°" : `${said.transmission} or more`),
      said.quality.extent ? fact("extent, sensitivity", [h("span", { class: "bm-whole-word" }, said.quality.extent), ", ", h("span", { class: "bm-whole-word" }, said.quality.sensitivity)], "bm-detail") : null,
      fact("driver", `${linkage.led[0].id}${said.turns_fully ? ", turns fully" : ""}`),
      links.length ? fact("links", links.map((each, k) => [k ? " " : "", h("span", {}, each)]), "bm-detail bm-links") : fact("dyads", linkage.dyads.map((dyad) => `${dyad.id} (${dyad.kind})`).join(" · "), "bm-detail"),
    ),
    said.freedom ? h("span", { class: "bm-quiet" }, said.freedom) : null,
    said.reasons.length ? h("span", { class: "bm-reason" }, said.reasons.join("; ")) : null,
  );
}
