// What the linkage must be, in fields: limits of dyads, regions, requirements, options.

import { give, h, put, say } from "../widget/dom.mjs";
import { limitPart, limitsOf, regionsOf, setBody, setLimit, setRegion, setRequirement, setSurrounding, shapeOf, splitLimits, bodyOf, limitRegions, poseName, withKeys } from "./document.mjs";
import { NumberField, PairField, button, choice, labelled, textField, tick } from "./fields.mjs";
import { hasLoads } from "./loads.mjs";
import { PointFields } from "./point_fields.mjs";

const SHAPES = ["point", "line", "segment", "box", "polygon"];
/** @type {[string, string, string[]][]} */
const OF_LINE = [["through", "passes through", SHAPES.filter((shape) => shape !== "line")], ["travel", "the pin stays within", SHAPES.slice(1)]];
const SIGMA = [["position", "position", "length"], ["angle_deg", "angle", "angle"]];
const MOST_NAMES = 200; // poses that are offered to be drawn at
const UNITS = ["", "mm", "cm", "m", "in", "ft"];

const section = (name, title, open, ...content) => h("details", { class: "bs-section", "data-section": name, open }, h("summary", {}, title), ...content);

export class TaskPanel {
  /** @type {(() => void) | undefined} */ onjudged; // after limits were compared with the chosen linkage
  /** @type {any} */ madeTables;
  /** @type {any} */ regionRows;
  /** @type {any} */ linkWidth;
  /** @type {any} */ margin;
  /** @type {any} */ inPlane;
  /** @type {any} */ bodyNumbers;
  /** @type {any} */ asks;
  /** @type {any} */ options;
  /** @type {any} */ tables;
  /** @type {any} */ apart;
  /** @type {any} */ regionList;
  /** @type {any} */ sigma;

  /** form: what can be asked, as the start of the page says. */
  constructor(store, scene, regions, body, files, form) {
    this.store = store;
    this.scene = scene;
    this.regions = regions;
    this.body = body;
    this.files = files;
    this.form = form;
    this.element = h("div", { class: "bs-task" });
    this.element.append(this.makeRequirements(), this.makeLimits(), this.makeRegions(), this.makeBody(), this.makeSigma(), ...this.makeOptions());
    store.on("document selection reference", () => this.draw());
    regions.onjudged = () => {
      this.drawVerdicts();
      this.onjudged?.();
    };
    this.draw();
  }

  edit(change) {
    this.store.edit(change);
  }

  length(label, commit, options = {}, attributes = {}) {
    return new NumberField({ label, commit, options: () => ({ kind: "length", unit: this.store.document.length_unit, optional: true, ...options }), step: () => this.scene.step, attributes });
  }

  /** Buttons that draw a shape; the one in use is pressed. */
  tools(label, shapes, toolOf, data) {
    return h("div", { class: "bs-tools", role: "group", "aria-label": label }, shapes.map((shape) => this.toolButton(shape, () => toolOf(shape), { "data-draw": `${data} ${shape}` })));
  }

  toolButton(text, toolOf, attributes) {
    const made = button(text, () => this.scene.use(made.tool && made.tool === this.scene.tool ? null : (made.tool = toolOf())), { "aria-pressed": "false", ...attributes });
    this.scene.on("tool", (tool) => put(made, "aria-pressed", Boolean(tool) && tool === made.tool));
    return made;
  }

  /** Fields for the points of a shape; set(change) changes them. */
  points(name, set) {
    return new PointFields({ name, set, options: () => ({ kind: "length", unit: this.store.document.length_unit }), step: () => this.scene.step });
  }

  // Limits

  makeLimits() {
    this.apart = tick("another limit for each of the two dyads", (on) => this.edit((document) => splitLimits(document, on)), { "data-key": "limits-apart" });
    this.tables = h("div", {});
    this.madeTables = [];
    return section("limits", "Limits of pivots, links and rails", false, this.apart.element, this.tables, h("p", { class: "bs-hint" }, "A rail or a slot given once is for one of the two dyads."));
  }

  limitsOf(form) {
    return this.form.limits.filter((each) => each.form === form);
  }

  makeTable(k) {
    const { store, regions } = this, edit = (changes) => this.edit((document) => setLimit(document, k, changes));
    const title = h("h3", {}), parts = {}, angles = [];
    const part = (key, name, shapes = SHAPES) => {
      const state = h("p", { class: "bs-state" });
      const numbers = this.points(`the limit of the ${key.replace("_", " ")}`, (change) => this.edit((document) => withPoints(document, k, key, change)));
      const remove = button("Delete", () => regions.removeLimit(k, key), { "data-do": `delete-limit-${k}-${key}`, "aria-label": `Delete the limit: ${name}` });
      parts[key] = { state, numbers, remove };
      parts[key].element = h("div", { class: "bs-limit-box" }, h("h4", {}, name), this.tools(`Draw a limit: ${name}`, shapes, (shape) => regions.limitTool(k, key, shape), `limit ${k} ${key}`), numbers.element, state, remove);
      return parts[key].element;
    };
    const pivots = this.limitsOf("region").map(({ key, label }) => part(key, label));
    const lines = this.limitsOf("line").map(({ key, label }) => {
      const angle = (name, words, options) => {
        const field = new NumberField({ label: `${label}: ${words}`, commit: (value) => edit({ [`${key} ${name}`]: value }), options: () => ({ kind: "angle", optional: true, ...options }), attributes: { "data-key": `${key}-${k}-${name}`, placeholder: "–" } });
        angles.push({ key: `${key} ${name}`, field });
        return labelled(words, field.element, "°");
      };
      return h("details", { "data-line": `${key}-${k}` }, h("summary", {}, label), h("div", { class: "bs-row" }, angle("direction_deg", "direction"), angle("tolerance_deg", "±", { least: 0, below: 90 })),
        OF_LINE.map(([name, words, shapes]) => part(`${key} ${name}`, words, shapes)));
    });
    const least = this.length("least length", (value) => edit({ length: range(value, limitsOf(store.document)[k]?.length?.most) }), { least: 0 }, { "data-key": `least-${k}`, placeholder: "any" });
    const most = this.length("greatest length", (value) => edit({ length: range(limitsOf(store.document)[k]?.length?.least, value) }), { least: 0 }, { "data-key": `most-${k}`, placeholder: "any" });
    const [{ label, choices }] = this.limitsOf("kinds");
    const kinds = choices.map(([kind, text]) => ({ kind, ...tick(`${kind}: ${text}`, () => edit({ kinds: kindsOf(kinds) }), { "data-key": `kind-${k}-${kind}` }) }));
    const lengthState = h("p", { class: "bs-state" }), kindsState = h("p", { class: "bs-state" });
    const element = h("div", { class: "bs-limit-table" }, title, pivots,
      h("div", { class: "bs-row" }, labelled("length from", least.element), labelled("to", most.element)), lengthState,
      h("div", { class: "bs-row", role: "group", "aria-label": label }, kinds.map((each) => each.element)), kindsState, lines);
    return { element, title, parts, angles, least, most, kinds, lengthState, kindsState };
  }

  drawLimits() {
    const { document } = this.store, tables = limitsOf(document), count = Math.max(1, tables.length);
    give(this.apart.box, "checked", tables.length > 1);
    while (this.madeTables.length < count) this.madeTables.push(this.makeTable(this.madeTables.length));
    while (this.tables.children.length > count) this.tables.lastChild.remove();
    while (this.tables.children.length < count) this.tables.append(this.madeTables[this.tables.children.length].element);
    for (let k = 0; k < count; k += 1) {
      const table = tables[k] ?? {}, made = this.madeTables[k];
      say(made.title, count > 1 ? `Dyad ${k + 1}` : "Both dyads");
      for (const key of Object.keys(made.parts)) this.drawLimit(made.parts[key], limitPart(table, key));
      for (const { key, field } of made.angles) field.show(limitPart(table, key));
      made.least.show(table.length?.least);
      made.most.show(table.length?.most);
      for (const { kind, box } of made.kinds) box.checked = !table.kinds || table.kinds.includes(kind);
    }
  }

  drawLimit({ numbers, remove }, region) {
    for (const each of [remove, numbers.element]) give(each, "hidden", !region);
    if (!region) return;
    const [[shape, stated]] = Object.entries(region);
    numbers.show(shape, shape === "point" ? [stated] : stated);
  }

  drawVerdicts() {
    const { regions } = this, tables = limitsOf(this.store.document);
    this.madeTables.forEach((made, k) => {
      for (const key of Object.keys(made.parts)) tell(made.parts[key].state, tables[k] && limitPart(tables[k], key) ? regions.said(k, key) : null);
      tell(made.lengthState, tables[k]?.length ? regions.said(k, "length") : null);
      tell(made.kindsState, tables[k]?.kinds ? regions.said(k, "kinds") : null);
    });
    this.regionRows.forEach((row, k) => tell(row.state, regions.touched ? [regions.touched[k]].filter(Boolean) : null));
  }

  // Regions to keep out of

  makeRegions() {
    this.regionList = h("div", {});
    this.regionRows = [];
    this.linkWidth = this.length("width of the links", (value) => this.edit((document) => setSurrounding(document, "link_width", value)), { least: 0 }, { "data-key": "link_width", placeholder: "0" });
    this.margin = this.length("least clearance", (value) => this.edit((document) => setSurrounding(document, "margin", value)), { least: 0 }, { "data-key": "margin", placeholder: "0" });
    this.inPlane = tick("links that stand on the ground must not touch the body either", (on) => this.edit((document) => setSurrounding(document, "body_in_plane", on || undefined)), { "data-key": "body_in_plane" });
    return section("keep-out", "Regions to keep out of", false,
      h("p", { class: "bs-hint" }, "The body and the links must not touch them between the poses."),
      this.tools("Draw a region to keep out of", ["box", "polygon"], (shape) => this.regions.regionTool(shape), "region"), this.regionList,
      h("div", { class: "bs-row" }, labelled("links are wide", this.linkWidth.element), labelled("least clearance", this.margin.element)), this.inPlane.element);
  }

  drawRegions() {
    const { store } = this, regions = regionsOf(store.document);
    while (this.regionRows.length < regions.length) {
      this.regionRows.push(this.regionRow(this.regionRows.length));
      this.regionList.append(this.regionRows.at(-1).element);
    }
    for (const row of this.regionRows.splice(regions.length)) row.element.remove();
    this.regionRows.forEach((row, k) => row.show(regions[k], store.selection?.kind === "region" && store.selection.index === k));
    const { link_width, margin, body_in_plane } = store.document.surroundings ?? {};
    this.linkWidth.show(link_width);
    this.margin.show(margin);
    give(this.inPlane.box, "checked", Boolean(body_in_plane));
  }

  regionRow(k) {
    const { store } = this, shapeKey = (region) => (region.box ? "box" : "polygon");
    const name = textField(`Name of region ${k + 1}`, (text) => this.edit((document) => setRegion(document, k, { name: text.trim() || undefined })), { "data-key": `region-name-${k}`, placeholder: `region ${k + 1}` });
    const numbers = this.points(`region ${k + 1}`, (change) =>
      this.edit((document) => {
        const region = regionsOf(document)[k], key = shapeKey(region);
        return setRegion(document, k, { [key]: change(region[key]) });
      }));
    const state = h("p", { class: "bs-state" }), inNumbers = h("details", {}, h("summary", {}, "in numbers"), numbers.element), file = h("p", { class: "bs-hint" });
    const element = h("div", { class: "bs-limit-box", "data-region-row": k, onfocusin: () => store.select({ kind: "region", index: k }) },
      h("div", { class: "bs-row" }, name, button("Delete", () => this.regions.removeRegion(k), { "data-do": `delete-region-${k}`, "aria-label": `Delete region ${k + 1}` })), state, inNumbers, file);
    const show = (region, selected) => {
      const text = (region.name ?? "").replace(/[\r\n]+/g, " ");
      if (document.activeElement !== name && name.value !== text) name.value = text;
      element.classList.toggle("bs-selected", selected);
      give(inNumbers, "hidden", region.file !== undefined);
      give(file, "hidden", !inNumbers.hidden);
      if (inNumbers.hidden) file.textContent = `from the drawing ${region.file}`;
      else numbers.show(shapeKey(region), region[shapeKey(region)]);
    };
    return { element, state, show };
  }

  // The body

  makeBody() {
    this.bodyNumbers = this.points("the outline", (change) => this.edit((document) => setBody(document, change(bodyOf(document)))));
    this.bodyCount = h("summary", {});
    this.bodyBox = h("details", {}, this.bodyCount, this.bodyNumbers.element);
    this.reference = choice("Draw at", [], (value) => this.store.setReference(Number(value)), { "data-key": "reference" });
    this.noBody = button("Delete the outline", () => this.edit((document) => setBody(document, [])), { "data-do": "delete-body" });
    return section("body", "Outline of the body", false,
      h("p", { class: "bs-hint" }, "It is seen at every pose, moves with the linkage, and says what an angle error counts as."),
      labelled("draw what belongs to the body at pose", this.reference),
      h("div", { class: "bs-tools" }, this.toolButton("Draw it", () => this.body.tool(), { "data-draw": "body" }), button("From a drawing (SVG, DXF)…", () => this.files.chooseOutline(), { "data-do": "outline-file" }), this.noBody),
      this.bodyBox);
  }

  drawBody() {
    const { document: task, referenceIndex } = this.store, corners = bodyOf(task), names = task.poses.slice(0, MOST_NAMES).map((_, k) => poseName(task, k));
    if (names.join("\n") !== this.poseNames) this.reference.replaceChildren(...names.map((name, k) => h("option", { value: k }, name)));
    this.poseNames = names.join("\n");
    this.reference.value = String(referenceIndex);
    give(this.noBody, "hidden", !task.body);
    give(this.bodyBox, "hidden", !corners.length);
    if (!corners.length) return;
    say(this.bodyCount, `${corners.length} corners, in numbers`);
    this.bodyNumbers.show("polygon", corners);
  }

  // Requirements and options

  makeRequirements() {
    this.asks = this.form.requirements.map((each) => ({ ...each, ...this.field(each, (value) => this.edit((document) => setRequirement(document, each.key, value))) }));
    const of = (...forms) => this.asks.filter(({ form }) => forms.includes(form)).map(({ element }) => element);
    return section("requirements", "What the linkage must be", true, h("div", { class: "bs-grid" }, of("number", "corridor"), of("choice")), of("flag"), of("area"), of("names"));
  }

  /** The element of a field, and how it shows a value: { element, show }. */
  field({ key, label, form, choices, ...bounds }, set) {
    const attributes = { "data-key": key };
    switch (form) {
      case "choice": case "word": {
        const [[usual]] = choices, element = choice(label, choices, (value) => set(value === usual ? undefined : value), attributes);
        return { element: labelled(label, element), show: (value) => (element.value = value ?? usual) };
      }
      case "flag": {
        const { box, element } = tick(label, (on) => set(on || undefined), attributes);
        return { element, show: (value) => give(box, "checked", Boolean(value)) };
      }
      case "names": {
        const ticks = choices.map(([name, text]) => ({ name, ...tick(text, () => set(some(ticks)), { "data-key": `${key}-${name}` }) }));
        const element = h("details", {}, h("summary", {}, label), h("div", { class: "bs-ticks" }, ticks.map((each) => each.element)), h("p", { class: "bs-hint" }, "None: any."));
        return { element, show: (value) => ticks.forEach(({ name, box }) => (box.checked = Boolean(value?.includes(name)))) };
      }
      case "corridor": { // a greatest magnitude, or with a least value both with their signs
        const sides = ["least", "greatest"], both = (least, greatest) => (least === undefined ? greatest : greatest === undefined ? "Write the greatest as well: a least alone bounds nothing." : [least, greatest]);
        const pair = new PairField({ labels: sides.map((side) => `${label}, ${side}`), options: () => ({ kind: "number" }), both, commit: set, attributes: sides.map((side) => ({ "data-key": `${key}-${side}`, placeholder: "–" })) });
        return { element: labelled(label, pair.element, " "), show: (value) => pair.show(Array.isArray(value) ? value : [undefined, value]) };
      }
      case "area": {
        const none = button("Delete", () => set(undefined), { "data-do": `delete-${key}`, "aria-label": `Delete the ${key}` });
        const element = h("div", { class: "bs-limit-box" }, h("h4", {}, label), this.tools(`Draw the ${key}`, ["box", "polygon"], (shape) => this.regions.footprintTool(shape), key), none);
        return { element, show: (value) => give(none, "hidden", !value) };
      }
      default: {
        const options = form === "length" || form === "lengths" ? { kind: "length", above: 0, many: form === "lengths" } : bounds;
        const field = new NumberField({ label, commit: set, options: () => ({ optional: true, unit: this.store.document.length_unit, ...options }), step: () => (form === "length" ? this.scene.step : 1), attributes: { ...attributes, placeholder: options.many ? "40, 50, 60" : "–" } });
        return { element: labelled(label, field.element, options.kind === "angle" ? "°" : " "), show: (value) => field.show(value) };
      }
    }
  }

  drawRequirements() {
    const { requirements } = this.store.document, loaded = hasLoads(this.store.document);
    for (const { key, show, element, loads: ofLoads } of this.asks) {
      show(requirements?.[key]);
      give(element, "hidden", Boolean(ofLoads) && !loaded && requirements?.[key] === undefined);
    }
  }

  makeOptions() {
    const { store } = this;
    this.unit = choice("unit of length", UNITS.map((unit) => [unit, unit || "not stated"]), (value) => this.edit((document) => withKeys(document, { length_unit: value || undefined })), { "data-key": "length_unit" });
    this.options = this.form.options.map((each) => ({ ...each, ...this.field(each, (value) => store.option(each.key, value)) }));
    const of = (made, ...forms) => this.options.filter((each) => each.made === made && forms.includes(each.form)).map(({ element }) => element);
    return [
      section("made", "How it is made", false, h("p", { class: "bs-hint" }, "Every linkage is rounded, or made of links in stock, and judged again: its card says what that costs."),
        h("div", { class: "bs-grid" }, of(true, "length", "lengths"))),
      section("options", "Unit and method", false, h("div", { class: "bs-grid" }, labelled("unit of length", this.unit), of(false, "word"), of(false, "length")),
        h("div", { class: "bs-ticks" }, of(false, "flag")), h("p", { class: "bs-hint" }, "Another unit leaves the numbers as they are.")),
    ];
  }

  drawOptions() {
    const { document, options } = this.store, unit = document.length_unit ?? "";
    if (![...this.unit.options].some((each) => each.value === unit)) this.unit.append(h("option", { value: unit }, unit));
    this.unit.value = unit;
    for (const { key, show } of this.options) show(options[key]);
  }

  // How well the poses are known

  /** The standard deviations of the poses: both or none. */
  makeSigma() {
    const { store, scene } = this;
    this.wanted = {};
    this.lack = h("p", { class: "bs-fault", hidden: true }, "Give both: how far positions are off, and how far angles.");
    this.sigma = SIGMA.map(([key, name, kind]) => {
      const field = new NumberField({
        label: `standard deviation of the ${name}`, options: () => ({ kind, unit: store.document.length_unit, optional: true, above: 0 }), step: () => (kind === "angle" ? 0.1 : scene.step / 10),
        commit: (value) => this.setSigma(key, value), attributes: { "data-key": `sigma-${key}`, placeholder: "–" },
      });
      return { key, name, field };
    });
    return section("sigma", "How well the poses are known", false,
      h("p", { class: "bs-hint" }, "Standard deviations of what was measured. Left empty: as well as their digits say."),
      h("div", { class: "bs-grid" }, this.sigma.map(({ name, field }) => labelled(`${name} ±`, field.element, name === "angle" ? "°" : " "))), this.lack);
  }

  setSigma(key, value) {
    this.wanted = withKeys({ ...this.store.document.pose_sigma, ...this.wanted }, { [key]: value });
    const given = Object.keys(this.wanted).length;
    give(this.lack, "hidden", given !== 1);
    if (given === 1) return; // the other one is still to come
    const pose_sigma = given ? this.wanted : undefined;
    this.wanted = {};
    this.store.edit((document) => withKeys(document, { pose_sigma }));
  }

  drawSigma() {
    const { pose_sigma } = this.store.document;
    this.wanted = {};
    give(this.lack, "hidden", true);
    for (const { key, field } of this.sigma) field.show(pose_sigma?.[key]);
  }

  /** While poses are dragged nothing here is another. */
  draw() {
    const { document, options, selection, reference } = this.store, { limits, keep_out, surroundings, body, requirements, length_unit, pose_sigma, poses } = document;
    const now = [limits, keep_out, surroundings, body, requirements, length_unit, pose_sigma, hasLoads(document), options, selection, reference, poses.length];
    if (now.every((each, k) => each === this.drawn?.[k]) && this.drawn) return;
    if (!this.drawn || pose_sigma !== this.drawn[6]) this.drawSigma(); // a half that was typed stays
    this.drawn = now;
    this.drawLimits();
    this.drawRegions();
    this.drawBody();
    this.drawRequirements();
    this.drawOptions();
    this.drawVerdicts();
  }
}

/** Whether a condition is met: a sign, and sentences where it is not. */
function tell(element, sentences) {
  give(element, "hidden", sentences === null);
  if (sentences === null) return;
  put(element, "class", `bs-state ${sentences.length ? "bs-broken" : "bs-met"}`);
  say(element, sentences.length ? `✕ ${sentences.join(" ")}` : "✓ met by the chosen linkage");
}

/** A document with other points in a limit. */
function withPoints(document, k, key, change) {
  const [[shape, stated]] = Object.entries(limitPart(limitsOf(document)[k], key));
  return setLimit(document, k, { [key]: shapeOf(shape, change(shape === "point" ? [stated] : stated)) });
}

const range = (least, most) => (least === undefined && most === undefined ? undefined : { ...(least === undefined ? {} : { least }), ...(most === undefined ? {} : { most }) });

/** The kinds that are ticked, or undefined for all of them. */
function kindsOf(kinds) {
  const list = kinds.filter(({ box }) => box.checked).map(({ kind }) => kind);
  return list.length === kinds.length || !list.length ? undefined : list;
}

function some(ticks) {
  const list = ticks.filter(({ box }) => box.checked).map(({ name }) => name);
  return list.length ? list : undefined;
}
