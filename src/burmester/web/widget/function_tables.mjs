// Cards, tables and facts of function generators.

import { card, fact, linksFact, transmissionFact } from "./cards.mjs";
import { h } from "./dom.mjs";
import { cells, table, verdictOf } from "./tables.mjs";

/** What a card says of a generator. */
export function generatorCard(generator, onclick) {
  const { said, defects, shortcomings } = generator;
  return card(
    generator,
    onclick,
    [fact("greatest error", said.max_error), transmissionFact(said.transmission), linksFact(said.links.map(([, value]) => value))],
    defects.length || shortcomings.length ? h("span", { class: "bm-reason" }, `It ${[...defects, ...shortcomings].join("; ")}`) : null,
  );
}

/** All generators with their figures. */
export function generatorTable(data) {
  const heads = [
    "", { name: "verdict", text: true }, { name: "type", text: true }, ...["ground", "input", "coupler", "output"].map((name) => `${name} link`),
    "greatest error", "of the range", "rms error", "least transm.", { name: "why not", text: true },
  ];
  const rows = data.generators.map((each) => {
    const { said } = each;
    const values = [
      each.id, verdictOf(each), each.type, ...said.links.map(([, value]) => value),
      said.max_error, said.percent, said.rms_error, said.transmission, each.defects.join("; ") || "–",
    ];
    return h("tr", {}, cells(values, [1, 2, 11], heads));
  });
  return table("All linkages, best first", heads, rows, { class: "bm-stacks" });
}

/** The pairs of angles, and what a generator makes of them. */
export function pairTable(data, generator) {
  const heads = ["pair", "input", "output wanted", "output made", "error"];
  const rows = generator.pairs.map((pair, k) => h("tr", { "data-pair": k + 1 }, cells([String(k + 1), ...pair])));
  return table(`Pairs of angles, and what ${generator.id} makes of them`, heads, rows, { class: "bm-pair-table" });
}

/** Dimensions and figures of a generator. */
export function generatorFacts(generator) {
  const rows = [...generator.said.links, ...generator.said.placed, ...generator.said.figures];
  return h("dl", { class: "bm-facts" }, rows.map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value))));
}
