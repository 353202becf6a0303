// The three linkages of one coupler curve: the one that is shown and its cognates, to choose from.

import { give, h, put, say } from "../widget/dom.mjs";
import { fixed } from "../widget/numbers.mjs";
import { decimalsOf } from "../widget/tables.mjs";
import { PLACED, leastOf, linked } from "./answers.mjs";
import { isOfPoints } from "./document.mjs";
import { Pace, isSeen, watch } from "./pacing.mjs";

export class CognatePanel {
  /** @type {any} */ known;

  constructor(store, answers) {
    this.store = store;
    this.answers = answers;
    this.known = null;
    this.asking = false;
    this.story = h("p", { class: "bm-story" });
    this.cards = h("div", { class: "bs-cognates", role: "group", "aria-label": "The linkages of one curve" });
    this.element = h("div", { class: "bs-cognate-panel" }, this.story, this.cards);
    this.pace = new Pace(() => this.renew(), () => isSeen(this.element));
    answers.on("answers shown placed", () => this.pace.ask());
    store.on("state document", () => this.pace.ask());
    watch(this.element, () => this.pace.ask());
  }

  /** The linkage whose cognates are shown: that which is chosen, or whose cognate is. */
  get of() {
    const { placed, chosen } = this.store;
    return this.answers.get(chosen === PLACED ? placed?.cognateOf : chosen) ?? (chosen === PLACED ? undefined : this.answers.shown);
  }

  async renew() {
    const { store, answers } = this, { of } = this;
    if (!isOfPoints(store.document)) return;
    if (!of || of.gone || answers.isOld) return this.show(of && !of.gone ? "The cognates are looked for when the answer is there." : "No linkage is there.");
    const key = store.solved;
    if (this.known?.key === key && this.known.of === of.id) return this.show();
    if (this.asking || !store.connection?.isOpen) return undefined;
    this.asking = true;
    try {
      const answer = await store.connection.ask({ do: "cognates", document: store.document, linkage: of.id });
      if (answer.kind === "cognates") this.known = { key, of: of.id, linkages: answer.linkages.map(linked) };
    } catch {
      // the connection ended: it says so itself
    }
    this.asking = false;
    if (this.known?.key === store.solved && this.known.of === this.of?.id) return this.show();
    if (store.solved !== key) this.pace.ask();
    return undefined;
  }

  show(instead) {
    const { known, of } = this, there = !instead && known && of;
    const none = there && !known.linkages.length;
    say(this.story, instead ?? (none ? `${of.id} has no cognates: a link of theirs would have no length.` : "By Roberts' theorem these linkages trace the same curve, with the same error. Choose one by its room, its pivots and its transmission."));
    this.cards.replaceChildren(...(there && !none ? [of, ...known.linkages].map((each, k) => this.card(each, k)) : []));
    give(this.cards, "hidden", !there || none);
    put(this.element, "data-of", there ? of.id : null);
  }

  card(linkage, k) {
    const { store, answers: { data } } = this, { of } = this, digits = decimalsOf(data), unit = data.unit ? ` ${data.unit}` : "";
    const point = (at) => `(${at.map((value) => fixed(value, digits)).join(", ")})`, { links } = linkage.said;
    const chosen = k ? store.chosen === PLACED && store.placed?.linkage?.id === linkage.id : store.chosen === of.id;
    const facts = [
      ["fixed pivots", linkage.led.filter((dyad) => dyad.fixed_pivot).map((dyad) => point(dyad.fixed_pivot)).join(" and ")],
      ...(links ? [["links", `${Object.entries(links).map(([name, value]) => `${name} ${value}`).join(", ")}${unit}`]] : []),
      ["transmission", leastOf(linkage) === "–" ? "–" : `${leastOf(linkage)} or more`],
      ["size", linkage.said.quality.extent ?? "–"],
    ];
    return h("article", { class: `bs-card bm-choice ${linkage.usable ? "bm-good" : "bm-bad"}${chosen ? " bs-chosen" : ""}`, "data-cognate": k },
      h("button", { type: "button", class: "bs-card-main", "aria-pressed": String(Boolean(chosen)), onclick: () => this.choose(k) },
        h("span", { class: "bm-choice-head" }, h("b", {}, k ? `Cognate ${k}` : of.id), " ", h("span", { class: "bm-type" }, linkage.type)),
        h("span", { class: "bm-verdict" }, linkage.usable ? "✓ usable" : "✕ not usable"),
        h("dl", { class: "bs-figures" }, facts.map(([name, value]) => [h("dt", {}, name), h("dd", {}, value)])),
        linkage.usable ? null : h("span", { class: "bm-reason" }, linkage.said.reasons.join("; "))));
  }

  choose(k) {
    const { store, of, known } = this;
    if (k) store.takeCognate(known.linkages[k - 1], of.id);
    else if (store.placed?.cognateOf) store.letCognateGo();
    else store.choose(of.id);
    this.show();
    this.cards.children[k]?.querySelector("button").focus();
  }
}
