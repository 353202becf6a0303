// The top of the report: its title, the outcome in a sentence, and warnings.

import { h } from "./dom.mjs";

const OPEN = /^R(303|31)/; // outcomes of tasks that have no one answer: nothing went wrong

/** The header of a report; good: whether a linkage is usable.
 *
 * Where one is, it says which; how it was found, and what to know of that, is there to unfold.
 */
export function header(data, good) {
  const { outcome, warnings } = data, open = OPEN.test(outcome.code);
  const [best, ...more] = good ? data.best : [];
  const found = [`${outcome.message[0].toUpperCase()}${outcome.message.slice(1)}. `, h("span", { class: "bm-code" }, outcome.code)];
  const said = (text) => text && data.best.some((sentence) => sentence.slice(1).startsWith(text.slice(1)));
  const told = [notes({ why: said(outcome.why) ? null : outcome.why, help: said(outcome.help) ? null : outcome.help }), warnings.length ? h("ul", { class: "bm-warnings", "aria-label": "Warnings" }, warnings.map(warning)) : null];
  const count = warnings.length ? `, and ${warnings.length} warning${warnings.length === 1 ? "" : "s"}` : "";
  return h(
    "header",
    { class: "bm-head" },
    h("p", { class: "bm-overline" }, `burmester · ${data.overline ?? "linkage report"}`),
    data.title ? h("h1", {}, data.title) : null,
    h(
      "p",
      { class: `bm-outcome ${good ? "bm-good" : open ? "bm-open" : "bm-bad"}` },
      h("span", { class: "bm-sign", "aria-hidden": "true" }, good ? "✓" : open ? "i" : "✕"),
      h("span", {}, best ?? found),
    ),
    (best ? more : data.best).map((sentence) => h("p", { class: "bm-best" }, sentence)),
    best
      ? h("details", { class: "bm-about" }, h("summary", {}, `How it was found${count}`), h("p", { class: "bm-found" }, found), told)
      : told,
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
