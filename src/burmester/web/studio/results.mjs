// The panel of cards: filtered, sorted and pinned.  A card keeps its linkage while a hand drags.

import { give, h, put, say } from "../widget/dom.mjs";
import { clamp, listed } from "../widget/numbers.mjs";
import { PLACED } from "./answers.mjs";
import { Compare } from "./compare.mjs";
import { FILTERS, ORDERS, arranged } from "./ordering.mjs";
import { Pace } from "./pacing.mjs";
import { ResultCard } from "./result_card.mjs";
import { QUICK } from "./store.mjs";

const MOST = 40; // cards that are there at once, unless all of them are asked for

const USUAL = { order: "rank", filter: "all", type: "" };

export class Results {
  constructor(store, answers, playing) {
    this.store = store;
    this.answers = answers;
    this.cards = new Map();
    this.wanted = { ...USUAL, ...store.filters };
    this.all = false;
    const choice = (name, entries, key) =>
      h("label", {}, `${name} `, h("select", { "data-choice": key, onchange: (event) => this.want(key, event.target.value) }, entries.map(([value, text]) => h("option", { value }, text))));
    this.chips = h("div", { class: "bs-filters", role: "group", "aria-label": "Which linkages are shown" });
    this.compare = new Compare(store, answers, playing);
    this.title = h("h2", {}, "Linkages");
    this.status = h("p", { class: "bs-results-status", role: "status" });
    this.doubt = h("p", { class: "bs-doubt" });
    this.gone = h("p", { class: "bs-gone-note" });
    this.list = h("div", { class: "bs-cards" });
    this.more = h("button", { type: "button", class: "bs-small", hidden: true, onclick: () => this.showAll() });
    this.element = h(
      "section",
      { class: "bs-results", "aria-label": "Linkages" },
      h("div", { class: "bs-results-head" }, this.title, this.status, this.doubt, this.gone,
        this.chips, h("div", { class: "bs-choices" }, choice("Sort by", Object.entries(ORDERS).map(([key, { name }]) => [key, name]), "order"))),
      this.compare.element,
      this.list,
      this.more,
    );
    this.pace = new Pace(() => this.update()); // what is read may lag behind the hand, what it holds may not
    this.list.addEventListener("keydown", (event) => this.walk(event));
    answers.on("answers placed", () => this.arrange());
    answers.on("moved", () => this.pace.ask());
    answers.on("shown", () => this.update());
    store.on("pinned", () => this.arrange());
    store.on("filters", () => this.filtered());
    store.on("state document", () => this.tell());
    this.arrange();
  }

  want(key, value) {
    this.store.filter(key, value);
  }

  /** Show by the filters of the store, which undo takes back. */
  filtered() {
    Object.assign(this.wanted, USUAL, this.store.filters);
    for (const select of /** @type {NodeListOf<HTMLSelectElement>} */ (this.element.querySelectorAll("[data-choice]"))) give(select, "value", this.wanted[select.dataset.choice ?? ""]);
    this.arrange();
  }

  showAll() {
    this.all = true;
    this.arrange();
  }

  /** Cards in their order: new ones are made, those of linkages that go on keep their elements. */
  arrange() {
    const { answers, store, wanted } = this;
    this.buildChips();
    const every = arranged(answers.linkages, { ...wanted, pinned: store.pinned });
    const shown = this.all ? every : every.slice(0, MOST);
    const list = answers.placed ? [answers.placed, ...shown] : shown;
    const cards = new Map();
    for (const linkage of list) cards.set(linkage, this.cards.get(linkage) ?? this.card());
    for (const [linkage, card] of this.cards) if (!cards.has(linkage)) card.element.remove();
    this.cards = cards;
    let before = null;
    for (const card of cards.values()) {
      const next = before ? before.nextSibling : this.list.firstChild;
      if (card.element !== next) this.list.insertBefore(card.element, next);
      before = card.element;
    }
    give(this.more, "hidden", every.length <= shown.length);
    if (!this.more.hidden) say(this.more, `Show all ${every.length}`);
    this.hidden = answers.linkages.length - every.length;
    this.update();
  }

  card() {
    const { store } = this;
    return new ResultCard({
      choose: (id) => store.choose(id),
      pin: (id) => store.pin(id),
      improve: (id) => this.improve(id),
      letGo: () => this.letGo(),
    });
  }

  /** Put the pivots away that a hand put down. */
  letGo() {
    if (this.store.placed?.cognateOf) this.store.letCognateGo();
    else this.store.place([]);
    if (this.store.chosen === PLACED) this.store.choose(this.answers.linkages[0]?.id ?? null);
  }

  /** A chip for each filter and for each type, with how many linkages it leaves. */
  buildChips() {
    const { answers: { linkages }, store: { pinned }, wanted } = this, types = [...new Set(linkages.map((each) => each.type))].sort();
    if (!types.includes(wanted.type)) wanted.type = "";
    const chip = (key, value, text, count) => ({ key, value, text: `${text} ${count}`, on: wanted[key] === value });
    const chips = [
      ...Object.entries(FILTERS).map(([value, { name, holds }]) => chip("filter", value, name, linkages.filter((each) => holds(each, pinned)).length)),
      ...(types.length > 1 ? types.map((type) => chip("type", type, type, linkages.filter((each) => each.type === type).length)) : []),
    ];
    const said = JSON.stringify(chips);
    if (said === this.chipsSaid) return;
    this.chipsSaid = said;
    this.chips.replaceChildren(...chips.map(({ key, value, text, on }) =>
      h("button", { type: "button", class: "bs-filter", "data-chip": value, "aria-pressed": String(on), onclick: () => this.want(key, key === "type" && on ? "" : value) }, text)));
  }

  /** What the cards say, in the order in which they stand. */
  update() {
    const { answers, store } = this, { data, isOld, shown } = answers;
    for (const [linkage, card] of this.cards) {
      card.show(linkage, { data, old: isOld && linkage.id !== PLACED, best: answers.linkages[0], chosen: linkage === shown, pinned: store.pinned.has(linkage.id) });
    }
    this.tell();
  }

  /** How many there are, and what is doubtful; read aloud only when the hand rests. */
  tell() {
    const { answers, store } = this, there = answers.linkages.filter((each) => !each.gone);
    const usable = there.filter((each) => each.usable).length;
    say(this.title, there.length ? `${there.length} linkage${there.length === 1 ? "" : "s"}, ${usable} usable` : store.solved ? "No linkage" : "Linkages");
    put(this.status, "aria-live", store.state === "dragging" ? "off" : "polite");
    say(this.status, this.statusText());
    const uncertain = store.followed?.uncertain ?? [];
    say(this.doubt, store.followed && answers.isOld ? (uncertain.length ? `May change when you let go: ${uncertain[0]}${/[.!]$/.test(uncertain[0]) ? "" : "."}` : store.followed.complete === false ? "A linkage that appears now is seen when you let go." : "") : "");
    say(this.gone, !answers.isOld && answers.gone.length ? `Not in the new answer: ${listed(answers.gone)} of the one before.` : "");
    this.element.classList.toggle("bs-stale", answers.isOld);
  }

  statusText() {
    const { store, answers } = this, hidden = this.hidden ? `${this.hidden} not shown by the filter. ` : "";
    if (store.state === "offline") return "The connection is gone; what you see is the last answer.";
    if (answers.isOld && store.state === "dragging") return store.followed ? "Moving along." : this.whenSolved();
    if (store.state === "solving") return "Looking for all linkages.";
    if (!store.solved) return "";
    const { best, outcome } = store.solved;
    if (!store.solved.linkages.some((each) => each.usable)) return `${hidden}${sentence(outcome?.message)}${outcome?.help ? ` What helps: ${outcome.help}.` : ""}`;
    return `${hidden}${best?.[0] ?? ""}`;
  }

  /** When the answer comes to a task that cannot be followed. */
  whenSolved() {
    const { slow } = this.store;
    if (slow === null) return "The new answer comes when you let go.";
    const took = `All linkages are looked for anew, which took ${slow < 0.95 ? "less than a second" : `${Math.round(slow)} s`} last time`;
    return slow > QUICK ? `${took}: the new answer comes when you let go.` : `${took}: the answer lags behind your hand by so much.`;
  }

  /** Look for better linkages near one that is not usable, as `burmester judge --improve` does. */
  async improve(id) {
    const { document, options, connection } = this.store;
    const card = () => [...this.cards].find(([linkage]) => linkage.id === id)?.[1];
    card()?.tellBetter(["Looking near it …"]);
    let said;
    try {
      said = (await (await connection.post("/improve", { document, options, linkage: id })).json()).better;
    } catch (error) {
      said = [`That did not work: ${/** @type {Error} */ (error).message}`];
    }
    if (document === this.store.document) card()?.tellBetter(said.length ? said.map(nearIt) : ["Nothing better lies near it."]);
  }

  /** Arrow keys go from card to card. */
  walk(event) {
    const step = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 }[event.key];
    const mains = [...this.cards.values()].map((card) => card.main), at = mains.indexOf(this.list.getRootNode().activeElement);
    if (!step || at < 0) return;
    event.preventDefault();
    mains[clamp(at + step, 0, mains.length - 1)].focus();
  }
}

/** A better linkage has a number only in the judgement that found it. */
const nearIt = (text) => text.replace(/^L\d+ changes/, "One changes");

const sentence = (text) => (text ? `${text[0].toUpperCase()}${text.slice(1)}.` : "");
