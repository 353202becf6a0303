// One linkage as a card of the studio: the card of the report, live, with what can be done with it.

import { give, h, put, say } from "../widget/dom.mjs";
import { Card, differenceOf, figuresOf, leastText, verdictOf } from "../widget/cards.mjs";
import { PLACED, leastOf, pathErrorOf, worstOf } from "./answers.mjs";

/** A card for good: it shows whatever linkage `show` gives it, and keeps its elements. */
export class ResultCard {
  /** @param {{ choose: Function, pin: Function, improve: Function, letGo: Function }} does */
  constructor(does) {
    this.card = new Card("bs-card-main", () => does.choose(this.id));
    this.main = this.card.element;
    this.pin = h("button", { type: "button", class: "bs-small", "aria-pressed": "false", title: "Pin two, and they move beside each other", onclick: () => does.pin(this.id) }, "Pin");
    this.improve = h("button", { type: "button", class: "bs-small", onclick: () => does.improve(this.id) }, "Look near it");
    this.letGo = h("button", { type: "button", class: "bs-small", onclick: () => does.letGo() });
    this.better = h("ul", { class: "bs-better", "aria-live": "polite" });
    this.element = h("article", { class: "bs-card bm-choice" }, this.main, h("div", { class: "bs-card-tools" }, this.pin, this.improve, this.letGo), this.better);
  }

  /** Show a linkage as it is now; best: what it is compared with; old: what only the whole search knows belongs to an older task. */
  show(linkage, { data, best, old, chosen, pinned }) {
    const { said } = linkage, { classList } = this.element, isPlaced = linkage.id === PLACED;
    if (this.id !== linkage.id || old) this.better.replaceChildren();
    if (this.id !== linkage.id) {
      this.id = linkage.id;
      put(this.element, "data-linkage", linkage.id);
    }
    const reason = linkage.usable || linkage.gone ? "" : linkage.followed ? linkage.reason ?? "" : said.reasons.join("; ");
    this.card.show(data, linkage, {
      name: isPlaced ? linkage.called : linkage.id,
      was: pastOf(linkage),
      verdict: linkage.gone ? "✕ gone" : verdictOf(linkage),
      figures: liveFigures(linkage, data),
      differs: old || isPlaced || linkage.gone ? "" : differenceOf(linkage, best, data),
      quiet: linkage.gone ?? ((linkage.usable && linkage.change) || said.rounded || ""),
      reason,
      help: reason && said.help && !linkage.followed ? `What would help: ${said.help}.` : "",
    });
    classList.toggle("bm-good", linkage.usable && !linkage.gone);
    classList.toggle("bm-bad", !linkage.usable || Boolean(linkage.gone));
    classList.toggle("bs-gone", Boolean(linkage.gone));
    classList.toggle("bs-old", old || Boolean(linkage.followed));
    classList.toggle("bs-chosen", chosen);
    setPressed(this.main, chosen);
    setPressed(this.pin, pinned);
    say(this.pin, pinned ? "Pinned" : "Pin");
    give(this.pin, "hidden", isPlaced);
    give(this.improve, "hidden", isPlaced || linkage.usable || old || Boolean(linkage.gone));
    give(this.letGo, "hidden", !isPlaced);
    say(this.letGo, linkage.called === "By hand" ? "Let go of the pivots" : "Put it away");
    for (const button of [this.pin, this.improve]) labelled(button, linkage.id);
  }

  /** What a search near the linkage found. */
  tellBetter(sentences) {
    this.better.replaceChildren(...sentences.map((sentence) => h("li", {}, sentence)));
  }
}

/** The figures of a card, those that are followed as they are now. */
export const liveFigures = (linkage, data) =>
  figuresOf(linkage, data).map(([key, name, text]) => {
    if (key === "worst" && data.isPath) return [key, "path error", pathErrorOf(linkage, data)];
    if (key === "worst" && linkage.followed) return [key, name, worstOf(linkage, data).replace("exact", "nothing")];
    return key === "least" && linkage.followed ? [key, name, leastText(leastOf(linkage))] : [key, name, text];
  });

/** What became of a linkage since the last search: its id then, and how far this search moved it. */
export function pastOf({ was, shift, isNew, followed }) {
  if (isNew && !was) return "new";
  const moved = shift && !followed ? `moved ${(100 * shift).toFixed(1)} %` : "";
  return [was ? `was ${was}` : "", moved].filter(Boolean).join(", ");
}

function setPressed(button, on) {
  put(button, "aria-pressed", Boolean(on));
}

function labelled(button, id) {
  put(button, "aria-label", `${button.textContent}: ${id}`);
}
