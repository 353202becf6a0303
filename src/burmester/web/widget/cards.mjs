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
    super(linkages.map((each, k) => fourBarCard(each, unit, () => choose(k))));
  }
}

/** A card: the linkage with its verdict, facts in rows of a list, and what is said below them. */
export function card(linkage, onclick, facts, ...below) {
  return h(
    "button",
    { type: "button", class: `bm-choice ${linkage.usable ? "bm-good" : "bm-bad"}`, "aria-pressed": "false", "data-linkage": linkage.id, onclick },
    h("span", { class: "bm-choice-head" }, h("b", {}, linkage.id), " ", h("span", { class: "bm-type" }, linkage.type)),
    h("span", { class: "bm-verdict" }, verdictOf(linkage)),
    h("dl", {}, facts),
    below,
  );
}

/** A row of the list on a card. */
export const fact = (name, value, kind = null) => [h("dt", { class: kind }, name), h("dd", { class: kind }, value)];

/** The least transmission angle on a card. */
export const transmissionFact = (text) => fact("transmission", text === "–" ? text : text === "0°" ? "down to 0°" : `${text} or more`);

/** The lengths of links on a card. */
export const linksFact = (lengths) => fact("links", lengths.map((each, k) => [k ? " " : "", h("span", {}, each)]), "bm-detail bm-links");

function fourBarCard(linkage, unit, onclick) {
  const { said } = linkage;
  const links = said.links ? Object.values(said.links) : [];
  const whole = (text) => h("span", { class: "bm-whole-word" }, text);
  return card(
    linkage,
    onclick,
    [
      fact("worst miss", missOf(said.worst, said.angle, unit).split(" and ").map((part, k) => [k ? ", " : "", whole(part)])),
      transmissionFact(said.transmission === "-" ? "–" : said.transmission),
      said.quality.extent ? fact("extent, sensitivity", [whole(said.quality.extent), ", ", whole(said.quality.sensitivity)], "bm-detail") : null,
      fact("driver", `${linkage.led[0].id}${said.turns_fully ? ", turns fully" : ""}`),
      links.length ? linksFact(links) : fact("dyads", linkage.dyads.map((dyad) => `${dyad.id} (${dyad.kind})`).join(" · "), "bm-detail"),
    ],
    said.freedom ? h("span", { class: "bm-quiet" }, said.freedom) : null,
    said.reasons.length ? h("span", { class: "bm-reason" }, said.reasons.join("; ")) : null,
  );
}
