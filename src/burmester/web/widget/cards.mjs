// The ranked linkages as cards: each with its picture, its verdict and its figures in words.  One is chosen, arrows go from one to the next.

import { h, put, say } from "./dom.mjs";
import { clamp, figure, fixed } from "./numbers.mjs";
import { Portrait } from "./portrait.mjs";

const ERRORS = { mm: 0.1, cm: 0.01, m: 0.0001, um: 1, in: 0.005, ft: 0.0005 }; // of lengths as a shop makes them, by unit
const LINK_DIGITS = 4; // significant ones of a link on a card
const ALIKE = 0.02; // of a length, and half a degree: less makes no difference between two linkages

/** The worst miss, by the words of the search. */
const missOf = ({ said }, data) => (said.worst === "-" ? "–" : [said.worst === "exact" ? "nothing" : withUnit(said.worst, data), said.angle && !["-", "exact", "free"].includes(said.angle) ? said.angle : null].filter(Boolean).join(", "));

const withUnit = (text, data) => `${text}${data.unit ? ` ${data.unit}` : ""}`;

/** The size of a linkage in the task's unit: the diagonal of the box of its pivots. */
export const sizeOf = (linkage, data) => (linkage.quality?.extent ?? NaN) * data.span;

/** What an error of a shop in every length does, in words: the sensitivity of a linkage. */
export function sensitivityText({ quality }, data) {
  const sensitivity = quality?.sensitivity ?? NaN, error = ERRORS[data.unit] ?? 10 ** Math.round(Math.log10(data.span / 1000));
  return [`${withUnit(figure(error), data)} of error`, Number.isFinite(sensitivity) ? `moves it ${withUnit(figure(error * sensitivity), data)}` : "–"];
}

/** The figures of a four-bar that guides a body: key, name and text each. */
export const figuresOf = (linkage, data) => [
  ["worst", "misses by", missOf(linkage, data)],
  ["least", "transmits", leastText(linkage.said.transmission)],
  ["size", "size", Number.isFinite(sizeOf(linkage, data)) ? withUnit(figure(sizeOf(linkage, data)), data) : "–"],
  ["sensitivity", ...sensitivityText(linkage, data)],
];

/** A least transmission angle as a card tells it. */
export const leastText = (text) => ({ "-": "–", "–": "–", "0°": "down to 0°" }[text] ?? `${text} or more`);

/** How a linkage differs from the best one, in words: "3 mm smaller, transmits 6° less"; "" where it hardly does. */
export function differenceOf(linkage, best, data) {
  if (!linkage.usable || !best?.usable || best.id === linkage.id) return "";
  const size = sizeOf(linkage, data) - sizeOf(best, data), angle = leastOf(linkage) - leastOf(best), sense = (value, more, less) => (value > 0 ? more : less);
  const parts = [
    Math.abs(size) > ALIKE * sizeOf(best, data) ? `${withUnit(figure(Math.abs(size)), data)} ${sense(size, "larger", "smaller")}` : "",
    Math.abs(angle) >= 0.5 ? `transmits ${fixed(Math.abs(angle), 0)}° ${sense(angle, "more", "less")}` : "",
  ].filter(Boolean);
  return parts.length ? `Than ${best.id}: ${parts.join(", ")}` : "";
}

const leastOf = (linkage) => linkage.least ?? linkage.min_transmission_angle_deg?.range ?? NaN;

/** The verdict of a linkage in one line: what it falls short in stands with it. */
export function verdictOf(linkage) {
  if (linkage.card?.facts) return linkage.card.verdict;
  if (!linkage.usable) return "✕ not usable";
  return linkage.shortcomings?.length && !linkage.followed ? `✓ usable, but ${linkage.shortcomings.join("; ")}` : "✓ usable";
}

/** The button of a card: `show` gives it a linkage, and it keeps its elements. */
export class Card {
  /** @param {string} kind @param {() => void} onclick */
  constructor(kind, onclick) {
    this.name = h("b", {});
    this.type = h("span", { class: "bm-type" });
    this.was = h("span", { class: "bs-was" });
    this.verdict = h("span", { class: "bm-verdict" });
    this.portrait = new Portrait();
    this.figures = h("dl", {});
    this.differs = h("span", { class: "bm-differs" });
    this.links = h("span", { class: "bm-lengths" });
    this.quiet = h("span", { class: "bm-quiet" });
    this.reason = h("span", { class: "bm-reason" });
    this.help = h("span", { class: "bs-help" });
    this.element = h("button", { type: "button", class: kind, "aria-pressed": "false", onclick },
      h("span", { class: "bm-choice-head" }, this.name, " ", this.type, " ", this.was), this.portrait.svg, this.verdict, this.figures, this.differs, this.links, this.quiet, this.reason, this.help);
  }

  /** figures: [key, name, text] each; what is not given stays empty. */
  show(data, linkage, { name = linkage.id, was = "", verdict = verdictOf(linkage), figures, differs = "", links = "", quiet = "", reason = "", help = "" }) {
    this.portrait.draw(data, linkage);
    for (const [element, text] of [[this.name, name], [this.type, linkage.type], [this.was, was], [this.verdict, verdict], [this.differs, differs], [this.links, links], [this.quiet, quiet], [this.reason, reason], [this.help, help]]) say(element, text);
    const rows = this.figures.children, names = figures.map(([key, title]) => `${key} ${title}`).join();
    if (names !== this.names) this.figures.replaceChildren(...figures.map(([key, title]) => h("div", {}, h("dt", {}, title), h("dd", { "data-figure": key }))));
    this.names = names;
    figures.forEach(([, , text], k) => say(rows[k].lastChild, text));
  }
}

/** A card for each linkage; `choose` is called with its index: `element` holds them, `mark` shows which one is chosen. */
export class Cards {
  constructor(data, linkages, choose) {
    const cards = (this.cards = linkages.map((each, k) => cardOf(data, each, linkages[0], () => choose(k))));
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

/** The card of a report: its facts are those that the data tell, or else those of a four-bar. */
function cardOf(data, linkage, best, onclick) {
  const { facts, quiet, reason } = linkage.card, links = Object.entries(linkage.said.links ?? {});
  const card = new Card(`bm-choice ${linkage.usable ? "bm-good" : "bm-bad"}`, onclick);
  put(card.element, "data-linkage", linkage.id);
  card.show(data, linkage, {
    figures: facts?.map(([name, text]) => [name, name, Array.isArray(text) ? text.join(", ") : text]) ?? figuresOf(linkage, data),
    differs: facts ? "" : differenceOf(linkage, best, data),
    links: links.length ? withUnit(links.map(([name, text]) => `${name} ${Number(Number(text).toPrecision(LINK_DIGITS))}`).join(", "), data) : "",
    quiet: quiet ?? "",
    reason: reason ?? "",
  });
  return card.element;
}
