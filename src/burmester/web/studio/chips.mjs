// What is asked and what is assumed, over the answers: each a chip that changes or removes it.  And what the search
// advises, with buttons that do it.

import { give, h, put } from "../widget/dom.mjs";
import { limitRegions, limitsOf, regionsOf, setLimit, setRequirement, setUsual } from "./document.mjs";
import { provedOf } from "../widget/tables.mjs";
import { button } from "./fields.mjs";
import { limitName } from "./regions.mjs";

const PIVOTS = ["fixed_pivot", "moving_pivot"];
const SPOKEN = ["W215"]; // codes that chips say
const FEW = 5; // chips of what is asked and kept, before the rest waits behind one

/** A value of a requirement in words, as its field has them. */
function textOf({ label, form, choices, kind }, value, unit) {
  const of = { angle: "°", length: unit ? ` ${unit}` : "" }[form === "length" ? "length" : kind] ?? "";
  switch (form) {
    case "flag": case "area": return label.split(":")[0];
    case "choice": case "word": return `${label}: ${choices.find(([name]) => name === value)?.[1] ?? value}`;
    case "names": return `${label}: ${value.join(", ")}`;
    case "corridor": return `${label} ${[value].flat().join(" to ")}`;
    default: return `${label} ${value}${of}`;
  }
}

export class Chips {
  /** panel: the fields of the task; regions: what is met of the limits. */
  constructor(store, answers, panel, regions) {
    this.store = store;
    this.answers = answers;
    this.panel = panel;
    this.regions = regions;
    this.open = null; // the key of the chip whose editor is shown
    this.isWhole = false; // whether all are shown
    this.list = h("ul", { class: "bs-chip-list", "aria-label": "Asked and assumed" });
    this.editor = h("div", { class: "bs-chip-editor", hidden: true });
    this.advice = h("div", { class: "bs-advice" });
    this.element = h("section", { class: "bs-chips", "aria-label": "What is asked and assumed" }, this.list, this.editor, this.advice);
    this.list.addEventListener("keydown", (event) => event.key === "Escape" && this.edit(null));
    store.on("document solved chosen", () => this.draw());
    panel.onjudged = () => this.draw();
    this.draw();
  }

  // What there is

  /** Every chip: { key, text, met, assumed, remove, field }; met: null where it is not known. */
  chips() {
    const { store, panel: { form } } = this, { document, options } = store, unit = document.length_unit;
    const requirements = form.requirements.filter(({ key }) => document.requirements?.[key] !== undefined).map((each) => {
      const value = document.requirements[each.key];
      const set = (next) => store.edit((now) => setRequirement(now, each.key, next));
      return { key: each.key, text: textOf(each, value, unit), met: this.meets(each.of), remove: () => set(undefined), edit: () => this.field(each, value, set) };
    });
    const limits = limitsOf(document).flatMap((table, k) => Object.keys(table).filter((key) => [...PIVOTS, "length", "kinds", "rail", "slot"].includes(key)).map((key) => this.limit(table, k, key)));
    const regions = regionsOf(document).map((region, k) => ({
      key: `region ${k}`, text: `keep out of ${region.name || `region ${k + 1}`}`, met: this.regions.touched ? !this.regions.touched[k] : null,
      remove: () => this.regions.removeRegion(k), edit: () => [this.show("region", k)],
    }));
    const how = form.options.filter(({ key }) => options[key] !== undefined).map((each) => {
      const set = (next) => store.option(each.key, next);
      return { key: `option ${each.key}`, text: textOf(each, options[each.key], unit), met: null, remove: () => set(undefined), edit: () => this.field(each, options[each.key], set) };
    });
    return [...requirements, ...limits, ...regions, ...how, ...this.assumed()];
  }

  limit(table, k, key) {
    const { store } = this, said = this.regions.said(k, key), range = ({ least, most }) => `${least === undefined ? "" : `from ${least} `}${most === undefined ? "" : `to ${most}`}`;
    const both = limitsOf(store.document).length < 2 ? "" : ` (dyad ${k + 1})`;
    const { direction_deg: angle, ...rest } = table[key];
    const text = key === "rail" || key === "slot" ? `${key}${angle === undefined ? "" : ` at ${angle}°`}${rest.through || rest.travel ? " as drawn" : ""}${both}` : key === "length" ? `link length ${range(table.length)}${both}` : key === "kinds" ? `kinds ${table.kinds.join(", ")}${both}` : `${limitName(store.document, { table: k, key })}: ${Object.keys(table[key])[0]}`;
    return { key: `limit ${k} ${key}`, text, met: said && !said.length, remove: () => store.edit((now) => setLimit(now, k, { [key]: undefined })), edit: () => [this.show("limit", key, k)] };
  }

  /** What the search assumed where the task says nothing; stated, it can be changed like all that is asked. */
  assumed() {
    const { store, panel: { form } } = this;
    if (this.answers.isOld) return this.before ?? [];
    this.before = store.advice.flatMap(({ assumed }) => assumed).map(({ part, key, value, words }) => {
      const spec = part === "requirements" && form.requirements.find((each) => each.key === key);
      const state = (next) => store.edit((document) => (part === "limits" ? setLimit(document, 0, { [key]: next }) : setRequirement(document, key, next)));
      const edit = spec ? () => this.field(spec, value, state) : part === "limits" && value ? () => [button("Make it a limit to drag", () => (state(value), this.select(key)), { "data-do": `state-${key}` })] : null;
      return { key: `assumed ${key}`, text: words, met: null, assumed: true, edit };
    });
    return this.before;
  }

  /** Whether the chosen linkage keeps a kind of requirement; null where only the whole search knows. */
  meets(kind) {
    const linkage = this.answers.shown;
    if (!linkage || linkage.followed || linkage.gone || this.answers.isOld || !linkage.unmet) return null;
    return !linkage.unmet.some((each) => each.kind === kind);
  }

  // Changing one

  /** A field with a value, as the panel of the task has it. */
  field(spec, value, set) {
    const { element, show } = this.panel.field(spec, set);
    show(value);
    return [element];
  }

  select(key, k = 0) {
    const { store } = this;
    store.select({ kind: "limit", index: limitRegions(store.document).findIndex((each) => each.table === k && each.key === key) });
  }

  show(kind, which, k = 0) {
    if (kind === "limit" && !PIVOTS.includes(which)) return h("p", { class: "bs-hint" }, "Its fields are under “Limits of pivots, links and rails”.");
    return button("Show it in the plane", () => (kind === "limit" ? this.select(which, k) : this.store.select({ kind, index: which })));
  }

  edit(key) {
    this.open = key === this.open ? null : key;
    this.draw();
    this.editor.querySelector("input, select, button")?.focus();
  }

  // Drawing

  draw() {
    const all = this.chips(), key = JSON.stringify([all.map(({ key: name, text, met, edit }) => [name, text, met, Boolean(edit)]), this.open, this.isWhole]);
    if (key !== this.drawn) {
      const { activeElement } = this.list.getRootNode(), had = this.list.contains(activeElement) ? activeElement.dataset.chip : null;
      this.drawn = key;
      const first = all.find(({ assumed }) => assumed), isShort = this.isWhole || all.length <= FEW + 1;
      const shown = isShort ? all : all.filter((each, k) => k < FEW || each.assumed || each.met === false || each.key === this.open), more = all.length - shown.length;
      const rest = more ? [h("li", { class: "bs-chip" }, h("button", { type: "button", "data-do": "all-chips", onclick: () => this.showAll() }, `and ${more} more`))] : [];
      this.list.replaceChildren(...shown.filter(({ assumed }) => !assumed).map((each) => this.chip(each)), ...rest, ...shown.filter(({ assumed }) => assumed).flatMap((each) => [...(each === first ? [h("li", { class: "bs-chips-of" }, "Assumed:")] : []), this.chip(each)]));
      if (had) /** @type {HTMLElement} */ (this.list.querySelector(`[data-chip="${had}"]`))?.focus();
      const opened = all.find((each) => each.key === this.open);
      if (!opened?.edit) this.open = null;
      if (this.editor.dataset.of !== this.open) this.editor.replaceChildren(...(this.open ? [opened.edit()].flat() : []));
      put(this.editor, "data-of", this.open ?? "");
      give(this.editor, "hidden", !this.open);
    }
    this.drawAdvice();
  }

  showAll() {
    this.isWhole = true;
    this.draw();
    /** @type {any} */ (this.list.children[FEW])?.firstElementChild.focus();
  }

  chip({ key, text, met, assumed = false, remove, edit }) {
    const mark = met === null ? "" : met ? "✓ " : "✕ ", said = `${mark}${text}`, spoken = assumed ? { "aria-label": `assumed: ${text}` } : {};
    const state = assumed ? "bs-assumed" : met === null ? "" : met ? "bs-met" : "bs-broken";
    return h("li", { class: `bs-chip ${state}` },
      edit ? h("button", { type: "button", "data-chip": key, "aria-expanded": String(this.open === key), title: "Change it", ...spoken, onclick: () => this.edit(key) }, said) : h("span", { "data-chip": key }, said),
      remove ? h("button", { type: "button", class: "bs-chip-remove", "aria-label": `Do not ask: ${text}`, title: "Do not ask for it", onclick: remove }, "✕") : null);
  }

  /** What the search says of its answer, but for what stands elsewhere on the page. */
  drawAdvice() {
    const { store } = this, isOld = this.answers.isOld;
    this.advice.classList.toggle("bs-stale", isOld);
    if (isOld || store.advice === this.advised) return;
    this.advised = store.advice;
    const [outcome, ...warnings] = store.advice, isUsable = store.solved.linkages.some((each) => each.usable);
    const buttons = ({ cures }) => (cures.length ? h("div", { class: "bs-row" }, cures.map((group) => button(capital(group.map((each) => each.words).join(" and ")), () => this.cure(group), { "data-cure": group.map((each) => each.key).join(" ") }))) : null);
    this.advice.replaceChildren(
      ...proved(store.solved),
      ...(outcome && !isUsable ? [buttons(outcome)].filter(Boolean) : []), // its words stand over the list of linkages
      ...warnings.filter(({ code }) => !SPOKEN.includes(code)).map((each) =>
        h("details", { class: "bs-advised", "data-advice": each.code }, h("summary", {}, capital(each.message)),
          each.why ? h("p", { class: "bs-why" }, `Why: ${each.why}.`) : null, each.help ? h("p", { class: "bs-help" }, `What helps: ${each.help}.`) : null, buttons(each))));
  }

  /** Do what an advice says: all that belongs together is one entry of the history. */
  cure(group) {
    const { store } = this, gesture = {}, seen = new Map();
    for (const { part, key, value } of group) {
      const k = seen.get(key) ?? 0;
      seen.set(key, k + 1);
      if (part === "options") store.option(key, value);
      else if (part === "time_limit") store.solve(value);
      else store.edit((document) => stated(document, part, key, value, k), { gesture });
    }
  }
}

/** What is proved, to unfold; nothing where no proof was asked for. */
function proved(solved) {
  const parts = provedOf(solved);
  return parts.length ? [h("details", { class: "bs-advised", "data-proved": "" }, h("summary", {}, solved.certificate.proved.length ? "What is proved" : "Nothing is proved"), parts)] : [];
}

/** A document that says what a cure proposes; k: the table of limits that it is for. */
function stated(document, part, key, value, k) {
  if (part === "requirements") return setRequirement(document, key, value);
  if (part === "tolerances") return ["x", "y"].reduce((now, axis, at) => setUsual(now, axis, value[at]), document);
  const [least, most] = key === "length" ? value : [];
  return setLimit(document, k, { [key]: key === "length" ? { ...(least ? { least } : {}), ...(most === null ? {} : { most }) } : value ?? undefined });
}

const capital = (text) => `${text[0].toUpperCase()}${text.slice(1)}`;
