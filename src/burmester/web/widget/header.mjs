// The top of the report: its title, the outcome in a sentence, and warnings.

import { h } from "./dom.mjs";

const OPEN = /^R(303|31)/; // outcomes of tasks that have no one answer: nothing went wrong

/** The header of a report; good: whether a linkage is usable. */
export function header(data, good) {
  const { outcome } = data, open = OPEN.test(outcome.code);
  return h(
    "header",
    { class: "bm-head" },
    h("p", { class: "bm-overline" }, "burmester · linkage report"),
    data.title ? h("h1", {}, data.title) : null,
    h(
      "p",
      { class: `bm-outcome ${good ? "bm-good" : open ? "bm-open" : "bm-bad"}` },
      h("span", { class: "bm-sign", "aria-hidden": "true" }, good ? "✓" : open ? "i" : "✕"),
      h("span", {}, `${outcome.message[0].toUpperCase()}${outcome.message.slice(1)}. `, h("span", { class: "bm-code" }, outcome.code)),
    ),
    data.best.map((sentence) => h("p", { class: "bm-best" }, sentence)),
    notes(outcome),
    data.warnings.length ? h("ul", { class: "bm-warnings", "aria-label": "Warnings" }, data.warnings.map(warning)) : null,
  );
}

const warning = (each) =>
  h(
    "li",
    {},
    h("p", {}, h("b", {}, "! Warning "), h("span", { class: "bm-code" }, each.code), ` ${each.message}.`),
    notes(each),
  );

/** Why a message is so, and what helps, where it says. */
const notes = ({ why, help }) => [
  why ? h("p", { class: "bm-why" }, h("b", {}, "Why: "), why, ".") : null,
  help ? h("p", { class: "bm-why" }, h("b", {}, "What helps: "), help, ".") : null,
];
