// The ranked function generators as cards.

import { h } from "./dom.mjs";
import { CardList } from "./cards.mjs";
import { verdictOf } from "./tables.mjs";

export class Cards extends CardList {
  constructor(generators, choose) {
    super(generators.map((each, k) => card(each, () => choose(k))));
  }
}

function card(generator, onclick) {
  const { said } = generator;
  const fact = (name, value, kind = null) => [h("dt", { class: kind }, name), h("dd", { class: kind }, value)];
  return h(
    "button",
    { type: "button", class: `bm-choice ${generator.usable ? "bm-good" : "bm-bad"}`, "aria-pressed": "false", "data-linkage": generator.id, onclick },
    h("span", { class: "bm-choice-head" }, h("b", {}, generator.id), " ", h("span", { class: "bm-type" }, generator.type)),
    h("span", { class: "bm-verdict" }, verdictOf(generator)),
    h(
      "dl",
      {},
      fact("greatest error", said.max_error),
      fact("transmission", said.transmission === "–" ? "–" : said.transmission === "0°" ? "down to 0°" : `${said.transmission} or more`),
      fact("links", said.links.map(([, value], k) => [k ? " " : "", h("span", {}, value)]), "bm-detail bm-links"),
    ),
    generator.defects.length || generator.shortcomings.length
      ? h("span", { class: "bm-reason" }, `It ${[...generator.defects, ...generator.shortcomings].join("; ")}`)
      : null,
  );
}
