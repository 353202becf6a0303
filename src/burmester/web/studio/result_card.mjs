// One linkage as a card: its verdict with the reason, its figures, and what would help.

import { give, h, put, say } from "../widget/dom.mjs";
import { PLACED, leastOf, pathErrorOf, worstOf } from "./answers.mjs";

const FIGURES = [
  ["worst", "worst miss"],
  ["least", "transmission"],
  ["size", "size"],
  ["sensitivity", "sensitivity"],
];

/** A card for good: it shows whatever linkage `show` gives it, and keeps its elements. */
export class ResultCard {
  /** @param {{ choose: Function, pin: Function, compare: Function, improve: Function, letGo: Function }} does */
  constructor(does) {
    this.name = h("b", {});
    this.type = h("span", { class: "bm-type" });
    this.was = h("span", { class: "bs-was" });
    this.verdict = h("span", { class: "bm-verdict" });
    this.figures = new Map(FIGURES.map(([key]) => [key, h("dd", { "data-figure": key })]));
    this.worst = h("dt", {});
    this.note = h("span", { class: "bs-card-note" });
    this.reason = h("span", { class: "bm-reason" });
    this.help = h("span", { class: "bs-help" });
    this.main = h(
      "button",
      { type: "button", class: "bs-card-main", "aria-pressed": "false", onclick: () => does.choose(this.id) },
      h("span", { class: "bm-choice-head" }, this.name, " ", this.type, " ", this.was),
      this.verdict,
      h("dl", { class: "bs-figures" }, FIGURES.map(([key, name]) => [key === "worst" ? this.worst : h("dt", {}, name), this.figures.get(key)])),
      this.note, this.reason, this.help,
    );
    this.pin = h("button", { type: "button", class: "bs-small", "aria-pressed": "false", onclick: () => does.pin(this.id) }, "Pin");
    this.compare = h("button", { type: "button", class: "bs-small", "aria-pressed": "false", onclick: () => does.compare(this.id) }, "Compare");
    this.improve = h("button", { type: "button", class: "bs-small", onclick: () => does.improve(this.id) }, "Look near it");
    this.letGo = h("button", { type: "button", class: "bs-small", onclick: () => does.letGo() });
    this.better = h("ul", { class: "bs-better", "aria-live": "polite" });
    this.element = h("article", { class: "bs-card bm-choice" }, this.main, h("div", { class: "bs-card-tools" }, this.pin, this.compare, this.improve, this.letGo), this.better);
  }

  /** Show a linkage as it is now; old: what only the whole search knows belongs to an older task. */
  show(linkage, { data, old, chosen, pinned, compared }) {
    const { said } = linkage, { classList } = this.element, isPlaced = linkage.id === PLACED;
    if (this.id !== linkage.id || old) this.better.replaceChildren();
    if (this.id !== linkage.id) {
      this.id = linkage.id;
      put(this.element, "data-linkage", linkage.id);
      }
    say(this.name, isPlaced ? linkage.called : linkage.id);
    say(this.type, linkage.type);
    say(this.was, pastOf(linkage));
    say(this.verdict, linkage.gone ? "✕ gone" : linkage.usable ? "✓ usable" : "✕ not usable");
    say(this.worst, data.isPath ? "path error" : "worst miss");
    say(this.figures.get("worst"), data.isPath ? pathErrorOf(linkage, data) : worstOf(linkage, data));
    say(this.figures.get("least"), least(linkage));
    say(this.figures.get("size"), said.quality.extent ?? "–");
    say(this.figures.get("sensitivity"), said.quality.sensitivity ?? "–");
    say(this.note, linkage.gone ?? ((linkage.usable && linkage.change) || (linkage.usable && !linkage.followed && linkage.shortcomings?.length ? `Falls short: ${linkage.shortcomings.join("; ")}` : "")));
    const reason = linkage.usable || linkage.gone ? "" : linkage.followed ? linkage.reason ?? "" : said.reasons.join("; ");
    say(this.reason, reason);
    say(this.help, reason && said.help && !linkage.followed ? `What would help: ${said.help}.` : "");
    classList.toggle("bm-good", linkage.usable && !linkage.gone);
    classList.toggle("bm-bad", !linkage.usable || Boolean(linkage.gone));
    classList.toggle("bs-gone", Boolean(linkage.gone));
    classList.toggle("bs-old", old || Boolean(linkage.followed));
    classList.toggle("bs-chosen", chosen);
    setPressed(this.main, chosen);
    setPressed(this.pin, pinned);
    setPressed(this.compare, compared);
    say(this.pin, pinned ? "Pinned" : "Pin");
    give(this.pin, "hidden", isPlaced);
    give(this.compare, "hidden", isPlaced || chosen);
    give(this.improve, "hidden", isPlaced || linkage.usable || old || Boolean(linkage.gone));
    give(this.letGo, "hidden", !isPlaced);
    say(this.letGo, linkage.called === "By hand" ? "Let go of the pivots" : "Put it away");
    for (const button of [this.pin, this.compare, this.improve]) labelled(button, linkage.id);
  }

  /** What a search near the linkage found. */
  tellBetter(sentences) {
    this.better.replaceChildren(...sentences.map((sentence) => h("li", {}, sentence)));
  }
}

/** What became of a linkage since the last search: its id then, and how far this search moved it. */
export function pastOf({ was, shift, isNew, followed }) {
  if (isNew && !was) return "new";
  const moved = shift && !followed ? `moved ${(100 * shift).toFixed(1)} %` : "";
  return [was ? `was ${was}` : "", moved].filter(Boolean).join(", ");
}

function least(linkage) {
  const angle = leastOf(linkage);
  return angle === "–" ? angle : angle === "0°" ? "down to 0°" : `${angle} or more`;
}

function setPressed(button, on) {
  put(button, "aria-pressed", Boolean(on));
}

function labelled(button, id) {
  put(button, "aria-label", `${button.textContent}: ${id}`);
}
