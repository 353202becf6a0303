// Fields of the task: a number with its unit, a text, a choice.  What cannot be read stays in its field, with the
// sentence that says so under it, and never enters the task.

import { give, h, put, say } from "../widget/dom.mjs";
import { quantity, written } from "./quantities.mjs";

let made = 0; // ids of fields and their sentences are unique on the page

/** A field for a number.
 *
 * label: its name for a screen reader; options: as `quantity` takes them, as a function, for the task's unit may change;
 * commit: called with the value where it is new; a sentence that it returns says why it is not taken.
 * step: how far the arrow keys go, a function.
 */
export class NumberField {
  constructor({ label, options, commit, step = () => 1, attributes = {} }) {
    made += 1;
    this.options = options;
    this.commit = commit;
    this.value = undefined;
    this.drafts = new Map(); // texts that could not be read, by what they are of
    this.fault = h("p", { class: "bs-fault", id: `bs-fault-${made}`, hidden: true });
    this.input = h("input", {
      class: "bs-number", type: "text", inputmode: "text", autocomplete: "off", spellcheck: "false", "aria-label": label, ...attributes,
      onchange: () => this.read(),
      oninput: () => this.fault.hidden || this.read(),
      onkeydown: (event) => this.nudge(event, step()),
    });
    this.element = h("span", { class: "bs-field" }, this.input, this.fault);
  }

  /** Show a value of the task; text that could not be read stays. */
  show(value) {
    const changed = value !== this.value;
    this.value = value;
    if (changed || this.fault.hidden) {
      const text = written(value);
      if (this.input.value !== text && !(this.isEdited && !changed)) this.input.value = text;
      if (changed) this.say(null);
    }
  }

  /** Show the value of another thing; what could not be read waits for its own thing to come back. */
  turnTo(id, value) {
    if (id === this.id) return;
    if (this.fault.hidden) this.drafts.delete(this.id);
    else this.drafts.set(this.id, this.input.value);
    const draft = this.drafts.get(id);
    this.id = id;
    this.value = value;
    give(this.input, "value", draft ?? written(value));
    this.say(draft === undefined ? null : quantity(draft, this.options()).fault ?? null);
  }

  get isEdited() {
    return document.activeElement === this.input && this.input.value !== written(this.value);
  }

  read() {
    const { value, fault } = quantity(this.input.value, this.options());
    this.say(fault ?? null);
    if (fault) return;
    const isNew = value !== this.value, before = this.value;
    this.value = value;
    const refused = isNew ? this.commit(value) : null;
    if (typeof refused === "string") {
      this.value = before; // the text stays, and waits for what it lacks
      this.say(refused);
    } else {
      this.input.value = written(this.value);
    }
  }

  /** The number that is typed, whether it was taken or not. */
  get typed() {
    return quantity(this.input.value, this.options()).value;
  }

  /** The arrow keys: a step, ten with Shift, a tenth with Alt. */
  nudge(event, step) {
    if (event.key === "Enter") this.read();
    const sense = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (!sense || event.ctrlKey || event.metaKey) return;
    const { value, fault } = quantity(this.input.value, this.options());
    if (fault || typeof value !== "number") return;
    event.preventDefault();
    this.input.value = written(stepped(value, sense * stepOf(event, step)));
    this.read();
  }

  say(sentence) {
    give(this.fault, "hidden", sentence === null);
    say(this.fault, sentence ?? "");
    if (sentence === null) {
      this.input.removeAttribute("aria-invalid");
      this.input.removeAttribute("aria-describedby");
    } else {
      put(this.input, "aria-invalid", "true");
      put(this.input, "aria-describedby", this.fault.id);
    }
  }
}

/** Two fields whose numbers are one value: `both` makes it of them, or says in a sentence what it lacks. */
export class PairField {
  /** @param {{ labels: string[], options: () => object, commit: (value: any) => void, both?: (one: any, other: any) => any, step?: () => number, attributes?: object[] }} what */
  constructor({ labels, options, commit, both = pointOf, step, attributes = [] }) {
    const read = () => {
      const value = both(this.fields[0].typed, this.fields[1].typed);
      return typeof value === "string" ? value : commit(value);
    };
    this.fields = labels.map((label, k) => new NumberField({ label, options: () => ({ ...options(), optional: true }), commit: read, step, attributes: attributes[k] }));
    this.element = h("span", { class: "bs-pair" }, this.fields.map((field) => field.element));
  }

  /** @param {any[] | undefined} values */
  show(values) {
    this.fields.forEach((field, k) => field.show(values?.[k]));
  }
}

/** Both numbers of a point, or neither. */
function pointOf(x, y) {
  if (x === undefined && y === undefined) return undefined;
  return x === undefined || y === undefined ? "Both numbers make the point: write the other one, too." : [x, y];
}

/** How far a key goes: a step, ten with Shift, a tenth with Alt. */
export const stepOf = (event, step) => step * (event.shiftKey ? 10 : event.altKey ? 0.1 : 1);

/** A value moved by a step, on the digits that both have. */
export const stepped = (value, by) => Number((value + by).toPrecision(12));

/** A label before what it names, in one line. */
export const labelled = (text, control, hint) =>
  h("label", { class: "bs-labelled" }, h("span", { class: "bs-label" }, text), control, hint ? h("span", { class: "bs-hint" }, hint) : null);

/** A field for a text. */
export function textField(label, commit, attributes = {}) {
  return h("input", { class: "bs-text", type: "text", autocomplete: "off", spellcheck: "false", "aria-label": label, ...attributes, onchange: (event) => commit(event.target.value) });
}

/** A box to tick. */
export function tick(text, commit, attributes = {}) {
  const box = h("input", { type: "checkbox", ...attributes, onchange: (event) => commit(event.target.checked) });
  return { box, element: h("label", { class: "bs-tick" }, box, " ", text) };
}

/** A choice among [value, text] pairs. */
export function choice(label, pairs, commit, attributes = {}) {
  return h(
    "select",
    { class: "bs-choice", "aria-label": label, ...attributes, onchange: (event) => commit(event.target.value) },
    pairs.map(([value, text]) => h("option", { value }, text)),
  );
}

export const button = (text, onclick, attributes = {}) => h("button", { type: "button", class: "bm-button", onclick, ...attributes }, text);
