// Functions of angles: an expression or pairs of angles, the linkages that make them, and the pairs dragged on the curves.

import { give, h, put, say } from "../widget/dom.mjs";
import { Report } from "../widget/report.mjs";
import { withKeys } from "./document.mjs";
import { NumberField, button, choice, labelled, textField, tick } from "./fields.mjs";
import { base64Of } from "./files.mjs";
import { History } from "./history.mjs";
import { written } from "./quantities.mjs";

const KEY = "burmester.studio.function"; // of what this tab keeps
const SOON = 250; // milliseconds of rest before linkages are looked for
const FIRST = { expression: "log10(x)", x: "1:2", input_deg: 60, output_deg: 60, pairs: 5 };
const PAIRS = [[0, 0], [20, 15], [40, 32], [60, 60]]; // where there is no answer whose pairs could be taken
const DIGITS = 4; // of the degrees of pairs that are taken from an expression
const BOUNDED = ["transmission", "link ratio"]; // what is asked of a function generator, beside its type
const TYPES = ["crank-rocker", "rocker-crank", "double-crank", "double-rocker", "triple-rocker", "change-point"];
const OF_EXPRESSION = ["expression", "x", "input_deg", "output_deg", "opposite", "spacing"];

/** A whole page over the studio's, with a history of its own: { task, links, side } as the server takes them. */
export class FunctionPage {
  /** @type {any} */ report;
  /** @type {any} */ fields;
  /** @type {any} */ judged;
  /** @type {any} */ ofExpression;
  /** @type {any} */ ofPairs;
  /** @type {any} */ types;
  /** @type {any} */ answer;
  /** @type {any} */ timer;

  /** files: who hands files over, with the store and the connection. */
  constructor(files) {
    this.files = files;
    this.server = files.server;
    this.name = "function";
    this.history = new History();
    this.state = kept() ?? { task: FIRST };
    this.status = h("p", { class: "bs-hint", role: "status" });
    this.fault = h("p", { class: "bs-fault", role: "alert", hidden: true });
    this.place = h("div", { class: "bs-function-report" });
    this.chooser = h("input", { type: "file", hidden: true, "data-file": "function", onchange: () => this.read({ file: this.chooser.files[0] }) });
    this.element = h("dialog", { class: "bs-function", "aria-label": "A function of an angle" }, this.head(), h("div", { class: "bs-function-main" }, h("div", { class: "bs-function-form" }, this.form()), this.place));
    this.element.addEventListener("keydown", (event) => this.key(event));
    this.element.addEventListener("paste", (event) => this.paste(event));
    this.place.addEventListener("pointerdown", (event) => this.grip(event), true);
    document.body.append(this.element);
  }

  /** Show the page; task: another one, as a task file has it. */
  open(task, name = this.name) {
    this.name = name;
    if (task) this.edit({ task, links: undefined });
    this.element.showModal();
    this.show();
    this.solve();
  }

  // The task

  edit(changes, gesture = /** @type {unknown} */ (null)) {
    this.history.record(this.state, gesture);
    this.take({ ...this.state, ...changes }, gesture !== null);
  }

  take(state, now = false) {
    if (!state) return;
    this.state = state;
    try {
      sessionStorage.setItem(KEY, JSON.stringify(state));
    } catch {
      // a tab that keeps nothing
    }
    if (!this.element.open) return;
    this.show();
    clearTimeout(this.timer);
    if (now) this.solve();
    else this.timer = setTimeout(() => this.solve(), SOON);
  }

  set(key, value) {
    this.edit({ task: withKeys(this.state.task, { [key]: value }) });
  }

  get document() {
    return { function: this.state.task };
  }

  /** What is judged in place of a search: a linkage that exists. */
  get options() {
    const { links, side } = this.state;
    return links ? { links, side } : {};
  }

  /** The pairs of the task; of an expression those that the last answer took from it. */
  get pairs() {
    const { task } = this.state;
    return Array.isArray(task.pairs) ? task.pairs : this.answer?.linkages[0]?.panels[0].dots.map((pair) => pair.map((each) => Number(each.toFixed(DIGITS)))) ?? PAIRS;
  }

  /** The task by pairs, which what is of the expression leaves. */
  byPairs(pairs) {
    return { ...withKeys(this.state.task, Object.fromEntries(OF_EXPRESSION.map((key) => [key, undefined]))), pairs };
  }

  // The form

  head() {
    const to = choice("Export", [], (value) => value && this.export(value), { "data-do": "export-function" });
    const formats = this.files.start.exports ?? [];
    to.replaceChildren(...[["", "Export…"], ["report", "Report .html"], ["result", "Result .json"], ...formats.map(({ format, title, suffix }) => [format, `${title} ${suffix}`])].map(([value, text]) => h("option", { value }, text)));
    this.exports = to;
    this.undo = button("↶", () => this.take(this.history.undo(this.state)), { "aria-label": "Undo", title: "Undo (Ctrl+Z)" });
    this.redo = button("↷", () => this.take(this.history.redo(this.state)), { "aria-label": "Redo", title: "Redo (Ctrl+Shift+Z)" });
    return h("header", { class: "bs-head" }, h("h2", {}, "A function of an angle"), this.undo, this.redo,
      button("Open…", () => this.chooser.click(), { "data-do": "open-function" }), button("Save task", () => this.save(), { "data-do": "save-function" }), to, this.chooser,
      button("Back to poses", () => this.element.close(), { "data-do": "close-function", class: "bm-button bs-function-close" }));
  }

  form() {
    const kinds = [["expression", "an expression in x"], ["pairs", "pairs of angles"]];
    this.kind = choice("The function is", kinds, (value) => this.edit({ task: value === "pairs" ? this.byPairs(this.pairs) : { ...this.state.task, ...FIRST } }), { "data-key": "kind" });
    this.fields = new Map();
    const number = (key, label, options, hint = "°") => {
      const field = new NumberField({ label, commit: (value) => this.set(key, value), options: () => options, attributes: { "data-key": key, placeholder: key === "pairs" ? "61" : options.optional ? "free" : "" } });
      this.fields.set(key, field);
      return labelled(label, field.element, hint);
    };
    const text = (key, label, attributes) => {
      const input = textField(label, (value) => this.set(key, value.trim()), { "data-key": key, ...attributes });
      this.fields.set(key, { show: (value) => document.activeElement !== input && give(input, "value", Array.isArray(value) ? value.map(written).join(":") : value ?? "") });
      return labelled(label, input);
    };
    const flag = (key, label) => {
      const { box, element } = tick(label, (on) => this.set(key, on || undefined), { "data-key": key });
      this.fields.set(key, { show: (value) => give(box, "checked", Boolean(value)) });
      return element;
    };
    const angle = { kind: "angle", above: 0 }, free = { kind: "angle", optional: true }, some = { kind: "number", optional: true, least: 3, whole: true };
    const spacing = choice("spaced", [["", "as is usual"], ["chebyshev", "as Chebyshev does"], ["even", "evenly"]], (value) => this.set("spacing", value || undefined), { "data-key": "spacing" });
    this.fields.set("spacing", { show: (value) => give(spacing, "value", value ?? "") });
    this.ofExpression = h("div", { class: "bs-grid" }, text("expression", "y =", { placeholder: "log10(x)" }), text("x", "x from:to", { placeholder: "1:2 or 0:pi/2" }),
      number("input_deg", "the input link turns by", angle), number("output_deg", "the output link turns by", angle), flag("opposite", "the output turns against the input"), number("pairs", "pairs taken from it", some, " "), labelled("spaced", spacing));
    this.cells = h("textarea", { class: "bs-text", rows: 8, spellcheck: "false", "aria-label": "Pairs of angles: input and output in degrees, and a weight if wanted", "data-key": "cells", onchange: () => this.read({ text: this.cells.value }) });
    this.ofPairs = h("div", {}, h("p", { class: "bs-hint" }, "Input and output in degrees, a pair a line; a weight may follow. Rows of a spreadsheet can be pasted. Drag a dot on a curve, and its pair follows."), this.cells);
    const types = TYPES.map((name) => ({ name, ...tick(name, () => this.set("types", ticked(types)), { "data-key": `type-${name}` }) }));
    this.types = types;
    const links = textField("lengths of ground, input, coupler, output", (value) => this.edit({ links: value.trim() || undefined }), { "data-key": "links", placeholder: "1, 2.2, 0.7, 2" });
    const side = choice("its output pin lies", [["", "on the better side"], ["left", "left"], ["right", "right"]], (value) => this.edit({ side: value || undefined }), { "data-key": "side" });
    this.judged = { links, side };
    const required = this.files.start.form.requirements.filter(({ of }) => BOUNDED.includes(of)).map(({ key, label, kind, least, below }) => number(key, label, { kind, optional: true, least, below }, kind === "angle" ? "°" : " "));
    const part = (title, ...content) => h("details", { class: "bs-section" }, h("summary", {}, title), h("div", { class: "bs-grid" }, content));
    return [
      labelled("the function is", this.kind), this.ofExpression, this.ofPairs, flag("minimax", "make the greatest error least"),
      part("What the linkage must be", required, h("details", {}, h("summary", {}, "types"), h("div", { class: "bs-ticks" }, types.map(({ element }) => element)), h("p", { class: "bs-hint" }, "None: any."))),
      part("Phases and size", number("input_phase_deg", "input link at input 0", free), number("output_phase_deg", "output link at output 0", free), number("ground", "ground link", { kind: "number", optional: true, above: 0 }, " ")),
      part("Judge a linkage that exists", labelled("ground, input, coupler, output", links), labelled("its output pin lies", side), h("p", { class: "bs-hint" }, "With lengths here, that linkage is judged, and no other looked for.")),
      this.status, this.fault,
    ];
  }

  show() {
    const { task, links, side } = this.state, isPairs = Array.isArray(task.pairs);
    give(this.kind, "value", isPairs ? "pairs" : "expression");
    give(this.ofExpression, "hidden", isPairs);
    give(this.ofPairs, "hidden", !isPairs);
    for (const [key, field] of this.fields) if (key !== "pairs" || !isPairs) field.show(task[key]);
    if (isPairs && document.activeElement !== this.cells) give(this.cells, "value", task.pairs.map((pair) => pair.map(written).join("  ")).join("\n"));
    for (const { name, box } of this.types) give(box, "checked", Boolean(task.types?.includes(name)));
    give(this.judged.links, "value", links ?? "");
    give(this.judged.side, "value", side ?? "");
    give(this.undo, "disabled", !this.history.canUndo);
    give(this.redo, "disabled", !this.history.canRedo);
  }

  // The server

  /** Look for linkages; one search at a time, and what changed meanwhile is looked for after it. */
  async solve() {
    clearTimeout(this.timer);
    if (this.busy) return void (this.again = true);
    this.busy = true;
    this.again = false;
    const { document, options } = this;
    say(this.status, "Looking …");
    let told;
    try {
      told = await this.server.ask({ do: "function", document, options });
    } catch {
      told = { kind: "ended", messages: [{ message: "the server does not answer", help: "once it does, change something here" }] };
    }
    this.busy = false;
    if (told.kind === "looked") this.draw(told, { document, options });
    else this.refuse(told.messages ?? [told]);
    if (this.again) await this.solve();
  }

  draw(answer, asked) {
    const { picked } = this, { scrollTop } = this.place;
    this.report?.close();
    this.answer = answer;
    this.asked = asked;
    this.refuse([]);
    this.report = new Report(answer, this.place, { webgl: false, still: Boolean(this.drag) });
    if (picked > 0 && picked < answer.linkages.length) this.report.choose(picked);
    this.place.scrollTop = scrollTop;
    put(this.place, "data-linkages", answer.linkages.length);
    this.place.classList.toggle("bs-draggable", !this.state.links);
  }

  /** Which linkage is looked at. */
  get picked() {
    return this.report ? this.report.linkages.indexOf(this.report.linkage) : 0;
  }

  refuse(messages) {
    say(this.status, "");
    give(this.fault, "hidden", !messages.length);
    say(this.fault, messages.map(({ message, why, help }) => [message, why, help].filter(Boolean).join(". ")).join(" "));
    this.place.classList.toggle("bs-stale", messages.length > 0);
  }

  /** Do what asks the server; what it refuses stands under the form. */
  async trying(then) {
    try {
      await then();
    } catch (error) {
      const { messages = [], message } = /** @type {any} */ (error);
      this.refuse(messages.length ? messages : [{ message }]);
    }
  }

  /** Read a file or rows as `burmester function` reads them; rows without a header are input and output. */
  read({ file = /** @type {any} */ (null), text = "" }) {
    return this.trying(async () => {
      const [first] = text.trim().split("\n"), mark = /[\t;,]/.exec(first)?.[0] ?? " ";
      const names = ["input_deg", "output_deg", "weight"].slice(0, first.trim().split(mark === " " ? /\s+/ : mark).length), bare = file || /[a-z]{2}/i.test(first);
      const rows = mark === " " ? text.trim().replace(/[ ]+/g, ",") : text.trim();
      const body = file ? { name: file.name, base64: await base64Of(file) } : { name: "pairs", text: bare ? text : `${names.join(mark === " " ? "," : mark)}\n${rows}` };
      this.chooser.value = "";
      const { document: found } = await (await this.server.post("/read", body)).json();
      if (!found.function) return this.refuse([{ message: "this is a task of poses", help: "open it on the page of poses" }]);
      if (file) this.name = file.name.replace(/\.[^.]*$/, "");
      return this.edit(file ? { task: found.function, links: undefined } : { task: this.byPairs(found.function.pairs) });
    });
  }

  paste(event) {
    const text = event.clipboardData?.getData("text/plain") ?? "";
    event.stopPropagation();
    if (!/\n\s*\S/.test(text.trim()) || event.target === this.cells) return;
    event.preventDefault();
    this.read({ text });
  }

  save() {
    return this.trying(async () => {
      const { document, name } = this;
      this.files.hand(await this.server.post("/task", { document, name }), `${name}.toml`);
    });
  }

  /** Write the linkage that is looked at, as the answer on the page has it. */
  export(value) {
    this.exports.value = "";
    return this.trying(async () => {
      if (!this.asked) return;
      const path = ["report", "result"].includes(value) ? value : "export", linkage = this.report?.linkage?.id ?? null;
      this.files.hand(await this.server.post(`/${path}`, { ...this.asked, kind: "function", name: this.name, format: value, linkage, settings: this.files.store.settings }), "function");
    });
  }

  // Hand and keys

  /** Take hold of a dot on a curve: the output of its pair follows the hand, up and down. */
  grip(event) {
    const dot = event.target.closest?.("[data-dot]");
    if (!dot || this.state.links) return;
    event.preventDefault();
    event.stopPropagation();
    const { dot: k, panel, ofPixel } = dot.dataset, pairs = this.pairs.map((pair) => [...pair]), y = event.clientY, gesture = {};
    const sense = panel === "0" ? -1 : 1; // the error is what is made less what is wanted
    const [, output] = pairs[k], digits = Math.max(0, 2 - Math.floor(Math.log10(Number(ofPixel))));
    this.drag = gesture;
    const move = ({ clientY }) => {
      const moved = Number((output + sense * (clientY - y) * Number(ofPixel)).toFixed(digits));
      this.edit({ task: this.byPairs(pairs.map((pair, i) => (i === Number(k) ? [pair[0], moved, ...pair.slice(2)] : pair))) }, gesture);
    };
    const end = () => {
      this.drag = null;
      removeEventListener("pointermove", move);
    };
    addEventListener("pointermove", move);
    addEventListener("pointerup", end, { once: true });
    addEventListener("pointercancel", end, { once: true });
  }

  /** Keys of this page are not those of the page below. */
  key(event) {
    event.stopPropagation();
    if (!(event.ctrlKey || event.metaKey) || event.target.closest("input[type=text], textarea")) return;
    const act = { z: () => this.take(event.shiftKey ? this.history.redo(this.state) : this.history.undo(this.state)), s: () => this.save(), o: () => this.chooser.click() }[event.key.toLowerCase()];
    if (!act) return;
    event.preventDefault();
    act();
  }
}

function ticked(ticks) {
  const list = ticks.filter(({ box }) => box.checked).map(({ name }) => name);
  return list.length ? list : undefined;
}

/** What this tab kept. */
function kept() {
  try {
    const state = JSON.parse(sessionStorage.getItem(KEY) ?? "null");
    return state?.task ? state : null;
  } catch {
    return null;
  }
}
